#include "base/image_io.h"

#include <gtest/gtest.h>
#include <webp/decode.h>

#include <memory>

#include "base/image_formats.h"
#include "base/random.h"
#include "base/tone.h"
#include "unit/temporary_folder.h"

namespace roomlight {
namespace {

using testing::readFile;
using testing::TemporaryFolder;
using testing::writeFile;

Image noise(int width, int height, float scale) {
  Image image(width, height);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    Rng rng(i, 0, 1);
    for (int c = 0; c < 3; ++c) image.pixels[i][c] = rng.uniform() * scale;
  }
  return image;
}

const Metadata kMetadata = {{"roomlight.version", "1.2.3"}, {"roomlight.settings", "{\"name\": \"Küche\"}"}};

TEST(ImageIo, exrKeepsEveryBitAndMetadata) {
  TemporaryFolder folder;
  const Image image = noise(37, 19, 1e5f);
  ASSERT_TRUE(writeExr(folder / "a.exr", image, kMetadata).ok());
  const auto read = readImage(folder / "a.exr");
  ASSERT_TRUE(read.ok()) << read.error();
  ASSERT_EQ(read.value().width, 37);
  ASSERT_EQ(read.value().height, 19);
  EXPECT_TRUE(read.value().pixels == image.pixels);
  const auto metadata = readMetadata(folder / "a.exr");
  ASSERT_TRUE(metadata.ok()) << metadata.error();
  for (const auto& [key, value] : kMetadata) EXPECT_EQ(metadata.value().at(key), value);
  EXPECT_EQ(folder.fileCount(), 1u) << "the temporary file stayed behind";
}

TEST(ImageIo, pngRoundsToEightBitsAndDecodesToLinear) {
  TemporaryFolder folder;
  const Image image = noise(33, 20, 1.2f);  // above 1: clipped
  ASSERT_TRUE(writePng(folder / "a.png", image, kMetadata).ok());
  const auto read = readImage(folder / "a.png");
  ASSERT_TRUE(read.ok()) << read.error();
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(srgbEncode(read.value().pixels[i][c]), std::min(1.0f, image.pixels[i][c]), 0.5f / 255 + 1e-5f);
    }
  }
  const auto metadata = readMetadata(folder / "a.png");
  ASSERT_TRUE(metadata.ok()) << metadata.error();
  for (const auto& [key, value] : kMetadata) EXPECT_EQ(metadata.value().at(key), value);
}

TEST(ImageIo, pngKeepsOpacity) {
  const TemporaryFolder folder;
  Image image(3, 1);
  image.pixels = {Vec3(1), Vec3(1), Vec3(1)};
  const std::vector<float> alpha = {0, 0.4f, 1};
  ASSERT_TRUE(writePng(folder / "a.png", image, {}, alpha).ok());
  const std::string file = readFile(folder / "a.png");
  const std::span<const uint8_t> bytes(reinterpret_cast<const uint8_t*>(file.data()), file.size());
  const formats::PngSize size = formats::readPngSize(bytes);
  EXPECT_EQ(size.bitsPerPixel, 32);
  const std::vector<uint8_t> rgba = formats::readPngTexels(bytes, size);
  EXPECT_EQ(rgba[3], 0);
  EXPECT_EQ(rgba[7], 102);
  EXPECT_EQ(rgba[11], 255);
  EXPECT_EQ(rgba[4], 255) << "colours are not multiplied by it";
}

TEST(ImageIo, jpegHoldsAnXmpPacketBehindItsFirstSegment) {
  const TemporaryFolder folder;
  ASSERT_TRUE(writeJpeg(folder / "a.jpg", Image(8, 8), 100000, "<x:xmpmeta/>").ok());
  const std::string file = readFile(folder / "a.jpg");
  EXPECT_EQ(file.substr(0, 4), "\xff\xd8\xff\xe0");
  const size_t first = 4 + 256 * static_cast<unsigned char>(file[4]) + static_cast<unsigned char>(file[5]);
  const std::string packet = std::string("http://ns.adobe.com/xap/1.0/") + '\0' + "<x:xmpmeta/>";
  EXPECT_EQ(file.substr(first, 2), "\xff\xe1");
  EXPECT_EQ(static_cast<size_t>(static_cast<unsigned char>(file[first + 3])), 2 + packet.size());
  EXPECT_EQ(file.substr(first + 4, packet.size()), packet);
  EXPECT_EQ(file[first + 4 + packet.size()], '\xff') << "the next segment follows";
}

