#include "engine/settings.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "engine/quality.h"

namespace roomlight {
namespace {

// Keeps the members in the order in which they are written.
using Json = nlohmann::ordered_json;

constexpr int64_t kLargestPicture = int64_t{1} << 27;  // pixels; also what the picture readers accept

template <class T>
struct Choice {
  const char* name;
  T value;
};
constexpr Choice<Attenuation> kAttenuations[] = {{"plain", Attenuation::Plain},
                                                 {"normalWeighted", Attenuation::NormalWeighted}};
constexpr Choice<BounceBy> kBounces[] = {{"rays", BounceBy::Rays}, {"cones", BounceBy::Cones}};
constexpr Choice<PhotonKernel> kKernels[] = {
    {"disc", PhotonKernel::Disc}, {"cone", PhotonKernel::Cone}, {"epanechnikov", PhotonKernel::Epanechnikov}};

// The one list of members: name, where it is, smallest and largest value. Reader, writer and range check all walk it.
template <class Visitor, class Settings>
void visitMembers(Visitor& v, Settings& s) {
  v.text("technique", s.technique);
  v.text("quality", s.quality);
  v.number("width", s.width, 1, 65536);
  v.number("height", s.height, 1, 65536);
  v.number("samples", s.samples, 0, 1 << 24);
  v.number("timeLimitS", s.timeLimitS, 0, 1e9);
  v.number("noiseLevel", s.noiseLevel, 0, 1);
  v.number("seed", s.seed, 0, std::numeric_limits<uint64_t>::max());
  v.flag("layers", s.layers);
  v.flag("layersByRoom", s.layersByRoom);
  v.number("threads", s.threads, 0, 1024);
  v.flag("blend", s.blend);
  v.number("blendUntilMse", s.blendUntilMse, 0, 1);
  v.group("path", [&](auto& g) {
    g.flag("lightPaths", s.path.lightPaths);
    g.flag("filter", s.path.filter);
  });
  v.group("voxel", [&](auto& g) {
    g.number("voxelSizeM", s.voxel.voxelSizeM, 0, 10);
    g.number("sizeFactor", s.voxel.sizeFactor, 0.1, 10);
    g.number("memoryBudgetMiB", s.voxel.memoryBudgetMiB, 1, 1e6);
    g.number("smallestM", s.voxel.smallestM, 1e-4, 10);
    g.number("largestM", s.voxel.largestM, 1e-4, 10);
  });
  v.group("radiance", [&](auto& g) {
    g.choice("attenuation", s.radiance.attenuation, kAttenuations);
    g.number("directSamples", s.radiance.directSamples, 1, 4096);
    g.number("links", s.radiance.links, 1, 4096);
    g.choice("bounceBy", s.radiance.bounceBy, kBounces);
    g.number("residual", s.radiance.residual, 1e-6, 1);
    g.number("maxBounces", s.radiance.maxBounces, 0, 100000);
    g.number("bouncesAtOnce", s.radiance.bouncesAtOnce, 0, 100000);
    g.flag("emittersApart", s.radiance.emittersApart);
  });
  v.group("hybrid", [&](auto& g) {
    g.number("firstSamples", s.hybrid.firstSamples, 1, 8);
    g.number("tolerance", s.hybrid.tolerance, 0, 1);
    g.number("raysPerShading", s.hybrid.raysPerShading, 1, 8);
    g.number("estimates", s.hybrid.estimates, 1, 256);
    g.number("gatherEvery", s.hybrid.gatherEvery, 1, 16);
    g.number("nearVoxels", s.hybrid.nearVoxels, 0, 1000);
    g.number("hitCellM", s.hybrid.hitCellM, -1, 10);
    g.number("hitSamples", s.hybrid.hitSamples, 1, 4096);
    g.number("causticPhotons", s.hybrid.causticPhotons, 0, 1 << 26);
    g.number("rayRoughness", s.hybrid.rayRoughness, 0, 1);
    g.number("filterPasses", s.hybrid.filterPasses, 0, 8);
  });
  v.group("gather", [&](auto& g) {
    g.number("raysPerShading", s.gather.raysPerShading, 1, 8);
    g.number("conesPerShading", s.gather.conesPerShading, 1, 4096);
    g.number("coneHalfAngleDeg", s.gather.coneHalfAngleDeg, 0.1, 60);
    g.number("startOffsetVoxels", s.gather.startOffsetVoxels, 0, 8);
    g.number("rayRoughness", s.gather.rayRoughness, 0, 1);
    g.number("filterPasses", s.gather.filterPasses, 0, 8);
    g.number("occlusionLambda", s.gather.occlusionLambda, 0, 1000);
    g.color("ambientCdM2", s.gather.ambientCdM2, 1e9);
  });
  v.group("vxgi", [&](auto& g) {
    g.number("resolution", s.vxgi.resolution, 8, 256);
    g.number("levels", s.vxgi.levels, 1, 8);
    g.number("voxelSizeM", s.vxgi.voxelSizeM, 0, 10);
    g.number("cones", s.vxgi.cones, 1, 4096);
    g.number("tracingStep", s.vxgi.tracingStep, 0.05, 4);
    g.number("maxSamples", s.vxgi.maxSamples, 1, 65536);
    g.number("startOffsetVoxels", s.vxgi.startOffsetVoxels, 0, 16);
    g.flag("rotateCones", s.vxgi.rotateCones);
    g.number("directSamples", s.vxgi.directSamples, 1, 4096);
    g.number("residual", s.vxgi.residual, 1e-6, 1);
    g.number("maxBounces", s.vxgi.maxBounces, 0, 100000);
    g.number("bouncesAtOnce", s.vxgi.bouncesAtOnce, 0, 100000);
    g.number("raysPerShading", s.vxgi.raysPerShading, 1, 8);
    g.number("rayRoughness", s.vxgi.rayRoughness, 0, 1);
    g.number("filterPasses", s.vxgi.filterPasses, 0, 8);
  });
  v.group("lpv", [&](auto& g) {
    g.number("cells", s.lpv.cells, 8, 256);
    g.number("coarseCells", s.lpv.coarseCells, 0, 256);
    g.number("coarseReach", s.lpv.coarseReach, 0, 100);
    g.number("steps", s.lpv.steps, 0, 100000);
    g.number("mapSize", s.lpv.mapSize, 8, 8192);
    g.number("mostMaps", s.lpv.mostMaps, 1, 65536);
    g.number("skySamples", s.lpv.skySamples, 1, 4096);
    g.flag("geometry", s.lpv.geometry);
    g.flag("bounces", s.lpv.bounces);
    g.flag("dampening", s.lpv.dampening);
    g.number("lookUpCells", s.lpv.lookUpCells, 0, 4);
    g.number("glossySteps", s.lpv.glossySteps, 1, 1024);
    g.number("raysPerShading", s.lpv.raysPerShading, 1, 8);
    g.number("rayRoughness", s.lpv.rayRoughness, 0, 1);
    g.number("filterPasses", s.lpv.filterPasses, 0, 8);
  });
  v.group("photon", [&](auto& g) {
    g.number("photons", s.photon.photons, 1000, 100000000);
    g.number("causticPhotons", s.photon.causticPhotons, 0, 100000000);
    g.number("nearest", s.photon.nearest, 2, 10000);
    g.number("causticNearest", s.photon.causticNearest, 2, 10000);
    g.choice("kernel", s.photon.kernel, kKernels);
    g.number("flatness", s.photon.flatness, 1, 100);
    g.number("largestRadiusM", s.photon.largestRadiusM, 1e-3, 1000);
    g.number("edgeRays", s.photon.edgeRays, 0, 64);
    g.number("finalGather", s.photon.finalGather, 0, 65536);
    g.number("irradianceEvery", s.photon.irradianceEvery, 1, 1000);
    g.number("nearRadii", s.photon.nearRadii, 0, 100);
    g.number("rouletteDepth", s.photon.rouletteDepth, 0, 1000);
    g.number("importons", s.photon.importons, 256, 1 << 24);
    g.number("mostEmitted", s.photon.mostEmitted, 1, 1e6);
    g.number("raysPerShading", s.photon.raysPerShading, 1, 8);
    g.number("rayRoughness", s.photon.rayRoughness, 0, 1);
    g.number("filterPasses", s.photon.filterPasses, 0, 8);
  });
  v.group("frames", [&](auto& g) {
    g.flag("reuse", s.frames.reuse);
    g.number("every", s.frames.every, 1, 256);
    g.number("everyStill", s.frames.everyStill, 1, 256);
    g.number("everyStale", s.frames.everyStale, 1, 256);
    g.number("everyVeil", s.frames.everyVeil, 1, 256);
    g.number("mostOfVeil", s.frames.mostOfVeil, 1, 1e6);
    g.number("quickMs", s.frames.quickMs, 0, 1e6);
    g.number("mostEstimates", s.frames.mostEstimates, 1, 1e6);
    g.number("smoothEstimates", s.frames.smoothEstimates, 0, 1e6);
    g.number("staleEstimates", s.frames.staleEstimates, 1e-6, 1e6);
    g.number("mostWhileMoving", s.frames.mostWhileMoving, 1, 1e6);
    g.number("nearM", s.frames.nearM, 0, 1000);
  });
}

template <class T>
Error outOfRange(const std::string& where, T low, T high) {
  return {fmt::format("{}: must be from {} to {}", where, low, high)};
}

// Shortest decimal number that reads back as the same float: 0.02, not 0.0199999996.
double tidy(float v) { return std::stod(fmt::format("{}", v)); }
template <class T>
T tidy(T v) {
  return v;
}

class Writer {
 public:
  Json json = Json::object();
  void text(const char* name, const std::string& value) { json[name] = value; }
  template <class T, class L, class H>
  void number(const char* name, const T& value, L, H) {
    json[name] = tidy(value);
  }
  void flag(const char* name, bool value) { json[name] = value; }
  template <class T, size_t N>
  void choice(const char* name, const T& value, const Choice<T> (&choices)[N]) {
    for (const Choice<T>& c : choices) {
      if (c.value == value) json[name] = c.name;
    }
  }
  void color(const char* name, Vec3 value, double) { json[name] = {tidy(value.x), tidy(value.y), tidy(value.z)}; }
  template <class Visit>
  void group(const char* name, Visit&& visit) {
    Writer inner;
    visit(inner);
    json[name] = inner.json;
  }
};

class RangeCheck {
 public:
  explicit RangeCheck(std::string path = {}) : path_(std::move(path)) {}
  std::optional<Error> error;
  void text(const char*, const std::string&) {}
  template <class T, class L, class H>
  void number(const char* name, const T& value, L low, H high) {
    if (error) return;
    // Written so that a NaN fails.
    if (!(value >= static_cast<T>(low) && value <= static_cast<T>(high))) {
      error = outOfRange(path_ + name, static_cast<T>(low), static_cast<T>(high));
    }
  }
  void flag(const char*, bool) {}
  template <class T, size_t N>
  void choice(const char*, const T&, const Choice<T> (&)[N]) {}
  void color(const char* name, Vec3 value, double high) {
    for (int c = 0; c < 3; ++c) number(name, static_cast<double>(value[c]), 0, high);
  }
  template <class Visit>
  void group(const char* name, Visit&& visit) {
    RangeCheck inner(path_ + name + ".");
    visit(inner);
    if (!error) error = inner.error;
  }

