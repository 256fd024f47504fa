#include "import/sh3d_furniture.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace roomlight::importers::sh3d {
namespace {

constexpr int kMostJoints = 8;                      // hinges of one model, and rails
constexpr float kShutRad = 0.01f, kShutM = 0.001f;  // what the home has opened by less is shut
constexpr float kInPlaneM = 0.001f;                 // a pin so little behind the middle of its leaf is not behind it
constexpr float kShortestSlideM = 0.01f;

// Whether a group's name begins with that, and not with a longer number.
bool isOf(const std::string& group, const std::string& prefix) {
  return group.starts_with(prefix) &&
         (group.size() == prefix.size() || std::isdigit(static_cast<unsigned char>(group[prefix.size()])) == 0);
}

Bounds3 boxOf(const Mesh& mesh) {
  Bounds3 box;
  for (const uint32_t index : mesh.indices) box.add(mesh.positions[index]);
  return box;
}

// Right-handed about a unit axis.
float angleAbout(Vec3 axis, Vec3 from, Vec3 to) {
  return std::atan2(dot(axis, cross(from, to)), dot(from, to) - dot(axis, from) * dot(axis, to));
}

// From shut to wide open, and how much of that the home has it open.
struct Travel {
  float whole = 0, atRest = 0;
};

// A leaf that the home has open farther than is usual, or the other way, is wide open like that.
Travel travelOf(float usual, float opened, float least) {
  if (std::abs(opened) < least) return {usual, 0};
  const float share = opened / usual;
  return share > 0 && share <= 1 ? Travel{usual, share} : Travel{opened, 1};
}

// All of it is worked out in the world: models are mirrored, turned, and scaled unevenly.
class LeafFinder {
 public:
  LeafFinder(const std::vector<const Mesh*>& meshes, const std::vector<Affine>& posed, const Affine& worldFrom,
             Vec3 front)
      : meshes_(meshes), posed_(posed), worldFrom_(worldFrom), front_(front) {}

  Bounds3 boxOfJoint(const std::string& joint) const {
    Bounds3 box;
    for (const Mesh* mesh : meshes_) {
      if (isOf(mesh->name, joint)) box.add(boxOf(*mesh));
    }
    return box;
  }

  // Without the pin or the rail itself.
  std::vector<size_t> meshesOn(const std::string& joint) const {
    std::vector<size_t> out;
    for (size_t i = 0; i < meshes_.size(); ++i) {
      if (!isOf(meshes_[i]->name, joint) && moves(joint, meshes_[i]->name)) out.push_back(i);
    }
    return out;
  }

  // Handles stand out to one side: the leaf itself is the largest mesh.
  size_t largestOf(const std::vector<size_t>& meshes) const {
    const auto diagonal = [&](size_t i) { return length(worldFrom_.vector(boxOf(*meshes_[i]).size())); };
    return *std::max_element(meshes.begin(), meshes.end(),
                             [&](size_t a, size_t b) { return diagonal(a) < diagonal(b); });
  }

  // By a right angle to the side on which the pin lies: elsewhere the leaf would turn into its frame.
  Leaf onHinge(const Bounds3& pin, size_t largest) const {
    Leaf leaf;
    leaf.hinge = worldFrom_.point(pin.centre()), leaf.axis = normalize(edge(pin, longestEdge(pin)));
    const Vec3 shut = centreOf(largest, worldFrom_) - leaf.hinge;
    const float side = dot(shut, front_) <= kInPlaneM ? 1.0f : -1.0f;
    const float usual = std::copysign(kPi / 2, side * dot(cross(leaf.axis, shut), front_));
    const Vec3 across = cross(leaf.axis, front_);  // along the leaf, also of one that turns about its middle
    const Affine pose = worldFrom_ * posed_[largest] * inverse(worldFrom_);
    const Travel travel = travelOf(usual, angleAbout(leaf.axis, across, pose.vector(across)), kShutRad);
    leaf.turnRad = travel.whole, leaf.atRest = travel.atRest;
    return leaf;
  }

