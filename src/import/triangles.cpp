#include "import/triangles.h"

#include <algorithm>
#include <numeric>

namespace roomlight::importers {
namespace {

// Of twice an area, in the file's units, of which nodes may make any size: edges of 1e-12, whose third powers floats
// hold.
constexpr double kSmallest = 1e-24;

}  // namespace

size_t dropDegenerate(Mesh& mesh) {
  size_t kept = 0;
  for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
    const uint32_t a = mesh.indices[t], b = mesh.indices[t + 1], c = mesh.indices[t + 2];
    const Vec3 ab = mesh.positions[b] - mesh.positions[a], ac = mesh.positions[c] - mesh.positions[a];
    // In doubles: the square of a small triangle's area is below what floats hold.
    const double x = double(ab.y) * ac.z - double(ab.z) * ac.y, y = double(ab.z) * ac.x - double(ab.x) * ac.z,
                 z = double(ab.x) * ac.y - double(ab.y) * ac.x;
    if (x * x + y * y + z * z < kSmallest * kSmallest) continue;
    mesh.indices[kept++] = a, mesh.indices[kept++] = b, mesh.indices[kept++] = c;
  }
  const size_t dropped = (mesh.indices.size() - kept) / 3;
  mesh.indices.resize(kept);
  return dropped;
}

size_t dropInfinite(Mesh& mesh) {
  constexpr float kFarthest = 1e12f;
  std::vector<bool> bad(mesh.positions.size());
  bool any = false;
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    Vec3& p = mesh.positions[i];
    if (isFinite(p) && maxComponent(abs(p)) <= kFarthest) continue;
    p = {}, bad[i] = any = true;
  }
  if (!any) return 0;
  size_t kept = 0;
  for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
    if (bad[mesh.indices[t]] || bad[mesh.indices[t + 1]] || bad[mesh.indices[t + 2]]) continue;
    for (size_t k = 0; k < 3; ++k) mesh.indices[kept++] = mesh.indices[t + k];
  }
  const size_t dropped = (mesh.indices.size() - kept) / 3;
  mesh.indices.resize(kept);
  return dropped;
}

size_t mendCoordinates(Mesh& mesh) {
  size_t mended = 0;
  for (std::vector<Vec2>& set : mesh.uv) {
    for (Vec2& uv : set) {
      if (saysSomething(uv)) continue;
      uv = {}, ++mended;
    }
  }
  return mended;
}

namespace {

constexpr size_t kMostTests =
    size_t{1} << 24;  // of corners against ears: up to the cube of their number, though mostly near its square

// Newell's normal: exact for plane polygons, an average for others; its length is twice the area.
Vec3 normalOf(std::span<const Vec3> p) {
  Vec3 n;
  for (size_t i = 1; i + 1 < p.size(); ++i) n += cross(p[i] - p[0], p[i + 1] - p[0]);
  return n;
}

struct Ears {
  std::span<const Vec3> p;
  Vec3 n;
  std::vector<uint32_t> left;  // corners not cut off yet

  float side(uint32_t a, uint32_t b, uint32_t c) const { return dot(n, cross(p[b] - p[a], p[c] - p[a])); }
  bool isEar(size_t k) const {
    const size_t count = left.size();
    const uint32_t a = left[(k + count - 1) % count], b = left[k], c = left[(k + 1) % count];
    if (!(side(a, b, c) > 0)) return false;
    for (const uint32_t q : left) {
      if (q == a || q == b || q == c || p[q] == p[a] || p[q] == p[b] || p[q] == p[c]) continue;
      if (side(a, b, q) >= 0 && side(b, c, q) >= 0 && side(c, a, q) >= 0) return false;
    }
    return true;
  }
};

}  // namespace

std::vector<std::array<uint32_t, 3>> triangulate(std::span<const Vec3> corners, EarBudget& budget) {
  std::vector<std::array<uint32_t, 3>> triangles;
  const size_t mostTests = std::min(kMostTests, budget.testsLeft);
  size_t tests = 0;
  Ears ears{corners, normalOf(corners), std::vector<uint32_t>(corners.size())};
  std::iota(ears.left.begin(), ears.left.end(), 0u);
  for (size_t k = 0, missed = 0; tests < mostTests && ears.left.size() > 3 && missed < ears.left.size();
       tests += ears.left.size()) {
    const size_t count = ears.left.size();
    k %= count;
    if (ears.isEar(k)) {
      triangles.push_back({ears.left[(k + count - 1) % count], ears.left[k], ears.left[(k + 1) % count]});
      ears.left.erase(ears.left.begin() + static_cast<std::ptrdiff_t>(k));
      missed = 0;
    } else {
      ++k, ++missed;
    }
  }
  if (tests >= budget.testsLeft && ears.left.size() > 3) ++budget.fans;
  budget.testsLeft -= std::min(tests, budget.testsLeft);
  for (size_t i = 1; i + 1 < ears.left.size(); ++i) triangles.push_back({ears.left[0], ears.left[i], ears.left[i + 1]});
  return triangles;
}

}  // namespace roomlight::importers
