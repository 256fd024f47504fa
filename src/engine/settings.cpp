#include "engine/settings.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <optional>
#include <set>

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

// The one list of members, by groups: name, where it is, smallest and largest value. Reader, writer and range check all
// walk it as `v`; the settings are constant for all but the reader.
void visitPath(auto& v, auto& s) {
  v.flag("lightPaths", s.lightPaths);
  v.flag("caustics", s.caustics);
  v.flag("filter", s.filter);
}

void visitVoxel(auto& v, auto& s) {
  v.number("voxelSizeM", s.voxelSizeM, 0, 10);
  v.number("sizeFactor", s.sizeFactor, 0.1, 10);
  v.number("memoryBudgetMiB", s.memoryBudgetMiB, 1, 1e6);
  v.number("smallestM", s.smallestM, 1e-4, 10);
  v.number("largestM", s.largestM, 1e-4, 10);
}

void visitRadiance(auto& v, auto& s) {
  v.choice("attenuation", s.attenuation, kAttenuations);
  v.number("directSamples", s.directSamples, 1, 4096);
  v.number("links", s.links, 1, 4096);
  v.choice("bounceBy", s.bounceBy, kBounces);
  v.number("residual", s.residual, 1e-6, 1);
  v.number("maxBounces", s.maxBounces, 0, 100000);
  v.number("bouncesAtOnce", s.bouncesAtOnce, 0, 100000);
  v.flag("emittersApart", s.emittersApart);
}

void visitHybrid(auto& v, auto& s) {
  v.number("firstSamples", s.firstSamples, 1, 8);
  v.number("tolerance", s.tolerance, 0, 1);
  v.number("raysPerShading", s.raysPerShading, 1, 8);
  v.number("estimates", s.estimates, 1, 256);
  v.number("gatherEvery", s.gatherEvery, 1, 16);
  v.number("nearVoxels", s.nearVoxels, 0, 1000);
  v.number("hitCellM", s.hitCellM, -1, 10);
  v.number("hitSamples", s.hitSamples, 1, 4096);
  v.number("causticPhotons", s.causticPhotons, 0, 1 << 26);
  v.number("rayRoughness", s.rayRoughness, 0, 1);
  v.number("filterPasses", s.filterPasses, 0, 8);
}

void visitCone(auto& v, auto& s) {
  v.number("raysPerShading", s.raysPerShading, 1, 8);
  v.number("conesPerShading", s.conesPerShading, 1, 4096);
  v.number("coneHalfAngleDeg", s.coneHalfAngleDeg, 0.1, 60);
  v.number("startOffsetVoxels", s.startOffsetVoxels, 0, 8);
  v.number("rayRoughness", s.rayRoughness, 0, 1);
  v.number("filterPasses", s.filterPasses, 0, 8);
  v.number("occlusionLambda", s.occlusionLambda, 0, 1000);
  v.color("ambientCdM2", s.ambientCdM2, 1e9);
}

// Of techniques for comparison, which shade and filter alike.
void visitShading(auto& v, auto& s) {
  v.number("raysPerShading", s.raysPerShading, 1, 8);
  v.number("rayRoughness", s.rayRoughness, 0, 1);
  v.number("filterPasses", s.filterPasses, 0, 8);
}

void visitVxgi(auto& v, auto& s) {
  v.number("resolution", s.resolution, 8, 256);
  v.number("levels", s.levels, 1, 8);
  v.number("voxelSizeM", s.voxelSizeM, 0, 10);
  v.number("cones", s.cones, 1, 4096);
  v.number("tracingStep", s.tracingStep, 0.05, 4);
  v.number("maxSamples", s.maxSamples, 1, 65536);
  v.number("startOffsetVoxels", s.startOffsetVoxels, 0, 16);
  v.flag("rotateCones", s.rotateCones);
  v.number("directSamples", s.directSamples, 1, 4096);
  v.number("residual", s.residual, 1e-6, 1);
  v.number("maxBounces", s.maxBounces, 0, 100000);
  v.number("bouncesAtOnce", s.bouncesAtOnce, 0, 100000);
  visitShading(v, s);
}

void visitLpv(auto& v, auto& s) {
  v.number("cells", s.cells, 8, 256);
  v.number("coarseCells", s.coarseCells, 0, 256);
  v.number("coarseReach", s.coarseReach, 0, 100);
  v.number("steps", s.steps, 0, 100000);
  v.number("mapSize", s.mapSize, 8, 8192);
  v.number("mostMaps", s.mostMaps, 1, 65536);
  v.number("skySamples", s.skySamples, 1, 4096);
  v.flag("geometry", s.geometry);
  v.flag("bounces", s.bounces);
  v.flag("dampening", s.dampening);
  v.number("lookUpCells", s.lookUpCells, 0, 4);
  v.number("glossySteps", s.glossySteps, 1, 1024);
  visitShading(v, s);
}

void visitPhoton(auto& v, auto& s) {
  v.number("photons", s.photons, 1000, 100000000);
  v.number("causticPhotons", s.causticPhotons, 0, 100000000);
  v.number("nearest", s.nearest, 2, 10000);
  v.number("causticNearest", s.causticNearest, 2, 10000);
  v.choice("kernel", s.kernel, kKernels);
  v.number("flatness", s.flatness, 1, 100);
  v.number("largestRadiusM", s.largestRadiusM, 1e-3, 1000);
  v.number("edgeRays", s.edgeRays, 0, 64);
  v.number("finalGather", s.finalGather, 0, 65536);
  v.number("irradianceEvery", s.irradianceEvery, 1, 1000);
  v.number("nearRadii", s.nearRadii, 0, 100);
  v.number("rouletteDepth", s.rouletteDepth, 0, 1000);
  v.number("importons", s.importons, 256, 1 << 24);
  v.number("mostEmitted", s.mostEmitted, 1, 1e6);
  visitShading(v, s);
}

void visitFrames(auto& v, auto& s) {
  v.flag("reuse", s.reuse);
  v.number("every", s.every, 1, 256);
  v.number("everyStill", s.everyStill, 1, 256);
  v.number("everyStale", s.everyStale, 1, 256);
  v.number("everyVeil", s.everyVeil, 1, 256);
  v.number("mostOfVeil", s.mostOfVeil, 1, 1e6);
  v.number("quickMs", s.quickMs, 0, 1e6);
  v.number("mostEstimates", s.mostEstimates, 1, 1e6);
  v.number("smoothEstimates", s.smoothEstimates, 0, 1e6);
  v.number("staleEstimates", s.staleEstimates, 1e-6, 1e6);
  v.number("mostWhileMoving", s.mostWhileMoving, 1, 1e6);
  v.number("nearM", s.nearM, 0, 1000);
}

void visitMembers(auto& v, auto& s) {
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
  v.group("path", [&](auto& g) { visitPath(g, s.path); });
  v.group("voxel", [&](auto& g) { visitVoxel(g, s.voxel); });
  v.group("radiance", [&](auto& g) { visitRadiance(g, s.radiance); });
  v.group("hybrid", [&](auto& g) { visitHybrid(g, s.hybrid); });
  v.group("cone", [&](auto& g) { visitCone(g, s.cone); });
  v.group("vxgi", [&](auto& g) { visitVxgi(g, s.vxgi); });
  v.group("lpv", [&](auto& g) { visitLpv(g, s.lpv); });
  v.group("photon", [&](auto& g) { visitPhoton(g, s.photon); });
  v.group("frames", [&](auto& g) { visitFrames(g, s.frames); });
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

const char* version() { return ROOMLIGHT_VERSION; }

}  // namespace roomlight