 private:
  std::string path_;
};

class Reader {
 public:
  Reader(const Json& json, std::string where) : json_(json), where_(std::move(where)) {
    if (!json_.is_object()) error = Error{fmt::format("{}: must be an object", where_)};
  }
  std::optional<Error> error;

  void text(const char* name, std::string& value) {
    const Json* j = find(name);
    if (!j) return;
    if (!j->is_string()) return fail(name, "must be a text");
    value = j->get<std::string>();
  }
  template <class T, class L, class H>
  void number(const char* name, T& value, L low, H high) {
    const Json* j = find(name);
    if (!j) return;
    if (!j->is_number()) return fail(name, "must be a number");
    if constexpr (std::is_integral_v<T>) {
      // As a double first: 1e30 or -1 must not wrap round to something that looks right.
      const double v = j->get<double>();
      if (!j->is_number_integer()) return fail(name, "must be a whole number");
      if (v < static_cast<double>(low) || v > static_cast<double>(high)) return range<T>(name, low, high);
      value = j->get<T>();
    } else {
      const auto v = j->get<T>();
      if (!(v >= static_cast<T>(low) && v <= static_cast<T>(high))) return range<T>(name, low, high);
      value = v;
    }
  }
  void flag(const char* name, bool& value) {
    const Json* j = find(name);
    if (!j) return;
    if (!j->is_boolean()) return fail(name, "must be true or false");
    value = j->get<bool>();
  }
  template <class T, size_t N>
  void choice(const char* name, T& value, const Choice<T> (&choices)[N]) {
    std::string chosen, names;
    text(name, chosen);
    if (error || !json_.contains(name)) return;
    for (const Choice<T>& c : choices) {
      names += (names.empty() ? "" : ", ") + std::string(c.name);
      if (chosen == c.name) return static_cast<void>(value = c.value);
    }
    error = Error{fmt::format("{}/{}: unknown value '{}'; there are {}", where_, name, chosen, names)};
  }
  void color(const char* name, Vec3& value, double high) {
    const Json* j = find(name);
    if (!j) return;
    if (!j->is_array() || j->size() != 3) return fail(name, "must be a list of three numbers");
    for (size_t c = 0; c < 3; ++c) {
      if (!(*j)[c].is_number()) return fail(name, "must be a list of three numbers");
      const double v = (*j)[c].get<double>();
      if (!(v >= 0 && v <= high)) return range<double>(name, 0, high);
      value[static_cast<int>(c)] = static_cast<float>(v);
    }
  }
  template <class Visit>
  void group(const char* name, Visit&& visit) {
    const Json* j = find(name);
    if (!j) return;
    Reader inner(*j, where_ + "/" + name);
    visit(inner);
    inner.finish();
    if (!error) error = inner.error;
  }
  // Call last: a key that nobody asked for is a mistake in spelling.
  void finish() {
    if (error) return;
    for (const auto& [key, value] : json_.items()) {
      if (known_.count(key)) continue;
      std::string list;
      for (const std::string& k : known_) list += (list.empty() ? "" : ", ") + k;
      error = Error{fmt::format("{}/{}: unknown key; there are {}", where_, key, list)};
      return;
    }
  }

