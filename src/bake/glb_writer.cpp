#include "bake/glb_writer.h"

#include <meshoptimizer.h>

#include <cstdint>
#include <cstring>
#include <vector>

namespace roomlight::bake {
namespace {

constexpr uint32_t kMagic = 0x46546c67, kVersion = 2, kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;

void addWord(std::string& out, uint32_t word) {
  for (int k = 0; k < 4; ++k) out.push_back(static_cast<char>(word >> (8 * k) & 0xff));
}

}  // namespace

GlbWriter::GlbWriter(bool compressed) : compressed_(compressed) {
  json["asset"] = {{"version", "2.0"}, {"generator", "roomlight"}};
}

int GlbWriter::addView(std::string_view bytes) {
  binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
  views_.push_back({{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}});
  binary_ += bytes;
  return static_cast<int>(views_.size()) - 1;
}

int GlbWriter::addAccessor(std::string_view bytes, Component component, const char* type, size_t count, int stride,
                           bool normalized) {
  const int view = compressed_ ? addCompressed(bytes, count,
                                               stride > 0 ? static_cast<size_t>(stride) : sizeof(uint32_t), stride == 0)
                               : addView(bytes);
  if (stride > 0) views_.back()["byteStride"] = stride;
  accessors_.push_back(
      {{"bufferView", view}, {"componentType", static_cast<int>(component)}, {"count", count}, {"type", type}});
  if (normalized) accessors_.back()["normalized"] = true;
  return static_cast<int>(accessors_.size()) - 1;
}

// Readers see a buffer that is nowhere, as large as all that is compressed.
int GlbWriter::addCompressed(std::string_view bytes, size_t count, size_t stride, bool triangles) {
  std::vector<unsigned char> packed(triangles ? meshopt_encodeIndexBufferBound(count, count)
                                              : meshopt_encodeVertexBufferBound(count, stride));
  packed.resize(triangles ? meshopt_encodeIndexBuffer(packed.data(), packed.size(),
                                                      reinterpret_cast<const unsigned int*>(bytes.data()), count)
                          : meshopt_encodeVertexBuffer(packed.data(), packed.size(), bytes.data(), count, stride));
  const int view = addView({reinterpret_cast<const char*>(packed.data()), packed.size()});
  Json& added = views_.back();
  added["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                    {"byteOffset", added["byteOffset"]},
                                                    {"byteLength", packed.size()},
                                                    {"byteStride", stride},
                                                    {"mode", triangles ? "TRIANGLES" : "ATTRIBUTES"},
                                                    {"count", count}};
  added["buffer"] = 1, added["byteOffset"] = plainBytes_, added["byteLength"] = bytes.size();
  plainBytes_ += bytes.size();
  return view;
}

void GlbWriter::setBounds(int accessor, const Bounds3& bounds) {
  Json& of = accessors_[static_cast<size_t>(accessor)];
  of["min"] = {bounds.lo.x, bounds.lo.y, bounds.lo.z};
  of["max"] = {bounds.hi.x, bounds.hi.y, bounds.hi.z};
}

std::string GlbWriter::finished() {
  binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
  json["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
  if (plainBytes_ > 0)
    json["buffers"].push_back(
        {{"byteLength", plainBytes_}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
  json["bufferViews"] = views_, json["accessors"] = accessors_;
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string out;
  addWord(out, kMagic), addWord(out, kVersion);
  addWord(out, static_cast<uint32_t>(12 + 8 + text.size() + 8 + binary_.size()));
  addWord(out, static_cast<uint32_t>(text.size())), addWord(out, kJsonChunk);
  out += text;
  addWord(out, static_cast<uint32_t>(binary_.size())), addWord(out, kBinaryChunk);
  return out += binary_;
}

}  // namespace roomlight::bake
