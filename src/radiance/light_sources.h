// Sources of light as a cache keeps them: what each sends straight to slots, and by particles to what is near it. It is
// traced once, scaled when the source is dimmed, and traced again only where a change has to do with it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "radiance/direct_light.h"
#include "radiance/links.h"
#include "radiance/near_lights.h"
#include "radiance/radiance_field.h"
#include "radiance/slot_light.h"
#include "trace/lights.h"

namespace roomlight {

// What the light of an emissive mesh hangs on, so that light traced for it is known again.
struct EmissiveMesh {
  EmissiveMesh() = default;
  EmissiveMesh(const Scene& scene, uint32_t instance);

  uint32_t instance = 0;
  int mesh = -1, texture = -1;
  bool doubleSided = false;
  Affine place;
  Vec3 emission;  // cd/m², by which the texture's is scaled

  // Whether the light of `o` is this one's, scaled.
  bool shinesLike(const EmissiveMesh& o) const;
  bool operator==(const EmissiveMesh&) const = default;
};

// Per channel; 0 where neither shines.
Vec3 scaleBetween(Vec3 from, Vec3 to);

// Of lamps, and of emissive meshes, that were switched off so many are kept, the newest, and in so much memory: when
// they come back nothing is traced.
constexpr size_t kMostDarkSources = 16, kMostDarkBytes = size_t{128} << 20;

// What light is traced with: the home as it is now.
struct LightTracing {
  const RayScene& rays;
  const Lights& lights;
  const Voxels& voxels;
  const Progress& progress;
  const SlotPaths& paths;
  const RadianceSettings& settings;
  const RadianceField& field;  // what is known so far: where the sky is seen, what is seen of lights
  const BrickImportance& importance;
  bool fewParticles;  // a first look: the rest follows with bounces
  uint64_t& rayCount;  // counts those traced

  SlotSampling slots() const { return {voxels, paths, settings.seed}; }
  DirectLight direct() const { return {rays, lights, slots(), field.seen, importance, settings}; }

  using OfBrick = std::function<void(size_t brick, std::vector<Vec3>& lux)>;
  SlotLight lightOfAll(const OfBrick& ofBrick) const;
  // Traces a light in a brick: all of it, or what boxes have to do with (see DirectLight).
  using BrickTracer = std::function<void(size_t brick, std::span<const Bounds3> near, std::span<Vec3> lux)>;
  SlotLight updated(const SlotLight& before, const SlotChange& change, const BrickTracer& trace) const;
  // None where there is no surface near the source.
  ParticleLight particlesFrom(ParticleSource source) const;
  // After a change, of the same source.
  void update(const SlotChange& change, const ParticleSource& source, ParticleLight& particles) const;
};

// A source whose light is kept apart from that of others.
class LightSource {
 public:
  // That makes what is kept its light now, per channel; 0 where it has been switched off: it may come back.
  Vec3 scale() const { return scale_; }
  bool isDark() const { return isBlack(scale_); }
  // lx, one value per slot.
  void addTo(const Voxels& voxels, std::span<Vec3> lux) const {
    if (!isDark()) direct_.addTo(voxels, scale_, lux);
  }
  const ParticleLight& particles() const { return particles_; }
  bool needsAllParticles() const { return particles_.few && !isDark(); }
  size_t bytes() const { return direct_.bytes() + particles_.bytes(); }

 protected:
  explicit LightSource(Vec3 scale) : scale_(scale) {}
  Vec3 scale_;
  SlotLight direct_;
  ParticleLight particles_;
};

// What is kept of it is for 1 cd.
class LampSource : public LightSource {
 public:
  LampSource(const LightTracing& t, const Lamp& lamp);
  const Lamp& lamp() const { return lamp_; }
  // Whether that lamp's light is this one's, scaled.
  bool shinesLike(const Lamp& lamp) const;
  void become(const Lamp& lamp) { lamp_ = lamp, scale_ = lamp.intensityCd; }
  void switchOff() { scale_ = {}; }
  // After a change of the home, of the lamp where it was.
  void updateDirect(const LightTracing& t, DirectLight& direct, const SlotChange& change);
  void updateParticles(const LightTracing& t, const SlotChange& change);
  void traceAllParticles(const LightTracing& t);

