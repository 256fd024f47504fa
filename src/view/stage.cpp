// How a state of lamps and things is put into a scene.
#include <algorithm>
#include <cmath>
#include <set>

#include "photometry/colour_temperature.h"
#include "view/editable.h"

namespace roomlight::view {
namespace {

Affine turnedBy(float turnDeg) {
  const float turnRad = turnDeg * kPi / 180, c = std::cos(turnRad), s = std::sin(turnRad);
  return {{c, 0, -s}, {0, 1, 0}, {s, 0, c}, {}};
}

Affine placeOf(const EditableObject& object, const ObjectState& state) {
  const Vec3 about = object.bounds.centre();
  Affine place = turnedBy(state.turnDeg);
  place.w = about - place.vector(about) + state.move;
  return place;
}

bool isAtRest(const ObjectState& state) { return isBlack(state.move) && state.turnDeg == 0; }

// How far open a leaf is: at rest where its thing is, and from there straight to shut and to wide open.
float openingOf(const EditableObject& object, const Leaf& leaf, float open) {
  const float start = object.openAtRest;
  if (open < start) return leaf.atRest * (open / start);
  return leaf.atRest + (1 - leaf.atRest) * ((open - start) / (1 - start));
}

// Of a leaf that is opened by that much more (Rodrigues' formula).
Affine swing(const Leaf& leaf, float by) {
  const float turnRad = by * leaf.turnRad, c = std::cos(turnRad), s = std::sin(turnRad);
  const auto turned = [&](Vec3 p) {
    return p * c + cross(leaf.axis, p) * s + leaf.axis * (dot(leaf.axis, p) * (1 - c));
  };
  Affine place{turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1}), {}};
  place.w = leaf.hinge - place.vector(leaf.hinge) + leaf.slideM * by;
  return place;
}

bool isSwung(const EditableObject& object, const EditableObject::Part& part, const ObjectState& state) {
  return part.leaf && state.open != object.openAtRest;
}

Bounds3 movedBox(const Bounds3& b, const Affine& motion) {
  Bounds3 out;
  for (int corner = 0; corner < 8; ++corner)
    out.add(motion.point({corner & 1 ? b.hi.x : b.lo.x, corner & 2 ? b.hi.y : b.lo.y, corner & 4 ? b.hi.z : b.lo.z}));
  return out;
}

// The shortest turn from one unit direction to another.
Affine turnBetween(Vec3 from, Vec3 to, Vec3 up) {
  const float c = dot(from, to);
  if (c < -0.9999f) {  // half a turn about `up`
    return {up * (2 * up.x) - Vec3{1, 0, 0}, up * (2 * up.y) - Vec3{0, 1, 0}, up * (2 * up.z) - Vec3{0, 0, 1}, {}};
  }
  const Vec3 v = cross(from, to);
  const auto turned = [&](Vec3 p) { return p + cross(v, p) + cross(v, cross(v, p)) / (1 + c); };
  return {turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1}), {}};
}

// From where the file has the lamp to where it is.
Affine lampPlace(const EditableHome& home, size_t index, const HomeState& state) {
  const EditableLamp& lamp = home.lamps[index];
  if (lamp.object >= 0) {
    const ObjectState& thing = state.objects[static_cast<size_t>(lamp.object)];
    return isAtRest(thing) ? Affine() : placeOf(home.objects[static_cast<size_t>(lamp.object)], thing);
  }
  if (lamp.sources.empty()) return {};
  const LampState& now = state.lamps[index];
  const Lamp& file = lamp.sources[0].full;
  Affine place = now.turnDeg == 0 ? Affine() : turnedBy(now.turnDeg);
  if (lamp.aimed && !(now.direction == place.vector(lamp.direction)))
    place = turnBetween(place.vector(lamp.direction), now.direction, place.vector(file.up)) * place;
  place.w = now.position - place.vector(lamp.position);
  return place;
}

// What the light of a source or a material is in that state, of which the file says it is `full`.
Vec3 lightIn(const EditableLamp& lamp, const LampState& state, bool hidden, Vec3 full) {
  if (!state.on || hidden) return {};
  const double flux = lamp.fluxLm > 0 ? state.fluxLm / lamp.fluxLm : 1;
  const auto factor = static_cast<float>(flux * static_cast<double>(state.dim));
  if (state.temperatureK) return blackBodyColour(static_cast<double>(*state.temperatureK)) * (luminance(full) * factor);
  return (state.color ? *state.color * luminance(full) : full) * factor;
}

