// Radiance HDR (G. Ward, "Real Pixels", Graphics Gems II, and the Radiance file format notes):
//   #?RADIANCE            or #?RGBE
//   KEY=value             FORMAT=32-bit_rle_rgbe; EXPOSURE=x may repeat, values were multiplied by all of them
//   (empty line)
//   -Y height +X width    other orientations are refused
//   scan lines: four bytes R G B E a pixel, run-length packed per component where the line starts with 2 2 hi lo
// A reader of our own: stb_image 2.27 loops for ever on a run of length zero at the end of a truncated file.
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/image_formats.h"

namespace roomlight::formats {
namespace {

class Reader {
 public:
  explicit Reader(std::span<const uint8_t> bytes) : bytes_(bytes) {}
  uint8_t byte() {
    if (at_ >= bytes_.size()) throw std::runtime_error("file ends too early");
    return bytes_[at_++];
  }
  uint8_t peek(size_t ahead) const { return at_ + ahead < bytes_.size() ? bytes_[at_ + ahead] : 0; }
  std::string line() {
    std::string text;
    for (char c; (c = static_cast<char>(byte())) != '\n';) {
      text.push_back(c);
      if (text.size() > 4096) throw std::runtime_error("a header line is longer than 4096 bytes");
    }
    return text;
  }

 private:
  std::span<const uint8_t> bytes_;
  size_t at_ = 0;
};

Vec3 decode(const uint8_t* rgbe) {
  if (rgbe[3] == 0) return {};
  const float scale = std::ldexp(1.0f, static_cast<int>(rgbe[3]) - (128 + 8));
  return Vec3{static_cast<float>(rgbe[0]), static_cast<float>(rgbe[1]), static_cast<float>(rgbe[2])} * scale;
}

// Component after component, each as runs: n > 128 repeats the next byte n - 128 times, else n bytes follow.
void readPackedLine(Reader& in, std::vector<uint8_t>& line, size_t width) {
  for (int i = 0; i < 4; ++i) in.byte();
  for (size_t component = 0; component < 4; ++component) {
    for (size_t x = 0; x < width;) {
      const uint8_t code = in.byte();
      const size_t count = code > 128 ? code - 128u : code;
      if (count == 0 || count > width - x) throw std::runtime_error("a scan line's runs do not add up");
      const uint8_t repeated = code > 128 ? in.byte() : uint8_t{0};
      for (size_t i = 0; i < count; ++i, ++x) line[4 * x + component] = code > 128 ? repeated : in.byte();
    }
  }
}

// Pixel after pixel; 1 1 1 n repeats the last pixel n times, consecutive ones count in units of 256.
void readFlatLine(Reader& in, std::vector<uint8_t>& line, size_t width) {
  unsigned shift = 0;
  for (size_t x = 0; x < width;) {
    uint8_t p[4];
    for (uint8_t& v : p) v = in.byte();
    if (p[0] == 1 && p[1] == 1 && p[2] == 1) {
      const size_t count = shift < 24 ? static_cast<size_t>(p[3]) << shift : width;
      if (x == 0 || count > width - x) throw std::runtime_error("a scan line's runs do not add up");
      for (size_t i = 0; i < 4 * count; ++i) line[4 * x + i] = line[4 * x + i - 4];
      x += count;
      shift += 8;
      if (count == 0 && shift > 24) throw std::runtime_error("a scan line's runs do not add up");
    } else {
      for (size_t i = 0; i < 4; ++i) line[4 * x + i] = p[i];
      ++x;
      shift = 0;
    }
  }
}

struct Header {
  ImageSize size;
  float exposure = 1;
};

Header readHeader(Reader& in, size_t fileBytes) {
  Header header;
  in.line();
  for (std::string text; !(text = in.line()).empty();) {
    if (text.starts_with("FORMAT=") && text != "FORMAT=32-bit_rle_rgbe") {
      throw std::runtime_error("only FORMAT=32-bit_rle_rgbe is read");
    }
    if (text.starts_with("EXPOSURE=")) header.exposure *= std::strtof(text.c_str() + 9, nullptr);
  }
  if (!(header.exposure > 0) || !std::isfinite(header.exposure))
    throw std::runtime_error("EXPOSURE is not a positive number");
  long long width = 0, height = 0;
  if (std::sscanf(in.line().c_str(), "-Y %9lld +X %9lld", &height, &width) != 2) {
    throw std::runtime_error("has no resolution line of the form '-Y height +X width'");
  }
  checkSize(width, height, fileBytes);
  header.size = {static_cast<int>(width), static_cast<int>(height)};
  return header;
}

}  // namespace

ImageSize readHdrSize(std::span<const uint8_t> bytes) {
  Reader in(bytes);
  return readHeader(in, bytes.size()).size;
}

Image readHdr(std::span<const uint8_t> bytes) {
  Reader in(bytes);
  const Header header = readHeader(in, bytes.size());
  const int width = header.size.width;
  Image image(width, header.size.height);
  const auto columns = static_cast<size_t>(width);
  std::vector<uint8_t> line(4 * columns);
  for (int y = 0; y < image.height; ++y) {
    const bool packed = width >= 8 && width < 32768 && in.peek(0) == 2 && in.peek(1) == 2 && in.peek(2) < 128 &&
                        (in.peek(2) << 8 | in.peek(3)) == width;
    packed ? readPackedLine(in, line, columns) : readFlatLine(in, line, columns);
    for (int x = 0; x < image.width; ++x) image.at(x, y) = decode(&line[4 * static_cast<size_t>(x)]) / header.exposure;
  }
  return image;
}

}  // namespace roomlight::formats
