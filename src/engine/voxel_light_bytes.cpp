#include "engine/voxel_light_bytes.h"

#include <cstring>
#include <type_traits>
#include <vector>

namespace roomlight {
namespace {

// One list of all members for writers and readers: `a` takes each in turn. Structs are taken apart by name: one that
// gains or loses a member does not compile until it is kept as well.
template <class T>
concept Flat = std::is_trivially_copyable_v<T>;

const BrickGrid& gridOf(const Voxels& voxels) { return voxels; }
BrickGrid& gridOf(Voxels& voxels) { return voxels; }

void visitVoxels(auto& a, auto& voxels) {
  auto& [voxelSizeM, origin, brickDims, brickIndex, bricks] = gridOf(voxels);
  a(voxelSizeM), a(origin), a(brickDims), a(brickIndex), a(bricks);
  a(voxels.voxels), a(voxels.slots);
  static_assert(sizeof(Voxels) == sizeof(BrickGrid) + sizeof(voxels.voxels) + sizeof(voxels.slots));
}

void visitLevel(auto& a, auto& level) {
  auto& [voxelSizeM, brickDims, brickIndex, bricks, planes, light] = level;
  a(voxelSizeM), a(brickDims), a(brickIndex), a(bricks), a(planes), a(light);
}

void visitLayers(auto& a, auto& layers) {
  auto& [lights, stride, shares, reach, glowOf] = layers;
  a.layers(lights);
  a(stride), a(shares), a(reach), a(glowOf);
}

void visitField(auto& a, auto& field) {
  auto& [origin, levels, unitCdM2, irradianceLux, sunLux, guide, seen, glow, sunPoints, glowShare, layers, bounces,
         residual, rays] = field;
  a(origin);
  a.size(levels);
  for (auto& level : levels) visitLevel(a, level);
  a(unitCdM2), a(irradianceLux), a(sunLux);
  auto& [guideOfBrick, cdf] = guide;
  a(guideOfBrick), a(cdf);
  SeenLights::visit(seen, a);
  LampGlow::visit(glow, a);
  a(sunPoints), a(glowShare);
  visitLayers(a, layers);
  a(bounces), a(residual), a(rays);
}

void visitLight(auto& a, auto& light) {
  auto& [voxels, field] = light;
  visitVoxels(a, voxels);
  visitField(a, field);
}

// To write and to count what will be written.
template <class Put>
class LightWriter {
 public:
  explicit LightWriter(Put put) : put_(std::move(put)) {}
  template <Flat T>
  void operator()(const T& value) {
    put_(&value, sizeof(value));
  }
  template <Flat T>
  void operator()(const std::vector<T>& items) {
    size(items);
    put_(items.data(), items.size() * sizeof(T));
  }
  template <class T>
  void size(const std::vector<T>& items) {
    (*this)(static_cast<uint64_t>(items.size()));
  }
  void layers(const std::shared_ptr<const LightLayers>& lights) { (*this)(static_cast<uint8_t>(lights != nullptr)); }

 private:
  Put put_;
};

class LightReader {
 public:
  LightReader(std::string_view bytes, std::shared_ptr<const LightLayers> layers)
      : left_(bytes), layers_(std::move(layers)) {}
  bool isDone() const { return isRight_ && left_.empty(); }

  template <Flat T>
  void operator()(T& value) {
    take(&value, 1);
  }
  template <Flat T>
  void operator()(std::vector<T>& items) {
    const size_t count = countOf(sizeof(T));
    items.resize(count);
    take(items.data(), count);
  }
  template <class T>
  void size(std::vector<T>& items) {
    items.resize(countOf(1));
  }
  void layers(std::shared_ptr<const LightLayers>& lights) {
    uint8_t has = 0;
    (*this)(has);
    isRight_ = isRight_ && has <= 1 && (has == 0 || layers_);
    if (has == 1) lights = layers_;
  }

 private:
  template <class T>
  void take(T* to, size_t count) {
    const size_t bytes = count * sizeof(T);
    isRight_ = isRight_ && bytes <= left_.size();
    if (!isRight_ || bytes == 0) return;
    std::memcpy(static_cast<void*>(to), left_.data(), bytes);
    left_.remove_prefix(bytes);
  }
  // Of items that take at least so many bytes each; 0 where there are not so many.
  size_t countOf(size_t itemBytes) {
    uint64_t count = 0;
    (*this)(count);
    isRight_ = isRight_ && count <= left_.size() / itemBytes;
    return isRight_ ? static_cast<size_t>(count) : 0;
  }

  std::string_view left_;
  std::shared_ptr<const LightLayers> layers_;
  bool isRight_ = true;
};

}  // namespace

std::string bytesOf(const VoxelLight& light) {
  size_t count = 0;
  LightWriter counter([&](const void*, size_t bytes) { count += bytes; });
  visitLight(counter, light);
  std::string out;
  out.reserve(count);
  LightWriter writer([&](const void* from, size_t bytes) { out.append(static_cast<const char*>(from), bytes); });
  visitLight(writer, light);
  return out;
}

std::optional<VoxelLight> voxelLightFrom(std::string_view bytes, const std::shared_ptr<const LightLayers>& layers) {
  std::optional<VoxelLight> light(std::in_place);
  LightReader reader(bytes, layers);
  visitLight(reader, *light);
  if (!reader.isDone()) light.reset();
  return light;
}

}  // namespace roomlight
