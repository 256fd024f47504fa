#include "gather/hit_cache.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/random.h"
#include "base/sorted_keys.h"

namespace roomlight {
namespace {

constexpr int kTop = 4;                // level of the largest cells, each twice as large as the one below
constexpr int kAlikeLevel = 1;               // level of cells whose samples are lit alike
constexpr int kAround = 2;             // level of cells whose mean bounds their samples,
constexpr float kRareHere = 3;         // to so many times that,
constexpr size_t kFewest = 6;          // where there are as many samples
constexpr float kFew = 1;              // samples
constexpr int kClusters = 4;           // places that samples of a largest cell may have a free way to
constexpr float kLift = 0.1f;          // of the largest cells: how far before their surface ways lie
constexpr float kChance = 2;           // times the noise: so much may a few cells differ without reason
constexpr float kStandsOut = 6;  // times its variance: a square deviation of a mean of kFewest that is no chance
constexpr float kLeastSpread = 0.02f,
                kMostSpread = 0.5f;  // of the light: how far cells of a level may differ from the next larger
constexpr size_t kAtOnce = 4096;  // samples

float cellM(const HitCache& cells, int level) { return cells.cellM() * static_cast<float>(1 << level); }

// A cell of one level.
struct Node {
  size_t begin, end;  // of its samples in the order
  Vec3 mean;
  float weight, off2, noise;
};

// A cell of the next larger level.
struct Parent {
  size_t begin, end;  // nodes
  float weight = 0, mean = 0;
  double signal = 0, freedom = 0;  // how far its cells are off one another beyond noise, and how free they are to be
};

struct NestedCells {
  std::vector<uint32_t> order;  // of samples
  std::vector<Node> nodes;
  std::vector<Parent> parents;
};

struct Smoothing {
  const RayScene& rays;
  const HitCache& cells;
  std::span<LitHit> samples;
  std::vector<uint32_t> cluster;  // of each sample; kClusters: it stands alone
  std::vector<Vec3> even;  // as told by the cells looked at so far
  std::vector<float> around;  // mean luminance of samples near
  std::vector<float> variance;  // of single samples, relative to that

