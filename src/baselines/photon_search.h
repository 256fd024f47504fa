// PhotonMap::nearest(), written once for every test that a photon may have to pass.
#pragma once

#include <algorithm>

#include "baselines/photon_map.h"

namespace roomlight {

template <class Accepts>
void PhotonMap::nearest(const PhotonQuery& q, size_t k, std::vector<NearPhoton>& out, Accepts&& accepts) const {
  out.clear();
  if (empty() || k == 0) return;
  float radius2 = q.radiusM * q.radiusM;
  const size_t most = 2 * k;  // kept before the farther half is dropped
  const auto shrink = [&] {
    std::nth_element(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(k) - 1, out.end(),
                     [](NearPhoton a, NearPhoton b) {
                       return a.distance2 < b.distance2 || (a.distance2 == b.distance2 && a.index < b.index);
                     });
    out.resize(k);
    radius2 = out.back().distance2;
  };
  Step stack[64];
  size_t used = 0;
  stack[used++] = {0, 0, static_cast<uint32_t>(size()), Vec3(0)};
  const uint32_t firstLeaf = (1u << levels_) - 1;
  while (used > 0) {
    Step s = stack[--used];
    if (lengthSquared(s.offset) > radius2) continue;
    while (s.node < firstLeaf) {
      const Node& node = nodes_[s.node];
      const uint32_t middle = s.begin + (s.end - s.begin) / 2;
      const float d = q.p[node.axis] - node.split;
      Step far = s;
      far.offset[node.axis] = d;
      if (d < 0) {
        far.node = 2 * s.node + 2, far.begin = middle;
        s.node = 2 * s.node + 1, s.end = middle;
      } else {
        far.node = 2 * s.node + 1, far.end = middle;
        s.node = 2 * s.node + 2, s.begin = middle;
      }
      if (lengthSquared(far.offset) <= radius2) stack[used++] = far;
    }
    for (uint32_t first = s.begin; first < s.end; first += kLanes) {
      float d2[kLanes];
      distances(q, first, d2);
      const uint32_t n = std::min<uint32_t>(kLanes, s.end - first);
      for (uint32_t lane = 0; lane < n; ++lane) {
        if (!(d2[lane] <= radius2)) continue;
        const uint32_t i = first + lane;
        if (dot(normal(i), q.n) < q.cosNormal || !accepts(i, place(i) - q.p)) continue;
        out.push_back({d2[lane], i});
        if (out.size() == most) shrink();
      }
    }
  }
  if (out.size() > k) shrink();
}

}  // namespace roomlight
