#include "scene/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace roomlight {
namespace {

constexpr uint32_t kMostInLeaf = 4;
constexpr float kThroughM = 2e-4f;  // by less, what stands on a plane passes through it by rounding

bool isInside(const Corners& q, Vec3 normal, Vec3 p) {
  for (size_t i = 0; i < 3; ++i) {
    if (dot(cross(q[(i + 1) % 3] - q[i], p - q[i]), normal) < 0) return false;
  }
  return true;
}

// Whether an edge of p passes through q.
bool edgePasses(const Corners& p, const Corners& q) {
  const Vec3 normal = cross(q[1] - q[0], q[2] - q[0]);
  const float size = length(normal);
  if (!(size > 0)) return false;
  float above[3];
  for (size_t i = 0; i < 3; ++i) above[i] = dot(p[i] - q[0], normal) / size;
  for (size_t i = 0; i < 3; ++i) {
    const size_t j = (i + 1) % 3;
    const float low = std::min(above[i], above[j]), high = std::max(above[i], above[j]);
    if (low > -kThroughM || high < kThroughM) continue;
    if (isInside(q, normal, lerp(p[i], p[j], above[i] / (above[i] - above[j])))) return true;
  }
  return false;
}

bool isNear(const Corners& p, const Corners& q, float reachM) {
  for (size_t i = 0; i < 3; ++i) {
    if (lengthSquared(nearestOn(q, p[i]) - p[i]) <= reachM * reachM) return true;
    if (lengthSquared(nearestOn(p, q[i]) - q[i]) <= reachM * reachM) return true;
  }
  return false;
}

bool leavesMeet(const TriangleTree& a, const TriangleTree::Node& na, const TriangleTree& b,
                const TriangleTree::Node& nb, const Affine& bFromA, float reachM) {
  for (uint32_t i = na.first; i < na.first + na.count; ++i) {
    const Corners local = a.triangle(i);
    const Corners p = {bFromA.point(local[0]), bFromA.point(local[1]), bFromA.point(local[2])};
    for (uint32_t k = nb.first; k < nb.first + nb.count; ++k) {
      const Corners q = b.triangle(k);
      if (edgePasses(p, q) || edgePasses(q, p) || (reachM > 0 && isNear(p, q, reachM))) return true;
    }
  }
  return false;
}

// Whether a box reaches to the plane of one of the leaf's triangles: a slanted wall has a box as large as the room.
bool reachesPlane(const Bounds3& box, const Affine& bFromA, const TriangleTree& b, const TriangleTree::Node& leaf,
                  float reachM) {
  const Vec3 centre = bFromA.point(box.centre()), half = box.size() * 0.5f;
  for (uint32_t k = leaf.first; k < leaf.first + leaf.count; ++k) {
    const Corners q = b.triangle(k);
    const Vec3 normal = cross(q[1] - q[0], q[2] - q[0]);
    const float reach = std::abs(dot(normal, bFromA.x)) * half.x + std::abs(dot(normal, bFromA.y)) * half.y +
                        std::abs(dot(normal, bFromA.z)) * half.z + reachM * length(normal);
    if (std::abs(dot(centre - q[0], normal)) <= reach) return true;
  }
  return false;
}

bool lineMeets(const Bounds3& b, Vec3 from, Vec3 along) {
  float first = 0, last = 1;
  for (int i = 0; i < 3; ++i) {
    if (along[i] == 0) {
      if (from[i] < b.lo[i] || from[i] > b.hi[i]) return false;
      continue;
    }
    const float s = (b.lo[i] - from[i]) / along[i], t = (b.hi[i] - from[i]) / along[i];
    first = std::max(first, std::min(s, t)), last = std::min(last, std::max(s, t));
  }
  return first <= last * (1 + 1e-5f) + 1e-6f;
}

// Moeller and Trumbore, with borders.
void addCrossing(const Corners& q, Vec3 from, Vec3 along, std::vector<LineCrossing>& out) {
  constexpr float kBorder = 1e-5f;
  const Vec3 e1 = q[1] - q[0], e2 = q[2] - q[0], normal = cross(e1, e2);
  const float slope = dot(along, normal), size = length(normal) * length(along);
  if (!(std::abs(slope) > 1e-6f * size)) return;
  const Vec3 offset = from - q[0], s = cross(along, offset);
  const float t = -dot(offset, normal) / slope, u = dot(e2, s) / slope, v = -dot(e1, s) / slope;
  if (t >= 0 && t <= 1 && u >= -kBorder && v >= -kBorder && u + v <= 1 + kBorder) out.push_back({t, slope / size});
}

}  // namespace

