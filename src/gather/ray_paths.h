// What the two halves of technique hybrid's shading hand to one another: RayScatter sends rays from surfaces, RayShader
// follows them.
#pragma once

#include <span>
#include <vector>

#include "gather/hit_survey.h"
#include "gather/shading.h"
#include "trace/bsdf.h"

namespace roomlight {

constexpr float kClear = 0.1f;  // roughness below which a reflection is a picture: what it shows is lit afresh
constexpr float kSpread = 0.4f;  // roughness, at least, with which what rough surfaces see reflects suns and lamps

// A ray on its way, and the parts of what it finds that its surface's lobes send to the eye.
struct GatherPath {
  Ray ray;
  Lobes factor;
  Vec3 from;  // where its direction was chosen,
  float pdf;  // and with which density; 0: no light was sampled for it
  int32_t side;  // of a brick, that samples of lights, sky and bright patches there followed
  uint32_t estimate;
  uint8_t depth, panes;
  bool clear;  // what it meets is seen clearly
  bool skyKnown;  // the sky, if the ray sees it, is counted elsewhere
  bool inGlow;  // of light that surfaces beside a lamp throw on one another `from` has its part already
  bool leavesNear;  // what reaches `from` straight from a light that this lies near is in the cache
  bool lampsKnown;  // straight from lamps to `from`, too, is counted elsewhere
  bool causticsKnown;  // of what its diffuse part finds photons have brought the light straight from suns, lamps and
                       // emissive meshes, once polished surfaces have reflected it
  bool picture;  // seen by the camera in a surface as smooth as a mirror
  float spread;  // roughness, at least, with which surfaces reflect suns and lamps for it
  bool sunKnown = false;  // what it finds of the sun itself is counted elsewhere
};

// A surface to be lit. The first has its lobes apart; later ones send their light back along a path.
struct GatherVertex {
  const SurfacePoint& s;
  const Bsdf& bsdf;
  Lobes factor;
  int32_t side;
  uint32_t estimate;
  uint8_t depth;
  bool first, followed, apart, clear;  // apart: the glossy lobe has rays of its own
  bool leavesNear = false;  // light straight from lights it lies near is in the cache
  bool skyKnown = false, lampsKnown = false;
  bool inGlow =
      false;  // points stand for what it reflects of lamps that it lies near, straight from them or not (LampGlow)
  bool causticsKnown = false;  // photons have brought what polished surfaces throw on the first; of later vertices:
                               // they are such surfaces
  bool glossOnly = false;  // leaves the diffuse lobe's light to others
  float gloss = 0;  // above zero: of a later vertex the glossy lobe alone, times this,
  bool sunKnown = false;  // and without what it reflects of the sun
  const Bsdf* blunt = nullptr;  // of later vertices, in place of `bsdf` towards suns and lamps
  const GuideCones* cones = nullptr;  // that part of the rays which gather diffuse light follow

  // Whether what its glossy lobe reflects is seen as a picture.
  bool picture() const { return first && apart && clear && s.m.roughness < kMirrorRoughness; }
  // Density of such rays, where that of unguided ones is known.
  float guided(float pdf, Vec3 wi) const {
    return cones ? (1 - cones->share) * pdf + cones->share * cones->pdf(wi) : pdf;
  }

  Lobes value(Vec3 wi) const {
    if (first) return {glossOnly ? Vec3(0) : bsdf.evaluateDiffuse(wi), followed ? Vec3(0) : bsdf.evaluateSpecular(wi)};
    return later(bsdf, wi);
  }
  // The same of a later vertex.
  Lobes later(const Bsdf& by, Vec3 wi) const {
    const Vec3 f = gloss > 0 ? by.evaluateSpecular(wi) * gloss : by.evaluate(wi);
    return {factor.diffuse * f, factor.specular * f};
  }
  // Density with which its rays go on along wi.
  float pdf(Vec3 wi) const { return gloss > 0 ? bsdf.pdfSpecular(wi) : bsdf.pdf(wi); }
};

// Of a path's light that photons may have brought, what they have not: it came from a light, by polished surfaces
// alone, to that whose diffuse lobe began the path.
inline Lobes withoutCaustics(const Lobes& factor, bool known) {
  return {known ? Vec3(0) : factor.diffuse, factor.specular};
}

// Where a gathering ray arrived that a cache could answer.
struct HitArrival {
  HitPlace at;
  Hit hit;
  Vec3 direction;
  int64_t slot;
  bool sure;  // nothing else lies in the slot's voxel
  uint32_t shading;  // that the ray came from,
  bool first;  // straight, to gather diffuse light,
  float factor;  // luminous part of what it finds that reaches the eye
};

// What photons bring to a surface, looked up for one place and good for those around it.
struct NearCaustics {
  Vec3 p, n;
  CausticMap::Light light;  // evenM2 0: none is known
  std::vector<Vec3> byLayer;

