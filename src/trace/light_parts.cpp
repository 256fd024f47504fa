#include "trace/light_parts.h"

namespace roomlight {

LightSample sampleLocal(const Lights& lights, std::span<const LightPart> parts, Vec3 p, Vec2 u, float choice) {
  const LocalChoice kind{lights};
  const LightTree::Choice c = chooseLight(weighed(parts, kind, p), kind, p, choice);
  if (!(c.chance > 0)) return {};
  LightSample s = kind.sample(c.index, p, u, c.rest);
  s.radiance *= 1 / c.chance;
  if (s.emitter >= 0) s.pdf *= c.chance;
  return s;
}

float pdfLocal(const Lights& lights, std::span<const LightPart> parts, Vec3 p, const SurfacePoint& q) {
  const int32_t index = lights.emitterOf(q.instance);
  if (index < 0) return 0;
  const auto emitter = static_cast<size_t>(index);
  const float chance = chanceOfLight(parts, LocalChoice{lights}, lights.lampCount() + emitter, p);
  return chance > 0 ? chance * lights.pdfEmitter(emitter, p, q) : 0;
}

}  // namespace roomlight
