#include "radiance/slot_paths.h"

#include "base/parallel.h"
#include "base/sampling.h"
#include "radiance/slot_lookup.h"
#include "voxel/lattice.h"

namespace roomlight {
namespace {

constexpr int kMostPanes = 16;          // surfaces a ray goes through or on from
constexpr float kLift = 0.1f;           // voxels; how far points are lifted to see one another along a bent surface
constexpr float kProbeHeight = 0.3f;    // voxels
constexpr float kLeastProbe = 0.02f;    // voxels
constexpr float kHiddenBehind = 0.15f,
                kStrictlyBehind = 0.05f;  // voxels; surfaces further behind a slot's place are not lit as it is
constexpr float kNothingLeft = 0.03f;
constexpr float kOneSheet = 1.1f;       // of the area with which a plane fills the voxel: more is more than one

uint32_t keyOf(Int3 voxel, int face) {
  const auto part = [](int v) { return static_cast<uint64_t>(static_cast<uint32_t>(v)); };
  return static_cast<uint32_t>(mix64(mix64(part(voxel.x) | part(voxel.y) << 32) + (part(voxel.z) | part(face) << 32)));
}

// Unit normal on the side that a ray along d meets, however small the triangle is.
Vec3 facing(Vec3 ng, Vec3 d) {
  const Vec3 n = ng / maxComponent(abs(ng));
  return n / std::copysign(length(n), -dot(n, d));
}

// Metres from the slot's place to the border of its voxel before it.
float toBorder(const Voxels& voxels, const FaceSlot& slot) {
  const int axis = slot.face / 2;
  const float q = (slot.position[axis] - voxels.origin[axis]) / voxels.voxelSizeM, below = q - std::floor(q);
  return voxels.voxelSizeM * (slot.face & 1 ? below : 1 - below);
}

// Whether voxel v holds one sheet and nothing else, and nothing of the next one stands on it.
bool isOneSheet(const Voxels& voxels, const SurfaceVoxel& voxel, Int3 v, const FaceSlot& slot) {
  const int ofAxis = 3 << (slot.face & ~1);
  const float h = voxels.voxelSizeM;
  if ((voxel.faces & ~ofAxis) != 0 ||
      !(slot.areaM2 * std::abs(slot.normal[slot.face / 2]) < kOneSheet * h * h * slot.opacity))
    return false;
  const Vec3 up = faceDirection(slot.face);
  return toBorder(voxels, slot) > 2 * kLift * h ||
         voxels.voxelAt({v.x + static_cast<int>(up.x), v.y + static_cast<int>(up.y), v.z + static_cast<int>(up.z)}) < 0;
}

}  // namespace

std::pair<size_t, size_t> slotsOfBrick(const Voxels& voxels, size_t brick) {
  const auto firstVoxel = voxels.bricks[brick].firstVoxel;
  const size_t end = brick + 1 < voxels.bricks.size() ? voxels.bricks[brick + 1].firstVoxel : voxels.voxels.size();
  const auto slotBegin = [&](size_t v) {
    return v < voxels.voxels.size() ? voxels.voxels[v].firstSlot : voxels.slots.size();
  };
  return {slotBegin(firstVoxel), slotBegin(end)};
}

SlotPaths::SlotPaths(const RayScene& rays, const Voxels& voxels, uint64_t seed, const Progress& progress, bool strict,
                     const Before* before)
    : rays_(&rays),
      voxels_(&voxels),
      behind_(strict ? kStrictlyBehind : kHiddenBehind),
      points_(voxels.slots.size()),
      key_(voxels.slots.size()),
      sheet_(voxels.slots.size()),
      free_(voxels.slots.size()) {
  for (const Instance& i : rays.scene().instances)
    clear_.push_back(letsLightThrough(
        rays.scene().materials[static_cast<size_t>(rays.scene().meshes[static_cast<size_t>(i.mesh)].material)]));
  parallelFor(voxels.bricks.size(), 4, [&](size_t b) {
    if (progress.stop()) return;
    if (before && before->remap.keeps(b)) {
      copyFrom(before->paths, before->remap.firstOld[b], b);
    } else {
      prepare(b, seed);
    }
  });
}

void SlotPaths::copyFrom(const SlotPaths& before, size_t firstBefore, size_t brick) {
  const auto [first, last] = slotsOfBrick(*voxels_, brick);
  for (size_t s = first, o = firstBefore; s < last; ++s, ++o) {
    points_[s] = before.points_[o], key_[s] = before.key_[o], sheet_[s] = before.sheet_[o], free_[s] = before.free_[o];
  }
}

void SlotPaths::prepare(size_t brick, uint64_t seed) {
  nameSlots(brick);
  const auto [first, last] = slotsOfBrick(*voxels_, brick);
  probe(first, last, seed);
}

void SlotPaths::nameSlots(size_t b) {
  const Brick& brick = voxels_->bricks[b];
  const Int3 corner = latticeOf(*voxels_).brickOf(brick.coord);
  size_t record = brick.firstVoxel;
  for (int z = 0; z < kBrickSize; ++z) {
    for (uint64_t bits = brick.occupied[static_cast<size_t>(z)]; bits; bits &= bits - 1, ++record) {
      const int bit = std::countr_zero(bits);
      const Int3 inBrick{bit & 7, bit >> 3, z},
          v{brick.coord.x * kBrickSize + inBrick.x, brick.coord.y * kBrickSize + inBrick.y,
            brick.coord.z * kBrickSize + inBrick.z};
      const Int3 inWorld{corner.x * kBrickSize + inBrick.x, corner.y * kBrickSize + inBrick.y,
                         corner.z * kBrickSize + inBrick.z};
      const SurfaceVoxel& voxel = voxels_->voxels[record];
      const size_t end = voxel.firstSlot + static_cast<size_t>(std::popcount(static_cast<unsigned>(voxel.faces)));
      for (size_t s = voxel.firstSlot; s < end; ++s) {
        key_[s] = keyOf(inWorld, voxels_->slots[s].face);
        sheet_[s] = isOneSheet(*voxels_, voxel, v, voxels_->slots[s]);
      }
    }
  }
}

// Points are spread over the voxel where the surface fills that. Each is looked up on the surface itself, for beside a
// curved surface the slot's plane lies behind it.
void SlotPaths::probe(size_t first, size_t last, uint64_t seed) {
  const float highest = kProbeHeight * voxels_->voxelSizeM;
  std::vector<Ray> rays;
  std::vector<Hit> hits;
  for (size_t s = first; s < last; ++s) {
    const FaceSlot& slot = voxels_->slots[s];
    if (!sheet_[s]) rays.push_back({offsetOrigin(slot.position, slot.normal), slot.normal, 0, highest});
  }
  hits.resize(rays.size());
  rays_->intersect(rays, hits);
  for (size_t s = first, next = 0; s < last; ++s) {
    free_[s] = highest;
    if (!sheet_[s] && hits[next++].valid()) free_[s] = hits[next - 1].t;
  }
  rays.clear();
  for (size_t s = first; s < last; ++s) appendProbes(s, seed, rays);
  hits.resize(rays.size());
  rays_->intersect(rays, hits);
  std::vector<std::pair<Vec3*, Vec3>> asked;  // point, and where it would be
  std::vector<Ray> parting;
  for (size_t s = first, next = 0; s < last; ++s) {
    const FaceSlot& slot = voxels_->slots[s];
    points_[s].fill(lifted(slot.position, slot.normal));
    if (!fillsVoxel(slot)) continue;
    for (Vec3& p : points_[s]) {
      const Ray& ray = rays[next];
      const Hit& hit = hits[next++];
      if (!hit.valid() || dot(facing(hit.ng, ray.direction), slot.normal) < 0.7f) continue;
      const Vec3 found = ray.origin + ray.direction * hit.t;
      if (sheet_[s]) {
        p = lifted(found, slot.normal);
      } else {
        asked.emplace_back(&p, lifted(found, slot.normal));
        parting.push_back(between(s, found, slot.normal));
      }
    }
  }
  std::vector<Vec3> left(parting.size());
  rays_->transmittance(parting, left);
  for (size_t i = 0; i < asked.size(); ++i) {
    if (luminance(left[i]) > 0.25f) *asked[i].first = asked[i].second;
  }
}

Vec3 SlotPaths::lifted(Vec3 p, Vec3 n) const { return offsetOrigin(p, n) + n * (0.01f * voxels_->voxelSizeM); }

// Short rays down onto the slot's surface, one in each quarter of its square. They start below whatever lies over it:
// in its own voxel, if there is nothing else in that.
void SlotPaths::appendProbes(size_t s, uint64_t seed, std::vector<Ray>& rays) const {
  const FaceSlot& slot = voxels_->slots[s];
  if (!fillsVoxel(slot)) return;
  const Frame frame(slot.normal);
  const float h = voxels_->voxelSizeM;
  float height = free_[s] < kProbeHeight * h ? 0.5f * free_[s] : kProbeHeight * h;
  if (sheet_[s]) height = std::clamp(toBorder(*voxels_, slot), kLeastProbe * h, height);
  for (uint32_t k = 0; k < kPoints; ++k) {
    Sampler sampler(key_[s], k, seed + 6);
    const Vec2 u = sampler.next2();
    const float x = 0.4f * (u.x + static_cast<float>(k & 1)) - 0.4f,
                y = 0.4f * (u.y + static_cast<float>(k >> 1)) - 0.4f;
    rays.push_back({slot.position + (frame.t * x + frame.b * y) * h + slot.normal * height, -slot.normal, 0,
                    height + kProbeHeight * h});
  }
}

// From the slot's place to p, both a little lifted, but not into what lies close above.
Ray SlotPaths::between(size_t s, Vec3 p, Vec3 n) const {
  const FaceSlot& slot = voxels_->slots[s];
  const float lift = std::min(kLift * voxels_->voxelSizeM, 0.5f * free_[s]);
  const Vec3 from = offsetOrigin(slot.position, slot.normal) + slot.normal * lift;
  const Vec3 to = offsetOrigin(p, n) + n * lift;
  return {from, to - from, 0, 1};
}

// What a pane transmits is left out of its albedo; what a veil lets through between its threads is not.
Vec3 SlotPaths::albedoOfTheRest(const Hit& hit, float passes) const {
  const MaterialSample m = materialAt(rays_->scene(), hit);
  const Vec3 albedo = bihemisphericalAlbedo(m);
  return m.alpha >= 1 ? min(albedo / std::max(1e-3f, 1 - passes), Vec3(1)) : albedo;
}

// Rays on their way to slots, step by step together, so that they can be traced together.
class SlotPaths::Follower {
 public:
  Follower(const SlotPaths& paths, std::span<const Ray> rays, std::span<Sampler> samplers, std::vector<Arrival>& ends,
           std::vector<HiddenReflection>* hidden)
      : paths_(paths),
        scene_(paths.rays_->scene()),
        samplers_(samplers),
        ends_(ends),
        hidden_(hidden),
        on_(rays.size()),
        way_(rays.begin(), rays.end()) {
    ends_.assign(rays.size(), {});
    for (size_t i = 0; i < rays.size(); ++i) on_[i] = i, ends_[i].ray = rays[i];
  }

