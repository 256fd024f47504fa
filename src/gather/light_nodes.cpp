#include "gather/light_nodes.h"

#include <algorithm>
#include <cmath>

namespace roomlight {

size_t LightNodes::Hash::operator()(const Key& k) const {
  uint64_t h = uint64_t{k.instance} << 16 | static_cast<uint64_t>(static_cast<uint8_t>(k.level)) << 8 | k.alone;
  const auto add = [&](uint32_t v) { h = (h ^ v) * 0x9e3779b97f4a7c15u, h ^= h >> 29; };
  for (const int32_t v : k.node) add(static_cast<uint32_t>(v));
  for (const int8_t v : k.normal) add(static_cast<uint8_t>(v));
  return h;
}

LightNodes::Key LightNodes::keyOf(const Place& place, Vec3 node, int level, bool alone) {
  const float eighth = std::exp2(static_cast<float>(level - 3));
  Key key{place.instance, {}, {}, static_cast<int8_t>(level), alone};
  for (int i = 0; i < 3; ++i) {
    key.node[static_cast<size_t>(i)] = static_cast<int32_t>(std::lround(node[i] / eighth));
    key.normal[static_cast<size_t>(i)] = static_cast<int8_t>(std::lround(3 * place.n[i]));
  }
  return key;
}

Vec3 LightNodes::nodeAt(const Key& key, Vec3 node, const Light& light) {
  Shard& shard = shards_[Hash()(key) % kShards];
  {
    const std::lock_guard lock(shard.mutex);
    if (const auto known = shard.light.find(key); known != shard.light.end()) return known->second;
  }
  const Vec3 found = light.gather(node);  // perhaps by two threads: the first one's stays
  const std::lock_guard lock(shard.mutex);
  return shard.light.try_emplace(key, found).first->second;
}

Vec3 LightNodes::at(const Place& place, const Light& light) {
  constexpr float kFaint = 0.01f;  // of the weight: nodes that are not asked for
  const auto level = static_cast<int>(std::ceil(std::log2(place.stepM)));
  const float step = std::exp2(static_cast<float>(level));
  const Vec3 steep = abs(place.n);
  const int a = steep.x >= steep.y && steep.x >= steep.z ? 0
                : steep.y >= steep.z                     ? 1
                                                         : 2,
            b = (a + 1) % 3, c = (a + 2) % 3;
  const float u = place.p[b] / step, v = place.p[c] / step;
  Vec3 sum;
  float weights = 0;
  for (int k = 0; k < 4; ++k) {
    const float nodeU = std::floor(u) + static_cast<float>(k & 1), nodeV = std::floor(v) + static_cast<float>(k >> 1),
                weight = (1 - std::abs(u - nodeU)) * (1 - std::abs(v - nodeV));
    if (weight < kFaint) continue;
    Vec3 node;  // on the tangent plane
    node[b] = nodeU * step, node[c] = nodeV * step;
    node[a] = place.p[a] - (place.n[b] * (node[b] - place.p[b]) + place.n[c] * (node[c] - place.p[c])) / place.n[a];
    if (!light.sees(node)) continue;
    sum += nodeAt(keyOf(place, node, level, false), node, light) * weight, weights += weight;
  }
  return weights > 0 ? sum / weights : nodeAt(keyOf(place, place.p, level, true), place.p, light);
}

void LightNodes::forget() {
  for (Shard& s : shards_) s.light.clear();
}

void LightNodes::forget(std::span<const uint32_t> instances) {
  for (Shard& s : shards_) {
    std::erase_if(s.light, [&](const auto& node) {
      return std::find(instances.begin(), instances.end(), node.first.instance) != instances.end();
    });
  }
}

size_t LightNodes::nodes() const {
  size_t count = 0;
  for (const Shard& s : shards_) {
    const std::lock_guard lock(s.mutex);
    count += s.light.size();
  }
  return count;
}

}  // namespace roomlight
