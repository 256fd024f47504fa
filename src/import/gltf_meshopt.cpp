// EXT_meshopt_compression and KHR_meshopt_compression: buffer views packed by meshoptimizer's codecs.
#include <fmt/format.h>
#include <meshoptimizer.h>

#include "import/failure.h"
#include "import/gltf_document.h"

namespace roomlight::importers {
namespace {

// The densest stream spends two bits on sixteen bytes: a view that claims more per byte is a lie, and is refused
// before memory is taken for it.
constexpr uint64_t kMaxExpansion = 64;

}  // namespace

Bytes decodeMeshopt(std::span<const uint8_t> compressed, const Json& extension) {
  const uint64_t stride = extension.at("byteStride").integer(256);
  const uint64_t count = extension.at("count").integer(uint64_t{1} << 32);
  const std::string mode = extension.at("mode").text();
  const std::string filter = extension.text("filter", "NONE");
  if (stride == 0 || count * stride > kMaxExpansion * (compressed.size() + 64)) {
    extension.fail(fmt::format("claims {} elements of {} bytes, more than its {} bytes can hold", count, stride,
                               compressed.size()));
  }

  // Filters work on groups of four elements; the spare ones are cut off again.
  Bytes out(((count + 3) & ~uint64_t{3}) * stride);
  int status = -1;
  if (mode == "ATTRIBUTES") {
    if (stride % 4 != 0) extension.fail("byteStride of attributes must be a multiple of 4");
    status = meshopt_decodeVertexBuffer(out.data(), count, stride, compressed.data(), compressed.size());
  } else if (mode == "TRIANGLES" || mode == "INDICES") {
    if (stride != 2 && stride != 4) extension.fail("byteStride of indices must be 2 or 4");
    if (mode == "TRIANGLES" && count % 3 != 0) extension.fail("count of a triangle list must be a multiple of 3");
    status = mode == "TRIANGLES"
                 ? meshopt_decodeIndexBuffer(out.data(), count, stride, compressed.data(), compressed.size())
                 : meshopt_decodeIndexSequence(out.data(), count, stride, compressed.data(), compressed.size());
  } else {
    extension.fail(fmt::format("mode '{}' is not known", printable(mode)));
  }
  if (status != 0) extension.fail("the compressed data are damaged or of a newer version");

  if (mode == "ATTRIBUTES" && filter == "OCTAHEDRAL") {
    if (stride != 4 && stride != 8) extension.fail("the octahedral filter needs a byteStride of 4 or 8");
    meshopt_decodeFilterOct(out.data(), count, stride);
  } else if (mode == "ATTRIBUTES" && filter == "QUATERNION") {
    if (stride != 8) extension.fail("the quaternion filter needs a byteStride of 8");
    meshopt_decodeFilterQuat(out.data(), count, stride);
  } else if (mode == "ATTRIBUTES" && filter == "EXPONENTIAL") {
    meshopt_decodeFilterExp(out.data(), count, stride);
  } else if (filter != "NONE") {
    extension.fail(fmt::format("filter '{}' is not known for mode '{}'", printable(filter), printable(mode)));
  }
  out.resize(count * stride);
  return out;
}

}  // namespace roomlight::importers
