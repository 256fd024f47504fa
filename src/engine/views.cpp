#include "engine/views.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <tuple>

#include "scene/find_named.h"
#include "scene/outline.h"
#include "trace/camera_rays.h"

namespace roomlight {
namespace {

constexpr float kStandM = 2.0f;         // ceilings lower than this are those of cupboards
constexpr float kUnderCeilingM = 0.05f;
constexpr float kBesideM = 1;           // of a plan around the floors: walls and a margin,
constexpr float kBesideAllM = 0.3f;     // but no more than this around everything
constexpr float kEyeM = 1.6f;           // of who stands in a panorama
constexpr float kTopFovRad = 0.9f;
constexpr int kLongerSidePixels = 1200, kPanoramaPixels = 2048;
constexpr std::pair<const char*, View> kViews[] = {{"camera", View::Camera},
                                                   {"top", View::Top},
                                                   {"plan", View::Plan},
                                                   {"panorama", View::Panorama},
                                                   {"stereo", View::Stereo}};

// A number from 0; -1: none of so many.
int indexOf(size_t count, const std::string& wanted) {
  size_t index = 0;
  const auto [end, code] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
  return code == std::errc() && end == wanted.data() + wanted.size() && index < count ? static_cast<int>(index) : -1;
}

// Panoramas stand upright: of where a camera looks only the compass direction is kept.
Affine upright(const Affine& m) {
  const Vec3 level{m.z.x, 0, m.z.z};
  return looking(m.w, length(level) > 1e-4f ? -level : Vec3{0, 0, -1});
}

void widen(Level& level, const Room& room) {
  for (const Vec2 c : room.floor) {
    level.low = {std::min(level.low.x, c.x), std::min(level.low.y, c.y)};
    level.high = {std::max(level.high.x, c.x), std::max(level.high.y, c.y)};
  }
}

Level levelAt(float elevationM) { return {elevationM, kInfinity, {kInfinity, kInfinity}, {-kInfinity, -kInfinity}}; }

Result<const Room*> pickRoom(std::span<const Room> rooms, const std::string& wanted) {
  const Result<size_t> found = findRoom(rooms, wanted);
  if (!found) return Error{"--room: " + found.error()};
  return &rooms[found.value()];
}

// The floor that is shown, and how much of it.
Result<Level> pickLevel(const Scene& scene, std::span<const Room> rooms, const ViewWish& wish) {
  const std::vector<Level> levels = levelsOf(rooms);
  if (!wish.room.empty()) {
    const Result<const Room*> room = pickRoom(rooms, wish.room);
    if (!room) return Error{room.error()};
    Level only = levelAt(room.value()->elevationM);
    only.ceilingM = only.elevationM + room.value()->heightM;
    widen(only, *room.value());
    return only;
  }
  if (levels.empty()) {
    if (!wish.level.empty())
      return Error{fmt::format("--level {}: the scene knows no rooms and none were found, so that it has no levels",
                               wish.level)};
    const Bounds3 b = scene.bounds();
    return Level{b.lo.y, b.hi.y, {b.lo.x, b.lo.z}, {b.hi.x, b.hi.z}};
  }
  if (wish.level.empty()) {
    // The one at the ground.
    return *std::min_element(levels.begin(), levels.end(), [](const Level& a, const Level& b) {
      return std::abs(a.elevationM) < std::abs(b.elevationM);
    });
  }
  const int index = indexOf(levels.size(), wish.level);
  std::string list;
  for (size_t i = 0; i < levels.size(); ++i)
    list += fmt::format("{}{} at {:.2f} m", i > 0 ? ", " : "", i, levels[i].elevationM);
  if (index < 0) return Error{fmt::format("--level {}: no such level; there are {}", wish.level, list)};
  return levels[static_cast<size_t>(index)];
}

float cutHeight(const Level& level, const ViewWish& wish) {
  return wish.cutM ? level.elevationM + *wish.cutM : level.ceilingM - kUnderCeilingM;
}

Result<Viewed> fromAbove(const Scene& scene, std::span<const Room> rooms, const ViewWish& wish) {
  const Result<Level> level = pickLevel(scene, rooms, wish);
  if (!level) return Error{level.error()};
  const Level& l = level.value();
  const Bounds3 all = scene.bounds();
  Vec2 low{l.low.x - kBesideM, l.low.y - kBesideM}, high{l.high.x + kBesideM, l.high.y + kBesideM};
  if (!all.empty()) {
    low = {std::max(low.x, all.lo.x - kBesideAllM), std::max(low.y, all.lo.z - kBesideAllM)};
    high = {std::min(high.x, all.hi.x + kBesideAllM), std::min(high.y, all.hi.z + kBesideAllM)};
  }
  const float acrossM = high.x - low.x, downM = high.y - low.y;
  Viewed out;
  if (wish.size) {
    std::tie(out.width, out.height) = *wish.size;
  } else {
    const float mpp = wish.metresPerPixel.value_or(std::max(acrossM, downM) / static_cast<float>(kLongerSidePixels));
    const float width = std::ceil(acrossM / mpp - 1e-3f), height = std::ceil(downM / mpp - 1e-3f);
    if (!(std::max(width, height) <= 65536))
      return Error{
          fmt::format("--metres-per-pixel {}: the picture would be {:.0f} x {:.0f} pixels; give more metres, or --size",
                      mpp, width, height)};
    out.width = std::max(1, static_cast<int>(width)), out.height = std::max(1, static_cast<int>(height));
  }
  Camera& c = out.camera;
  c.cutHeightM = cutHeight(l, wish);
  c.emptyBackdrop = true;
  c.worldFromCamera = looking({0.5f * (low.x + high.x), c.cutHeightM + 1, 0.5f * (low.y + high.y)}, {0, -1, 0});
  // Metres a pixel at the cut, that all of it fits.
  const float fit = std::max(acrossM / static_cast<float>(out.width), downM / static_cast<float>(out.height));
  const float halfHeightM =
      0.5f * static_cast<float>(out.height) * (wish.view == View::Plan ? wish.metresPerPixel.value_or(fit) : fit);
  if (wish.view == View::Plan) {
    c.projection = Projection::Orthographic;
    c.yMagM = halfHeightM;
    c.name = "plan";
  } else {
    c.yFovRad = wish.yFovRad.value_or(kTopFovRad);
    c.worldFromCamera.w.y = c.cutHeightM + halfHeightM / std::tan(0.5f * c.yFovRad);
    c.name = "top";
  }
  return out;
}

Result<Viewed> around(std::span<const Room> rooms, const Camera& placed, bool isPlaced, const ViewWish& wish) {
  const bool stereo = wish.view == View::Stereo;
  Viewed out{placed, kPanoramaPixels, stereo ? kPanoramaPixels : kPanoramaPixels / 2};
  if (wish.size) {
    std::tie(out.width, out.height) = *wish.size;
    if (out.width != out.height * (stereo ? 1 : 2)) {
      return Error{fmt::format(
          "--size {}x{}: {}; write {}x{}", out.width, out.height,
          stereo ? "two panoramas, one above the other, are as wide as high" : "a panorama is twice as wide as high",
          2 * std::max(1, out.width / 2), stereo ? 2 * std::max(1, out.width / 2) : std::max(1, out.width / 2))};
    }
    if (stereo && out.height % 2 != 0)
      return Error{
          fmt::format("--size {}x{}: each eye needs as many rows; write an even height", out.width, out.height)};
  }
  Camera& c = out.camera;
  c.projection = stereo ? Projection::StereoPanorama : Projection::Panorama;
  c.aspect = 0, c.cutHeightM = kInfinity;  // of a camera that a home is cut open for
  if (!wish.eye && (!wish.room.empty() || (!isPlaced && !rooms.empty()))) {
    const Room* room = &*std::max_element(rooms.begin(), rooms.end(), [](const Room& a, const Room& b) {
      return std::abs(signedAreaM2(a.floor)) < std::abs(signedAreaM2(b.floor));
    });
    if (!wish.room.empty()) {
      const Result<const Room*> picked = pickRoom(rooms, wish.room);
      if (!picked) return Error{picked.error()};
      room = picked.value();
    }
    const Vec2 middle = middleOf(*room);
    c.worldFromCamera =
        looking({middle.x, room->elevationM + std::min(kEyeM, 0.7f * room->heightM), middle.y}, {0, 0, -1});
    c.name = room->name;
  }
  c.worldFromCamera = upright(c.worldFromCamera);
  return out;
}

}  // namespace

Result<View> viewFromName(const std::string& name) {
  std::string names;
  for (const auto& [n, view] : kViews) {
    if (name == n) return view;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", n);
  }
  return Error{fmt::format("--view {}: no such view; there are {}", name, names)};
}

std::vector<Level> levelsOf(std::span<const Room> rooms) {
  std::vector<const Room*> sorted;
  for (const Room& room : rooms) sorted.push_back(&room);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Room* a, const Room* b) { return a->elevationM < b->elevationM; });
  std::vector<Level> levels;
  float last = -kInfinity;
  std::vector<float> lowest;  // ceilings, also those that one cannot stand under
  for (const Room* room : sorted) {
    if (room->elevationM - last > kLevelsApartM)
      levels.push_back(levelAt(room->elevationM)), lowest.push_back(kInfinity);
    Level& l = levels.back();
    last = room->elevationM;
    widen(l, *room);
    const float ceiling = room->elevationM + room->heightM;
    lowest.back() = std::min(lowest.back(), ceiling);
    if (room->heightM >= kStandM) l.ceilingM = std::min(l.ceilingM, ceiling);
  }
  for (size_t i = 0; i < levels.size(); ++i)
    levels[i].ceilingM = levels[i].ceilingM < kInfinity ? levels[i].ceilingM : lowest[i];
  return levels;
}

