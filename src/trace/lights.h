// Every light of a scene, sampled directly: lamps, emissive meshes, suns and the sky.
#pragma once

#include <span>
#include <vector>

#include "base/sampler.h"
#include "scene/scene.h"
#include "trace/emitter_pieces.h"
#include "trace/lamp_light.h"
#include "trace/light_tree.h"
#include "trace/sky_distribution.h"
#include "trace/surface_point.h"

namespace roomlight {

// A ray that leaves a light.
struct LightRay {
  Vec3 origin, direction;
  Vec3 fluxLm;  // emission / density: all the light of what it was chosen from, if this were the only ray
  int32_t lamp = -1;     // that it left, of all lamps
  int32_t emitter = -1;  // or emissive mesh
};

class MeanEmission;

class Lights {
 public:
  struct EmitterTriangle {
    uint32_t triangle;
    float share; // of the emitter's flux
    float areaM2;
    TriangleVertices v;
    Vec3 normal; // unit, of the front
  };

  // `sunApart`: the sun in an image of the sky counts as one of the suns. The same light, for who takes care of sharp
  // shadows.
  explicit Lights(const Scene& scene, bool sunApart = false);
  // Of a scene that was edited where it stands; suns and sky are as before, and taken from there.
  Lights(const Scene& scene, Lights&& before);
  Lights(Lights&&) = default;
  Lights(const Lights&) = delete;

  // One of the lamps, of the emissive meshes, or of both (lamps first), by what each could give at p without shadows;
  // and the chance with which a certain one is chosen.
  LightTree::Choice chooseLamp(Vec3 p, float choice) const { return choose(lampRange(), p, choice); }
  float chanceOfLamp(size_t index, Vec3 p) const { return chanceOf(lampRange(), index, p); }
  LightTree::Choice chooseEmitter(Vec3 p, float choice) const;
  float chanceOfEmitter(size_t index, Vec3 p) const { return chanceOf(emitterRange(), lamps_.size() + index, p); }
  LightTree::Choice chooseLocal(Vec3 p, float choice) const { return choose(localRange(), p, choice); }
  float chanceOfLocal(size_t index, Vec3 p) const { return chanceOf(localRange(), index, p); }
  size_t localCount() const { return lamps_.size() + emitters_.size(); }
  float localImportance(size_t index, Vec3 p) const {
    return index < lamps_.size() ? importance(lampTerms_[index], p)
                                 : importance(emitterTerms_[index - lamps_.size()], p);
  }
  // Groups of lamps, of emissive meshes and of both, whose numbers are as everywhere here; empty where there are at
  // most kMostOneByOne.
  static constexpr size_t kMostOneByOne = 64;
  const LightTree& lampTree() const { return lampTree_; }
  const LightTree& emitterTree() const { return emitterTree_; }
  const LightTree& localTree() const { return localTree_; }
  // All point and spot lamps one by one (no emissive meshes).
  size_t lampCount() const { return lamps_.size(); }
  const Lamp& lamp(size_t index) const { return lamps_[index]; }
  bool hasExtendedLamps() const { return extendedLamps_; }
  LightSample sampleLamp(size_t index, Vec3 p, Vec2 u) const;
  // One of them, chosen by what each could give at p without shadows.
  LightSample sampleLamps(Vec3 p, Sampler& sampler) const;
  // Rays leave the lamps in proportion to their flux, in their LampDirections.
  LightRay sampleLampRay(Sampler& sampler) const;
  // The same of one of them alone.
  LightRay sampleLampRay(size_t index, Sampler& sampler) const;
  // Such rays per m² of a surface element at p with normal n, of all rays, if nothing stands between. Of an extended
  // lamp as if all came from its centre.
  float lampDensity(Vec3 p, Vec3 n) const;
  // One sample among emissive meshes only, and its density.
  LightSample sampleEmitters(Vec3 p, Vec2 u, float choice) const;
  float pdfEmitters(Vec3 p, const SurfacePoint& q) const;
  // The same of one alone, as if there were no other, and what its light at p could be without shadows, for choosing.
  LightSample sampleEmitter(size_t index, Vec3 p, Vec2 u, float choice) const {
    return sampleEmitter(index, emitterPieces(index, p), p, u, choice);
  }
  // For several samples of it at one place: what its pieces could give there.
  EmitterPieces::Weights emitterPieces(size_t index, Vec3 p) const { return emitters_[index].pieces.weights(p); }
  LightSample sampleEmitter(size_t index, const EmitterPieces::Weights& pieces, Vec3 p, Vec2 u, float choice) const {
    return sampleEmitter(emitters_[index], pieces, p, u, choice, 1);
  }
  // A point of one triangle of it, chosen with that chance; dark where the triangle does not shine towards p.
  LightSample sampleEmitterTriangle(size_t index, size_t triangle, float chance, Vec3 p, Vec2 u) const {
    return sampleOnTriangle(emitters_[index], emitters_[index].triangles[triangle], chance, p, u);
  }
  float pdfEmitter(size_t index, Vec3 p, const SurfacePoint& q) const { return pdfInEmitter(emitters_[index], p, q); }
  float emitterImportance(size_t index, Vec3 p) const { return importance(emitterTerms_[index], p); }
  float lampImportance(size_t index, Vec3 p) const { return importance(lampTerms_[index], p); }
  // Emissive meshes one by one: each is all of one instance that emits.
  size_t emitterCount() const { return emitters_.size(); }
  int32_t emitterOf(uint32_t instance) const { return emitterOfInstance_[instance]; }  // -1: none
  uint32_t emitterInstance(size_t index) const { return emitters_[index].instance; }
  const Bounds3& emitterBounds(size_t index) const { return emitters_[index].bounds; }
  float emitterAreaM2(size_t index) const { return emitters_[index].areaM2; }  // of one side
  float emitterFluxLm(size_t index) const { return emitters_[index].fluxLm; }  // luminous
  bool emitterShinesTwice(size_t index) const { return emitters_[index].doubleSided; }  // to both sides
  std::span<const EmitterTriangle> emitterTriangles(size_t index) const { return emitters_[index].triangles; }
  // From its surface: places by flux, directions by cosine.
  LightRay sampleEmitterRay(size_t index, Sampler& sampler) const;

