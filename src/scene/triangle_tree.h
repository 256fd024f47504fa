// The triangles of a mesh in a hierarchy of boxes that is split only where somebody looks: for a few questions about
// large meshes, without the time and memory that a hierarchy for rays takes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "scene/scene.h"

namespace roomlight {

using Corners = std::array<Vec3, 3>;

// Refers to the mesh and must not outlive it. Questions split boxes: not for several threads at once.
class TriangleTree {
 public:
  struct Node {
    Bounds3 bounds;
    uint32_t first = 0, count = 0;  // of order_
    uint32_t child = 0;             // the first of two; 0: not split
  };

  TriangleTree(const Mesh& mesh, const Affine& worldFromMesh);

  // Of all triangles, m; empty where there are none.
  const Bounds3& bounds() const { return nodes_[0].bounds; }
  Node node(uint32_t index) const { return nodes_[index]; }
  // Numbers of the two parts of a node, or 0 for a leaf.
  uint32_t split(uint32_t index);
  // The k-th of a leaf's triangles, in world space.
  Corners triangle(uint32_t k) const;

 private:
  Bounds3 boundsOf(uint32_t first, uint32_t count) const;

  const Mesh* mesh_;
  Affine worldFromMesh_;
  std::vector<uint32_t> order_;  // numbers of triangles
  std::vector<Node> nodes_;
};

// Calls `visit(Corners)` for all triangles whose leaf's box `wants(Bounds3)`.
template <class Wants, class Visit>
void visitTriangles(TriangleTree& tree, const Wants& wants, const Visit& visit) {
  std::vector<uint32_t> open{0};
  while (!open.empty()) {
    const uint32_t at = open.back();
    open.pop_back();
    const TriangleTree::Node node = tree.node(at);
    if (node.count == 0 || !wants(node.bounds)) continue;
    if (const uint32_t child = tree.split(at)) {
      open.push_back(child), open.push_back(child + 1);
      continue;
    }
    for (uint32_t k = node.first; k < node.first + node.count; ++k) visit(tree.triangle(k));
  }
}

// The point of a triangle that is nearest to p.
Vec3 nearestOn(const Corners& q, Vec3 p);

// Where a line meets a triangle.
struct LineCrossing {
  float t;       // share of the way
  float cosine;  // between the line and the triangle's front; below 0: the line comes from the front
};
// Appends all of the line from `from` to `to`, in no order; one that runs along an edge is met by both of its
// triangles.
void addCrossings(TriangleTree& tree, Vec3 from, Vec3 to, std::vector<LineCrossing>& out);

// Whether a triangle of `a`, whose place in b's world is bFromA (rigid), passes through one of `b` by more than a fifth
// of a millimetre, or comes as near to one as reachM (above 0). Triangles that lie in one plane pass not; edges that
// meet may.
bool trianglesMeet(TriangleTree& a, TriangleTree& b, const Affine& bFromA, float reachM);

// The box around a moved box.
Bounds3 movedBounds(const Bounds3& b, const Affine& motion);

// Whether two boxes share a point or are within reachM of it, along each axis; below 0: overlap by so much.
inline bool boxesMeet(const Bounds3& a, const Bounds3& b, float reachM) {
  return minComponent(min(a.hi - b.lo, b.hi - a.lo)) >= -reachM;
}

}  // namespace roomlight
