#include "home/light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/parallel.h"
#include "base/random.h"
#include "base/sampling.h"
#include "engine/views.h"
#include "home/cameras.h"
#include "home/rooms.h"
#include "photometry/sun.h"
#include "scene/outline.h"
#include "trace/camera_rays.h"

namespace roomlight::home {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kLatitudeDeg = 48, kLongitudeDeg = 11;
constexpr int kAzimuths = 24;
constexpr float kAltitudesDeg[] = {25, 35, 45, 55};
constexpr double kSunShare = 0.12;            // of what is seen indoors, as much as is wished in the sun
constexpr float kBlueHourDeg = -4;  // altitude of the sun at which the sky is about as bright as lit rooms
constexpr float kNightDeg = -9;  // and at which it is hardly seen from one
constexpr double kGroundReflectance = 0.2;
constexpr double kLeastDaylight = 0.003;  // share of sky or sun; below it are seams between walls
constexpr double kLumenPerM2 = 100, kLeastLumen = 500, kMostLumen = 6000;
constexpr float kUnderThings = 0.0005f;  // of the extent: how far below them the ground lies
constexpr float kUnderCeilingM = 0.06f, kHighestLampM = 3.2f, kLowestLampM = 1.8f;
constexpr size_t kMostLamps = 40;

Vec3 towards(float azimuthRad, float altitudeRad) {
  return {std::sin(azimuthRad) * std::cos(altitudeRad), std::sin(altitudeRad),
          -std::cos(azimuthRad) * std::cos(altitudeRad)};
}

// Share of the sky around a place.
double openness(const RayScene& rays, Vec3 p) {
  constexpr int kRays = 1024;
  std::vector<float> open(kRays);
  parallelFor(open.size(), 64, [&](size_t i) {
    const Vec3 d = sampleSphere(latticePoint(static_cast<int>(i), kRays));
    open[i] = luminance(rays.transmittance({p, d, 0, kInfinity}));
  });
  double sum = 0;
  for (const float o : open) sum += static_cast<double>(o);
  return sum / kRays;
}

// Share of what is seen that light from there falls on.
double shareLit(const RayScene& rays, const std::vector<Seen>& seen, Vec3 toSun) {
  if (seen.empty()) return 0;
  std::vector<float> lit(seen.size(), 0);
  parallelFor(seen.size(), 32, [&](size_t i) {
    const Seen& s = seen[i];
    if (dot(s.n, toSun) > 0.05f) lit[i] = luminance(rays.transmittance({offsetOrigin(s.p, s.n), toSun, 0, kInfinity}));
  });
  double sum = 0;
  for (const float l : lit) sum += static_cast<double>(l);
  return sum / static_cast<double>(seen.size());
}

// Share of the sky over what is seen, weighted as it lights.
double shareOfSky(const RayScene& rays, const std::vector<Seen>& seen) {
  constexpr int kRays = 16;
  if (seen.empty()) return 1;
  std::vector<float> open(seen.size(), 0);
  parallelFor(seen.size(), 16, [&](size_t i) {
    Rng random(i, 0, 0);
    const Frame frame(seen[i].n);
    for (int k = 0; k < kRays; ++k) {
      const Vec3 d = frame.toWorld(sampleCosineHemisphere(random.uniform2()));
      open[i] += luminance(rays.transmittance({offsetOrigin(seen[i].p, seen[i].n), d, 0, kInfinity})) / kRays;
    }
  });
  double sum = 0;
  for (const float o : open) sum += static_cast<double>(o);
  return sum / static_cast<double>(seen.size());
}

// Indoors: where most of the sun comes in, but no more of it than a patch. Where none does, from behind the camera.
Vec3 sunIndoors(const RayScene& rays, const std::vector<Seen>& seen, Vec3 otherwise) {
  Vec3 best = otherwise;
  double bestScore = 0;
  for (const float altitudeDeg : kAltitudesDeg) {
    for (int i = 0; i < kAzimuths; ++i) {
      const Vec3 d = towards(2 * kPi * (static_cast<float>(i) + 0.5f) / kAzimuths, altitudeDeg * kPi / 180);
      const double share = shareLit(rays, seen, d);
      const double score = share < kSunShare ? share : std::max(0.3 * kSunShare, kSunShare - 0.4 * (share - kSunShare));
      if (share > 0.002 && score > bestScore) bestScore = score, best = d;
    }
  }
  return best;
}

// Outdoors: over a shoulder of whoever looks, from the side that lights more.
Vec3 sunOutdoors(const RayScene& rays, const std::vector<Seen>& seen, const Camera& camera) {
  const Vec3 back = camera.worldFromCamera.z;
  const float azimuth = std::atan2(back.x, -back.z);
  Vec3 best;
  double bestShare = -1;
  for (const float turnDeg : {-50.0f, 50.0f, -25.0f, 25.0f, -90.0f, 90.0f}) {
    const Vec3 d = towards(azimuth + turnDeg * kPi / 180, 42 * kPi / 180);
    const double share = shareLit(rays, seen, d) + (std::abs(turnDeg) == 50.0f ? 0.1 : 0);
    if (share > bestShare + 0.02) bestShare = share, best = d;
  }
  return best;
}

// Place and time at which the sun stands there, the plan turned to fit.
Json daylightFrom(Vec3 toSun, const char* sky) {
  const double altitude = std::asin(std::clamp(static_cast<double>(toSun.y), -1.0, 1.0));
  int bestMinute = 0;
  double bestMiss = 10, bearing = 0;
  const int first = altitude < 0 ? 21 * 60 : 5 * 60, last = altitude < 0 ? 23 * 60 : 12 * 60 + 30;
  for (int minute = first; minute <= last; minute += 5) {
    const SunPosition p = sunPosition({2026, 6, 10, minute / 60.0 - 2}, kLatitudeDeg, kLongitudeDeg);
    if (std::abs(p.altitudeRad - altitude) < bestMiss)
      bestMiss = std::abs(p.altitudeRad - altitude), bestMinute = minute, bearing = p.bearingRad;
  }
  const double onPlan = std::atan2(static_cast<double>(toSun.x), -static_cast<double>(toSun.z));
  const double north = std::remainder((bearing - onPlan) * 180 / static_cast<double>(kPi), 360.0);
  return {{"sky", sky},
          {"latitude", kLatitudeDeg},
          {"longitude", kLongitudeDeg},
          {"time", fmt::format("2026-06-10T{:02}:{:02}+02:00", bestMinute / 60, bestMinute % 60)},
          {"north", std::round(north * 10) / 10},
          {"ground", kGroundReflectance}};
}

// Below the horizon, so that the glow of the sky is before the camera, to its left.
Vec3 sunAfterSunset(const Camera& camera, float altitudeDeg) {
  constexpr float kAside = 50 * kPi / 180;
  const float altitude = altitudeDeg * kPi / 180;
  const Vec3 ahead = -camera.worldFromCamera.z;
  const float bearing = std::atan2(ahead.x, -ahead.z) - kAside;
  return {std::sin(bearing) * std::cos(altitude), std::sin(altitude), -std::cos(bearing) * std::cos(altitude)};
}

Json number(float v) { return std::round(static_cast<double>(v) * 1000) / 1000; }
Json place(Vec3 p) { return Json::array({number(p.x), number(p.y), number(p.z)}); }

// How free a lamp at p would shine down: share of rays that go half a metre.
double freedomBelow(const RayScene& rays, Vec3 p) {
  constexpr int kRays = 48;
  const Frame down({0, -1, 0});
  int open = 0;
  for (int i = 0; i < kRays; ++i) {
    open += rays.intersect({p, down.toWorld(sampleCosineHemisphere(latticePoint(i, kRays))), 0, 0.5f}).valid() ? 0 : 1;
  }
  return open / static_cast<double>(kRays);
}

// Under the ceiling, as far from the walls as may be, where nothing hangs.
std::optional<Vec3> lampPlace(const RayScene& rays, const Room& room) {
  constexpr int kSteps = 16;
  const Level box = levelsOf({&room, 1}).front();
  const Vec2 middle = middleOf(room);
  std::optional<Vec3> best;
  double bestScore = 0;
  for (int i = -1; i < kSteps * kSteps; ++i) {
    const Vec2 at = i < 0
                        ? middle
                        : Vec2{box.low.x + (box.high.x - box.low.x) * (static_cast<float>(i % kSteps) + 0.5f) / kSteps,
                               box.low.y + (box.high.y - box.low.y) * (static_cast<float>(i / kSteps) + 0.5f) / kSteps};
    if (!contains(room.floor, at)) continue;
    const double edge = distanceToEdgeM(room.floor, at);
    if (!(edge > bestScore)) continue;
    const Vec3 eye{at.x, room.elevationM + 0.6f * room.heightM, at.y};
    const Hit ceiling = rays.intersect({eye, {0, 1, 0}, 0, kInfinity});
    if (!ceiling.valid()) continue;
    const Vec3 p{at.x, std::min(eye.y + ceiling.t - kUnderCeilingM, room.elevationM + kHighestLampM), at.y};
    if (p.y < room.elevationM + kLowestLampM || insideBody(rays, p)) continue;
    const double free = freedomBelow(rays, p);
    if (free > 0.8 && edge * free > bestScore) bestScore = edge * free, best = p;
  }
  return best;
}

double fluxForLm(const Room& room) {
  return std::round(std::clamp(kLumenPerM2 * areaM2(room), kLeastLumen, kMostLumen) / 50) * 50;
}

Json ceilingLamp(const Room& room, Vec3 p) {
  const double flux = fluxForLm(room), side = std::clamp(0.1 * std::sqrt(areaM2(room)), 0.3, 0.6);
  return {{"name", room.name + " ceiling lamp"},
          {"type", "area"},
          {"position", place(p)},
          {"direction", {0, -1, 0}},
          {"width", std::round(side * 100) / 100},
          {"height", std::round(side * 100) / 100},
          {"flux", fmt::format("{:.0f} lm", flux)},
          {"temperature", "3000 K"}};
}

// Where everything else fails: over the eye, as bright as what is seen is far away.
Json lampOverCamera(const RayScene& rays, const std::vector<Seen>& seen, const Camera& camera) {
  std::vector<float> distances;
  for (const Seen& s : seen) distances.push_back(s.distanceM);
  std::sort(distances.begin(), distances.end());
  const float far = distances.empty() ? 3 : distances[distances.size() / 2];
  const Vec3 eye = camera.worldFromCamera.w, ahead = -camera.worldFromCamera.z;
  const auto reach = [&](Vec3 from, Vec3 d, float most) {
    return std::min(most, 0.5f * rays.intersect({from, d, 0, kInfinity}).t);
  };
  Vec3 p = eye + ahead * reach(eye, ahead, 0.3f * far);
  p.y += reach(p, {0, 1, 0}, 0.8f);
  const double flux = std::clamp(4 * static_cast<double>(kPi) * 60 * static_cast<double>(far * far), kLeastLumen, 1e7);
  return {{"name", "Lamp over the camera"},
          {"type", "point"},
          {"position", place(p)},
          {"flux", fmt::format("{:.0f} lm", flux)},
          {"temperature", "3000 K"}};
}

// Wide enough to end close to the horizon as the camera sees it.
Json groundUnder(const Bounds3& b, const Camera& camera) {
  const float extent = maxComponent(b.size());
  const float eyeHeight = camera.worldFromCamera.w.y - b.lo.y;
  const float radius = std::clamp(std::max(8 * extent, 28 * eyeHeight), 4.0f, std::max(60.0f, 3 * extent));
  const auto fine = [](float v) { return std::round(static_cast<double>(v) * 1e6) / 1e6; };  // things may be small
  return {{"elevation", fine(b.lo.y - kUnderThings * extent)},
          {"centre", {number(b.centre().x), number(b.centre().z)}},
          {"radius", number(radius)},
          {"reflectance", kGroundReflectance}};
}

bool reaches(const RayScene& rays, const std::vector<Json>& lamps, const Seen& s) {
  return std::any_of(lamps.begin(), lamps.end(), [&](const Json& lamp) {
    const Vec3 to = Vec3{lamp["position"][0].get<float>(), lamp["position"][1].get<float>() - 0.01f,
                         lamp["position"][2].get<float>()} -
                    s.p;
    return dot(to, s.n) > 0 && luminance(rays.transmittance({offsetOrigin(s.p, s.n), to, 0, 0.999f})) > 0.01f;
  });
}

double shareReached(const RayScene& rays, const std::vector<Json>& lamps, const std::vector<Seen>& seen) {
  const auto reached = std::count_if(seen.begin(), seen.end(), [&](const Seen& s) { return reaches(rays, lamps, s); });
  return seen.empty() ? 1 : static_cast<double>(reached) / static_cast<double>(seen.size());
}

// Of what is seen, in rooms with a lamp of their own.
double shareWithLamps(const RayScene& rays, const std::vector<Room>& rooms, const std::vector<Seen>& seen) {
  std::vector<Room> withLamps;
  std::copy_if(rooms.begin(), rooms.end(), std::back_inserter(withLamps),
               [&](const Room& room) { return hasLight(rays.scene(), room); });
  const auto isLit = [&](const Seen& s) {
    return std::any_of(withLamps.begin(), withLamps.end(),
                       [&](const Room& room) { return isIn(room, s.p + s.n * 0.05f); });
  };
  return static_cast<double>(std::count_if(seen.begin(), seen.end(), isLit)) /
         static_cast<double>(std::max<size_t>(1, seen.size()));
}

std::string listed(bool daylight, const char* darkSky, size_t ceilingLamps, bool overCamera, bool ground) {
  std::vector<std::string> parts;
  if (daylight) parts.push_back("daylight");
  if (darkSky) parts.push_back(darkSky);
  if (ceilingLamps > 0)
    parts.push_back(ceilingLamps == 1 ? "a ceiling lamp" : fmt::format("{} ceiling lamps", ceilingLamps));
  if (overCamera) parts.push_back("a lamp over the camera");
  if (ground) parts.push_back("a ground");
  std::string text;
  for (size_t i = 0; i < parts.size(); ++i) text += (i == 0 ? "" : i + 1 == parts.size() ? " and " : ", ") + parts[i];
  return text;
}

}  // namespace

