// What the published study of the method reports (voxel cones against VXGI, light propagation volumes and photon
// mapping; six home scenes, quad-core desktop with a GTX 950).
#pragma once

#include <array>

#include "engine/settings.h"

namespace roomlight::published {

struct Figures {
  const char* name;     // ours for it
  std::array<double, 6> drawingS;  // Table 1, of scenes 1 to 6
  double settledMse;               // Fig. 2
  double framesPerSecond;          // Fig. 3
};

constexpr std::array<Figures, 4> kTechniques = {
    {{technique::kCone, {48.2, 97.5, 125.4, 225.8, 317.4, 425.8}, 0.0034, 36},
     {technique::kVxgi, {58.7, 114.3, 134.8, 246.7, 358.9, 493.2}, 0.0051, 28},
     {technique::kLpv, {62.4, 124.5, 145.9, 266.3, 395.6, 528.4}, 0.0085, 23},
     {technique::kPhoton, {65.7, 136.7, 152.1, 274.0, 419.3, 608.7}, 0.0105, 7}}};

}  // namespace roomlight::published
