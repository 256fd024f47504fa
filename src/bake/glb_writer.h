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
  // `compressed`: accessors by EXT_meshopt_compression.
  explicit GlbWriter(bool compressed = false);
  Json json;  // "asset" is there; what the writer adds comes with finished()

  // The number of the buffer view.
  int addView(std::string_view bytes);
  // `bytes`: elements one after the other; those of vertices must be of multiples of 4 bytes, `stride`. Without a
  // stride: numbers of vertices (UnsignedInt), three a triangle. The accessor's number.
  int addAccessor(std::string_view bytes, Component component, const char* type, size_t count, int stride,
                  bool normalized);
  // The bounds of an accessor, which those of positions must have.
  void setBounds(int accessor, const Bounds3& bounds);

  // The whole file.
  std::string finished();

 private:
  int addCompressed(std::string_view bytes, size_t count, size_t stride, bool triangles);

  const bool compressed_;
  size_t plainBytes_ = 0;  // of what is compressed
  std::string binary_;
  Json views_ = Json::array(), accessors_ = Json::array();
};

template <class T>
std::string_view bytesOf(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

}  // namespace roomlight::bake
