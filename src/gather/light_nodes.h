// Light on places that no slot stands for, kept from frame to frame: gathered at the nodes of a square grid on each
// surface, once, and linear between them.
#pragma once

#include <array>
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
  struct Light {
    // Whether a node lies open beside the place, not behind a wall. Asked each time.
    std::function<bool(Vec3 node)> sees;
    // What falls on a node, lx. Asked once.
    std::function<Vec3(Vec3 node)> gather;
  };

  // What falls on a place, lx: of the nodes around it that it sees; if there is none, as at the place itself. From many
  // threads at once, but not while nodes are forgotten.
  Vec3 at(const Place& place, const Light& light);
  void forget();
  void forget(std::span<const uint32_t> instances);
  size_t nodes() const;

 private:
  struct Key {
    uint32_t instance;
    std::array<int32_t, 3> node;  // in eighths of a step
    std::array<int8_t, 3> normal;  // in thirds
    int8_t level;  // the step's logarithm of base 2
    bool alone;  // no node of the grid but a place that sees none
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

  static Key keyOf(const Place& place, Vec3 node, int level, bool alone);
  Vec3 nodeAt(const Key& key, Vec3 node, const Light& light);

  std::array<Shard, kShards> shards_;
};

}  // namespace roomlight
