// One path from the camera, or from a light meter, to where it ends, with light sampled at every vertex.
#pragma once

#include "base/sampler.h"
#include "filter/filter.h"
#include "reference/light_vertices.h"
#include "reference/visible_lights.h"
#include "trace/light_layers.h"
#include "trace/surfaces.h"

namespace roomlight {

// Where light of a path goes that is kept apart: a sum for each layer.
struct PathLayers {
  const LightLayers& lights;
  std::span<Vec3> sums;
  void add(int32_t layer, Vec3 light) {
    if (layer >= 0) sums[static_cast<size_t>(layer)] += light;
  }
};

class PathWalk {
 public:
  // vertices: of light paths to connect to, or null.
  // visible: of these lights, by which they are chosen.
  // white: what is seen first, or through panes, is whitened (scene/surface.h).
  // causticsKnown: what CausticSplats bring is left out.
  PathWalk(const RayScene& rays, const Lights& lights, const VisibleLights& visible,
           const LightVertices* vertices = nullptr, bool white = false, bool causticsKnown = false)
      : rays_(rays),
        lights_(lights),
        visible_(visible),
        surfaces_(rays.surfaces()),
        vertices_(vertices && !vertices->all().empty() ? vertices : nullptr),
        white_(white),
        causticsKnown_(causticsKnown) {}

  // Towards the ray's origin, cd/m²; added to `layers` as well, if there are.
  Vec3 radiance(const Ray& ray, Sampler& sampler, uint64_t& rayCount, PathLayers* layers = nullptr) const;
  // The same, and for a filter: parts of the light, by how the first surface that is no mirror scatters it, and what is
  // seen there, looking through panes. Variances are left alone; of what was in `seen` nothing is kept.
  Vec3 radiance(const Ray& ray, Sampler& sampler, uint64_t& rayCount, FilterPixel& seen,
                PathLayers* layers = nullptr) const;
  // On a surface element, lux. Without what comes straight from the sky, through panes too: who calls adds that.
  Vec3 illuminanceButSky(Vec3 p, Vec3 n, Sampler& sampler, uint64_t& rayCount) const;

 private:
  struct State;
  struct Vertex;
  struct Candidates;
  struct Parts;
  struct NoRecord;
  struct Apart;
  class FirstSurface;
  template <class Record>
  Vec3 follow(State& path, Sampler& sampler, uint64_t& rayCount, Record record) const;
  Vec3 skyBehind(const State& path) const;
  Vec3 sunsBehind(const State& path) const;
  float emissionWeight(const State& path, const SurfacePoint& s, int32_t emitter) const;
  float lampShareAt(const State& path, const SurfacePoint& s, const Bsdf& bsdf) const;
  bool passThrough(State& path, const SurfacePoint& s, const Bsdf& bsdf, Sampler& sampler) const;
  // What goes to `parts` and `diffuse`, where that is asked for, is contained in the value.
  template <bool kParts>
  Vec3 lit(const State& path, const Vertex& at, const Candidates& candidates, Sampler& sampler, uint64_t& rayCount,
           Parts* parts) const;
  template <bool kParts>
  Vec3 contribution(const Vertex& at, const LightSample& light, uint64_t& rayCount, Vec3* diffuse) const;
  template <bool kParts>
  Vec3 direct(const Vertex& at, Sampler& sampler, uint64_t& rayCount, Parts* parts, const Apart& apart,
              bool skyToo = true) const;
  template <bool kParts>
  Vec3 connected(const Vertex& at, const Candidates& candidates, Sampler& sampler, uint64_t& rayCount, Vec3* diffuse,
                 const Apart& apart) const;

  const RayScene& rays_;
  const Lights& lights_;
  const VisibleLights& visible_;
  const Surfaces& surfaces_;
  const LightVertices* vertices_;
  const bool white_, causticsKnown_;
};

}  // namespace roomlight
