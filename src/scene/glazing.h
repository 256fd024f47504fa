// Light through and off window panes, as one surface of the scene that stands for one clear pane or for several with
// air between. Each pane is a slab: Fresnel's equations for s and p polarisation apart at its two faces, absorption
// along the refracted way, and all reflections to and fro inside; panes one behind the other likewise, so what is not
// let through or reflected is absorbed:
//   r_s, r_p by Fresnel, a = internal^(1 / cos theta_t);  T = (1 - r)² a / (1 - r² a²),  R = r (1 + a T)
//   behind each other: T = T1 T2 / (1 - R1 R2),  R = R1 + T1² R2 / (1 - R1 R2);  unpolarised light: the mean of s and p
// Sources: Born & Wolf, Principles of Optics, 1.5 and 7.6 (without interference); Rubin 1982 for panes in a row.
#pragma once

namespace roomlight {

constexpr int kMostGlazingPanes = 4;

struct Glazing {
  int panes = 0;  // 0: the surface is no glazing
  float ior = 1.52f;  // of the glass, at least 1
  float internalTransmittance =
      1;  // of one pane at normal incidence without its reflections, above 0; 0.96 of 6 mm clear glass
};

struct GlazingLight {
  float transmitted = 0, reflected = 0;  // shares of unpolarised light; the rest is absorbed
};

// Of light that meets the surface under |cos theta|, from either side.
GlazingLight glazingLight(const Glazing& glazing, float cosTheta);

// Share of the light from a uniform half sphere that is reflected. By quadrature: a hundred times the cost of
// glazingLight().
float glazingHemisphericalReflectance(const Glazing& glazing);

}  // namespace roomlight
