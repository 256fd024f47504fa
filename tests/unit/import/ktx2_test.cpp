// KTX2 pictures: their texels, and what happens to damaged ones.
#include <gtest/gtest.h>
#include <zstd.h>

#include <random>

#include "import/pictures.h"
#include "unit/import/gltf_file.h"
#include "unit/import/ktx2_file.h"
#include "unit/temporary_folder.h"

namespace roomlight {
namespace {

using importers::Bytes;
using importers::DecodedPicture;
using testing::BitWriter;
using testing::Ktx2File;

DecodedPicture decode(const std::string& file) {
  const Bytes bytes(file.begin(), file.end());
  importers::Warnings warnings;
  return importers::tryPictures({{"picture", bytes}}, warnings)[0];
}

std::vector<uint8_t> texelsOf(const std::string& file) {
  const DecodedPicture picture = decode(file);
  EXPECT_EQ(picture.failure, "");
  return picture.texture.rgba;
}

std::vector<uint8_t> texel(const std::vector<uint8_t>& rgba, size_t i) {
  return {rgba.begin() + 4 * static_cast<std::ptrdiff_t>(i), rgba.begin() + 4 * static_cast<std::ptrdiff_t>(i) + 4};
}

using Texel = std::vector<uint8_t>;

std::string uastc(const BitWriter& block) {
  Ktx2File f;
  f.level = block.block();
  return f.bytes();
}

std::string zstandard(const std::string& bytes) {
  std::string out(ZSTD_compressBound(bytes.size()), '\0');
  out.resize(ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), 3));
  return out;
}

TEST(Ktx2, plainTexelsOfOneToFourChannels) {
  Ktx2File f{.width = 2, .height = 1};
  f.format = 37, f.level = "\x01\x02\x03\x04\x05\x06\x07\x08";
  EXPECT_EQ(texelsOf(f.bytes()), (Texel{1, 2, 3, 4, 5, 6, 7, 8}));
  f.format = 44;  // blue first
  EXPECT_EQ(texelsOf(f.bytes()), (Texel{3, 2, 1, 4, 7, 6, 5, 8}));
  f.format = 23;
  EXPECT_EQ(texelsOf(f.bytes()), (Texel{1, 2, 3, 255, 4, 5, 6, 255}));
  f.format = 16;
  EXPECT_EQ(texelsOf(f.bytes()), (Texel{1, 2, 0, 255, 3, 4, 0, 255}));
  f.format = 9;
  EXPECT_EQ(texelsOf(f.bytes()), (Texel{1, 0, 0, 255, 2, 0, 0, 255}));
}

TEST(Ktx2, texelsPackedByZstandard) {
  Ktx2File f{.width = 100, .height = 100};
  f.format = 29, f.scheme = 2, f.level = zstandard(std::string(30000, '\x07'));
  const Texel rgba = texelsOf(f.bytes());
  ASSERT_EQ(rgba.size(), 40000u);
  EXPECT_EQ(texel(rgba, 9999), (Texel{7, 7, 7, 255}));
}

TEST(Ktx2, uastcBlockOfOneColour) {
  const Texel rgba = texelsOf(uastc(BitWriter().put(0x17, 5).put(10, 8).put(20, 8).put(30, 8).put(40, 8)));
  for (size_t i = 0; i < 16; ++i) EXPECT_EQ(texel(rgba, i), (Texel{10, 20, 30, 40}));
}

// Mode 1: endpoints of 8 bits, weights of 2, of which the first lacks its highest bit.
TEST(Ktx2, uastcBlockOfOneSubset) {
  BitWriter b;
  b.mode(0x35, 6, 15);
  for (const uint32_t end : {0, 255, 255, 0, 100, 100}) b.put(end, 8);
  b.put(1, 1);
  for (uint32_t i = 1; i < 16; ++i) b.put(i % 4, 2);
  const Texel rgba = texelsOf(uastc(b));
  EXPECT_EQ(texel(rgba, 0), (Texel{84, 171, 100, 255}));
  EXPECT_EQ(texel(rgba, 4), (Texel{0, 255, 100, 255}));
  EXPECT_EQ(texel(rgba, 6), (Texel{171, 84, 100, 255}));
  EXPECT_EQ(texel(rgba, 15), (Texel{255, 0, 100, 255}));
}

// Mode 4: two subsets, endpoints of a quint and three bits. Pattern 13 has the upper half in subset 1.
TEST(Ktx2, uastcBlockOfTwoSubsetsWithQuints) {
  BitWriter b;
  b.mode(0x13, 5, 15).put(13, 5);
  b.put(0, 7).put(0, 7).put(4 + 4 * 5 + 4 * 25, 7).put(0, 7);  // quints of the endpoints 6, 7, 8 are 4
  for (int i = 0; i < 12; ++i) b.put(0, 3);
  b.put(0, 1);
  for (int i = 1; i < 8; ++i) b.put(0, 2);
  b.put(0, 1);
  for (int i = 9; i < 16; ++i) b.put(3, 2);
  const Texel rgba = texelsOf(uastc(b));
  const Texel upper = texel(rgba, 0), lower = texel(rgba, 15);
  EXPECT_EQ(upper, (Texel{26, 26, 0, 255}));  // quint 4, bits 0: (4 * 26) >> 2
  EXPECT_EQ(lower, (Texel{0, 0, 0, 255}));
}

