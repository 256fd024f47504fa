// Puts a binary glTF 2.0 file together: buffer views, accessors and the two chunks.
#pragma once

#include <nlohmann/json.hpp>

#include <span>
#include <string>
#include <string_view>

#include "base/vec.h"

namespace roomlight::bake {

using Json = nlohmann::ordered_json;

// Types of components as glTF numbers them.
enum class Component : int { Byte = 5120, UnsignedByte = 5121, UnsignedShort = 5123, UnsignedInt = 5125, Float = 5126 };

class GlbWriter {
 public:
  GlbWriter();
  Json json;  // "asset" is there; what the writer adds comes with finished()

  // The number of the buffer view.
  int addView(std::string_view bytes);
  // `bytes`: elements one after the other; those of vertices must be of multiples of 4 bytes, `stride`. The accessor's
  // number.
  int addAccessor(std::string_view bytes, Component component, const char* type, size_t count, int stride,
                  bool normalized);
  // Of positions, with their bounds.
  int addPositions(std::span<const Vec3> positions);

  // The whole file.
  std::string finished();

 private:
  std::string binary_;
  Json views_ = Json::array(), accessors_ = Json::array();
};

template <class T>
std::string_view bytesOf(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

}  // namespace roomlight::bake
