#include "mix_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>

#include "arguments.h"
#include "base/parallel.h"
#include "base/write_file.h"
#include "commands.h"
#include "exit_status.h"
#include "mix/floor_plan.h"
#include "output_files.h"

namespace roomlight::cli {
namespace {

constexpr const char *kStatesIndex = "states.json",
                     *kOverlaysIndex = "overlays.json";  // both kinds may lie in one folder
constexpr float kStateQuality = 90;  // of WebP; states are looked at, overlays are summed

Status makeFolder(const std::filesystem::path& folder) {
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  if (std::filesystem::is_directory(folder)) return Ok{};
  return Error{fmt::format("{}: is not a folder and none can be made there", folder.string())};
}

// Pictures that an earlier run wrote into this folder, told by its index; what is written anew is among them.
void removeFormer(const std::filesystem::path& folder, const char* index, const char* list) {
  const Result<std::string> text = readTextFile(folder / index);
  if (!text) return;
  const Json json = Json::parse(text.value(), nullptr, false);
  if (!json.is_object() || !json.contains(list) || !json[list].is_array()) return;
  for (const Json& entry : json[list]) {
    const std::filesystem::path name = entry.is_object() && entry.contains("file") && entry["file"].is_string()
                                           ? entry["file"].get<std::string>()
                                           : "";
    std::error_code ignored;
    if (!name.empty() && name == name.filename())
      std::filesystem::remove(folder / name, ignored);  // folders with something in them stay
  }
}

std::string stateIndex(const MixHome& home, const Switches& switches, const Metadata& metadata,
                       const std::string& extension) {
  Json index = {{"version", 1},     {"width", home.stack.width}, {"height", home.stack.height},
                {"made", metadata}, {"lamps", Json::array()},    {"states", Json::array()}};
  for (const size_t lamp : switches.lamps) index["lamps"].push_back(home.layers[lamp].name);
  for (const uint32_t mask : allStates(switches.lamps.size()))
    index["states"].push_back({{"mask", mask}, {"file", stateName(mask, switches.lamps.size()) + extension}});
  return index.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string told(const OverlayTrial& trial) {
  std::string text;
  for (size_t i = 0; i < kBlendModes.size(); ++i)
    text += fmt::format("{}{} {:.1f}", i ? ", " : "", cssName(kBlendModes[i]), trial.errors[i].rms);
  return text;
}

Status writePages(const FloorPlan& plan, const OverlayTrial& trial, const OverlaysJob& job) {
  if (const Status s = writeWhole(job.folder / "index.html", pageOf(plan)); !s) return s;
  if (const Status s = writeWhole(job.folder / kOverlaysIndex, overlayIndexOf(plan, trial)); !s) return s;
  if (job.cardFile.empty()) return Ok{};
  if (const Status s = writeWhole(job.cardFile, cardOf(plan, job.urlPrefix, job.dimmed)); !s) return s;
  return job.dimmed ? writeWhole(sensorsFileOf(job.cardFile), sensorsOf(plan)) : Status(Ok{});
}

}  // namespace

std::string layerTable(const std::vector<LayerInfo>& layers) {
  size_t widest = 4;
  for (const LayerInfo& l : layers) widest = std::max(widest, l.name.size());
  std::string table = fmt::format("{:<{}}  {:<5}  {:>8}  {:>8}  {:<18}  {}\n", "name", widest, "kind", "colour", "flux",
                                  "linear RGB", "room");
  for (const LayerInfo& l : layers) {
    const std::string kelvin = l.kelvin ? fmt::format("{:.0f} K", *l.kelvin) : "-",
                      flux = l.fluxLm ? fmt::format("{:.0f} lm", *l.fluxLm) : "-";
    const std::string rgb = fmt::format("{:.3f} {:.3f} {:.3f}", l.colour.x, l.colour.y, l.colour.z);
    table += fmt::format("{:<{}}  {:<5}  {:>8}  {:>8}  {:<18}  {}\n", l.name, widest, l.kind, kelvin, flux, rgb,
                         l.room.empty() ? "-" : l.room);
  }
  return table;
}

Status writeBytes(const std::filesystem::path& file, const ByteImage& image, const Metadata& metadata,
                  float webpQuality) {
  const std::string e = lowerExtension(file);
  if (e == ".webp") return writeWebp(file, image, webpQuality);
  if (e == ".jpg") return writeJpeg(file, image, std::numeric_limits<size_t>::max());
  return writePng(file, image, metadata);
}

std::filesystem::path sensorsFileOf(const std::filesystem::path& cardFile) {
  return cardFile.parent_path() / (cardFile.stem().string() + "_sensors.yaml");
}

int writeStates(const MixHome& home, const Switches& switches, const ShownMix& shown, const Metadata& metadata,
                const StatesJob& job, ProgressDisplay& display) {
  if (const Status s = makeFolder(job.folder); !s) return failed(s.error(), kFailed);
  removeFormer(job.folder, kStatesIndex, "states");
  if (const Status s = writeWhole(job.folder / kStatesIndex, stateIndex(home, switches, metadata, job.extension)); !s)
    return failed(s.error(), kFailed);
  const std::vector<uint32_t> states = allStates(switches.lamps.size());
  std::mutex oneAtATime;
  std::string error;
  size_t written = 0;
  std::atomic<bool> stop = false;
  display.report("states", 0);
  // Every state is mixed anew: that is exact, and takes a fraction of the time that writing its picture takes.
  parallelFor(states.size(), 1, [&](size_t i) {
    if (stop || interrupted()) return;
    const ByteImage image = displayMix(home, gainsOfState(switches, states[i]), shown.look, job.extension != ".jpg");
    const Status s = writeBytes(job.folder / (stateName(states[i], switches.lamps.size()) + job.extension), image,
                                metadata, kStateQuality);
    const std::lock_guard lock(oneAtATime);
    if (!s && !stop.exchange(true)) error = s.error();
    if (s) display.report("states", static_cast<float>(++written) / static_cast<float>(states.size()));
  });
  if (stop) return failed(error, kFailed);
  if (written < states.size()) {
    printError(fmt::format("interrupted: {} of {} states are written", written, states.size()));
    return kInterrupted;
  }
  display.line(fmt::format("wrote {} states of {} lamps to {}, told by its {}", states.size(), switches.lamps.size(),
                           job.folder.string(), kStatesIndex));
  return kOk;
}

int writeOverlays(const MixHome& home, const Switches& switches, const ShownMix& shown, const Metadata& metadata,
                  const OverlaysJob& job, ProgressDisplay& display) {
  if (const Status s = makeFolder(job.folder); !s) return failed(s.error(), kFailed);
  removeFormer(job.folder, kOverlaysIndex, "overlays");
  const OverlayTrial trial = tryOverlays(home.stack, switches, shown.look);
  FloorPlan plan = planOf(home.layers, switches, job.entities, job.extension);
  plan.width = home.stack.width, plan.height = home.stack.height;
  const auto least = std::min_element(trial.errors.begin(), trial.errors.end(),
                                      [](const BlendError& a, const BlendError& b) { return a.rms < b.rms; });
  plan.blend = job.blend.value_or(kBlendModes[static_cast<size_t>(least - trial.errors.begin())]);
  const ByteImage base = displayMix(home, gainsOfState(switches, 0), shown.look, false);
  if (const Status s = writeBytes(job.folder / plan.baseFile,
                                  displayMix(home, gainsOfState(switches, 0), shown.look, true), metadata, kLossless);
      !s)
    return failed(s.error(), kFailed);
  display.report("overlays", 0);
  for (size_t i = 0; i < plan.lamps.size(); ++i) {
    if (interrupted()) {
      printError(fmt::format("interrupted: {} of {} overlays are written", i, plan.lamps.size()));
      return kInterrupted;
    }
    plan.lamps[i].opacities = trial.opacities[i];
    const ByteImage lit = displayMix(home, gainsOfState(switches, uint64_t{1} << i), shown.look, false);
    if (const Status s =
            writeBytes(job.folder / plan.lamps[i].file, overlayOf(base, lit, plan.blend), metadata, kLossless);
        !s)
      return failed(s.error(), kFailed);
    display.report("overlays", static_cast<float>(i + 1) / static_cast<float>(plan.lamps.size()));
  }
  if (const Status s = writePages(plan, trial, job); !s) return failed(s.error(), kFailed);
  display.line(fmt::format("wrote base and {} overlays to {}, for mix-blend-mode: {}; open its index.html",
                           plan.lamps.size(), job.folder.string(), cssName(plan.blend)));
  display.line(fmt::format("error of several lamps together, root mean square in steps of 1/255: {}", told(trial)));
  if (!job.cardFile.empty())
    display.line(
        fmt::format("wrote {}{}", job.cardFile, job.dimmed ? " and " + sensorsFileOf(job.cardFile).string() : ""));
  return kOk;
}

}  // namespace roomlight::cli