Vec2 middleOf(const Room& room) {
  constexpr int kSteps = 20;
  const Level box = levelsOf({&room, 1}).front();
  // Ties go to the middle of the box, so that long rooms are not seen from one end.
  const Vec2 centre = (box.low + box.high) * 0.5f;
  Vec2 best = centre;
  float bestScore = -kInfinity;
  for (int j = 0; j <= kSteps; ++j) {
    for (int i = 0; i <= kSteps; ++i) {
      const Vec2 p{box.low.x + (box.high.x - box.low.x) * static_cast<float>(i) / kSteps,
                   box.low.y + (box.high.y - box.low.y) * static_cast<float>(j) / kSteps};
      if (!contains(room.floor, p)) continue;
      const float score =
          static_cast<float>(distanceToEdgeM(room.floor, p)) - 1e-3f * std::hypot(p.x - centre.x, p.y - centre.y);
      if (score > bestScore) bestScore = score, best = p;
    }
  }
  return best;
}

Result<Viewed> makeView(const Scene& scene, std::span<const Room> rooms, const Camera& placed, bool isPlaced,
                        std::pair<int, int> usual, const ViewWish& wish) {
  Camera base = placed;
  if (wish.eye) {
    base = {};
    base.name = "eye";
    const Vec3 forward = wish.target ? *wish.target - *wish.eye : Vec3{0, 0, -1};
    if (lengthSquared(forward) < 1e-12f) return Error{"--target: is where --eye is; name a place to look at"};
    base.worldFromCamera = looking(*wish.eye, forward);
  }
  Result<Viewed> out = Viewed{base, usual.first, usual.second};
  switch (wish.view) {
    case View::Camera: {
      if (wish.size) std::tie(out.value().width, out.value().height) = *wish.size;
      Camera& c = out.value().camera;
      if (wish.yFovRad) c.yFovRad = *wish.yFovRad, c.aspect = 0, c.projection = Projection::Perspective;
      if (!wish.cutM) break;
      const Result<Level> level = pickLevel(scene, rooms, wish);
      if (!level) return Error{level.error()};
      c.cutHeightM = cutHeight(level.value(), wish);
      break;
    }
    case View::Top:
    case View::Plan: out = fromAbove(scene, rooms, wish); break;
    case View::Panorama:
    case View::Stereo: out = around(rooms, base, isPlaced || wish.eye, wish); break;
  }
  if (out && wish.emptyBackdrop) out.value().camera.emptyBackdrop = *wish.emptyBackdrop;
  return out;
}

