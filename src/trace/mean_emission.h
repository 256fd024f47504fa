// How much light triangles emit on average, to share out light samples by. A triangle that emits anywhere has a mean
// above zero: one without is never sampled.
#pragma once

#include <map>
#include <vector>

#include "scene/scene.h"

namespace roomlight {

// A texture's values summed over blocks of texels, so that the mean over any rectangle is quick to tell.
class BlockSums {
 public:
  enum class Of { Light, Alpha };
  BlockSums(const Texture& texture, Of what);
  // Of the blocks that look-ups in a box of texture coordinates read: above zero if one of these is.
  float meanAround(Vec2 lo, Vec2 hi) const;

 private:
  const Texture& texture_;
  size_t columns_, rows_;
  std::vector<uint64_t>
      sums_;  // over all blocks left of and above a corner; whole numbers, so that differences are exact
};

class MeanEmission {
 public:
  explicit MeanEmission(const Scene& scene) : scene_(scene) {}

  // Per triangle, luminance in cd/m². Exact without textures, else from a number of look-ups that grows with the texels
  // covered, up to some thousand.
  const std::vector<float>& ofMesh(int mesh);

 private:
  std::vector<float> compute(const Mesh& mesh);
  const BlockSums* sumsOf(const TextureRef& ref, const Mesh& mesh, BlockSums::Of what);

  const Scene& scene_;
  std::map<int, std::vector<float>> known_;  // per mesh
  std::map<std::pair<int, BlockSums::Of>, BlockSums> sums_;  // per texture
};

// Emits the same everywhere.
bool emitsEvenly(const Material& material);

}  // namespace roomlight