void stageLamp(const EditableHome& home, size_t index, const HomeState& to, Scene& scene, SceneChange& change) {
  const EditableLamp& lamp = home.lamps[index];
  const LampState& state = to.lamps[index];
  const bool hidden = lamp.object >= 0 && to.objects[static_cast<size_t>(lamp.object)].hidden;
  const Affine place = lampPlace(home, index, to);
  for (const EditableLamp::Source& s : lamp.sources) {
    Lamp& out = scene.lamps[s.lamp];
    out.position = place.point(s.full.position);
    out.direction = place.vector(s.full.direction), out.up = place.vector(s.full.up);
    out.intensityCd = lightIn(lamp, state, hidden, s.full.intensityCd);
    out.luminanceCdM2 = lightIn(lamp, state, hidden, s.full.luminanceCdM2);
    change.lamps = change.lamps || lamp.glows.empty() || out.kind != LampKind::Area;
  }
  for (const EditableLamp::Glow& g : lamp.glows) {
    Vec3& emission = scene.materials[g.material].emission;
    const Vec3 next = lightIn(lamp, state, hidden, g.emission);
    if (!(emission == next)) change.glow.insert(change.glow.end(), lamp.instances.begin(), lamp.instances.end());
    emission = next;
  }
  if (lamp.object >= 0 || lamp.sources.empty()) return;
  for (const uint32_t i : lamp.instances) {  // rectangles, which stand in the world's own frame
    Affine& now = scene.instances[i].worldFromObject;
    if (now == place) continue;
    now = place;
    change.moved.push_back(i);
  }
}

void stageObject(const EditableHome& home, size_t index, const HomeState& to, Scene& scene, SceneChange& change) {
  const EditableObject& object = home.objects[index];
  const ObjectState& state = to.objects[index];
  bool painted = false;
  for (size_t k = 0; k < object.paints.size(); ++k) {
    Vec3& color = scene.materials[object.paints[k].material].baseColor;
    painted = painted || !(color == state.colors[k]);
    color = state.colors[k];
  }
  for (const EditableObject::Part& part : object.parts) {
    Instance& instance = scene.instances[part.instance];
    const bool rests = isAtRest(state) && !isSwung(object, part, state);
    const Affine place = rests ? part.atRest : motionOf(object, part, state) * part.atRest;
    const int mesh = state.hidden ? home.hiddenMesh : part.mesh;
    if (!painted && instance.mesh == mesh && instance.worldFromObject == place)
      continue;  // the frame of a door that opens
    change.before[part.instance] = movedBox(part.bounds, instance.worldFromObject * inverse(part.atRest));
    instance.worldFromObject = place, instance.mesh = mesh;
    change.moved.push_back(part.instance);
  }
}

void sortOnce(std::vector<uint32_t>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace

SceneChange stage(const EditableHome& home, const HomeState& from, const HomeState& to, Scene& scene) {
  SceneChange change;
  for (size_t i = 0; i < home.objects.size(); ++i) {
    if (!(from.objects[i] == to.objects[i])) stageObject(home, i, to, scene, change);
  }
  for (size_t i = 0; i < home.lamps.size(); ++i) {
    const int object = home.lamps[i].object;
    const bool carried =
        object >= 0 && !(from.objects[static_cast<size_t>(object)] == to.objects[static_cast<size_t>(object)]);
    if (carried || !(from.lamps[i] == to.lamps[i])) stageLamp(home, i, to, scene, change);
  }
  sortOnce(change.moved), sortOnce(change.glow);
  return change;
}

Affine motionOf(const EditableObject& object, const ObjectState& state) {
  return isAtRest(state) ? Affine() : placeOf(object, state);
}

Affine motionOf(const EditableObject& object, const EditableObject::Part& part, const ObjectState& state) {
  const Affine place = motionOf(object, state);
  if (!isSwung(object, part, state)) return place;
  return place * swing(*part.leaf, openingOf(object, *part.leaf, state.open) - part.leaf->atRest);
}

Bounds3 boundsOf(const EditableObject& object, const ObjectState& state) {
  if (isAtRest(state) && state.open == object.openAtRest) return object.bounds;
  Bounds3 bounds;
  for (const EditableObject::Part& part : object.parts) {
    bounds.add(movedBox(part.bounds, motionOf(object, part, state)));
  }
  return bounds;
}

Vec3 positionOf(const EditableHome& home, size_t lamp, const HomeState& state) {
  return lampPlace(home, lamp, state).point(home.lamps[lamp].position);
}

}  // namespace roomlight::view
