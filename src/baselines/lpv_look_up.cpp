#include "baselines/lpv.h"

namespace roomlight {
namespace {

const LpvLevel* levelAt(const LpvLight& light, Vec3 p) {
  for (const LpvLevel& level : light.levels) {
    if (level.holds(p)) return &level;
  }
  return nullptr;
}

// Of four harmonics of radiance: irradiance / pi on what faces n. The cosine lobe keeps the first as it is and two
// thirds of the others (Ramamoorthi & Hanrahan 2001).
float facing(const std::array<float, 4>& c, Vec3 n) {
  return kSh0 * c[0] - (2.0f / 3) * kSh1 * (c[1] * n.x + c[2] * n.y + c[3] * n.z);
}

// Kaplanyan & Dachsbacher's remedy for light that leaked: where the intensity grows towards the surface and points
// another way than it grows, it counts for less.
float dampened(const std::array<float, 4>& here, const std::array<float, 4>& above, Vec3 n) {
  const std::array<float, 4> growth{here[0] - above[0], here[1] - above[1], here[2] - above[2], here[3] - above[3]};
  if (facing(growth, n) <= 0) return 1;
  const Vec3 a{here[1], here[2], here[3]}, b{growth[1], growth[2], growth[3]};
  const float lengths = length(a) * length(b);
  return lengths > 0 ? std::clamp(0.5f + 0.5f * dot(a, b) / lengths, 0.0f, 1.0f) : 1;
}

}  // namespace

LpvLevel::LpvLevel(const LpvGrid& light, LpvGeometry geometry)
    : lattice_(light.lattice()), geometry_(std::move(geometry)), cells_(lattice_.paddedCount()) {
  for (size_t i = 0; i < cells_.size(); ++i) cells_[i] = light.get(i);
}

bool LpvLevel::holds(Vec3 p) const {
  const Vec3 q = lattice_.local(p);
  return minComponent(q) >= 0.5f && q.x <= static_cast<float>(lattice_.cells.x) - 0.5f &&
         q.y <= static_cast<float>(lattice_.cells.y) - 0.5f && q.z <= static_cast<float>(lattice_.cells.z) - 0.5f;
}

LpvIntensity LpvLevel::at(Vec3 p) const {
  const Vec3 q = lattice_.local(p) + Vec3(0.5f);
  const Int3 n = lattice_.padded();
  const auto low = [](float v, int most) { return std::clamp(static_cast<int>(std::floor(v)), 0, most - 2); };
  const Int3 c{low(q.x, n.x), low(q.y, n.y), low(q.z, n.z)};
  const auto part = [](float v, int from) { return std::clamp(v - static_cast<float>(from), 0.0f, 1.0f); };
  const Vec3 f{part(q.x, c.x), part(q.y, c.y), part(q.z, c.z)};
  LpvIntensity out{};
  for (int i = 0; i < 8; ++i) {
    const float w = (i & 1 ? f.x : 1 - f.x) * (i & 2 ? f.y : 1 - f.y) * (i & 4 ? f.z : 1 - f.z);
    const LpvIntensity& cell = cells_[lattice_.index({c.x + (i & 1), c.y + ((i >> 1) & 1), c.z + (i >> 2)})];
    for (size_t k = 0; k < 3; ++k) {
      for (size_t j = 0; j < 4; ++j) out[k][j] += w * cell[k][j];
    }
  }
  return out;
}

Vec3 lpvIrradiance(const LpvLight& light, Vec3 p, Vec3 ng, Vec3 ns, const LpvSettings& settings) {
  const LpvLevel* level = levelAt(light, p);
  if (!level) return {};
  const float cellM = level->lattice().cellM;
  const Vec3 from = p + ng * (settings.lookUpCells * cellM);
  const LpvIntensity here = level->at(from),
                     above = settings.dampening ? level->at(from + ng * (0.5f * cellM)) : LpvIntensity{};
  Vec3 out;
  for (size_t c = 0; c < 3; ++c) {
    out[static_cast<int>(c)] = std::max(0.0f, facing(here[c], ns)) *
                               (settings.dampening ? dampened(here[c], above[c], ns) : 1) * level->perCd();
  }
  return out;
}

// A march from cell to cell: what geometry stops of the ray has the radiance of the light that goes the other way
// there; what is left in the end, that of the last place.
Vec3 lpvRadiance(const LpvLight& light, Vec3 p, Vec3 ng, Vec3 d, const LpvSettings& settings) {
  const LpvLevel* level = levelAt(light, p);
  if (!level) return {};
  Vec3 q = p + ng * (settings.lookUpCells * level->lattice().cellM), sum, last;
  float left = 1;
  for (int i = 0; i < settings.glossySteps && left > 0.01f; ++i) {
    const LpvIntensity here = level->at(q);
    for (size_t c = 0; c < 3; ++c) {
      last[static_cast<int>(c)] =
          std::max(0.0f, kSh0 * here[c][0] - kSh1 * (here[c][1] * d.x + here[c][2] * d.y + here[c][3] * d.z)) *
          level->perCd();
    }
    const float stepM = level->lattice().cellM, passes = level->geometry().passes(q + d * (0.5f * stepM), d);
    sum += last * (left * (1 - passes));
    left *= passes;
    q += d * stepM;
    level = levelAt(light, q);
    if (!level) break;
  }
  return sum + last * left;
}

}  // namespace roomlight
