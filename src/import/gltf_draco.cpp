#include "import/gltf_data.h"

#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "import/failure.h"

namespace roomlight::importers {
namespace {

// A stream may claim this many triangles and vertices, and so many a byte; a vertex this many numbers.
constexpr uint64_t kFreeElements = 1 << 16;
constexpr uint64_t kElementsPerByte = 64;
constexpr uint64_t kMostComponents = 64;

// One of Draco's decoders that looks at what the stream claims before it takes memory for it.
template <class Decoder>
class Wary : public Decoder {
 public:
  explicit Wary(uint64_t most) : most_(most) {}
  bool claimsTooMuch() const { return tooMuch_; }

 protected:
  // Both methods begin with two counts: vertices and triangles, or triangles and vertices.
  bool DecodeConnectivity() override {
    draco::DecoderBuffer ahead = *this->buffer();
    uint32_t first = 0, second = 0;
    if (!draco::DecodeVarint(&first, &ahead) || !draco::DecodeVarint(&second, &ahead)) return false;
    tooMuch_ = uint64_t{first} + second > most_;
    return !tooMuch_ && Decoder::DecodeConnectivity();
  }
  bool DecodeAllAttributes() override {
    uint64_t components = 0;
    const draco::PointCloud* cloud = this->point_cloud();
    for (int i = 0; i < cloud->num_attributes(); ++i)
      components += static_cast<uint64_t>(cloud->attribute(i)->num_components());
    tooMuch_ = components > kMostComponents;
    return !tooMuch_ && Decoder::DecodeAllAttributes();
  }

 private:
  uint64_t most_;
  bool tooMuch_ = false;
};

template <class Decoder>
void decodeWith(std::span<const uint8_t> bytes, uint64_t most, const Json& extension, draco::Mesh& mesh) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  Wary<Decoder> decoder(most);
  const draco::Status status = decoder.Decode(draco::DecoderOptions(), &buffer, &mesh);
  if (decoder.claimsTooMuch())
    extension.fail(fmt::format("claims far more vertices or triangles than its {} bytes can hold", bytes.size()));
  if (!status.ok()) extension.fail(fmt::format("the Draco data are damaged: {}", printable(status.error_msg_string())));
}

void decodeMesh(std::span<const uint8_t> bytes, uint64_t most, const Json& extension, draco::Mesh& mesh) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::DracoHeader header{};
  if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok())
    extension.fail("the Draco data are cut short or no Draco data");
  if (header.encoder_type != draco::TRIANGULAR_MESH) extension.fail("the Draco data hold no triangles");
  // glTF allows only this version; the counts of older ones are stored in another way.
  if (header.version_major != 2 || header.version_minor != 2) {
    extension.fail(
        fmt::format("Draco bitstream {}.{} is not supported, only 2.2", header.version_major, header.version_minor));
  }
  if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING) {
    decodeWith<draco::MeshEdgebreakerDecoder>(bytes, most, extension, mesh);
  } else if (header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING) {
    decodeWith<draco::MeshSequentialDecoder>(bytes, most, extension, mesh);
  } else {
    extension.fail("the Draco data use an unknown method");
  }
}

DracoAttribute valuesOf(const draco::Mesh& mesh, const draco::PointAttribute& attribute, const Json& use) {
  DracoAttribute out;
  out.components = attribute.num_components();
  out.scaled = attribute.normalized();
  const size_t width = static_cast<size_t>(out.components);
  if (width == 0 || width > 16) use.fail(fmt::format("the Draco attribute has {} components", width));
  out.values.resize(mesh.num_points() * width);
  for (uint32_t i = 0; i < mesh.num_points(); ++i) {
    const draco::AttributeValueIndex value = attribute.mapped_index(draco::PointIndex(i));
    if (value.value() >= attribute.size()) use.fail("the Draco data are damaged: a vertex has no value");
    float* v = &out.values[i * width];
    if (!attribute.ConvertValue(value, static_cast<int8_t>(width), v))
      use.fail("the Draco data are damaged: a value cannot be read");
  }
  return out;
}

}  // namespace

DracoPrimitive decodeDraco(GltfDocument& document, const Json& extension) {
  const BufferView& view = document.views[static_cast<size_t>(extension.at("bufferView").index(document.views.size()))];
  const uint64_t most =
      std::min<uint64_t>(kFreeElements + kElementsPerByte * view.bytes.size(), document.budget.left());
  draco::Mesh mesh;
  decodeMesh(view.bytes, most, extension, mesh);
  document.budget.spend(size_t{3} * mesh.num_faces() + mesh.num_points(), extension.path());

  DracoPrimitive out;
  out.vertexCount = mesh.num_points();
  out.indices.reserve(size_t{3} * mesh.num_faces());
  for (uint32_t f = 0; f < mesh.num_faces(); ++f) {
    for (const draco::PointIndex& corner : mesh.face(draco::FaceIndex(f))) {
      if (corner.value() >= out.vertexCount)
        extension.fail(fmt::format("the Draco data are damaged: triangle {} has no vertex {}", f, corner.value()));
      out.indices.push_back(corner.value());
    }
  }
  const Json attributes = extension.at("attributes");
  for (const auto& [name, id] : attributes.raw().items()) {
    const Json use = attributes.at(name.c_str());
    const draco::PointAttribute* attribute =
        mesh.GetAttributeByUniqueId(static_cast<uint32_t>(use.integer(0xffffffff)));
    if (!attribute) use.fail("the Draco data hold no such attribute");
    out.attributes.emplace(name, valuesOf(mesh, *attribute, use));
  }
  return out;
}

}  // namespace roomlight::importers
