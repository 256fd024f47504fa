#include "trace/light_rays.h"

#include <algorithm>

namespace roomlight {
namespace {

// Meshes are taken apart until pieces are no longer than this, or so many: a chandelier's bulbs, a strip of light.
constexpr float kPieceM = 0.2f;
constexpr int kMostHalvings = 3;
constexpr double kLeastShare = 1e-5;  // of all flux: a mesh with less would hardly start a ray; paths find it as ever

using Triangle = Lights::EmitterTriangle;

Vec3 middle(const Triangle& t) { return (t.v.a + t.v.b + t.v.c) / 3; }

Bounds3 boundsOf(std::span<const Triangle*> triangles) {
  Bounds3 bounds;
  for (const Triangle* t : triangles) bounds.add(t->v.a), bounds.add(t->v.b), bounds.add(t->v.c);
  return bounds;
}

// In halves along the longest edge of the box around them, each again.
template <class Add>
void takeApart(std::span<const Triangle*> triangles, int halvings, const Add& add) {
  const Bounds3 bounds = boundsOf(triangles);
  const Vec3 size = bounds.size(), centre = bounds.centre();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  if (halvings < kMostHalvings && size[axis] > kPieceM) {
    const auto half = std::partition(triangles.begin(), triangles.end(),
                                     [&](const Triangle* t) { return middle(*t)[axis] < centre[axis]; });
    const auto low = static_cast<size_t>(half - triangles.begin());
    if (low > 0 && low < triangles.size()) {
      takeApart(triangles.first(low), halvings + 1, add);
      takeApart(triangles.subspan(low), halvings + 1, add);
      return;
    }
  }
  add(triangles, bounds);
}

}  // namespace

LightRays::LightRays(const Lights& lights) : lights_(lights), leaves_(lights.emitterCount()) {
  const auto isSmall = [&](size_t i) {
    return lights.emitterAreaM2(i) * (lights.emitterShinesTwice(i) ? 2 : 1) <= kWidestM2;
  };
  double most = lights.lampFluxLm(), flux = 0;
  for (size_t i = 0; i < lights.emitterCount(); ++i) most += isSmall(i) ? lights.emitterFluxLm(i) : 0;
  for (size_t i = 0; i < lights.emitterCount(); ++i) {
    if (!isSmall(i) || lights.emitterFluxLm(i) < kLeastShare * most) continue;
    flux += lights.emitterFluxLm(i);
    leaves_[i] = true;
    emitters_.push_back(i);
    cdf_.push_back(static_cast<float>(flux));
  }
  const double all = flux + lights.lampFluxLm();
  if (!(all > 0)) return;
  for (float& end : cdf_) end /= static_cast<float>(flux);
  shareOfLamps_ = emitters_.empty() ? 1 : static_cast<float>(lights.lampFluxLm() / all);
  for (const size_t i : emitters_) addPieces(i, static_cast<float>(lights.emitterFluxLm(i) / all));
  all_ = emitters_.size() == lights.emitterCount() && lights.sunCount() == 0 && !lights.sky().present();
}

void LightRays::addPieces(size_t emitter, float share) {
  const std::span<const Triangle> all = lights_.emitterTriangles(emitter);
  const bool twice = lights_.emitterShinesTwice(emitter);
  std::vector<const Triangle*> triangles;
  for (const Triangle& t : all) triangles.push_back(&t);
  takeApart(std::span<const Triangle*>(triangles), 0, [&](std::span<const Triangle*> some, const Bounds3& bounds) {
    Piece piece{bounds.centre(), 0.5f * length(bounds.size()), {}, 0, 0, 0};
    float area = 0, part = 0;
    for (const Triangle* t : some) piece.facing += t->normal * t->areaM2, area += t->areaM2, part += t->share;
    // A box around a ball is wider than the ball.
    piece.radius = std::min(piece.radius, 0.5f * maxComponent(bounds.size()));
    piece.facing = twice ? Vec3(0) : piece.facing / area;
    piece.flatness = length(piece.facing);
    piece.raysPerSr = share * part / (4 * kPi);
    piece.mostPerM2 = share * part / (twice ? 2 * area : area);
    pieces_.push_back(piece);
  });
}

LightRay LightRays::sample(Sampler& sampler) const {
  if (emitters_.empty()) return lights_.sampleLampRay(sampler);
  if (shareOfLamps_ > 0 && sampler.next1() < shareOfLamps_) {
    LightRay ray = lights_.sampleLampRay(sampler);
    ray.fluxLm = ray.fluxLm / shareOfLamps_;
    return ray;
  }
  const float choice = sampler.next1();
  const size_t i =
      std::min(static_cast<size_t>(std::upper_bound(cdf_.begin(), cdf_.end(), choice) - cdf_.begin()), cdf_.size() - 1);
  LightRay ray = lights_.sampleEmitterRay(emitters_[i], sampler);
  ray.fluxLm = ray.fluxLm / ((1 - shareOfLamps_) * (cdf_[i] - (i > 0 ? cdf_[i - 1] : 0)));
  return ray;
}

// A convex body that shines evenly sends towards w its area as seen from there: of a closed one a quarter of its area
// on average, of a flat one its area times the cosine. |n w| summed over triangles is taken for a mixture of both.
float LightRays::densityM2(const Piece& piece, Vec3 p, Vec3 n) const {
  const Vec3 d = piece.centre - p;
  // Where the horizon cuts the sphere some of it is above.
  const float height = dot(n, d), above = height >= piece.radius ? height : 0.5f * (height + piece.radius);
  if (above <= 0) return 0;
  const float inverse2 = 1 / std::max(lengthSquared(d), 1e-8f), inverse = std::sqrt(inverse2),
              facing = -dot(piece.facing, d) * inverse;
  const float towards = 1 - piece.flatness + 2 * (std::abs(facing) + facing);
  return std::min(piece.raysPerSr * towards * above * inverse2 * inverse, piece.mostPerM2);
}

float LightRays::densityM2(Vec3 p, Vec3 n) const {
  float density = shareOfLamps_ > 0 ? shareOfLamps_ * lights_.lampDensity(p, n) : 0;
  for (const Piece& piece : pieces_) density += densityM2(piece, p, n);
  return density;
}

}  // namespace roomlight