  bool holdsAt(Vec3 q, Vec3 normal) const {
    constexpr float kSameNormal = 0.9999f;
    return lengthSquared(q - p) < light.evenM2 && dot(n, normal) > kSameNormal;
  }
};

struct GatherWork {
  struct Shadowed {
    uint32_t estimate;
    bool sure, layersOnly, mirrored;  // mirrored: by what is as smooth as a mirror, from what the camera sees in it
    Lobes light;
    LightOrigin origin;
  };
  struct Doubt {
    GatherPath path;
    Hit hit;
    int64_t slot;
    Vec3 p, n;
    const HitCell* cell;  // in place of the slot, where there is one
  };
  // Per estimate; those of a shading follow one another.
  std::vector<Sampler> samplers;
  std::vector<Lobes> found;
  std::vector<float> most;  // luminance that a single path may add, by either lobe,
  std::vector<float> expected;  // and that all together should
  std::vector<Vec3> rare;  // of `found`, what single diffuse finds have beyond `rareFrom` times that
  float rareFrom = kInfinity;
  std::vector<Vec3> mirrored;  // of `found`, emission seen as a picture
  std::vector<GatherPath> paths, next;
  std::vector<Ray> rays;
  std::vector<Hit> hits;
  std::vector<Vec3> places;  // where rays arrived: all,
  std::vector<HitPlace> cells;  // those that a cell may know (normals of any length), and
  std::vector<Hit> surfaces;  // those whose surface is looked at
  std::vector<Ray> shadowRays;
  std::vector<Shadowed> shadowed;
  std::vector<Vec3> left;
  std::vector<Doubt> doubts;
  uint64_t rayCount = 0;
  NearCaustics caustics;
  const HitSurvey* survey = nullptr;  // what is known of places where rays arrive; never null while rays are sent
  std::vector<HitArrival>* arrivals = nullptr;  // where given, rays tell only where they arrive: no light is asked for
  // Where light is kept in layers: sums of the shadings, the one of each estimate, and the part that the estimate has
  // in it.
  LayerSums* layers = nullptr;
  const LightLayers* lightLayers = nullptr;
  bool layersAlone = false;  // for meters: nobody wants the sum of all light
  std::vector<uint32_t> shadingOf;  // of each estimate
  std::span<SurfaceLight> shaded;  // light of the shadings
  std::vector<float> part;

  void clear() {
    samplers.clear(), found.clear(), most.clear(), expected.clear(), rare.clear(), mirrored.clear(), paths.clear(),
        next.clear(), shadingOf.clear(), part.clear();
    caustics.light.evenM2 = 0;
    rayCount = 0, layers = nullptr, layersAlone = false, survey = nullptr, arrivals = nullptr, rareFrom = kInfinity;
  }
  void arrive(const GatherPath& path, const Hit& hit, const HitPlace& at, int64_t slot, bool sure) {
    const bool gathers = path.depth == 1 && !isBlack(path.factor.diffuse);
    arrivals->push_back({at, hit, path.ray.direction, slot, sure, shadingOf[path.estimate], gathers,
                         luminance(path.factor.diffuse + path.factor.specular)});
  }
  // `sure`: of a light that is sampled too, so that none of its samples stands for much. Returns what was added.
  Lobes add(uint32_t estimate, const Lobes& factor, Vec3 radiance, const LightOrigin& origin, bool sure = false) {
    const auto bounded = [&](Vec3 light, float limit) {
      const float l = luminance(light);
      return sure || l <= limit ? light : light * (limit / l);
    };
    const Lobes light{bounded(factor.diffuse * radiance, most[estimate]),
                      bounded(factor.specular * radiance, most[estimate])};
    const float diffuse = luminance(light.diffuse), usual = rareFrom * expected[estimate];
    if (usual > 0 && diffuse > usual) rare[estimate] += light.diffuse * (1 - usual / diffuse);
    found[estimate].diffuse += light.diffuse;
    found[estimate].specular += light.specular;
    if (layers) addToLayers(estimate, light, origin);
    return light;
  }
  // What a path's first ray shows of other things.
  void show(const GatherPath& path, Vec3 p, Vec3 n) {
    if (!path.picture || path.depth != 1 || arrivals) return;
    shaded[shadingOf[path.estimate]].reflected.add({n, p, 1}, luminance(path.factor.specular));
  }
  // Of what was added: emission seen as a picture.
  void takeMirrored(uint32_t estimate, Vec3 specular, const LightOrigin& origin);
  void takeMirroredOfLayer(uint32_t estimate, Vec3 specular, const LightOrigin& origin);
  void addToLayers(uint32_t estimate, const Lobes& light, const LightOrigin& origin);
  void shadow(const Ray& ray, const Shadowed& what) { shadowRays.push_back(ray), shadowed.push_back(what); }
};

}  // namespace roomlight