  bool isDone() const { return on_.empty(); }

  // To the next surface, and on from there where no slot stands for it or it lets the ray through.
  void step() {
    hits_.resize(on_.size());
    paths_.rays_->intersect(way_, hits_);
    next_.clear(), meetings_.clear(), parting_.clear();
    for (size_t j = 0; j < on_.size(); ++j) {
      if (hits_[j].valid()) {
        meet(j);
      } else {
        ends_[on_[j]].escaped = true;
      }
    }
    decideMeetings();
    on_.swap(next_);
    way_.clear();
    for (const size_t i : on_) way_.push_back(ends_[i].ray);
  }

 private:
  // A surface on the way of a ray: whether a slot stands for it is known only after a look at what parts them.
  struct Meeting {
    size_t ray;  // index into the rays on their way
    Vec3 p, n;
    float passes;
    int64_t slot;
  };

  void meet(size_t j) {
    const Hit& hit = hits_[j];
    Arrival& end = ends_[on_[j]];
    const Vec3 d = end.ray.direction;
    Meeting m{j, end.ray.origin + d * hit.t, facing(hit.ng, d), 0, -1};
    if (paths_.clear_[hit.instance]) {
      const SurfacePlace s = placeAt(scene_, hit, d);
      const Vec3 through = straightTransmittance(*s.material, materialAt(scene_, hit), std::abs(dot(s.ng, d)));
      m.passes = std::min(1.0f, luminance(through));
      if (samplers_[on_[j]].next1() < m.passes) {
        end.left *= through / m.passes;
        return goOn(on_[j], {offsetOrigin(s.p, -s.ng), d, 0, kInfinity});
      }
    }
    m.slot = slotAtSurface(*paths_.voxels_, m.p, m.n);
    if (m.slot < 0) return reflect(m);
    const auto s = static_cast<size_t>(m.slot);
    const FaceSlot& slot = paths_.voxels_->slots[s];
    if (dot(slot.position - m.p, slot.normal) > paths_.behind_ * paths_.voxels_->voxelSizeM) {
      reflect(m);
    } else if (paths_.sheet_[s]) {
      arrive(m);
    } else {
      meetings_.push_back(m);
      parting_.push_back(paths_.between(s, m.p, m.n));
    }
  }

