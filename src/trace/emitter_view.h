// An emissive mesh as the points of a small place see it: of its triangles those that shine there, chosen by what they
 // send.
#pragma once

#include <vector>

#include "trace/lights.h"

namespace roomlight {

class EmitterView {
 public:
  // Of one emissive mesh, from somewhere within `place`.
  EmitterView(const Lights& lights, size_t emitter, const Bounds3& place);
  // Whether none of it shines towards the place.
  bool dark() const { return !whole_ && chosen_.empty(); }
  // As Lights::sampleEmitter, with the same mean for every p within the place.
  LightSample sample(Vec3 p, Vec2 u, float choice) const;

 private:
  struct Chosen {
    uint32_t triangle;
    float end;  // of its share, all shares up to it
  };
  const Lights& lights_;
  size_t emitter_;
  bool whole_ = false;  // too many triangles to look at them one by one
  std::vector<Chosen> chosen_;
};

}  // namespace roomlight