TEST(ImageIo, pngRefusesNotANumber) {
  TemporaryFolder folder;
  Image image(2, 2);
  image.at(1, 1).y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(writePng(folder / "a.png", image, {}).ok());
  EXPECT_EQ(folder.fileCount(), 0u);
}

TEST(ImageIo, writingIntoAMissingFolderIsOneLineThatNamesTheFile) {
  const Image image(2, 2);
  for (const Status& status : {writeExr("/nonexistent/a.exr", image, {}), writePng("/nonexistent/a.png", image, {})}) {
    ASSERT_FALSE(status.ok());
    EXPECT_NE(status.error().find("/nonexistent/a."), std::string::npos) << status.error();
    EXPECT_EQ(status.error().find('\n'), std::string::npos) << status.error();
  }
}

TEST(ImageIo, failedWriteKeepsTheOldFile) {
  TemporaryFolder folder;
  ASSERT_TRUE(writePng(folder / "a.png", noise(4, 4, 1), {}).ok());
  const std::string before = readFile(folder / "a.png");
  ASSERT_FALSE(writePng(folder / "a.png", Image(), {}).ok());
  EXPECT_EQ(readFile(folder / "a.png"), before);
}

// 3 x 1 pixels, stored flat: red 1, a repeat of it, green 0.5.
const std::string kFlatHdr = std::string("#?RADIANCE\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 3\n") +
                             std::string("\x80\x00\x00\x81\x01\x01\x01\x01\x00\x80\x00\x80", 12);

TEST(ImageIo, hdrFlatLineWithRepeatAndExposure) {
  TemporaryFolder folder;
  writeFile(folder / "a.hdr", kFlatHdr);
  const auto read = readImage(folder / "a.hdr");
  ASSERT_TRUE(read.ok()) << read.error();
  EXPECT_TRUE(read.value().pixels[0] == Vec3(0.5f, 0, 0));
  EXPECT_TRUE(read.value().pixels[1] == Vec3(0.5f, 0, 0));
  EXPECT_TRUE(read.value().pixels[2] == Vec3(0, 0.25f, 0));
}

TEST(ImageIo, hdrPackedLine) {
  TemporaryFolder folder;
  std::string bytes = "#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8\n";
  bytes += std::string("\x02\x02\x00\x08", 4);
  bytes += std::string("\x88\x80", 2);                              // red: 128 eight times
  bytes += std::string("\x08\x00\x10\x20\x30\x40\x50\x60\x70", 9);  // green: eight values
  bytes += std::string("\x84\x00\x84\x40", 4);                      // blue: 0 four times, 64 four times
  bytes += std::string("\x88\x81", 2);                              // exponent 1
  writeFile(folder / "a.hdr", bytes);
  const auto read = readImage(folder / "a.hdr");
  ASSERT_TRUE(read.ok()) << read.error();
  EXPECT_TRUE(read.value().pixels[3] == Vec3(1, 0.375f, 0));
  EXPECT_TRUE(read.value().pixels[7] == Vec3(1, 0.875f, 0.5f));
}

TEST(ImageIo, everyTruncationIsAnErrorAndNothingCrashes) {
  TemporaryFolder folder;
  const Image image = noise(16, 9, 1);
  ASSERT_TRUE(writeExr(folder / "a.exr", image, kMetadata).ok());
  ASSERT_TRUE(writePng(folder / "a.png", image, kMetadata).ok());
  writeFile(folder / "a.hdr", kFlatHdr);
  for (const char* name : {"a.exr", "a.png", "a.hdr"}) {
    const std::string whole = readFile(folder / name);
    // A PNG whose pixels are complete may lack its end chunk.
    const size_t last = std::string(name) == "a.png" ? whole.size() - 16 : whole.size();
    for (size_t n = 0; n < last; n += 7) {
      writeFile(folder / "cut", whole.substr(0, n));
      const auto read = readImage(folder / "cut");
      EXPECT_FALSE(read.ok()) << name << " cut to " << n << " bytes";
      if (!read.ok()) {
        EXPECT_EQ(read.error().find('\n'), std::string::npos);
      }
      (void)readMetadata(folder / "cut");
    }
  }
}