bool outdoorLightComesIn(const RayScene& rays, const std::vector<Room>& rooms, const Camera& camera) {
  const Sights sights = sightsOf(rays, camera);
  if (!isIndoors(rays, rooms, camera, sights)) return true;
  double share = rays.scene().sky.present() ? shareOfSky(rays, sights.surfaces) : 0;
  for (const Sun& sun : rays.scene().suns) share += shareLit(rays, sights.surfaces, sun.toLight);
  return share > kLeastDaylight;
}

AddedLight lightFor(const RayScene& rays, const std::vector<Room>& rooms, const Camera& camera, Mood mood,
                    const Json& ownGround) {
  const Sights sights = sightsOf(rays, camera);
  const std::vector<Seen>& seen = sights.surfaces;
  const bool indoors = isIndoors(rays, rooms, camera, sights), dark = mood == Mood::Evening || mood == Mood::Night;
  const Vec3 overShoulder = sunOutdoors(rays, seen, camera);
  const Vec3 toSun = dark || !indoors ? overShoulder : sunIndoors(rays, seen, overShoulder);
  const double daylightReaches = dark ? 0 : shareOfSky(rays, seen) + shareLit(rays, seen, toSun);
  bool daylight = !dark && (!indoors || daylightReaches > kLeastDaylight);

  std::vector<Json> lamps;
  for (const Room& room : rooms) {
    if (lamps.size() >= kMostLamps) break;
    if (hasLight(rays.scene(), room)) continue;
    const std::optional<Vec3> p = lampPlace(rays, room);
    if (!p) continue;
    const bool open = !dark && openness(rays, {p->x, room.elevationM + 0.5f * room.heightM, p->z}) > kLeastDaylight;
    daylight = daylight || open;
    if (mood != Mood::Day || !open) lamps.push_back(ceilingLamp(room, *p));
  }
  const size_t ceilingLamps = lamps.size();
  // Evening and night outdoors are dark but for lamps.
  const bool overCamera = daylightReaches < kLeastDaylight &&
                          shareReached(rays, lamps, seen) + shareWithLamps(rays, rooms, seen) < 0.05 &&
                          (indoors || !dark);
  if (overCamera) lamps.push_back(lampOverCamera(rays, seen, camera));

  AddedLight out;
  Json& j = out.document;
  j["version"] = 1;
  if (mood != Mood::Auto) j["scene"] = {{"suns", "off"}, {"sky", "off"}};
  if (dark) {
    j["daylight"] = daylightFrom(sunAfterSunset(camera, mood == Mood::Night ? kNightDeg : kBlueHourDeg), "clear");
    j["daylight"]["temperature"] = "12000 K";
  } else if (daylight) {
    j["daylight"] = daylightFrom(toSun, indoors ? "clear" : "intermediate");
  }
  const bool addsGround = !indoors && ownGround.is_null();
  if (addsGround) j["ground"] = groundUnder(rays.bounds(), camera);
  if (j.contains("daylight") && !ownGround.is_null()) j["daylight"]["ground"] = ownGround;
  if (!lamps.empty()) j["lamps"] = lamps;
  out.summary = listed(daylight,
                       !dark                 ? nullptr
                       : mood == Mood::Night ? "a night sky"
                                             : "the sky after sunset",
                       ceilingLamps, overCamera, addsGround);
  return out;
}

Json assumedDaylight() {
  return {{"sky", "clear"},
          {"latitude", kLatitudeDeg},
          {"longitude", kLongitudeDeg},
          {"time", "2026-06-10T12:00+02:00"},
          {"ground", kGroundReflectance}};
}

double assumedFluxLm(const std::vector<Room>& rooms, Vec3 position) {
  const auto room = std::find_if(rooms.begin(), rooms.end(), [&](const Room& r) { return isIn(r, position); });
  return room == rooms.end() ? kLeastLumen : fluxForLm(*room);
}

}  // namespace roomlight::home
