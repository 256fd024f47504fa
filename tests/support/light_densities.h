// Whether samples of lights have the density that multiple importance sampling asks for.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "trace/lights.h"
#include "trace/ray_scene.h"

namespace roomlight::test {

// Of a sample of an emissive mesh from p, where a ray that way meets the mesh and nothing before it: `pdfAt(point)` is
// that of the sample. Whether it could be compared.
template <class PdfAt>
bool expectDensityOfItsPoint(const RayScene& rays, Vec3 p, const LightSample& s, const PdfAt& pdfAt) {
  if (!s.valid() || !(s.pdf > 0)) return false;
  const Hit hit = rays.intersect({p, s.wi, 0, kInfinity});
  if (!hit.valid() || std::abs(hit.t - s.distance) > 1e-4f) return false;
  EXPECT_NEAR(pdfAt(surfaceAt(rays.scene(), hit, s.wi)) / s.pdf, 1, 0.02) << "at " << p.x << ' ' << p.y << ' ' << p.z;
  return true;
}

}  // namespace roomlight::test
