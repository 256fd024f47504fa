#include "trace/emitter_view.h"

#include <algorithm>

namespace roomlight {
namespace {

constexpr size_t kMostTriangles = 1024;
constexpr float kGrazing =
    0.1f;  // cosine added for triangles seen edge on from the middle, of which places aside see more

}  // namespace

EmitterView::EmitterView(const Lights& lights, size_t emitter, const Bounds3& place)
    : lights_(lights), emitter_(emitter) {
  const Vec3 middle = place.centre(), half = place.size() * 0.5f;
  const float radius2 = lengthSquared(half);
  const bool twice = lights.emitterShinesTwice(emitter);
  const auto triangles = lights.emitterTriangles(emitter);
  whole_ = triangles.size() > kMostTriangles;
  if (whole_) return;
  float sum = 0;
  for (size_t i = 0; i < triangles.size(); ++i) {
    const Lights::EmitterTriangle& t = triangles[i];
    const float off = dot(t.normal, middle - t.v.a);  // m in front of its plane
    if (!twice && off + dot(abs(t.normal), half) <= 0) continue;
    const Vec3 d = middle - (t.v.a + t.v.b + t.v.c) / 3;
    const float d2 = lengthSquared(d) + radius2 + 1e-6f;
    const float cosine = twice ? std::abs(off) : std::max(off, 0.0f);
    sum += t.share * (cosine / std::sqrt(d2) + kGrazing) / (d2 + t.areaM2);
    chosen_.push_back({static_cast<uint32_t>(i), sum});
  }
  for (Chosen& c : chosen_) c.end /= sum;
}

LightSample EmitterView::sample(Vec3 p, Vec2 u, float choice) const {
  if (whole_) return lights_.sampleEmitter(emitter_, p, u, choice);
  if (dark()) return {};
  auto at = std::upper_bound(chosen_.begin(), chosen_.end(), choice,
                             [](float value, const Chosen& c) { return value < c.end; });
  if (at == chosen_.end()) --at;
  const float before = at == chosen_.begin() ? 0 : std::prev(at)->end;
  return lights_.sampleEmitterTriangle(emitter_, at->triangle, at->end - before, p, u);
}

}  // namespace roomlight
