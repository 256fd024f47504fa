// Inside this folder readers throw; importGltf and importObj turn it into the one-line error of the contract.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "import/printable.h"

namespace roomlight::importers {

struct Failure : std::runtime_error {
  using std::runtime_error::runtime_error;  // "place: what is wrong; what to do"
};

[[noreturn]] inline void fail(std::string_view place, std::string_view what) {
  throw Failure(std::string(place).append(place.empty() ? "" : ": ").append(what));
}

}  // namespace roomlight::importers