  // To the end of the rail that is farther away.
  Leaf onRail(const Bounds3& rail, size_t largest) const {
    Leaf leaf;
    const int k = longestEdge(rail);
    const Bounds3 box = boxOf(*meshes_[largest]);
    const float down = rail.lo[k] - box.lo[k], up = rail.hi[k] - box.hi[k];
    Vec3 slide;
    slide[k] = std::abs(down) > std::abs(up) ? down : up;
    slide = worldFrom_.vector(slide);
    const float usual = length(slide);
    if (!(usual > kShortestSlideM)) return leaf;
    const Vec3 way = slide / usual,
               posed = centreOf(largest, worldFrom_ * posed_[largest]) - centreOf(largest, worldFrom_);
    const Travel travel = travelOf(usual, dot(posed, way), kShutM);
    leaf.slideM = way * travel.whole, leaf.atRest = travel.atRest;
    return leaf;
  }

 private:
  Vec3 centreOf(size_t mesh, const Affine& place) const { return place.point(boxOf(*meshes_[mesh]).centre()); }

  Vec3 edge(const Bounds3& box, int k) const {
    Vec3 out;
    out[k] = box.hi[k] - box.lo[k];
    return worldFrom_.vector(out);
  }
  int longestEdge(const Bounds3& box) const {
    int longest = 0;
    for (int k = 1; k < 3; ++k) {
      if (lengthSquared(edge(box, k)) > lengthSquared(edge(box, longest))) longest = k;
    }
    return longest;
  }

  const std::vector<const Mesh*>& meshes_;
  const std::vector<Affine>& posed_;
  const Affine& worldFrom_;
  Vec3 front_;
};

// Not of pins too small, or models too large, for floats.
bool opens(const Leaf& leaf) {
  return isFinite(leaf.hinge) && isFinite(leaf.axis) && isFinite(leaf.slideM) && std::isfinite(leaf.turnRad) &&
         (leaf.turnRad != 0 || !isBlack(leaf.slideM));
}

}  // namespace

// "sweethome3d_hinge_1" moves what is "opening_on_hinge_1", with the panes and mirrors in it; so do rails, and balls
// move arms. Any other transformation moves the groups of its name.
bool moves(const std::string& transformation, const std::string& group) {
  const std::string head = "sweethome3d_", tail = "_transformation";
  const std::string name =
      transformation.ends_with(tail) ? transformation.substr(0, transformation.size() - tail.size()) : transformation;
  if (name.empty()) return false;
  if (name.starts_with(head)) {
    for (const char* what : {"opening_on_", "window_pane_on_", "window_mirror_on_", "mirror_on_", "arm_on_"}) {
      if (isOf(group, head + what + name.substr(head.size()))) return true;
    }
  }
  return isOf(group, name);
}

std::vector<int> findLeaves(const std::vector<const Mesh*>& meshes, const std::vector<Affine>& posed,
                            const Affine& worldFrom, Vec3 front, Scene& scene) {
  std::vector<int> out(meshes.size(), -1);
  const LeafFinder finder(meshes, posed, worldFrom, front);
  const auto add = [&](const std::string& joint, const Bounds3& box, bool slides) {
    const std::vector<size_t> on = box.empty() ? std::vector<size_t>() : finder.meshesOn(joint);
    if (on.empty()) return;
    const size_t largest = finder.largestOf(on);
    const Leaf leaf = slides ? finder.onRail(box, largest) : finder.onHinge(box, largest);
    if (!opens(leaf)) return;
    for (const size_t i : on) out[i] = static_cast<int>(scene.leaves.size());
    scene.leaves.push_back(leaf);
  };
  // All leaves share a unique rail: were more than one to slide, they would only change places.
  const Bounds3 uniqueRail = finder.boxOfJoint("sweethome3d_unique_rail");
  for (int n = 1; n <= kMostJoints; ++n) {
    const std::string hinge = "sweethome3d_hinge_" + std::to_string(n), rail = "sweethome3d_rail_" + std::to_string(n);
    add(hinge, finder.boxOfJoint(hinge), false);
    add(rail, n == 1 && !uniqueRail.empty() ? uniqueRail : finder.boxOfJoint(rail), true);
  }
  return out;
}

}  // namespace roomlight::importers::sh3d
