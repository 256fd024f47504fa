#include "import/child_process.h"

#include <fmt/format.h>

#include <cstdlib>
#include <exception>
#include <new>
#include <optional>
#include <system_error>

#include "base/platform/module.h"
#include "base/platform/process.h"
#include "import/failure.h"

namespace roomlight::importers {
namespace {

namespace fs = std::filesystem;

constexpr const char* kReader = "roomlight-model-reader";
constexpr unsigned kSeconds = 60;
// A busy machine may give it half of a core.
constexpr ProcessLimits kReaderLimits{
    .coreSeconds = kSeconds, .seconds = 2 * kSeconds, .memoryBytes = uint64_t{8} << 30};
constexpr int kFailed = 3;  // exit status: stdout says why

std::span<const uint8_t> bytesOf(std::string_view text) {
  return {reinterpret_cast<const uint8_t*>(text.data()), text.size()};
}

}  // namespace

fs::path modelReader() {
  if (const char* told = std::getenv("ROOMLIGHT_MODEL_READER"); told && *told) return told;
  std::error_code code;
  for (const fs::path& folder : {moduleFolder(), programFolder()}) {
    if (fs::exists(folder / kReader, code)) return folder / kReader;
  }
  return installed(fs::path("libexec/roomlight") / kReader);
}

Bytes inChildProcess(const fs::path& program, const std::vector<std::string>& arguments,
                     std::span<const uint8_t> input) {
  constexpr const char* kNoProcess = "cannot be read, as no process can be started for it";
  RunToEnd run = runWithInput(program, arguments, input, {0, kFailed});
  if (!run.isStarted && run.error == 0) fail("", kNoProcess);
  if (!run.isStarted)
    fail("", fmt::format("{} ({}: {})", kNoProcess, program.filename().string(),
                         std::generic_category().message(run.error)));
  if (run.exitStatus != 0 && run.exitStatus != kFailed) fail("", "is damaged, or needs too much time or memory");
  if (!run.output) fail("", "cannot be read back from its reader");
  const Bytes& said = *run.output;
  if (run.exitStatus == kFailed)
    fail("", printable(std::string_view(reinterpret_cast<const char*>(said.data()), said.size()), 300));
  return std::move(*run.output);
}

void serveParent(const std::function<Bytes(const Bytes& input)>& work) {
  limitThisProcess(kReaderLimits);
  // Libraries complain on the terminal; what matters comes back as a failure.
  const int result = takeOverOutput();
  if (result < 0) std::_Exit(1);
  int status = 1;
  try {
    const std::optional<Bytes> input = readInput();
    if (input && writeAll(result, work(*input))) status = 0;
  } catch (const std::bad_alloc&) {
    status = 1;
  } catch (const std::exception& e) {
    if (writeAll(result, bytesOf(e.what()))) status = kFailed;
  } catch (...) {
    status = 1;
  }
  std::_Exit(status);  // nothing is left to tidy up
}

}  // namespace roomlight::importers