 private:
  Lamp lamp_;
};

class EmitterSource : public LightSource {
 public:
  // `apart`: else its light on slots is kept together with that of all others, and only its particles here. `small`:
  // how many emissive meshes send particles out.
  EmitterSource(const LightTracing& t, size_t index, bool apart, size_t small);
  const EmissiveMesh& mesh() const { return mesh_; }  // as it was when it was traced
  int32_t index() const { return index_; }  // of all emissive meshes; -1: dark
  void become(size_t index, const EmissiveMesh& now);
  void switchOff() { scale_ = {}, index_ = -1; }
  void updateDirect(const LightTracing& t, DirectLight& direct, const EmissiveMesh& now, bool apart,
                    const SlotChange& change);
  void updateParticles(const LightTracing& t, size_t small, const SlotChange& change);
  void traceAllParticles(const LightTracing& t, size_t small);

 private:
  EmissiveMesh mesh_;
  int32_t index_;
};

// What particles of a source that shines have left.
struct LitParticles {
  const ParticleLight* particles;
  Vec3 scale;  // that makes them its light
  int32_t lamp, emitter;  // whose; -1: none
};

// All suns and the sky.
class DaylightSource {
 public:
  // Also where suns light what sends their light on by place (`sunPoints`), where those are wanted. `othersGuide`: of
  // bricks by their neighbours, where links share the light of the sky; empty: they do not.
  void trace(const LightTracing& t, const Links& links, const SkyGuide& othersGuide, std::vector<GlowPoint>& sunPoints);
  void update(const LightTracing& t, const SlotChange& change);
  const SlotLight& suns() const { return suns_; }
  const SlotLight& sky() const { return sky_; }
  size_t bytes() const { return suns_.bytes() + sky_.bytes() + ways_.size() * sizeof(ways_[0]); }

 private:
  SlotLight suns_, sky_;
  SkyDirections ways_;  // empty: no sky
};

// All lamps: one by one or, where they are many and stay as they are, together. Of those that were switched off the
// newest are kept.
class LampSources {
 public:
  static bool apart(const RadianceSettings& settings, const Lights& lights);
  // What is known of lamps in the same place stays; the rest is traced.
  void match(const LightTracing& t);
  void update(const LightTracing& t, const SlotChange& change);
  void traceAllParticles(const LightTracing& t);
  bool hasFewParticles() const;
  // The scene's lamps in their order, and then those that were switched off; none where they are lit together.
  const std::vector<LampSource>& each() const { return each_; }
  const SlotLight& together() const { return together_; }
  void addParticles(std::vector<LitParticles>& to) const;
  size_t bytes() const;

 private:
  void forgetBut(const Lights& lights);
  std::vector<LampSource> each_;
  SlotLight together_;
  ParticleLight particlesTogether_;
};

// All emissive meshes: one by one or, where they are many, together but for their particles.
class EmitterSources {
 public:
  static bool apart(const RadianceSettings& settings, const Lights& lights);
  void match(const LightTracing& t);
  void update(const LightTracing& t, const SlotChange& change);
  void traceAllParticles(const LightTracing& t);
  bool hasFewParticles() const;
  const std::vector<EmitterSource>& each() const { return each_; }
  const SlotLight& together() const { return together_; }
  // Of one mesh, straight; traced where it is not kept apart.
  void addEmitter(const LightTracing& t, size_t index, std::vector<Vec3>& lux) const;
  void addParticles(std::vector<LitParticles>& to) const;
  size_t bytes() const;

 private:
  std::vector<EmitterSource> each_;
  SlotLight together_;
  std::vector<EmissiveMesh> knownTogether_;  // as they were then
};

}  // namespace roomlight