  void decideMeetings() {
    left_.resize(parting_.size());
    paths_.rays_->transmittance(parting_, left_);
    for (size_t i = 0; i < meetings_.size(); ++i) {
      if (luminance(left_[i]) > 0.25f) {
        arrive(meetings_[i]);
      } else {
        reflect(meetings_[i]);
      }
    }
  }

  void goOn(size_t i, const Ray& ray) {
    ends_[i].ray = ray;
    if (!(luminance(ends_[i].left) < kNothingLeft)) next_.push_back(i);
  }

  void arrive(const Meeting& m) {
    Arrival& end = ends_[on_[m.ray]];
    end.slot = m.slot, end.hit = hits_[m.ray], end.passes = m.passes;
  }

  // Not lit as the slot's place is: behind it, or parted from it by another surface (a pane that crosses the voxel).
  void reflect(const Meeting& m) {
    const size_t i = on_[m.ray];
    Arrival& end = ends_[i];
    const SurfacePlace s = placeAt(scene_, hits_[m.ray], end.ray.direction);
    end.left *= paths_.albedoOfTheRest(hits_[m.ray], m.passes);
    end.reflected = true;
    if (hidden_) hidden_->push_back({i, s.p, s.ng, end.left, m.slot, s.material});
    goOn(i, {offsetOrigin(s.p, s.ng), Frame(s.ng).toWorld(sampleCosineHemisphere(samplers_[i].next2())), 0, kInfinity});
  }

  const SlotPaths& paths_;
  const Scene& scene_;
  const std::span<Sampler> samplers_;
  std::vector<Arrival>& ends_;
  std::vector<HiddenReflection>* const hidden_;
  std::vector<size_t> on_, next_;  // rays on their way
  std::vector<Ray> way_, parting_;
  std::vector<Hit> hits_;
  std::vector<Meeting> meetings_;
  std::vector<Vec3> left_;
};

void SlotPaths::follow(std::span<const Ray> rays, std::span<Sampler> samplers, std::vector<Arrival>& ends,
                       std::vector<HiddenReflection>* hidden) const {
  Follower follower(*this, rays, samplers, ends, hidden);
  for (int k = 0; k < kMostPanes && !follower.isDone(); ++k) follower.step();
}

}  // namespace roomlight
