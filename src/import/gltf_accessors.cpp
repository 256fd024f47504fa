#include "import/gltf_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "import/failure.h"

namespace roomlight::importers {
namespace {

enum ComponentType {
  kByte = 5120,
  kUnsignedByte = 5121,
  kShort = 5122,
  kUnsignedShort = 5123,
  kUnsignedInt = 5125,
  kFloat = 5126,
};

size_t sizeOf(int componentType) {
  switch (componentType) {
    case kByte:
    case kUnsignedByte: return 1;
    case kShort:
    case kUnsignedShort: return 2;
    default: return 4;
  }
}

int readComponentType(const Json& json) {
  const Json type = json.at("componentType");
  const int value = static_cast<int>(type.integer(65535));
  if (value != kByte && value != kUnsignedByte && value != kShort && value != kUnsignedShort && value != kUnsignedInt &&
      value != kFloat) {
    type.fail(fmt::format("{} is no component type", value));
  }
  return value;
}

template <class T>
T load(const uint8_t* p) {
  T v;
  std::memcpy(&v, p, sizeof v);
  return v;
}

double component(const uint8_t* p, int componentType) {
  switch (componentType) {
    case kByte: return load<int8_t>(p);
    case kUnsignedByte: return *p;
    case kShort: return load<int16_t>(p);
    case kUnsignedShort: return load<uint16_t>(p);
    case kUnsignedInt: return load<uint32_t>(p);
    default: return load<float>(p);
  }
}

// The bytes of `count` elements of `size` bytes in a buffer view, and their stride.
std::span<const uint8_t> range(const GltfDocument& document, const Json& json, size_t count, size_t size,
                               size_t* stride) {
  const BufferView& view = document.views[static_cast<size_t>(json.at("bufferView").index(document.views.size()))];
  const size_t offset = json.integer("byteOffset", 0, uint64_t{1} << 40);
  *stride = view.stride > 0 ? view.stride : size;
  if (*stride < size)
    json.fail(fmt::format("elements of {} bytes overlap: the stride of the buffer view is {}", size, *stride));
  const size_t available = offset <= view.bytes.size() ? view.bytes.size() - offset : 0;
  const bool fits = count == 0 || (available >= size && (available - size) / *stride >= count - 1);
  if (!fits)
    json.fail(fmt::format("{} elements of {} bytes reach beyond the buffer view of {} bytes", count, size,
                          view.bytes.size()));
  return view.bytes.subspan(std::min(offset, view.bytes.size()));
}

void openSparse(GltfDocument& document, const Json& sparse, Accessor& a) {
  const size_t count = sparse.at("count").integer(a.count);
  const Json indices = sparse.at("indices"), values = sparse.at("values");
  const int type = readComponentType(indices);
  if (type != kUnsignedByte && type != kUnsignedShort && type != kUnsignedInt)
    indices.fail("sparse indices must be unsigned integers");
  size_t stride = 0;
  const auto bytes = range(document, indices, count, sizeOf(type), &stride);
  document.budget.spend(count, sparse.path());
  a.sparseIndices.resize(count);
  for (size_t i = 0; i < count; ++i) {
    a.sparseIndices[i] = static_cast<uint32_t>(component(bytes.data() + i * stride, type));
    if (a.sparseIndices[i] >= a.count || (i > 0 && a.sparseIndices[i] <= a.sparseIndices[i - 1])) {
      indices.fail(fmt::format("index {} is out of range or not ascending", a.sparseIndices[i]));
    }
  }
  a.sparseBytes = range(document, values, count, sizeOf(a.componentType) * static_cast<size_t>(a.components), &stride);
}

}  // namespace

float normalizer(int componentType) {
  switch (componentType) {
    case kByte: return 127;
    case kUnsignedByte: return 255;
    case kShort: return 32767;
    case kUnsignedShort: return 65535;
    default: return 1;
  }
}

Accessor openAccessor(GltfDocument& document, const Json& use) {
  const Json list = document.root().list("accessors");
  const Json json = list[static_cast<size_t>(use.index(list.size()))];
  Accessor a{.json = json, .bytes = {}, .sparseIndices = {}, .sparseBytes = {}};
  a.count = json.at("count").integer(std::numeric_limits<uint32_t>::max());
  a.componentType = readComponentType(json);
  a.normalized = json.boolean("normalized", false);
  const std::string type = json.at("type").text();
  if (type != "SCALAR" && type != "VEC2" && type != "VEC3" && type != "VEC4")
    json.at("type").fail(fmt::format("'{}' is no type of vertices", printable(type)));
  a.components = type == "SCALAR" ? 1 : type.back() - '0';
  if (json.find("bufferView"))
    a.bytes = range(document, json, a.count, sizeOf(a.componentType) * static_cast<size_t>(a.components), &a.stride);
  if (const auto sparse = json.find("sparse")) openSparse(document, *sparse, a);
  return a;
}

std::vector<float> readFloats(const Accessor& a, int components, std::span<const uint32_t> selection) {
  if (a.components < components) a.json.fail(fmt::format("has {} components, {} are needed", a.components, components));
  const size_t count = selection.empty() ? a.count : selection.size(), width = static_cast<size_t>(components),
               size = sizeOf(a.componentType);
  const bool scaled = a.normalized && a.componentType != kFloat;
  const double scale = scaled ? 1.0 / static_cast<double>(normalizer(a.componentType)) : 1.0;
  std::vector<float> out(count * width);
  for (size_t i = 0; i < count; ++i) {
    const size_t element = selection.empty() ? i : selection[i];
    const uint8_t* p = a.bytes.empty() ? nullptr : a.bytes.data() + element * a.stride;
    const auto sparse = std::lower_bound(a.sparseIndices.begin(), a.sparseIndices.end(), element);
    if (sparse != a.sparseIndices.end() && *sparse == element) {
      p = a.sparseBytes.data() +
          static_cast<size_t>(sparse - a.sparseIndices.begin()) * size * static_cast<size_t>(a.components);
    }
    for (size_t c = 0; p && c < width; ++c) {
      const double v = component(p + c * size, a.componentType) * scale;
      out[i * width + c] = static_cast<float>(scaled ? std::max(v, -1.0) : v);
    }
  }
  return out;
}

std::vector<uint32_t> readIndices(const Accessor& a) {
  if (a.components != 1) a.json.fail("indices must be scalars");
  if (a.componentType == kFloat) a.json.fail("indices must be unsigned integers");
  if (!a.sparseIndices.empty() || a.bytes.empty()) a.json.fail("indices must lie in a buffer view and not be sparse");
  std::vector<uint32_t> out(a.count);
  for (size_t i = 0; i < a.count; ++i) {
    const double v = component(a.bytes.data() + i * a.stride, a.componentType);
    out[i] = v < 0 ? std::numeric_limits<uint32_t>::max() : static_cast<uint32_t>(v);
  }
  return out;
}

}  // namespace roomlight::importers