// Mode 17: luminance and alpha, each with weights of its own.
TEST(Ktx2, uastcBlockOfLuminanceAndAlpha) {
  BitWriter b;
  b.mode(0x25, 6, 23);
  for (const uint32_t end : {0, 255, 255, 0}) b.put(end, 8);
  b.put(0, 1).put(0, 1);
  for (uint32_t i = 1; i < 16; ++i) b.put(3, 2).put(1, 2);
  const Texel rgba = texelsOf(uastc(b));
  EXPECT_EQ(texel(rgba, 0), (Texel{0, 0, 0, 255}));
  EXPECT_EQ(texel(rgba, 1), (Texel{255, 255, 255, 171}));
}

TEST(Ktx2, basisLzBlocksThatNameTheirPalettesInEveryWay) {
  const Texel rgba = texelsOf(testing::basisLzPicture().bytes());
  ASSERT_EQ(rgba.size(), 8u * 8 * 4);
  // Endpoint 1: red 0, green 16 -> 132, blue 23 -> 189, modifiers 13 and 42. Selector 1: rows of -42, -13, +13, +42.
  EXPECT_EQ(texel(rgba, 0), (Texel{0, 90, 147, 90}));
  EXPECT_EQ(texel(rgba, 8 + 3), (Texel{0, 119, 176, 119}));
  EXPECT_EQ(texel(rgba, 16 + 4), (Texel{13, 145, 202, 145}));
  EXPECT_EQ(texel(rgba, 24 + 7), (Texel{42, 174, 231, 174}));
  // Selector 0: columns.
  EXPECT_EQ(texel(rgba, 32), (Texel{0, 90, 147, 90}));
  EXPECT_EQ(texel(rgba, 63), (Texel{42, 174, 231, 174}));
}

TEST(Ktx2, kindsThatCannotBeDecodedAreNamed) {
  Ktx2File f;
  f.format = 145, f.level = std::string(16, 'x');
  const std::string file = f.bytes();
  EXPECT_EQ(importers::undecodable(Bytes(file.begin(), file.end())), "KTX2 (format 145)");
  f.format = 37, f.scheme = 3;
  const std::string deflated = f.bytes();
  EXPECT_EQ(importers::undecodable(Bytes(deflated.begin(), deflated.end())), "KTX2 (supercompression 3)");
}

TEST(Ktx2, picturesThatLieAreRefused) {
  Ktx2File huge{.width = 16384, .height = 16384};
  huge.level = "x";
  EXPECT_NE(decode(huge.bytes()).failure.find("has only"), std::string::npos);
  Ktx2File wide{.width = 0x80000001, .height = 1};
  EXPECT_NE(decode(wide.bytes()).failure.find("claims"), std::string::npos);
  Ktx2File little{.width = 8, .height = 8};
  little.format = 37, little.level = "few";
  EXPECT_NE(decode(little.bytes()).failure.find("has 3 bytes of 256"), std::string::npos);
  little.scheme = 2, little.level = zstandard("few");
  EXPECT_NE(decode(little.bytes()).failure.find("cut short"), std::string::npos);
  EXPECT_NE(decode(uastc(BitWriter().put(0x45, 7))).failure.find("damaged"), std::string::npos);  // no mode
}

// A few hundred cut and scrambled files of every kind, as pictures of a scene: it opens, with or without them.
TEST(Ktx2, damagedPicturesNeverHarmTheirScene) {
  Ktx2File plain{.width = 5, .height = 3};
  plain.format = 23, plain.level = std::string(45, 'x');
  Ktx2File packed = plain;
  packed.scheme = 2, packed.level = zstandard(plain.level);
  BitWriter block;
  block.mode(0x13, 5, 15).put(13, 5);
  for (int i = 0; i < 24; ++i) block.put(static_cast<uint32_t>(i), 4);
  Ktx2File blocks{.width = 8, .height = 4};
  blocks.level = block.block() + block.block();
  std::mt19937 random(1);
  const testing::TemporaryFolder folder;
  for (const Ktx2File& original : {plain, packed, blocks, testing::basisLzPicture()}) {
    for (int i = 0; i < 100; ++i) {
      std::string bytes = original.bytes();
      for (int k = 0; k < 1 + i % 4; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
      if (i % 5 == 0) bytes.resize(random() % bytes.size());
      testing::GltfFile f = testing::GltfFile::triangle();
      f.json["images"] = {{{"bufferView", f.addView(bytes)}}};
      f.json["textures"] = {{{"source", 0}}};
      f.json["materials"][0]["normalTexture"] = {{"index", 0}};
      const auto imported = f.import(folder / "a.glb");
      ASSERT_TRUE(imported) << imported.error();
      for (const std::string& line : imported.value().warnings) EXPECT_EQ(line.find('\n'), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace roomlight
