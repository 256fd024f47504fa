// How a luminaire's light leaves it: luminous intensity over directions, as measured by a goniophotometer and written
// into IES LM-63 and EULUMDAT files. Directions are C, gamma (CIE 121): gamma from the nadir up, C about the vertical,
// counter-clockwise seen from above. Own axes: x towards C0, y towards C90, z up, away from the nadir
// (docs/reference/luminaires.md).
#pragma once

#include <string>
#include <vector>

#include "base/vec.h"

namespace roomlight {

struct PhotometricWeb {
  std::string name, manufacturer, format;  // UTF-8; of the luminaire, and such as "IES LM-63-2002, type C"
  std::vector<float> cRad;      // ascending from 0 to 2 pi; the last plane is the first
  std::vector<float> gammaRad;  // ascending, from 0 to pi at most; dark beyond
  std::vector<float> candela;   // gammaRad.size() in every plane
  float peakCd = 0;
  double fluxLm = 0;        // integrated over the web
  double statedFluxLm = 0;  // that the file says leaves the luminaire or its lamps; 0: it does not
  double watts = 0;
  float sizeC0M = 0, sizeC90M = 0, heightM = 0;  // of the luminous opening, along C0-C180 and C90-C270; 0, 0: a point
  bool round = false;  // an ellipse of these axes, else a rectangle
  std::vector<float> tiltRad, tiltFactor;  // of lamps whose flux depends on the tilt of the luminaire; ascending

  size_t gammas() const { return gammaRad.size(); }
  float at(size_t plane, size_t gamma) const { return candela[plane * gammas() + gamma]; }
  bool hasOpening() const { return sizeC0M > 0 && sizeC90M > 0; }
};

// A direction's place among the planes and gammas: cell and how far into it, 0 to 1.
struct WebPlace {
  size_t plane, gamma;
  float c, g;
  bool dark;  // beyond the gammas
};
WebPlace placeInWeb(const PhotometricWeb& web, Vec3 direction);

// Towards a unit direction in the web's own axes, bilinear in C and gamma.
float intensityCd(const PhotometricWeb& web, Vec3 direction);

// Flux through a cell, lm: the exact integral of the bilinear intensity over its solid angle.
double cellFluxLm(const PhotometricWeb& web, size_t plane, size_t gamma);

// Sums up the finished candela: peakCd and fluxLm.
void sumUp(PhotometricWeb& web);

// What is left of the flux when the luminaire's nadir is so far from straight down.
float tiltFactor(const PhotometricWeb& web, float tiltRad);

// Whether light leaves above the plane of the opening too.
bool shinesUp(const PhotometricWeb& web);

// Half-angle about the nadir that holds all intensities of at least a tenth of the peak.
float beamHalfAngleRad(const PhotometricWeb& web);

// Directions from a luminaire in proportion to the light it sends there: cells of its web are chosen by their flux, and
// a direction inside the cell evenly over its solid angle.
class WebSampler {
 public:
  explicit WebSampler(const PhotometricWeb& web);  // must outlive the sampler

  // Unit, in the web's own axes; `pdf` per steradian.
  Vec3 sample(Vec2 u, float& pdf) const;
  float pdf(Vec3 direction) const;  // 0 where no light goes

 private:
  float density(size_t plane, size_t gamma) const { return density_[gamma * planes_ + plane]; }

  const PhotometricWeb& web_;
  size_t planes_;  // intervals of C
  std::vector<float> rowUpTo_;  // upper end of each interval of gamma, of all flux
  std::vector<float> upTo_;  // upper end of each cell in its row, of the row's flux
  std::vector<float> density_;  // per steradian, in each cell
};

}  // namespace roomlight
