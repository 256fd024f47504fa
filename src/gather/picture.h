// From camera rays to a picture: pass by pass, tile by tile, with any shader.
#pragma once

#include "base/image.h"
#include "base/progress.h"
#include "gather/shading.h"
#include "scene/scene.h"

namespace roomlight {

struct PictureSettings {
  int width = 960, height = 540;
  int samples = 8;          // camera rays a pixel, at most
  int firstSamples = 8;     // before it is known which pixels need more
  float tolerance = 0;  // relative standard error of a pixel's luminance above which it does; 0: all pixels get all
  int raysPerShading = 2;  // camera rays that see one surface and share its light: cones, shadow rays, a reflection
  int laterShare = 1;  // times as many share it after the first pass
  int fewestShadings = 2;  // where there are as many rays
  int gatherEvery = 1;  // pixels of which one gathers for all, a power of two, by as many times the estimates; the
                        // filter spreads what it finds
  int filterPasses = 5;  // of the filter that removes remaining noise (filter.h); 0: none
  float rayRoughness = 0.3f;  // reflections below this roughness get a ray of their own
  bool rareApart = false;  // light that single rays find far beyond what all should find is filtered apart
  bool white = false;  // what the camera sees straight, or through panes, is whitened (scene/surface.h)
  bool orNothing = false;  // once progress says stop no picture is made; else the first pass is ended
  double timeLimitS = 0;  // no pass after the first is begun that would end later
  bool tellsError = false;  // estimates what error is left
  double untilMse = 0;  // and, where above 0, goes on until that is no larger, or all samples are taken
  uint64_t seed = 0;
};

// Estimates of what a picture is off by, below 0: not known.
struct ErrorLeft {
  double relative =
      -1;  // root mean square over pixels, relative to their luminance (dark ones: to a twentieth of the mean)
  double srgbMse = -1;  // as compare's mse: exposed automatically and encoded as sRGB
};

struct GatheredPicture {
  Image image;  // linear, cd/m²
  Image occlusion;  // mean ambient occlusion, 0 open to 1 closed, in every channel; empty where nothing is closed, or
                    // the technique does not ask
  std::vector<Image> layers;  // where the shader keeps light apart: their sum is `image`
  int samples = 0;
  ErrorLeft error;  // where it was to be told (error_probes.h)
  uint64_t rays = 0, cones = 0;
  size_t layerBytes = 0;  // taken by sums of layers while they were added up
};

GatheredPicture gatherPicture(const RayScene& rays, const Lights& lights, const SurfaceShader& shader,
                              const Camera& camera, const PictureSettings& settings, const Progress& progress);

}  // namespace roomlight
