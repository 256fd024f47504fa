// OpenEXR (openexr.com, file layout version 2): scan lines or tiles of named channels with typed attributes.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>

#include <filesystem>
#include <stdexcept>

#include "base/image_formats.h"

namespace roomlight::formats {
namespace {

// A slice whose element (0, 0) of the data window is `first`.
Imf::Slice sliceAt(const Imath::Box2i& window, float* first, int width) {
  return Imf::Slice::Make(Imf::FLOAT, first, window, sizeof(Vec3), sizeof(Vec3) * static_cast<size_t>(width));
}

// Checked, before the library takes memory for the pixels.
ImageSize sizeOf(const Imf::InputFile& in, const std::filesystem::path& file) {
  const Imath::Box2i window = in.header().dataWindow();
  const int64_t width = int64_t{window.max.x} - window.min.x + 1, height = int64_t{window.max.y} - window.min.y + 1;
  checkSize(width, height, std::filesystem::file_size(file));
  return {static_cast<int>(width), static_cast<int>(height)};
}

}  // namespace

void writeExr(const std::filesystem::path& file, const Image& image, const Metadata& metadata) {
  if (image.width < 1 || image.height < 1) throw std::runtime_error("a picture without pixels cannot be written");
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const auto& [key, value] : metadata) header.insert(key, Imf::StringAttribute(value));
  Imf::FrameBuffer frame;
  auto* first = const_cast<float*>(&image.pixels.front().x);  // the library only reads from it
  const char* names[] = {"R", "G", "B"};
  for (int c = 0; c < 3; ++c) {
    header.channels().insert(names[c], Imf::Channel(Imf::FLOAT));
    frame.insert(names[c], sliceAt(header.dataWindow(), first + c, image.width));
  }
  Imf::OutputFile out(file.c_str(), header);
  out.setFrameBuffer(frame);
  out.writePixels(image.height);
}

Image readExr(const std::filesystem::path& file) {
  Imf::Header::setMaxImageSize(65536, 65536);  // before the library allocates its table of lines
  Imf::InputFile in(file.c_str());
  const ImageSize size = sizeOf(in, file);
  const Imath::Box2i window = in.header().dataWindow();
  const Imf::ChannelList& channels = in.header().channels();
  const bool grey = !channels.findChannel("R") && channels.findChannel("Y");
  const char* names[] = {grey ? "Y" : "R", grey ? "Y" : "G", grey ? "Y" : "B"};
  Image image(size.width, size.height);
  Imf::FrameBuffer frame;
  for (int c = 0; c < (grey ? 1 : 3); ++c) {
    const Imf::Channel* channel = channels.findChannel(names[c]);
    if (!channel) throw std::runtime_error(std::string("has no channel ") + names[c] + "; R, G and B (or Y) are read");
    if (channel->xSampling != 1 || channel->ySampling != 1)
      throw std::runtime_error("subsampled channels are not read");
    frame.insert(names[c], sliceAt(window, &image.pixels.front()[c], image.width));
  }
  in.setFrameBuffer(frame);
  in.readPixels(window.min.y, window.max.y);
  if (grey) {
    for (Vec3& p : image.pixels) p = Vec3(p.x);
  }
  return image;
}

ImageSize readExrSize(const std::filesystem::path& file) {
  Imf::Header::setMaxImageSize(65536, 65536);
  const Imf::InputFile in(file.c_str());
  return sizeOf(in, file);
}

Metadata readExrMetadata(const std::filesystem::path& file) {
  Imf::Header::setMaxImageSize(65536, 65536);
  Imf::InputFile in(file.c_str());
  Metadata metadata;
  for (auto i = in.header().begin(); i != in.header().end(); ++i) {
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&i.attribute()))
      metadata[i.name()] = text->value();
  }
  return metadata;
}

}  // namespace roomlight::formats
