// What a scene needs and this machine cannot give: memory beside, places for light, the ray tracer. One line.
#pragma once

#include <stdexcept>

namespace roomlight {

class ResourceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace roomlight