std::optional<float> shownFloorM(const Scene& scene, const Camera& camera) {
  std::optional<float> floor;
  if (!(camera.cutHeightM < kInfinity)) return floor;
  for (const Room& r : scene.rooms) {
    if (r.elevationM < camera.cutHeightM && (!floor || r.elevationM > *floor)) floor = r.elevationM;
  }
  return floor;
}

std::vector<bool> roomMask(const Scene& scene, const Camera& camera, int width, int height) {
  const std::optional<float> floor = shownFloorM(scene, camera);
  if (!floor) return {};
  const CameraRays rays(camera, width, height);
  // Where a camera looks straight down, a ray that ends on a floor but began beside it met a wall of the room; slanted
  // ones met the house from outside.
  const bool straightDown = normalize(camera.worldFromCamera.z).y > 0.999f;
  std::vector<bool> mask(static_cast<size_t>(width) * static_cast<size_t>(height));
  for (size_t i = 0; i < mask.size(); ++i) {
    const auto x = static_cast<float>(i % static_cast<size_t>(width)),
               y = static_cast<float>(i / static_cast<size_t>(width));
    const Ray ray = rays.ray(x + 0.5f, y + 0.5f);
    if (!(ray.direction.y < 0)) continue;
    const auto at = [&](float elevationM) {
      return ray.origin + ray.direction * ((elevationM - ray.origin.y) / ray.direction.y);
    };
    const Vec3 onFloor = at(*floor),
               onCut = at(camera.cutHeightM);  // between them a ray from above meets the walls of a room
    mask[i] = std::any_of(scene.rooms.begin(), scene.rooms.end(), [&](const Room& r) {
      return std::abs(r.elevationM - *floor) < kLevelsApartM &&
             ((straightDown && contains(r.floor, {onFloor.x, onFloor.z})) || contains(r.floor, {onCut.x, onCut.z}));
    });
  }
  return std::find(mask.begin(), mask.end(), true) == mask.end() ? std::vector<bool>() : mask;
}

}  // namespace roomlight
