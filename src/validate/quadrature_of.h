// From the program's vectors to the quadrature's.
#pragma once

#include "trace/meter.h"
#include "validate/quadrature.h"

namespace roomlight {

inline quadrature::Point exact(Vec3 v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
inline quadrature::Element exact(const SurfaceElement& e) { return {exact(e.position), exact(e.normal)}; }

}  // namespace roomlight
