#include "bake/glb_writer.h"

#include <cstdint>
#include <cstring>

namespace roomlight::bake {
namespace {

constexpr uint32_t kMagic = 0x46546c67, kVersion = 2, kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;

void addWord(std::string& out, uint32_t word) {
  for (int k = 0; k < 4; ++k) out.push_back(static_cast<char>(word >> (8 * k) & 0xff));
}

}  // namespace

GlbWriter::GlbWriter() { json["asset"] = {{"version", "2.0"}, {"generator", "roomlight"}}; }

int GlbWriter::addView(std::string_view bytes) {
  binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
  views_.push_back({{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}});
  binary_ += bytes;
  return static_cast<int>(views_.size()) - 1;
}

int GlbWriter::addAccessor(std::string_view bytes, Component component, const char* type, size_t count, int stride,
                           bool normalized) {
  const int view = addView(bytes);
  if (stride > 0) views_.back()["byteStride"] = stride;
  accessors_.push_back(
      {{"bufferView", view}, {"componentType", static_cast<int>(component)}, {"count", count}, {"type", type}});
  if (normalized) accessors_.back()["normalized"] = true;
  return static_cast<int>(accessors_.size()) - 1;
}

int GlbWriter::addPositions(std::span<const Vec3> positions) {
  Bounds3 bounds;
  for (const Vec3 p : positions) bounds.add(p);
  const int accessor = addAccessor({reinterpret_cast<const char*>(positions.data()), positions.size_bytes()},
                                   Component::Float, "VEC3", positions.size(), sizeof(Vec3), false);
  accessors_.back()["min"] = {bounds.lo.x, bounds.lo.y, bounds.lo.z};
  accessors_.back()["max"] = {bounds.hi.x, bounds.hi.y, bounds.hi.z};
  return accessor;
}

std::string GlbWriter::finished() {
  binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
  json["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
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
