// Light on places that no slot stands for, kept from frame to frame: gathered at the nodes of a square grid on each
// surface, once, and linear between them.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <unordered_map>

#include "base/vec.h"

namespace roomlight {

class LightNodes {
 public:
  struct Place {
    uint32_t instance;
    Vec3 p, n;   // m; n of length 1
    float stepM;  // wanted between nodes: they are up to twice as far apart
  };
  // What falls on a node, lx; none where the place is not one beside which it lies, as behind a wall.
  using Gather = std::function<std::optional<Vec3>(Vec3 node)>;

  // What falls on a place, lx. From many threads at once; `gather` is not called for nodes that are known.
  Vec3 at(const Place& place, const Gather& gather);
  void forget();
  void forget(std::span<const uint32_t> instances);
  size_t nodes() const;

 private:
  struct Key {
    uint32_t instance;
    std::array<int32_t, 3> node;  // in steps
    int8_t level;                 // the step's logarithm of base 2
    int8_t facing;                // the axis nearest to the normal, 0 to 2, and 3 more where it points down
    bool operator==(const Key&) const = default;
  };
  struct Hash {
    size_t operator()(const Key& k) const;
  };
  struct Shard {
    mutable std::mutex mutex;
    std::unordered_map<Key, Vec3, Hash> light;
  };
  static constexpr size_t kShards = 16;

  std::optional<Vec3> nodeAt(const Key& key, Vec3 node, const Gather& gather);

  std::array<Shard, kShards> shards_;
};

}  // namespace roomlight