  std::vector<uint64_t> keysOf(int level) const {
    std::vector<uint64_t> keys(samples.size());
    parallelFor(keys.size(), kAtOnce,
                [&](size_t i) { keys[i] = mix64(cells.keyOf(samples[i].at, level) + cluster[i]); });
    return keys;
  }
  void findClusters();
  void boundSamples();
  void startAtTop();
  std::vector<uint32_t> nestedOrder(const std::vector<uint64_t>& keys, const std::vector<uint64_t>& larger) const;
  NestedCells cellsOf(const std::vector<uint64_t>& keys, const std::vector<uint64_t>& larger) const;
  float findSpread(NestedCells& nested) const;
  void drawTowards(const Parent& parent, float spread2, NestedCells& nested);
  void refine(int level);
};

// Of the samples in one largest cell those that see the first, then of the rest those that see the first of these, and
// so on.
void Smoothing::findClusters() {
  cluster.assign(samples.size(), 0);
  const float lift = kLift * cellM(cells, kTop);
  for (uint32_t c = 0; c < kClusters; ++c) {
    const std::vector<uint64_t> keys = keysOf(kTop);
    const std::vector<uint32_t> order = sortedBy(keys);
    std::vector<Ray> ways;
    std::vector<uint32_t> who;
    forRuns(keys, order, [&](size_t begin, size_t end) {
      if (cluster[order[begin]] != c) return;
      const HitPlace& first = samples[order[begin]].at;
      for (size_t k = begin + 1; k < end; ++k) {
        const HitPlace& place = samples[order[k]].at;
        const Vec3 from = place.p + place.n * lift;
        ways.push_back({from, first.p + first.n * lift - from, 0, 1}), who.push_back(order[k]);
      }
    });
    std::vector<Vec3> left(ways.size());
    parallelRanges(ways.size(), kAtOnce, [&](size_t begin, size_t end) {
      rays.transmittance(std::span(ways).subspan(begin, end - begin), std::span(left).subspan(begin, end - begin));
    });
    for (size_t i = 0; i < who.size(); ++i) {
      if (!(luminance(left[i]) > 0.25f)) cluster[who[i]] = c + 1;
    }
  }
}

// What single samples have far beyond those around them is rare, too.
void Smoothing::boundSamples() {
  around.resize(samples.size());
  const std::vector<uint64_t> keys = keysOf(kAround);
  const std::vector<uint32_t> order = sortedBy(keys);
  forRuns(keys, order, [&](size_t begin, size_t end) {
    float mean = 0;
    for (size_t k = begin; k < end; ++k) mean += luminance(samples[order[k]].even) / static_cast<float>(end - begin);
    float left = 0;
    for (size_t k = begin; k < end; ++k) {
      LitHit& hit = samples[order[k]];
      const float own = luminance(hit.even),
                  beyond = end - begin >= kFewest && own > kRareHere * mean ? 1 - kRareHere * mean / own : 0;
      hit.rare += hit.even * beyond, hit.even = hit.even * (1 - beyond);
      left += luminance(hit.even) / static_cast<float>(end - begin);
    }
    for (size_t k = begin; k < end; ++k) around[order[k]] = left;
  });
}

void Smoothing::startAtTop() {
  even.resize(samples.size()), variance.resize(samples.size());
  // Of samples so near to one another that they should agree: squares of how far they are off their mean, and how many
  // of them are free to be.
  std::vector<float> square(samples.size()), freedom(samples.size());
  const std::vector<uint64_t> near = keysOf(kAlikeLevel);
  const std::vector<uint32_t> nearOrder = sortedBy(near);
  forRuns(near, nearOrder, [&](size_t begin, size_t end) {
    Vec3 sum;
    for (size_t k = begin; k < end; ++k) sum += samples[nearOrder[k]].even;
    const float n = static_cast<float>(end - begin);
    for (size_t k = begin; k < end; ++k) {
      const float off = luminance(samples[nearOrder[k]].even - sum / n);
      square[nearOrder[k]] = off * off / std::max(around[nearOrder[k]] * around[nearOrder[k]], 1e-20f),
      freedom[nearOrder[k]] = (n - 1) / n;
    }
  });
  const std::vector<uint64_t> keys = keysOf(kTop);
  const std::vector<uint32_t> order = sortedBy(keys);
  forRuns(keys, order, [&](size_t begin, size_t end) {
    if (cluster[order[begin]] == kClusters) {
      for (size_t k = begin; k < end; ++k) even[order[k]] = samples[order[k]].even;
      return;
    }
    Vec3 sum, rare;
    float weight = 0;
    for (size_t k = begin; k < end; ++k) {
      const LitHit& hit = samples[order[k]];
      sum += hit.even * hit.rays, rare += hit.rare * hit.rays, weight += hit.rays;
    }
    sum = sum / weight, rare = rare / weight;
    // Of few nothing is known: as uncertain as they are bright.
    float squares = kFew, free = kFew;
    for (size_t k = begin; k < end; ++k) squares += square[order[k]], free += freedom[order[k]];
    const float v = squares / free;
    for (size_t k = begin; k < end; ++k) even[order[k]] = sum, samples[order[k]].rare = rare, variance[order[k]] = v;
  });
}

// Samples by cells of this level, those in one of the next larger one after the other.
std::vector<uint32_t> Smoothing::nestedOrder(const std::vector<uint64_t>& keys,
                                             const std::vector<uint64_t>& larger) const {
  const std::vector<uint32_t> byKey = sortedBy(keys);
  std::vector<uint64_t> largerOf(keys.size());
  for (size_t i = 0; i < keys.size(); ++i) largerOf[i] = larger[byKey[i]];
  const std::vector<uint32_t> second = sortedBy(largerOf);
  std::vector<uint32_t> order(keys.size());
  for (size_t i = 0; i < keys.size(); ++i) order[i] = byKey[second[i]];
  return order;
}

NestedCells Smoothing::cellsOf(const std::vector<uint64_t>& keys, const std::vector<uint64_t>& larger) const {
  NestedCells out{nestedOrder(keys, larger), {}, {}};
  const std::vector<uint32_t>& order = out.order;
  std::vector<Node>& nodes = out.nodes;
  std::vector<Parent>& parents = out.parents;
  forRuns(keys, order, [&](size_t begin, size_t end) {
    if (cluster[order[begin]] == kClusters) return;
    Node node{begin, end, {}, 0, 0, 0};
    float squares = 0;
    for (size_t k = begin; k < end; ++k) {
      const LitHit& hit = samples[order[k]];
      node.mean += hit.even * hit.rays, node.weight += hit.rays, squares += hit.rays * hit.rays;
    }
    node.mean = node.mean / node.weight;
    const float known = luminance(even[order[begin]]),
                off = std::clamp(luminance(node.mean) - known, -known, 2 * known);
    node.off2 = off * off, node.noise = variance[order[begin]] * known * known * squares / (node.weight * node.weight);
    if (parents.empty() || larger[order[nodes[parents.back().begin].begin]] != larger[order[begin]])
      parents.push_back({nodes.size(), nodes.size()});
    nodes.push_back(node);
    parents.back().end = nodes.size(), parents.back().weight += node.weight,
    parents.back().mean += node.weight * luminance(node.mean);
  });
  return out;
}

// Of all cells of a level, relative and squared: how far they differ from the larger ones that they are in, beyond
// noise. Tells it of each larger one, too.
float Smoothing::findSpread(NestedCells& nested) const {
  double signal = 0, all = 0;
  for (Parent& parent : nested.parents) {
    const float known = luminance(even[nested.order[nested.nodes[parent.begin].begin]]);
    double signalAlone = 0;
    for (size_t c = parent.begin; c < parent.end; ++c) {
      // A mean that holds the cell itself differs from it by less.
      const Node& node = nested.nodes[c];
      const float off = luminance(node.mean) - parent.mean / parent.weight, free = 1 - node.weight / parent.weight;
      signalAlone += static_cast<double>(node.weight * (off * off - free * node.noise));
      parent.signal += static_cast<double>(node.weight * (off * off - kChance * free * node.noise)),
          parent.freedom += static_cast<double>(node.weight * free);
    }
    signal += signalAlone, all += parent.freedom * static_cast<double>(known * known);
  }
  return all > 0 ? std::clamp(static_cast<float>(signal / all), kLeastSpread * kLeastSpread, kMostSpread * kMostSpread)
                 : 0;
}

// What the cells of a larger one tell, each drawn towards what that does.
void Smoothing::drawTowards(const Parent& parent, float spread2, NestedCells& nested) {
  const std::vector<uint32_t>& order = nested.order;
  std::vector<Node>& nodes = nested.nodes;
  const Vec3 whole = even[order[nodes[parent.begin].begin]];
  // As much as all cells of this level differ, or as those of the same larger one do.
  const float known = luminance(whole),
              own = parent.freedom > 0 ? static_cast<float>(parent.signal / parent.freedom) : 0,
              prior = std::max(spread2 * known * known, own);
  Vec3 sum;
  float weight = 0;
  for (size_t c = parent.begin; c < parent.end; ++c) {
    Node& node = nodes[c];
    float share = prior > 0 ? prior / (prior + node.noise) : 1;
    if (node.end - node.begin >= kFewest && node.off2 > kStandsOut * node.noise)
      share = std::max(share, 1 - node.noise / node.off2);
    node.mean = whole + (node.mean - whole) * share;
    sum += node.mean * node.weight, weight += node.weight;
  }
  // What stands out by chance is brighter more often than darker: all together stay as bright as they were.
  const Vec3 most = sum / weight, keep = whole / max(most, Vec3(1e-20f));
  for (size_t c = parent.begin; c < parent.end; ++c) {
    for (size_t k = nodes[c].begin; k < nodes[c].end; ++k) even[order[k]] = nodes[c].mean * keep;
  }
}

void Smoothing::refine(int level) {
  NestedCells nested = cellsOf(keysOf(level), keysOf(level + 1));
  const float spread2 = findSpread(nested);
  parallelFor(nested.parents.size(), 64, [&](size_t i) { drawTowards(nested.parents[i], spread2, nested); });
}

}  // namespace

void smoothLight(const RayScene& rays, const HitCache& cells, std::span<LitHit> samples) {
  Smoothing work{rays, cells, samples, {}, {}, {}, {}};
  work.findClusters();
  work.boundSamples();
  work.startAtTop();
  for (int level = kTop; level-- > 0;) work.refine(level);
  for (size_t i = 0; i < samples.size(); ++i) samples[i].even = work.even[i];
}

}  // namespace roomlight