 private:
  const Json* find(const char* name) {
    known_.insert(name);
    if (error) return nullptr;
    const auto it = json_.find(name);
    return it == json_.end() ? nullptr : &*it;
  }
  void fail(const char* name, const char* what) { error = Error{fmt::format("{}/{}: {}", where_, name, what)}; }
  template <class T, class L, class H>
  void range(const char* name, L low, H high) {
    error = outOfRange(fmt::format("{}/{}", where_, name), static_cast<T>(low), static_cast<T>(high));
  }

  const Json& json_;
  std::string where_;
  std::set<std::string> known_;
};

}  // namespace

std::string settingsToJson(const RenderSettings& settings) {
  Writer writer;
  visitMembers(writer, settings);
  return writer.json.dump(2, ' ', false, Json::error_handler_t::replace);
}

Result<RenderSettings> settingsFromJson(std::string_view text, const std::string& where, const RenderSettings& defaults,
                                        const std::string& quality) {
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Json::exception& e) {
    return Error{fmt::format("{}: not valid JSON: {}", where, e.what())};
  }
  RenderSettings settings = defaults;
  // What a quality stands for comes first, so that the other members go before it wherever they are in the text.
  std::string chosen = quality;
  if (quality.empty()) Reader(json, where + ": ").text("quality", chosen);
  if (!chosen.empty()) {
    if (const Status status = applyQuality(chosen, settings); !status)
      return Error{fmt::format("{}: {}", where, status.error())};
  }
  Reader reader(json, where + ": ");
  visitMembers(reader, settings);
  reader.finish();
  if (reader.error) return *reader.error;
  if (!quality.empty()) settings.quality = quality;
  return settings;
}

Status checkSettings(const RenderSettings& settings) {
  RangeCheck check;
  visitMembers(check, settings);
  if (check.error) return *check.error;
  RenderSettings named;
  if (const Status status = applyQuality(settings.quality, named); !status) return status;
  if (int64_t{settings.width} * settings.height > kLargestPicture) {
    return Error{fmt::format("width, height: {} x {} pixels are more than {}", settings.width, settings.height,
                             kLargestPicture)};
  }
  if (settings.voxel.smallestM > settings.voxel.largestM) {
    return Error{fmt::format("voxel.smallestM: must not be above voxel.largestM: {} > {}", settings.voxel.smallestM,
                             settings.voxel.largestM)};
  }
  if (settings.vxgi.resolution % 2 != 0)
    return Error{
        fmt::format("vxgi.resolution: must be even, for coarser voxels are made of two finer ones each way: {}",
                    settings.vxgi.resolution)};
  return Ok{};
}

}  // namespace roomlight
