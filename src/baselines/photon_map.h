// Photons in a balanced kd-tree (Jensen 2001, chapter 6), 20 bytes each: places in three arrays that are tested eight
// at a time, leaves of at most sixteen.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace roomlight {

struct Photon {
  Vec3 p;
  Vec3 fluxLm;  // that arrives, per channel
  Vec3 wi;      // unit, towards where it came from
  Vec3 n;       // unit geometric normal on the side it arrived at
};

// Where photons are looked for: in an ellipsoid around p as flat as `flatness` says along n, on surfaces that look n's
// way.
struct PhotonQuery {
  Vec3 p, n;
  float flatness = 4;         // distance along n counts so many times
  float cosNormal = 0.7f;     // smallest cosine between n and a photon's normal
  float radiusM = kInfinity;  // none farther than this
};

struct NearPhoton {
  float distance2 = 0;  // m², as the query measures it
  uint32_t index = 0;
};

class PhotonMap {
 public:
  PhotonMap() = default;
  // The same tree for any number of threads. `order`, where asked for, tells which of `photons` each of the map's is.
  explicit PhotonMap(std::span<const Photon> photons, std::vector<uint32_t>* order = nullptr);

  size_t size() const { return rest_.size(); }
  bool empty() const { return rest_.empty(); }
  size_t bytes() const { return size() * (3 * sizeof(float) + sizeof(Rest)) + nodes_.size() * sizeof(Node); }
  // As kept: powers within 1/512 of their largest channel, directions within a degree.
  Vec3 place(size_t i) const { return {x_[i], y_[i], z_[i]}; }
  Vec3 fluxLm(size_t i) const;
  Vec3 direction(size_t i) const;  // wi
  Vec3 normal(size_t i) const;

  // The k nearest, in no order; fewer where there are no more. `accepts(index, offset from q.p)` decides on what else
  // they must satisfy.
  template <class Accepts>
  void nearest(const PhotonQuery& q, size_t k, std::vector<NearPhoton>& out, Accepts&& accepts) const;
  void nearest(const PhotonQuery& q, size_t k, std::vector<NearPhoton>& out) const;

 private:
  struct Rest {
    uint32_t flux;  // three mantissas of 8 bits, shared exponent (Ward 1991)
    uint16_t wi, n;  // octahedral (Meyer et al. 2010)
  };
  struct Node {
    float split = 0;
    int axis = 0;
  };
  struct Step {  // a subtree still to be searched
    uint32_t node, begin, end;
    Vec3 offset;  // from the query to its box, per axis
  };
  // Squared distances of photons first, first + 1, .. first + 7 as the query measures them.
  void distances(const PhotonQuery& q, size_t first, float* out) const;

  std::vector<float> x_, y_, z_;  // with seven more at the end, for loads of eight
  std::vector<Rest> rest_;
  std::vector<Node> nodes_;  // children of i are 2 i + 1 and 2 i + 2
  int levels_ = 0;  // of inner nodes
  static constexpr size_t kLanes = 8;
};

}  // namespace roomlight

#include "baselines/photon_search.h"
