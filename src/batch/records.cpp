#include "batch/records.h"

#include <fmt/format.h>

#include <charconv>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/platform/files.h"
#include "base/write_file.h"
#include "batch/durable.h"

namespace roomlight::batch {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr size_t kIdDigits = 16;

Status keep(const fs::path& file, const Json& json) {
  std::error_code code;
  fs::create_directories(file.parent_path(), code);
  if (code) return cannotWrite(file, code.value());
  return writeDurably(file, json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace

Status keepDone(const Folder& folder, const std::string& id, const DoneRecord& r) {
  return keep(folder.done(id), {{"seconds", r.seconds}, {"peakMiB", r.peakMiB}, {"tries", r.tries}, {"host", r.host}});
}

std::optional<DoneRecord> doneRecord(const Folder& folder, const std::string& id) {
  const Json json = Json::parse(textOf(folder.done(id)), nullptr, false);
  if (!json.is_object()) return std::nullopt;
  return DoneRecord{json.value("seconds", 0.0), json.value("peakMiB", 0.0), json.value("tries", 1),
                    json.value("host", "")};
}

Status keepFailed(const Folder& folder, const std::string& id, const FailedRecord& r) {
  return keep(folder.failed(id),
              {{"line", r.line}, {"how", r.how}, {"tries", r.tries}, {"final", r.isFinal}, {"host", r.host}});
}

std::optional<FailedRecord> failedRecord(const Folder& folder, const std::string& id) {
  const Json json = Json::parse(textOf(folder.failed(id)), nullptr, false);
  if (!json.is_object()) return std::nullopt;
  return FailedRecord{json.value("line", ""), json.value("how", ""), json.value("tries", 0), json.value("final", false),
                      json.value("host", "")};
}

void forgetFailed(const Folder& folder, const std::string& id) {
  std::error_code ignored;
  fs::remove(folder.failed(id), ignored);
}

IdSet idsIn(const fs::path& folder) {
  IdSet ids;
  forEachName(folder, [&](std::string_view part) {
    if (part.size() != 2 || part[0] == '.') return;
    forEachName(folder / part, [&](std::string_view name) {
      uint64_t id = 0;
      const char* const end = name.data() + name.size();
      if (name.size() == kIdDigits && std::from_chars(name.data(), end, id, 16).ptr == end) ids.insert(id);
    });
  });
  return ids;
}

}  // namespace roomlight::batch