  size_t sunCount() const { return suns_.size() + (sky_.hasSpot() ? 1 : 0); }
  LightSample sampleSun(size_t index, Vec2 u) const;
  Bounds3 sunDirections(size_t index) const;  // a box that holds all unit directions of it
  // Radiance of sun discs along d with the density sampleSun has there (0 outside and for delta suns).
  Vec3 sunDisc(size_t index, Vec3 d, float& pdf) const;

  const SkyDistribution& sky() const { return sky_; }
  LightSample sampleSky(Vec2 u) const;

  bool hasLocal() const { return !lamps_.empty() || !emitters_.empty(); }
  bool hasEmitters() const { return !emitters_.empty(); }
  double emittedFluxLm() const { return emitterFluxLm_; }  // of emissive meshes
  double lampFluxLm() const { return lampFluxLm_; }  // by which lamps share rays: of a spot as if without falloff

 private:
  struct Emitter {
    uint32_t instance;
    Vec3 centre, normal;  // normal: of a flat one-sided emitter, else zero
    Bounds3 bounds;
    float areaM2 = 0;
    float fluxLm = 0;
    bool doubleSided = false;
    bool even = true;  // emits the same everywhere
    Vec3 emission;  // if so
    EmitterPieces pieces;
    std::vector<EmitterTriangle> triangles;  // by piece
    std::vector<float> cdf;  // upper ends of their shares
    std::vector<int32_t> slotOfTriangle;  // mesh triangle -> index into triangles, -1: does not emit
  };
  struct EmitterTerms {  // of emitters_[i], worked out once
    Vec3 centre, normal;  // normal: zero unless it lies in a plane and shines to one side
    float cd;  // its flux over pi
    float least2;  // m2, of the distance at least
  };
  struct LampTerms {  // of lamps_[i], worked out once
    Vec3 position, direction;
    float intensityCd;  // luminance
    float cosInner, cosOuter;  // of a spot; -1 for a point
    float raysPerSr,
        cosSpread;  // density of lamp rays, of all lamps' rays, inside the cone of that cosine; without a web
    const Lamp* web;  // the lamp, where it has a web
    float radius2 = 0;  // m²; of an extended lamp
    bool shinesUp = true;  // of a web
  };
  // Lamps, emissive meshes, or both, as indices into the list "lamps, then emissive meshes".
  struct Range {
    size_t first, last;
    const LightTree& tree;  // empty where there are few
  };
  Range lampRange() const { return {0, lamps_.size(), lampTree_}; }
  Range emitterRange() const { return {lamps_.size(), lamps_.size() + emitters_.size(), emitterTree_}; }
  Range localRange() const { return {0, lamps_.size() + emitters_.size(), localTree_}; }
  // One chosen by what each could give at p without shadows, and the chance. Lamps come first, then emissive meshes.
  LightTree::Choice choose(const Range& among, Vec3 p, float choice) const;
  float chanceOf(const Range& among, size_t index, Vec3 p) const;
  LightTree treeOf(size_t first, size_t last) const;
  void addAllLocal();
  void addEmitter(uint32_t instance, MeanEmission& means);
  static float importance(const EmitterTerms& e, Vec3 p);
  float importance(const LampTerms& lamp, Vec3 p) const;
  float webImportance(const LampTerms& lamp, Vec3 p) const;
  void addLamps();
  LightRay lampRay(size_t index, Vec2 u, float chance, Sampler& sampler) const;
  LightSample sampleEmitter(const Emitter& e, const EmitterPieces::Weights& pieces, Vec3 p, Vec2 u, float choice,
                            float chance) const;
  LightSample sampleEmitter(const Emitter& e, Vec3 p, Vec2 u, float choice, float chance) const {
    return sampleEmitter(e, e.pieces.weights(p), p, u, choice, chance);
  }
  LightSample sampleOnTriangle(const Emitter& e, const EmitterTriangle& t, float chance, Vec3 p, Vec2 u) const;
  float pdfInEmitter(const Emitter& e, Vec3 p, const SurfacePoint& q) const;
  static void takePieces(Emitter& e);
  static const EmitterTriangle& chosenTriangle(const Emitter& e, float choice);
  Vec3 emissionAt(const Emitter& e, const EmitterTriangle& t, Vec2 b) const;

  const Scene& scene_;
  std::vector<Lamp> lamps_;
  std::vector<float> lampShare_;  // of all rays from lamps
  std::vector<LampDirections> lampDirections_;
  std::vector<LampTerms> lampTerms_;
  std::vector<Sun> suns_;
  std::vector<Emitter> emitters_;
  std::vector<EmitterTerms> emitterTerms_;  // of each
  std::vector<int32_t> emitterOfInstance_;
  LightTree lampTree_, emitterTree_, localTree_;
  SkyDistribution sky_;
  double emitterFluxLm_ = 0, lampFluxLm_ = 0;
  bool extendedLamps_ = false;
};

}  // namespace roomlight
