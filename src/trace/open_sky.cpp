#include "trace/open_sky.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "base/sampling.h"
#include "trace/meter.h"

namespace roomlight {
namespace {

constexpr float kAnywhere = 0.1f;    // of all samples go anywhere, for what the few rays missed
constexpr float kNeighbour = 0.25f;  // of what the brightest neighbour has, a cell has at least
constexpr int kCloser = 8;           // rays into cells that see sky and into those around them
constexpr int kRounds = 4;           // of looking closer around what was found last

}  // namespace

OpenSky::OpenSky(const RayScene& rays, const Lights& lights, const SurfaceElement& element, uint64_t seed)
    : lights_(lights), frame_(element.normal), present_(lights.sky().present()) {
  if (!present_) return;
  std::array<float, kCells> found = look(rays, offsetOrigin(element.position, element.normal), seed), weight{};
  float sum = 0, upTo = 0;
  for (int i = 0; i < kCells; ++i) {
    float brightest = 0;
    forAround(i, [&](int other) { brightest = std::max(brightest, found[static_cast<size_t>(other)]); });
    sum += weight[static_cast<size_t>(i)] = std::max(found[static_cast<size_t>(i)], kNeighbour * brightest);
  }
  for (size_t i = 0; i < kCells; ++i)
    upTo_[i] = upTo += sum > 0 ? kAnywhere / kCells + (1 - kAnywhere) * weight[i] / sum : 1.0f / kCells;
}

template <class Body>
void OpenSky::forAround(int cell, Body&& body) {
  const int x = cell % kAround, y = cell / kAround;
  for (int qy = std::max(0, y - 1); qy <= std::min(kUp - 1, y + 1); ++qy) {
    for (int dx = -1; dx <= 1; ++dx) body(qy * kAround + (x + dx + kAround) % kAround);
  }
}

// Mean luminance of the sky that is seen in each cell: a ray each, and more where there is some. What is seen through
// an opening hangs together.
std::array<float, OpenSky::kCells> OpenSky::look(const RayScene& rays, Vec3 origin, uint64_t seed) const {
  std::array<float, kCells> sum{}, count{};
  std::array<bool, kCells> looked{};
  Rng rng(seed, 0, 0);
  std::vector<int> cells(kCells);
  std::iota(cells.begin(), cells.end(), 0);
  std::vector<Ray> tries;
  std::vector<Vec3> left;
  for (int round = 0; round <= kRounds && !cells.empty(); ++round) {
    const int each = round > 0 ? kCloser : 1;
    tries.clear();
    for (const int c : cells) {
      for (int k = 0; k < each; ++k) tries.push_back({origin, direction(c, rng.uniform2()), 0, kInfinity});
    }
    left.resize(tries.size());
    rays.transmittance(tries, left);
    for (size_t i = 0; i < tries.size(); ++i) {
      const auto c = static_cast<size_t>(cells[i / static_cast<size_t>(each)]);
      sum[c] += luminance(left[i] * lights_.sky().radiance(tries[i].direction)), count[c] += 1;
    }
    std::vector<int> next;
    for (const int c : cells) {
      if (!(sum[static_cast<size_t>(c)] > 0)) continue;
      forAround(c, [&](int other) {
        if (!std::exchange(looked[static_cast<size_t>(other)], true)) next.push_back(other);
      });
    }
    cells = std::move(next);
  }
  for (size_t i = 0; i < kCells; ++i) sum[i] /= count[i];
  return sum;
}

// Parts even in azimuth and in the square of the sine of the angle from the normal.
Vec3 OpenSky::direction(int cell, Vec2 u) const {
  const float azimuth = 2 * kPi * (static_cast<float>(cell % kAround) + u.x) / kAround,
              sin2 = (static_cast<float>(cell / kAround) + u.y) / kUp;
  const float sine = std::sqrt(sin2);
  return frame_.toWorld({sine * std::cos(azimuth), sine * std::sin(azimuth), std::sqrt(std::max(0.0f, 1 - sin2))});
}

LightSample OpenSky::sample(Vec2 u) const {
  LightSample out;
  const float pick = u.x * upTo_[kCells - 1];
  const auto cell = std::min<size_t>(
      static_cast<size_t>(std::upper_bound(upTo_.begin(), upTo_.end(), pick) - upTo_.begin()), kCells - 1);
  const float before = cell > 0 ? upTo_[cell - 1] : 0, chance = upTo_[cell] - before;
  out.wi = direction(static_cast<int>(cell), {std::clamp((pick - before) / chance, 0.0f, 0x1.fffffep-1f), u.y});
  out.pdf = chance * kCells * std::max(dot(out.wi, frame_.toWorld({0, 0, 1})), 1e-6f) / kPi;
  out.radiance = lights_.sky().radiance(out.wi) / out.pdf;
  return out;
}

}  // namespace roomlight
