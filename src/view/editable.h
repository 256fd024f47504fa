// What can be changed in a home while it is looked at: its lamps and its things, found in the scene once, and the state
// of all of them as a value. A state is put into a scene by stage(); going back is going to an earlier state.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "scene/scene_change.h"

namespace roomlight::view {

// Whatever gives light and can be dimmed apart: lamps of one name in one thing, or the parts of a thing that shine.
struct EditableLamp {
  struct Source {  // as the file has it
    size_t lamp;  // of the scene's
    Lamp full;
  };
  struct Glow {  // a material that nothing else uses
    size_t material;
    Vec3 emission;
  };
  std::string name, label;  // label: what people call it (scene/shown_names.h)
  std::string kind;  // "point", "spot", "area", "photometric", "glow"
  int object = -1;  // that it belongs to and moves with; -1: none
  std::vector<Source> sources;
  std::vector<Glow> glows;
  std::vector<uint32_t> instances;  // that shine
  Vec3 position, direction;  // of the first source, or the middle of what shines
  bool aimed = false;  // has a direction that can be turned
  Vec3 color{1, 1, 1};  // of luminance 1
  std::optional<float> temperatureK;  // of a black body of that colour, where there is one
  double fluxLm = 0;  // 0: unknown
  bool fluxAssumed = false;  // it gives no light, and nobody says how much it would: off at first
};

struct EditableObject {
  struct Part {
    uint32_t instance;
    Affine atRest;
    int mesh;
    Bounds3 bounds;  // at rest, world
    std::optional<Leaf> leaf;  // that it is of
  };
  struct Paint {
    size_t material;  // that nothing else uses
    Vec3 color;
  };
  std::string name, label;  // label: what people call it (scene/shown_names.h)
  bool movable = false;
  bool opens = false;  // has leaves
  float openAtRest = 0;  // how far the file has them open, on the average
  bool lampBody = false;  // the shining rectangle of a lamp that is edited as one, no thing
  std::vector<Part> parts;
  std::vector<Paint> paints;
  Bounds3 bounds;  // at rest
};

struct LampState {
  Vec3 position, direction;
  float turnDeg = 0;  // about the vertical, with a thing that took it along; before it is aimed
  float dim = 1;
  bool on = true;
  std::optional<float> temperatureK;
  std::optional<Vec3> color;  // of luminance 1; neither: the file's
  double fluxLm = 0;
  bool operator==(const LampState&) const = default;
};

struct ObjectState {
  Vec3 move;
  float turnDeg = 0;  // counter-clockwise seen from above, about the middle of the box
  bool hidden = false;
  float open = 0;  // 0 shut, 1 wide open: all leaves together
  std::vector<Vec3> colors;  // of its paints
  bool operator==(const ObjectState&) const = default;
};

// A local time; the offset from UTC stays as the home has it.
struct SunState {
  int year = 2000, month = 6, day = 21;
  double hour = 12;
  bool on = true;  // false: no sun or sky by date
  bool operator==(const SunState&) const = default;
};

struct HomeState {
  std::vector<LampState> lamps;
  std::vector<ObjectState> objects;
  std::optional<SunState> sun;
  bool operator==(const HomeState&) const = default;
};

struct EditableHome {
  std::vector<EditableLamp> lamps;
  std::vector<EditableObject> objects;
  int hiddenMesh = 0;  // one without triangles
  HomeState atStart;  // without the sun
};

// Parts the materials of things and lamps from each other, so that each can be changed alone; what is seen stays as it
// is.
EditableHome makeEditable(Scene& scene);

// Brings a scene from one state to another and says what that changed; the sun and the sky are not its business.
SceneChange stage(const EditableHome& home, const HomeState& from, const HomeState& to, Scene& scene);

// From where the file has a thing, or a part of it with its leaf, to where it is in that state. Rigid.
Affine motionOf(const EditableObject& object, const ObjectState& state);
Affine motionOf(const EditableObject& object, const EditableObject::Part& part, const ObjectState& state);
// Where the thing is in that state.
Bounds3 boundsOf(const EditableObject& object, const ObjectState& state);
// Where the lamp is, also when what it belongs to has moved.
Vec3 positionOf(const EditableHome& home, size_t lamp, const HomeState& state);

}  // namespace roomlight::view