TEST(ImageIo, sizesAreReadFromTheHeaderAlone) {
  const TemporaryFolder folder;
  const Image image = noise(24, 9, 1);
  ASSERT_TRUE(writeExr(folder / "a.exr", image, kMetadata).ok());
  ASSERT_TRUE(writePng(folder / "a.png", image, kMetadata).ok());
  ASSERT_TRUE(writeJpeg(folder / "a.jpg", image, SIZE_MAX, "<x:xmpmeta/>").ok());
  writeFile(folder / "a.hdr",
            "#?RADIANCE\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\n\n-Y 9 +X 24\n" + std::string(864, '\x80'));
  for (const char* name : {"a.exr", "a.png", "a.jpg", "a.hdr"}) {
    ASSERT_TRUE(readImage(folder / name).ok()) << name;
    const std::string whole = readFile(folder / name);
    writeFile(folder / "cut", whole.substr(0, whole.size() - 100));
    for (const char* file : {name, "cut"}) {
      const Result<ImageSize> size = readImageSize(folder / file);
      ASSERT_TRUE(size.ok()) << name << ", " << file << ": " << size.error();
      EXPECT_EQ(size.value(), (ImageSize{24, 9})) << name << ", " << file;
    }
    writeFile(folder / "cut", whole.substr(0, 20));
    const Result<ImageSize> none = readImageSize(folder / "cut");
    ASSERT_FALSE(none.ok()) << name;
    EXPECT_NE(none.error().find("cut: "), std::string::npos) << none.error();
  }
  writeFile(folder / "absurd.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 65000 +X 2000\nxxxx");
  EXPECT_FALSE(readImageSize(folder / "absurd.hdr").ok());
  std::string png = readFile(folder / "a.png");
  png.replace(16, 8, "\x7f\xff\xff\xff\x7f\xff\xff\xff");
  writeFile(folder / "absurd.png", png);
  EXPECT_FALSE(readImageSize(folder / "absurd.png").ok());
}

TEST(ImageIo, absurdSizesAreRefusedBeforeAllocation) {
  TemporaryFolder folder;
  for (const char* size : {"-Y 999999999 +X 999999999", "-Y 65000 +X 2000", "-Y 0 +X 5", "-Y -3 +X 5", "+X 5 -Y 5"}) {
    writeFile(folder / "a.hdr", std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n") + size + "\nxxxx");
    EXPECT_FALSE(readImage(folder / "a.hdr").ok()) << size;
  }
}

TEST(ImageIo, unknownContentMissingFileAndFolderAreErrors) {
  TemporaryFolder folder;
  writeFile(folder / "a.png", "this is not a picture");
  EXPECT_FALSE(readImage(folder / "a.png").ok());
  EXPECT_FALSE(readImage(folder / "missing.exr").ok());
  EXPECT_FALSE(readImage(folder.path()).ok());
  EXPECT_NE(readImage(folder / "missing.exr").error().find("no such file"), std::string::npos);
}

ByteImage transparent() {
  ByteImage image(5, 3, 4);
  for (size_t i = 0; i < image.samples.size(); ++i) image.samples[i] = static_cast<uint8_t>(40 + 3 * i);
  return image;
}

TEST(ImageIo, pngKeepsBytesAndAlpha) {
  const TemporaryFolder folder;
  const ByteImage image = transparent();
  ASSERT_TRUE(writePng(folder / "a.png", image, kMetadata).ok());
  const std::string bytes = readFile(folder / "a.png");
  const std::vector<uint8_t> file(bytes.begin(), bytes.end());
  EXPECT_EQ(formats::readPngTexels(file, formats::readPngSize(file)), image.samples);
  EXPECT_EQ(readMetadata(folder / "a.png").value().at("roomlight.version"), kMetadata.at("roomlight.version"));
}

TEST(ImageIo, webpWithoutLossKeepsBytesAndAlpha) {
  const TemporaryFolder folder;
  const ByteImage image = transparent();
  ASSERT_TRUE(writeWebp(folder / "a.webp", image, kLossless).ok());
  const std::string bytes = readFile(folder / "a.webp");
  int width = 0, height = 0;
  const std::unique_ptr<uint8_t, void (*)(void*)> decoded(
      WebPDecodeRGBA(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size(), &width, &height), WebPFree);
  ASSERT_TRUE(decoded && width == 5 && height == 3);
  EXPECT_TRUE(std::equal(image.samples.begin(), image.samples.end(), decoded.get()));
  EXPECT_FALSE(writeWebp(folder / "b.webp", ByteImage(20000, 1, 3), 80).ok()) << "wider than WebP can be";
  EXPECT_FALSE(std::filesystem::exists(folder / "b.webp"));
}

}  // namespace
}  // namespace roomlight