// Ericson, Real-Time Collision Detection, 5.1.5.
Vec3 nearestOn(const Corners& q, Vec3 p) {
  const Vec3 ab = q[1] - q[0], ac = q[2] - q[0], ap = p - q[0], bp = p - q[1], cp = p - q[2];
  const float d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
              d6 = dot(ac, cp);
  if (d1 <= 0 && d2 <= 0) return q[0];
  if (d3 >= 0 && d4 <= d3) return q[1];
  if (d6 >= 0 && d5 <= d6) return q[2];
  const float vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return q[0] + ab * (d1 > d3 ? d1 / (d1 - d3) : 0);
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return q[0] + ac * (d2 > d6 ? d2 / (d2 - d6) : 0);
  const float e = d4 - d3, f = d5 - d6;
  if (va <= 0 && e >= 0 && f >= 0) return q[1] + (q[2] - q[1]) * (e + f > 0 ? e / (e + f) : 0);
  const float sum = va + vb + vc;
  return sum > 0 ? q[0] + ab * (vb / sum) + ac * (vc / sum) : q[0];
}

TriangleTree::TriangleTree(const Mesh& mesh, const Affine& worldFromMesh)
    : mesh_(&mesh), worldFromMesh_(worldFromMesh), order_(mesh.triangleCount()) {
  std::iota(order_.begin(), order_.end(), 0u);
  const auto count = static_cast<uint32_t>(order_.size());
  nodes_.push_back({boundsOf(0, count), 0, count, 0});
}

Corners TriangleTree::triangle(uint32_t k) const {
  const uint32_t* corner = mesh_->indices.data() + size_t{3} * order_[k];
  const auto at = [&](int i) { return worldFromMesh_.point(mesh_->positions[corner[i]]); };
  return {at(0), at(1), at(2)};
}

Bounds3 TriangleTree::boundsOf(uint32_t first, uint32_t count) const {
  Bounds3 out;
  for (uint32_t k = first; k < first + count; ++k) {
    for (const Vec3 p : triangle(k)) out.add(p);
  }
  return out;
}

// At the median along the longest side: as many triangles on both sides, wherever they lie.
uint32_t TriangleTree::split(uint32_t index) {
  const Node node = nodes_[index];
  if (node.child != 0 || node.count <= kMostInLeaf) return node.child;
  const Vec3 size = node.bounds.size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const Vec3 row{worldFromMesh_.x[axis], worldFromMesh_.y[axis], worldFromMesh_.z[axis]};
  const auto middle = [&](uint32_t triangle) {
    const uint32_t* corner = mesh_->indices.data() + size_t{3} * triangle;
    return dot(row, mesh_->positions[corner[0]] + mesh_->positions[corner[1]] + mesh_->positions[corner[2]]);
  };
  const auto begin = order_.begin() + node.first;
  const uint32_t half = node.count / 2;
  std::nth_element(begin, begin + half, begin + node.count,
                   [&](uint32_t a, uint32_t b) { return middle(a) < middle(b); });
  const auto child = static_cast<uint32_t>(nodes_.size());
  nodes_.push_back({boundsOf(node.first, half), node.first, half, 0});
  nodes_.push_back({boundsOf(node.first + half, node.count - half), node.first + half, node.count - half, 0});
  nodes_[index].child = child;
  return child;
}

void addCrossings(TriangleTree& tree, Vec3 from, Vec3 to, std::vector<LineCrossing>& out) {
  const Vec3 along = to - from;
  visitTriangles(
      tree, [&](const Bounds3& b) { return lineMeets(b, from, along); },
      [&](const Corners& q) { addCrossing(q, from, along, out); });
}

bool trianglesMeet(TriangleTree& a, TriangleTree& b, const Affine& bFromA, float reachM) {
  std::vector<std::pair<uint32_t, uint32_t>> open{{0, 0}};
  while (!open.empty()) {
    const auto [i, k] = open.back();
    open.pop_back();
    const TriangleTree::Node na = a.node(i), nb = b.node(k);
    if (na.count == 0 || nb.count == 0 || !boxesMeet(movedBounds(na.bounds, bFromA), nb.bounds, reachM)) continue;
    const bool larger = length(na.bounds.size()) > length(nb.bounds.size());
    const uint32_t childOfA = larger || b.split(k) == 0 ? a.split(i) : 0, childOfB = childOfA ? 0 : b.split(k);
    if (childOfA) {
      if (b.split(k) == 0 && !reachesPlane(na.bounds, bFromA, b, nb, reachM)) continue;
      open.emplace_back(childOfA, k), open.emplace_back(childOfA + 1, k);
    } else if (childOfB) {
      open.emplace_back(i, childOfB), open.emplace_back(i, childOfB + 1);
    } else if (leavesMeet(a, na, b, nb, bFromA, reachM)) {
      return true;
    }
  }
  return false;
}

Bounds3 movedBounds(const Bounds3& b, const Affine& motion) {
  const Vec3 centre = motion.point(b.centre()), half = b.size() * 0.5f;
  const Vec3 reach = abs(motion.x) * half.x + abs(motion.y) * half.y + abs(motion.z) * half.z;
  Bounds3 out;
  out.lo = centre - reach, out.hi = centre + reach;
  return out;
}

}  // namespace roomlight
