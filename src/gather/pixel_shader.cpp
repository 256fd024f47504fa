#include "gather/pixel_shader.h"

#include <algorithm>

#include "trace/bsdf.h"

namespace roomlight {
namespace {

constexpr int kMostPanes = 16;
constexpr float kSameNormal = 0.95f;  // cosine between normals of one surface
constexpr float kSamePlane = 0.3f;    // of the distance between two points: how far off the tangent plane
constexpr float kBehind = -0.35f;     // cosine
// What a veil or pane itself reflects is filtered with the surface behind it. The filter compares planes: a surface
// seen through something lies as if this far behind where it is, in proportion to what is held back, and so apart from
// what is seen of it beside the veil.
constexpr float kVeilM = 2;
constexpr float kVeilRoughness =
    1;  // before the sky: reflections of few samples are filtered as on what stands behind veils elsewhere
constexpr float kOutshines = 16,
                kShadeM =
                    0.3f;  // times as bright as what fills most of a pixel, as far from a lamp as its shade may be
constexpr float kUnobstructed = 0.999f;  // of the light left: below, something stands before
constexpr float kLeastSurvival = 0.25f;  // probability that cloth behind cloth is lit
constexpr float kGlint =
    1e-4f;       // of a bidirectional reflectance, where a white wall has .32: less is not seen of a lamp in a pane
constexpr float kMirrorReflectance = 0.2f;  // brighter, and smooth: a mirror

// What panes reflect is seen by all rays.
bool isPane(const MaterialSample& m, bool clear) { return m.roughness < kMirrorRoughness && clear; }

bool isBesideLamp(const Lights& lights, Vec3 p) {
  for (size_t i = 0; i < lights.lampCount(); ++i) {
    if (length(lights.lamp(i).position - p) < kShadeM) return true;
  }
  for (size_t i = 0; i < lights.emitterCount(); ++i) {
    const Bounds3& b = lights.emitterBounds(i);
    if (length(max(max(b.lo - p, p - b.hi), Vec3(0))) < kShadeM) return true;
  }
  return false;
}

void accumulate(MaterialSample& sum, const MaterialSample& m, float weight) {
  sum.baseColor += m.baseColor * weight, sum.emission += m.emission * weight, sum.f0 += m.f0 * weight,
      sum.f90 += m.f90 * weight;
  sum.alpha += m.alpha * weight, sum.metallic += m.metallic * weight, sum.roughness += m.roughness * weight,
      sum.transmission += m.transmission * weight;
  sum.glazed = m.glazed;
}

// Which of `every` pixels along the curve gathers in a pass: far from those of passes before.
uint32_t turn(uint32_t pass, uint32_t every) {
  uint32_t turn = 0;
  for (uint32_t bit = pass / 4, place = every / 2; place > 0; bit /= 2, place /= 2) turn += bit % 2 * place;
  return turn;
}

}  // namespace

bool isMirror(const MaterialSample& m, bool clear) {
  return m.roughness < kMirrorRoughness && !clear && luminance(m.f0) > kMirrorReflectance;
}
Vec3 veiledPlace(const SurfacePoint& s, Vec3 left) {
  return s.p + s.ns * (kVeilM * (1 - std::min(1.0f, luminance(left))));
}

PixelSequence::PixelSequence(int x, int y, uint32_t pass, uint64_t seed, uint32_t every) : seed_(seed) {
  const auto spread = [](uint32_t v) {  // a zero after every bit
    v = (v | (v << 8)) & 0x00ff00ffu;
    v = (v | (v << 4)) & 0x0f0f0f0fu;
    v = (v | (v << 2)) & 0x33333333u;
    return (v | (v << 1)) & 0x55555555u;
  };
  constexpr uint32_t kBlock = 512;  // pixels along an edge of what shares a sequence
  const auto ux = static_cast<uint32_t>(x), uy = static_cast<uint32_t>(y);
  index_ = spread(ux % kBlock) | (spread(uy % kBlock) << 1);
  key_ = mix64((uint64_t{pass} << 48) + (uint64_t{uy / kBlock} << 24) + ux / kBlock);
  gathers_ = index_ % every == turn(pass, every);
  shadingIndex_ = gathers_ ? index_ / every : index_;
}

FilterPixel meanOf(const FilterPixel& sum, const PixelCount& count) {
  FilterPixel p = sum;
  const float inverse = 1 / static_cast<float>(std::max(1u, count.rays));
  const float diffuse = count.gathered == count.rays ? inverse : 1 / static_cast<float>(std::max(1u, count.gathered));
  const float specular = count.glossy == count.rays ? inverse : 1 / static_cast<float>(std::max(1u, count.glossy));
  p.diffuse *= diffuse, p.rare *= diffuse, p.sharp *= inverse, p.albedo *= inverse, p.specular *= specular,
      p.rest *= inverse;
  const float albedo = std::max(luminance(p.albedo), 1e-3f);
  p.diffuseVariance *= diffuse * diffuse / (albedo * albedo), p.sharpVariance *= inverse * inverse / (albedo * albedo);
  p.specularVariance *= specular * specular;
  // One sample does not tell how far it is off: it is taken to be as uncertain as it is bright, as for paths
// (pixel_sums.cpp).
  if (count.rays == 1 && p.diffuseVariance <= 0) {
    const float irradiance = luminance(p.diffuse) / albedo, glossy = luminance(p.specular);
    p.diffuseVariance = irradiance * irradiance, p.specularVariance = std::max(p.specularVariance, glossy * glossy);
  }
  if (p.surface > 0) {
    p.normal = length(p.normal) > 0 ? normalize(p.normal) : p.normal;
    p.position *= 1 / p.surface;
    p.roughness *= 1 / p.surface;
  }
  p.surface *= inverse;
  p.weight = static_cast<float>(std::max(1u, count.rays));
  p.diffuseShare = static_cast<float>(count.gathered) / p.weight,
  p.specularShare = static_cast<float>(count.glossy) / p.weight;
  return p;
}

// Rays on their way through panes, with what is left of each and where it stands.
struct PixelShader::Layer {
  std::array<Ray, kRaysAtOnce> ray;
  std::array<Vec3, kRaysAtOnce> left;
  std::array<bool, kRaysAtOnce> seen{};  // whether a surface before stands for what the ray sees
  std::array<Hit, kRaysAtOnce> hit;
  size_t count = 0;
  Vec3 place(size_t i) const { return ray[i].origin + ray[i].direction * hit[i].t; }
  void add(const Ray& r, Vec3 l, bool s) { ray[count] = r, left[count] = l, seen[count++] = s; }
};

// Rays of a layer that see one surface.
struct PixelShader::Group {
  uint32_t instance = kNoHit, triangle = 0;
  Vec3 p, ng;  // where the first ray meets it
  std::array<uint8_t, kRaysAtOnce> member{};
  size_t count = 0;
};

// One of a pixel's surfaces, as rays of a layer see it.
struct PixelShader::SeenSurface {
  const Group& group;
  const Layer& layer;
  const PixelSequence& sequence;
  uint32_t surface;  // its number
  size_t rays;       // of the pixel
  Sampler forShadow(size_t ray) const { return sequence.forShadow(surface, static_cast<uint32_t>(ray)); }
};

// For how many of the rays that see a surface it is shaded.
struct PixelShader::ShadingPlan {
  bool mirror, pane;
  bool further;      // an earlier pass told what there is
  size_t most;       // shadings, were all of the pixel's rays to see it
  size_t shadings;
  float weight;      // rays that each stands for
  Vec3 left;         // of its light
  float survival;    // probability that it is lit at all
};

PixelShader::Group* PixelShader::groupOf(const Ray& ray, const Hit& hit, std::span<Group> groups, size_t& used) const {
  for (size_t i = 0; i < used; ++i) {
    if (groups[i].instance == hit.instance && groups[i].triangle == hit.triangle) return &groups[i];
  }
  const TriangleVertices t = worldTriangle(rays_.scene(), hit.instance, hit.triangle);
  const Vec3 p = ray.origin + ray.direction * hit.t, n = normalize(cross(t.b - t.a, t.c - t.a)),
             ng = dot(n, ray.direction) < 0 ? n : -n;
  for (size_t i = 0; i < used; ++i) {
    Group& g = groups[i];
    if (g.instance != hit.instance || dot(g.ng, ng) < kSameNormal) continue;
    const Vec3 between = p - g.p;
    if (std::abs(dot(between, g.ng)) <= kSamePlane * length(between)) return &g;
  }
  groups[used] = {hit.instance, hit.triangle, p, ng, {}, 0};
  return &groups[used++];
}

MaterialSample PixelShader::meanMaterial(const SeenSurface& seen, bool uniform) const {
  const Group& group = seen.group;
  const Layer& layer = seen.layer;
  if (uniform) return materialAt(rays_.scene(), layer.hit[group.member[0]]);
  MaterialSample mean{{}, 0, 0, 0, 0, {}, {}, {}, nullptr};
  for (size_t i = 0; i < group.count; ++i)
    accumulate(mean, materialAt(rays_.scene(), layer.hit[group.member[i]]), 1 / static_cast<float>(group.count));
  return mean;
}

// Whether any ray of the group could see a light that stands there in a smooth surface.
bool PixelShader::glints(const SeenSurface& seen, const MaterialSample& m, Vec3 toLight) const {
  const Layer& layer = seen.layer;
  for (size_t i = 0; i < seen.group.count; ++i) {
    const size_t k = seen.group.member[i];
    const SurfacePoint s = surfaceAt(rays_.scene(), layer.hit[k], layer.ray[k].direction, m);
    if (luminance(Bsdf(s.m, s.ns, s.ng, -layer.ray[k].direction).evaluate(toLight)) > kGlint) return true;
  }
  return false;
}

// Of all sharp lights, seen from every ray of the group; of a `smooth` surface only of those that it could show.
// Returns where they begin in `out`.
uint32_t PixelShader::shadows(const SeenSurface& seen, const MaterialSample* smooth, std::vector<Shadow>& out,
                              GatherCounters& count) const {
  const Group& group = seen.group;
  const Layer& layer = seen.layer;
  const auto begin = static_cast<uint32_t>(out.size());
  out.resize(begin + sharp_.count());
  if (sharp_.count() == 0) return begin;
  std::array<Vec3, kRaysAtOnce> points;
  std::array<Vec2, kRaysAtOnce> u;
  for (size_t i = 0; i < group.count; ++i) {
    const size_t k = group.member[i];
    points[i] = offsetOrigin(layer.place(k), group.ng);
  }
  for (size_t i = 0; i < group.count; ++i) u[i] = seen.forShadow(i).next2();
  for (size_t l = 0; l < sharp_.count(); ++l) {
    // No normal of the group, nor a shading normal worth the name, faces a light so far behind.
    const Vec3 toLight = sharp_.sample(l, group.p, u[0]).wi;
    if (dot(toLight, group.ng) < kBehind || (smooth && !glints(seen, *smooth, toLight))) continue;
    out[begin + l] = sharp_.shadow(l, std::span(points).first(group.count), std::span(u).first(group.count));
    count.rays += group.count;
  }
  return begin;
}

PixelShader::ShadingPlan PixelShader::planned(const SeenSurface& seen, const MaterialSample& m, bool clear,
                                              const PixelCount& known) const {
  const Group& group = seen.group;
  ShadingPlan plan;
  const int raysPerShading = settings_.raysPerShading * (known.rays > 0 ? settings_.laterShare : 1);
  plan.most = std::max(std::min(static_cast<size_t>(settings_.fewestShadings), seen.rays),
                       seen.rays / static_cast<size_t>(raysPerShading));
  plan.mirror = isMirror(m, clear);
  plan.pane = isPane(m, clear);
  // What panes reflect is a picture: every ray shows its own of it, at first. Panes behind others show the same again.
  plan.further = known.rays > 0 && settings_.tolerance > 0 && !byLayer_;
  for (size_t i = 0; i < group.count; ++i)
    plan.left += seen.layer.left[group.member[i]] / static_cast<float>(group.count);
  const bool hind = luminance(plan.left) < kUnobstructed;
  const size_t raysPerPane = (plan.further ? 2 : 1) * (hind ? 2 : 1);
  plan.shadings =
      plan.pane ? (group.count + raysPerPane - 1) / raysPerPane : (group.count * plan.most + seen.rays - 1) / seen.rays;
  plan.weight = static_cast<float>(group.count) / static_cast<float>(plan.shadings);
  // Of cloth behind cloth little light comes through: few are lit for all.
  plan.survival = settings_.gatherEvery <= 1 && hind && !plan.pane && clear
                      ? std::clamp(luminance(plan.left), kLeastSurvival, 1.0f)
                      : 1.0f;
  return plan;
}

// One surface: to be shaded for some of the rays with the mean of their materials, for all where it shows a picture.
void PixelShader::see(const SeenSurface& seen, PixelSum pixel, TileWork& work, Layer& behind,
                      GatherCounters& count) const {
  const Group& group = seen.group;
  const Layer& layer = seen.layer;
  const Scene& scene = rays_.scene();
  const Mesh& mesh = scene.meshes[static_cast<size_t>(scene.instances[group.instance].mesh)];
  const Material& material = scene.materials[static_cast<size_t>(mesh.material)];
  const MaterialSample mean = meanMaterial(seen, isUniform(material, mesh)),
                       m = settings_.white ? whitened(mean) : mean;
  const float cosTheta = std::abs(dot(group.ng, layer.ray[group.member[0]].direction));
  const Vec3 through = passing(m, material, cosTheta);
  const bool solid = luminance(through) < 0.5f;
  const ShadingPlan plan = planned(seen, m, !isBlack(through), *pixel.count);
  const size_t shadings = plan.shadings;
  const float weight = plan.weight;
  const Vec3 left = plan.left;
  const bool isLit = plan.survival >= 1 || seen.forShadow(0).fast1() < plan.survival;
  const uint32_t shadow = !isLit ? 0 : shadows(seen, plan.pane ? &m : nullptr, work.shadows, count);

  FilterPixel& sum = *pixel.sum;
  work.parts.push_back({pixel, static_cast<uint32_t>(work.shadings.size()), isLit ? static_cast<uint32_t>(shadings) : 0,
                        left * m.alpha, weight, seen.sequence.gathers()});
  for (size_t j = 0; j < shadings; ++j) {
    const size_t i = group.member[(2 * j + 1) * group.count / (2 * shadings)];
    const SurfacePoint s = surfaceAt(scene, layer.hit[i], layer.ray[i].direction, m);
    const Vec3 emitted = left * s.emitted() * weight;
    sum.rest += emitted;
    if (const int32_t emitter = byLayer_ ? lights_.emitterOf(group.instance) : -1; emitter >= 0)
      byLayer_->add(pixel.index, LayerSums::kRest, layers_->ofEmitter[static_cast<size_t>(emitter)], emitted);
    if (!plan.mirror && !layer.seen[i]) {
      TileWork::Part& part = work.parts.back();
      part.veil = !solid;
      part.normal += s.ns * weight, part.position += veiledPlace(s, layer.left[i]) * weight;
      part.roughness += (solid ? m.roughness : kVeilRoughness) * weight, part.surface += weight;
    }
    if (!isLit) {
      work.parts.back().unlitAlbedo +=
          left * m.alpha * Bsdf(s.m, s.ns, s.ng, -layer.ray[i].direction).diffuseAlbedo() * weight;
      continue;
    }
    work.shadings.push_back({s, -layer.ray[i].direction,
                             seen.sequence.forShading(seen.surface, static_cast<uint32_t>(j),
                                                      static_cast<uint32_t>(std::max(plan.most, shadings))),
                             shadow, plan.mirror});
    work.shadings.back().once = work.parts.back().once =
        (plan.further || plan.pane || plan.survival < 1) && weight <= (plan.pane ? 4 : 1);
  }
  work.parts.back().survival = plan.survival;
  if (!keepsFragments_ && solid) addPlace(work.parts.back());
  if (!isBlack(through)) passOn(seen, through, solid, behind);
  if (plan.mirror) reflectOn(seen, m, behind);
}

// A lamp's shade that fills a twentieth of a pixel of the wall would spread over the wall, as hot as it is; its light
// is kept where it is. Elsewhere what outshines its pixel may be noise, which is to be filtered.
void PixelShader::findOutshining(TileWork& work, std::span<const SurfaceLight> light) const {
  const auto brightness = [&](const TileWork::Part& part) {
    float sum = 0;
    for (const SurfaceLight& l : light.subspan(part.first, part.count))
      sum += luminance(l.diffuse + l.rare + l.sharp + l.specular + l.mirrored);
    return part.count > 0 ? sum / static_cast<float>(part.count) : 0;
  };
  const auto rays = [](const TileWork::Part& part) { return part.weight * static_cast<float>(part.count); };
  for (size_t begin = 0, end = 0; begin < work.parts.size(); begin = end) {
    size_t most = begin;
    for (end = begin; end < work.parts.size() && work.parts[end].pixel.sum == work.parts[begin].pixel.sum; ++end) {
      if (rays(work.parts[end]) > rays(work.parts[most])) most = end;
    }
    if (end - begin < 2 || work.parts[most].count == 0) continue;
    const float usual = brightness(work.parts[most]);
    for (size_t i = begin; i < end; ++i) {
      TileWork::Part& part = work.parts[i];
      part.apart =
          i != most && brightness(part) > kOutshines * usual && isBesideLamp(lights_, work.shadings[part.first].s.p);
    }
  }
}

void PixelShader::addPlace(const TileWork::Part& part) {
  FilterPixel& sum = *part.pixel.sum;
  sum.normal += part.normal, sum.position += part.position, sum.roughness += part.roughness,
      sum.surface += part.surface;
}

void PixelShader::addPart(const TileWork::Part& part, std::span<const SurfaceLight> shadings) {
  FilterPixel& sum = *part.pixel.sum;
  const float weight = part.weight / part.survival;
  if (part.apart) {
    for (const SurfaceLight& l : shadings)
      sum.rest += part.left * (l.diffuse + l.rare + l.sharp + l.specular + l.mirrored) * weight,
          part.pixel.count->occlusion += l.occlusion * weight;
    return;
  }
  addVariance(shadings, part);
  sum.albedo += part.unlitAlbedo;
  for (const SurfaceLight& l : shadings) {
    sum.diffuse += part.left * l.diffuse * (weight * static_cast<float>(part.gathers));
    sum.rare += part.left * l.rare * (weight * static_cast<float>(part.gathers));
    sum.sharp += part.left * l.sharp * weight;
    sum.albedo += part.left * l.albedo * part.weight;
    sum.specular += part.left * l.specular * (weight * static_cast<float>(part.glossy));
    sum.rest += part.left * l.mirrored * weight;
    if (part.pixel.reflected) part.pixel.reflected->add(l.reflected, luminance(part.left) * weight);
    part.pixel.count->occlusion += l.occlusion * weight;
  }
}

// What is no part of the surface that fills most of the pixel. Shadows and reflections on it stay as they are.
void PixelShader::addFragment(TileWork::Part& part, std::span<const SurfaceLight> shadings, Fragments& fragments) {
  const uint32_t pixel = part.pixel.index;
  std::vector<Fragment>& all = fragments.all;
  auto f = std::find_if(all.rbegin(), all.rend(), [&](const Fragment& o) { return o.pixel == pixel; });
  if (f == all.rend()) all.push_back({pixel, {}, {}, {}, {}}), f = all.rbegin();
  part.fragment = static_cast<int32_t>(all.rend() - f) - 1;
  f->normal += part.normal, f->position += part.position, f->surface += part.surface, f->albedo += part.unlitAlbedo;
  const float weight = part.weight / part.survival;
  for (const SurfaceLight& l : shadings) {
    const Vec3 diffuse = part.left * (l.diffuse + l.rare) * weight,
               other = part.left * (l.sharp + l.specular + l.mirrored) * weight;
    f->diffuse += diffuse, f->albedo += part.left * l.albedo * part.weight, f->luminance += luminance(diffuse + other);
    part.pixel.sum->rest += other;
    part.pixel.count->occlusion += l.occlusion * weight;
  }
}

void PixelShader::add(TileWork& work, std::span<const SurfaceLight> light, Fragments* fragments) {
  const auto shadingsOf = [&](const TileWork::Part& part) { return light.subspan(part.first, part.count); };
  for (size_t begin = 0, end = 0; begin < work.parts.size(); begin = end) {
    bool anySolid = false;
    for (end = begin; end < work.parts.size() && work.parts[end].pixel.sum == work.parts[begin].pixel.sum; ++end)
      anySolid = anySolid || (!work.parts[end].veil && work.parts[end].surface > 0);
    // A pane before the sky is the surface that the pixel shows, with all panes behind it.
    const auto surfaceOf = [&](const TileWork::Part& part) { return part.veil && anySolid ? 0 : part.surface; };
    size_t most = begin;
    for (size_t i = begin; i < end; ++i) {
      if (surfaceOf(work.parts[i]) > surfaceOf(work.parts[most])) most = i;
    }
    const FilterPixel& sum = *work.parts[begin].pixel.sum;
    const bool known = sum.surface > 0;
    const TileWork::Part& largest = work.parts[most];
    const float surface = known ? sum.surface : std::max(surfaceOf(largest), 1e-6f);
    const Vec3 place = (known ? sum.position : largest.position) / surface,
               normal = known ? sum.normal : largest.normal;
    for (size_t i = begin; i < end; ++i) {
      TileWork::Part& part = work.parts[i];
      if (fragments && surfaceOf(part) > 0 && !part.veil &&
          !onOneSheet(normal, place, part.normal, part.position / part.surface)) {
        part.apart = true;
        addFragment(part, shadingsOf(part), *fragments);
      } else {
        if (fragments && surfaceOf(part) > 0 &&
            (!part.veil ||
             (i == most && (!known || onOneSheet(normal, place, part.normal, part.position / part.surface)))))
          addPlace(part);
        addPart(part, shadingsOf(part));
      }
    }
  }
}

// As addVariance() has it for all light, for each layer; before its light is added.
void PixelShader::addVarianceOfLayers(const TileWork::Part& part, std::span<const SurfaceLight> whole,
                                      const LayerSums& light) const {
  if (part.count == 0) return;
  const float n = static_cast<float>(part.count), weight = part.weight / part.survival, unlit = 1 - part.survival;
  const float ofDiffuse = weight * static_cast<float>(part.gathers),
              ofSpecular = weight * static_cast<float>(part.glossy);
  const auto shadings = whole.subspan(part.first, part.count);
  float albedo = 0;
  for (const SurfaceLight& s : shadings) albedo += luminance(part.left * s.albedo);
  const float albedoBefore = luminance(part.pixel.sum->albedo) - albedo * part.weight,
              glossyBefore = static_cast<float>(std::max(1u, part.pixel.count->glossy));
  for (size_t l = 0; l < layers_->size(); ++l) {
    const auto lightOf = [&](size_t s, LayerSums::Part lobe) {
      return luminance(part.left * light.get(part.first + s, lobe, l));
    };
    float diffuse = 0, specular = 0, sharp = 0;
    for (size_t s = 0; s < shadings.size(); ++s)
      diffuse += lightOf(s, LayerSums::kDiffuse), specular += lightOf(s, LayerSums::kSpecular),
          sharp += lightOf(s, LayerSums::kSharp);
    Vec3 variance;
    if (unlit > 0)
      variance += Vec3{diffuse * diffuse * ofDiffuse * ofDiffuse, sharp * sharp * weight * weight,
                       specular * specular * ofSpecular * ofSpecular} *
                  unlit;
    // Of one shading alone parts are as uncertain as the whole, or, if that is a single estimate, by how far they are
    // off what was known before.
    const float between = n > 1 ? n / (n - 1) : part.once ? 1.0f : 0.0f;
    const float irradiance =
        n > 1 ? diffuse / std::max(albedo, 1e-6f)
              : luminance(byLayer_->get(part.pixel.index, LayerSums::kDiffuse, l)) / std::max(albedoBefore, 1e-6f);
    const float usualSpecular =
        n > 1 ? specular / n : luminance(byLayer_->get(part.pixel.index, LayerSums::kSpecular, l)) / glossyBefore;
    for (size_t s = 0; s < shadings.size(); ++s) {
      const SurfaceLight& all = shadings[s];
      const float d = lightOf(s, LayerSums::kDiffuse), g = lightOf(s, LayerSums::kSpecular);
      const float ofSharp =
          luminance(light.get(part.first + s, LayerSums::kSharp, l)) / std::max(luminance(all.sharp), 1e-20f);
      variance.y += lengthSquared(part.left) / 3 * all.sharpVariance * ofSharp * ofSharp * n * weight * weight;
      const float offDiffuse = d - luminance(part.left * all.albedo) * irradiance, offSpecular = g - usualSpecular;
      variance.x += offDiffuse * offDiffuse * between * ofDiffuse * ofDiffuse,
          variance.z += offSpecular * offSpecular * between * ofSpecular * ofSpecular;
      if (n > 1) continue;
      const float relDiffuse = d / std::max(luminance(all.diffuse), 1e-20f),
                  relSpecular = g / std::max(luminance(all.specular), 1e-20f);
      variance.x += all.diffuseVariance * relDiffuse * relDiffuse * ofDiffuse * ofDiffuse,
          variance.z += all.specularVariance * relSpecular * relSpecular * ofSpecular * ofSpecular;
    }
    byLayer_->add(part.pixel.index, LayerSums::kVariance, static_cast<int32_t>(l), variance);
  }
}

// What is not filtered with the pixel's own surface: diffuse light is its fragment's, where there is one.
void PixelShader::addLayersApart(const TileWork::Part& part, const LayerSums& light, Fragments* fragments) const {
  const Vec3 once = part.left * (part.weight / part.survival);
  for (size_t s = part.first; s < part.first + part.count; ++s) {
    for (const auto lobe : {LayerSums::kDiffuse, LayerSums::kSharp, LayerSums::kSpecular}) {
      if (part.fragment < 0 || lobe != LayerSums::kDiffuse)
        byLayer_->addFrom(part.pixel.index, LayerSums::kRest, lobe, light, s, once);
    }
    for (size_t l = 0; part.fragment >= 0 && l < layers_->size(); ++l)
      fragments->byLayer[static_cast<size_t>(part.fragment) * layers_->size() + l] +=
          once * light.get(s, LayerSums::kDiffuse, l);
  }
}

void PixelShader::addLayers(const TileWork& work, std::span<const SurfaceLight> whole, const LayerSums& light,
                            Fragments* fragments) const {
  if (fragments) fragments->byLayer.resize(fragments->all.size() * layers_->size());
  for (const TileWork::Part& part : work.parts) {
    const Vec3 once = part.left * (part.weight / part.survival), diffuse = once * static_cast<float>(part.gathers),
               specular = once * static_cast<float>(part.glossy);
    const auto add = [&](LayerSums::Part to, LayerSums::Part lobe, Vec3 factor) {
      for (size_t s = part.first; s < part.first + part.count; ++s)
        byLayer_->addFrom(part.pixel.index, to, lobe, light, s, factor);
    };
    add(LayerSums::kRest, LayerSums::kRest, once);
    if (part.apart) {
      addLayersApart(part, light, fragments);
      continue;
    }
    addVarianceOfLayers(part, whole, light);
    add(LayerSums::kDiffuse, LayerSums::kDiffuse, diffuse), add(LayerSums::kSharp, LayerSums::kSharp, once),
        add(LayerSums::kSpecular, LayerSums::kSpecular, specular);
  }
}

void PixelShader::addBackground(Vec3 left, Vec3 direction, PixelSum pixel) const {
  pixel.sum->rest += left * background(lights_, direction);
  if (!byLayer_) return;
  const Vec3 sky = skyAlong(lights_, direction);
  byLayer_->add(pixel.index, LayerSums::kRest, layers_->sky, left * sky);
  byLayer_->add(pixel.index, LayerSums::kRest, layers_->sun, left * (background(lights_, direction) - sky));
}

// From how the shadings of one surface differ. Shadows are the same for all of them, so there deviations add, not
// variances.
void PixelShader::addVariance(std::span<const SurfaceLight> light, const TileWork::Part& part) {
  FilterPixel& sum = *part.pixel.sum;
  const Vec3 left = part.left;
  const float weight = part.weight / part.survival, ofDiffuse = weight * static_cast<float>(part.gathers),
              ofSpecular = weight * static_cast<float>(part.glossy);
  float diffuse = 0, albedo = 0, specular = 0, shadows = 0;
  for (const SurfaceLight& l : light) {
    diffuse += luminance(left * l.diffuse), albedo += luminance(left * l.albedo),
        specular += luminance(left * l.specular);
    shadows += l.sharpVariance;
  }
  const float n = static_cast<float>(light.size());
  if (part.survival < 1) {  // what is lit stands for what is not, too
    const float unlit = 1 - part.survival;
    float sharp = 0;
    for (const SurfaceLight& l : light) sharp += luminance(left * l.sharp);
    sum.diffuseVariance += unlit * diffuse * diffuse * ofDiffuse * ofDiffuse,
        sum.specularVariance += unlit * specular * specular * ofSpecular * ofSpecular;
    sum.sharpVariance += unlit * sharp * sharp * weight * weight;
  }
  sum.sharpVariance += lengthSquared(left) / 3 * shadows * n * weight * weight;
  if (light.size() < 2) {
    const float l2 = luminance(left) * luminance(left), diffuse2 = l2 * ofDiffuse * ofDiffuse,
                specular2 = l2 * ofSpecular * ofSpecular;
    for (const SurfaceLight& l : light)
      sum.diffuseVariance += l.diffuseVariance * diffuse2, sum.specularVariance += l.specularVariance * specular2;
    if (!part.once) return;
    // A single estimate: how far it is off what was known before, if anything was.
    const float known = luminance(sum.diffuse) / std::max(luminance(sum.albedo), 1e-6f), off = diffuse - albedo * known;
    const float offSpecular =
        specular - luminance(sum.specular) / static_cast<float>(std::max(1u, part.pixel.count->glossy));
    sum.diffuseVariance += off * off * ofDiffuse * ofDiffuse,
        sum.specularVariance += offSpecular * offSpecular * ofSpecular * ofSpecular;
    return;
  }
  const float diffuse2 = ofDiffuse * ofDiffuse * n / (n - 1), specular2 = ofSpecular * ofSpecular * n / (n - 1),
              irradiance = diffuse / std::max(albedo, 1e-6f);
  for (const SurfaceLight& l : light) {
    const float d = luminance(left * l.diffuse) - luminance(left * l.albedo) * irradiance,
                g = luminance(left * l.specular) - specular / n;
    sum.diffuseVariance += d * d * diffuse2, sum.specularVariance += g * g * specular2;
  }
}

// Sends the group's rays on through their pane.
void PixelShader::passOn(const SeenSurface& seen, Vec3 through, bool solid, Layer& behind) {
  const Group& group = seen.group;
  const Layer& layer = seen.layer;
  for (size_t i = 0; i < group.count; ++i) {
    const size_t k = group.member[i];
    const Vec3 left = layer.left[k] * through;
    if (luminance(left) < 1e-3f) continue;
    behind.add({offsetOrigin(layer.place(k), -group.ng), layer.ray[k].direction, 0, kInfinity}, left,
               layer.seen[k] || solid);
  }
}

// Sends them on as a mirror reflects them.
void PixelShader::reflectOn(const SeenSurface& seen, const MaterialSample& m, Layer& behind) const {
  const Layer& layer = seen.layer;
  for (size_t i = 0; i < seen.group.count; ++i) {
    const size_t k = seen.group.member[i];
    const Vec3 d = layer.ray[k].direction;
    const SurfacePoint s = surfaceAt(rays_.scene(), layer.hit[k], d, m);
    const Vec2 u = seen.forShadow(i).next2();
    const BsdfSample r = Bsdf(s.m, s.ns, s.ng, -d).sampleSpecular(u);
    if (r.valid() && !isBlack(r.weight))
      behind.add({offsetOrigin(s.p, s.ng), r.wi, 0, kInfinity}, layer.left[k] * r.weight, layer.seen[k]);
  }
}

void PixelShader::see(std::span<const Ray> rays, const PixelSequence& sequence, PixelSum pixel, TileWork& work,
                      GatherCounters& count) const {
  std::array<Layer, 2> layers;
  for (const Ray& r : rays) {
    if (r.tMax > 0) layers[0].add(r, Vec3(1), false);  // others see no light (CameraRays::seeing)
  }
  uint32_t surface = 0;
  for (int pane = 0; pane < kMostPanes && layers[pane & 1].count > 0; ++pane) {
    Layer& layer = layers[pane & 1];
    Layer& behind = layers[(pane + 1) & 1];
    behind.count = 0;
    rays_.intersectClose(std::span(layer.ray).first(layer.count), std::span(layer.hit).first(layer.count));
    count.rays += layer.count;
    std::array<Group, kRaysAtOnce> groups;
    size_t used = 0;
    for (size_t i = 0; i < layer.count; ++i) {
      if (!layer.hit[i].valid()) {
        addBackground(layer.left[i], layer.ray[i].direction, pixel);
        continue;
      }
      Group* g = groupOf(layer.ray[i], layer.hit[i], groups, used);
      g->member[g->count++] = static_cast<uint8_t>(i);
    }
    pixel.count->edge |= used > 1 || (pane == 0 && used == 1 && groups[0].count < rays.size());
    for (size_t i = 0; i < used; ++i)
      see({groups[i], layer, sequence, surface++, rays.size()}, pixel, work, behind, count);
  }
  const auto n = static_cast<uint32_t>(rays.size());
  pixel.count->rays += n, pixel.count->gathered += n, pixel.count->glossy += n;
}

}  // namespace roomlight
