// Buffers and buffer views, compressed views included: afterwards every view is a checked span of bytes.
#include <fmt/format.h>
#include <meshoptimizer.h>

#include "import/failure.h"
#include "import/gltf_document.h"

namespace roomlight::importers {

// EXT_meshopt_compression and KHR_meshopt_compression: buffer views packed by meshoptimizer's codecs.

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

namespace {

constexpr uint64_t kMaxBytes = uint64_t{1} << 40;  // any number above is nonsense and would overflow sums
constexpr uint64_t kMostReadings = 4;  // how often compressed views may use each byte of the buffers, on average

std::optional<Json> meshoptOf(const Json& object) {
  auto found = object.extension("EXT_meshopt_compression");
  return found ? found : object.extension("KHR_meshopt_compression");
}

std::span<const uint8_t> loadBuffer(GltfDocument& document, const Json& buffer, size_t index) {
  const uint64_t stated = buffer.integer("byteLength", kMaxBytes, kMaxBytes);
  std::span<const uint8_t> bytes;
  if (const auto uri = buffer.find("uri")) {
    document.storage.push_back(readUri(document.folder, uri->text(), uri->path()));
    document.budget.grantFor(document.storage.back().size());
    bytes = document.storage.back();
  } else if (meshoptOf(buffer)) {
    return {};  // a fallback: its views are compressed and lie elsewhere
  } else if (index == 0) {
    bytes = document.binaryChunk;
  } else {
    buffer.fail("has neither a uri nor a binary chunk");
  }
  if (!buffer.find("byteLength")) return bytes;
  if (bytes.size() < stated)
    buffer.fail(fmt::format("claims {} bytes, but there are {}; the file is cut short", stated, bytes.size()));
  return bytes.first(stated);
}

// As much of a range as there is: who reads it says what is missing.
std::span<const uint8_t> slice(const std::vector<std::span<const uint8_t>>& buffers, const Json& range) {
  const auto buffer = buffers[static_cast<size_t>(range.at("buffer").index(buffers.size()))];
  const uint64_t offset = range.integer("byteOffset", 0, kMaxBytes);
  const uint64_t length = range.at("byteLength").integer(kMaxBytes);
  if (offset > buffer.size()) return {};
  return buffer.subspan(offset, std::min<uint64_t>(length, buffer.size() - offset));
}

}  // namespace

void loadBuffers(GltfDocument& document) {
  const Json list = document.root().list("buffers");
  const Json views = document.root().list("bufferViews");
  std::vector<std::span<const uint8_t>> buffers;
  document.storage.reserve(list.size() + views.size());  // spans point into it
  for (size_t i = 0; i < list.size(); ++i) buffers.push_back(loadBuffer(document, list[i], i));

  std::vector<size_t> compressed;
  document.views.resize(views.size());
  for (size_t i = 0; i < views.size(); ++i) {
    const Json view = views[i];
    document.views[i].stride = view.integer("byteStride", 0, 1 << 16);
    if (const auto meshopt = meshoptOf(view)) {
      compressed.push_back(i);
    } else {
      document.views[i].bytes = slice(buffers, view);
    }
  }
  // Each view unfolds into so much a byte; many on the same bytes would fill the memory.
  uint64_t held = 0, used = 0;
  for (const auto& buffer : buffers) held += buffer.size();
  for (const size_t i : compressed) {
    used += slice(buffers, *meshoptOf(views[i])).size();
    if (used > kMostReadings * held) views[i].fail("too many compressed buffer views lie on the same bytes");
  }
  std::vector<Bytes> decoded(compressed.size());
  parallelOrFail(compressed.size(), [&](size_t k) {
    const Json extension = *meshoptOf(views[compressed[k]]);
    decoded[k] = decodeMeshopt(slice(buffers, extension), extension);
  });
  for (size_t k = 0; k < compressed.size(); ++k) {
    document.storage.push_back(std::move(decoded[k]));
    document.views[compressed[k]].bytes = document.storage.back();
  }
}

}  // namespace roomlight::importers
