#include "base/image_layers.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

#include "base/image_formats.h"
#include "base/parallel.h"

namespace roomlight::formats {
namespace {

constexpr const char* kNames[] = {"R", "G", "B"};
constexpr int kCompression =
    1;  // floats with noise in them hardly shrink further; higher levels take several times as long
constexpr uint64_t kMostFloats = uint64_t{1} << 32;

Imf::Slice slice(const Imath::Box2i& window, const Image& image, int channel) {
  auto* first = const_cast<float*>(&image.pixels.front().x) + channel;  // the library only reads from what it writes
  return Imf::Slice::Make(Imf::FLOAT, first, window, sizeof(Vec3), sizeof(Vec3) * static_cast<size_t>(image.width));
}

// The library has one pool of threads for all files.
int useThreads() {
  const int threads = threadCount();
  if (Imf::globalThreadCount() != threads) Imf::setGlobalThreadCount(threads);
  return threads;
}

bool isName(const std::string& channel) {
  return !channel.empty() && std::all_of(channel.begin(), channel.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  });
}

bool isRead(const Imf::Channel* channel) { return channel && channel->xSampling == 1 && channel->ySampling == 1; }

bool isComplete(const Imf::ChannelList& channels, const std::string& prefix) {
  return std::all_of(std::begin(kNames), std::end(kNames),
                     [&](const char* name) { return isRead(channels.findChannel(prefix + name)); });
}

}  // namespace

void writeLayers(const std::filesystem::path& file, const LayeredImage& image) {
  const Image& whole = image.whole;
  if (whole.width < 1 || whole.height < 1) throw std::runtime_error("a picture without pixels cannot be written");
  Imf::Header header(whole.width, whole.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  header.zipCompressionLevel() = kCompression;
  for (const auto& [key, value] : image.metadata) header.insert(key, Imf::StringAttribute(value));
  Imf::FrameBuffer frame;
  const auto add = [&](const std::string& prefix, const Image& layer) {
    if (layer.width != whole.width || layer.height != whole.height)
      throw std::runtime_error("layers of different sizes cannot be written");
    for (int c = 0; c < 3; ++c) {
      if (header.channels().findChannel(prefix + kNames[c]))
        throw std::runtime_error(fmt::format("two layers are called '{}'", prefix));
      header.channels().insert(prefix + kNames[c], Imf::Channel(Imf::FLOAT));
      frame.insert(prefix + kNames[c], slice(header.dataWindow(), layer, c));
    }
  };
  add("", whole);
  for (const PictureLayer& layer : image.layers) {
    if (!isName(layer.channel))
      throw std::runtime_error(fmt::format("'{}' is no name for a layer: letters, digits and _ alone", layer.channel));
    add(layer.channel + ".", layer.image);
  }
  Imf::OutputFile out(file.c_str(), header, useThreads());
  out.setFrameBuffer(frame);
  out.writePixels(whole.height);
}

LayeredImage readLayers(const std::filesystem::path& file) {
  Imf::Header::setMaxImageSize(65536, 65536);  // before the library allocates its table of lines
  Imf::InputFile in(file.c_str(), useThreads());
  const Imath::Box2i window = in.header().dataWindow();
  const int64_t width = int64_t{window.max.x} - window.min.x + 1, height = int64_t{window.max.y} - window.min.y + 1;
  checkSize(width, height, std::filesystem::file_size(file));
  const Imf::ChannelList& channels = in.header().channels();
  if (!isComplete(channels, "")) throw std::runtime_error("has no channels R, G and B");
  LayeredImage image;
  for (auto c = channels.begin(); c != channels.end(); ++c) {
    const std::string name = c.name();
    if (name.size() < 3 || !name.ends_with(".R")) continue;
    const std::string layer = name.substr(0, name.size() - 2);
    if (isName(layer) && isComplete(channels, layer + ".")) image.layers.push_back({layer, {}});
  }
  if (image.layers.empty()) throw std::runtime_error("has no layers: it was not written by render --layers");
  const auto floats = static_cast<uint64_t>(width * height) * 3 * (image.layers.size() + 1);
  if (floats > kMostFloats)
    throw std::runtime_error(fmt::format("header claims {} layers of {} x {} pixels, more than is read",
                                         image.layers.size(), width, height));
  Imf::FrameBuffer frame;
  const auto add = [&](const std::string& prefix, Image& into) {
    into = Image(static_cast<int>(width), static_cast<int>(height));
    for (int c = 0; c < 3; ++c) frame.insert(prefix + kNames[c], slice(window, into, c));
  };
  add("", image.whole);
  for (PictureLayer& layer : image.layers) add(layer.channel + ".", layer.image);
  in.setFrameBuffer(frame);
  in.readPixels(window.min.y, window.max.y);
  for (auto i = in.header().begin(); i != in.header().end(); ++i) {
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&i.attribute()))
      image.metadata[i.name()] = text->value();
  }
  return image;
}

}  // namespace roomlight::formats
