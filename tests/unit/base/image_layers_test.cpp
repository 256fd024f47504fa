#include "base/image_layers.h"

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "base/random.h"
#include "unit/temporary_folder.h"

namespace roomlight {
namespace {

using testing::TemporaryFolder;

Image noise(int width, int height, uint64_t seed) {
  Image image(width, height);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    Rng rng(i, 0, seed);
    for (int c = 0; c < 3; ++c) image.pixels[i][c] = rng.uniform() * 1e4f;
  }
  return image;
}

LayeredImage picture(int layers) {
  LayeredImage out;
  out.whole = noise(61, 37, 0);
  for (int i = 0; i < layers; ++i)
    out.layers.push_back({"lamp_" + std::to_string(10 + i), noise(61, 37, static_cast<uint64_t>(i) + 1)});
  out.metadata = {{kLayersKey, R"({"version":1,"layers":[{"channel":"lamp_10","name":"Küche. Lampe"}]})"},
                  {"roomlight.seed", "7"}};
  return out;
}

TEST(ImageLayers, keepEveryBitNamesAndMetadata) {
  TemporaryFolder folder;
  const LayeredImage image = picture(17);
  for (const int threads : {1, 4}) {
    Result<LayeredImage> read = Error{"not read"};
    withThreads(threads, [&] {
      const Status written = writeLayers(folder / "a.exr", image);
      ASSERT_TRUE(written) << written.error();
      read = readLayers(folder / "a.exr");
    });
    ASSERT_TRUE(read) << read.error();
    EXPECT_EQ(read.value().whole.width, 61);
    EXPECT_EQ(read.value().whole.height, 37);
    EXPECT_TRUE(read.value().whole.pixels == image.whole.pixels);
    ASSERT_EQ(read.value().layers.size(), image.layers.size());
    for (size_t i = 0; i < image.layers.size(); ++i) {
      EXPECT_EQ(read.value().layers[i].channel, image.layers[i].channel);
      EXPECT_TRUE(read.value().layers[i].image.pixels == image.layers[i].image.pixels) << i;
    }
    for (const auto& [key, value] : image.metadata) EXPECT_EQ(read.value().metadata.at(key), value);
  }
  EXPECT_EQ(folder.fileCount(), 1u) << "the temporary file stayed behind";
}

TEST(ImageLayers, areAnOrdinaryPictureForOthers) {
  TemporaryFolder folder;
  const LayeredImage image = picture(2);
  ASSERT_TRUE(writeLayers(folder / "a.exr", image));
  const auto read = readImage(folder / "a.exr");
  ASSERT_TRUE(read) << read.error();
  EXPECT_TRUE(read.value().pixels == image.whole.pixels);
}

TEST(ImageLayers, refuseWhatHasNone) {
  TemporaryFolder folder;
  ASSERT_TRUE(writeExr(folder / "plain.exr", noise(4, 4, 0), {}));
  const auto plain = readLayers(folder / "plain.exr");
  ASSERT_FALSE(plain);
  EXPECT_NE(plain.error().find("no layers"), std::string::npos) << plain.error();
  ASSERT_TRUE(writePng(folder / "a.png", Image(4, 4), {}));
  EXPECT_FALSE(readLayers(folder / "a.png"));
  EXPECT_FALSE(readLayers(folder / "missing.exr"));
  ASSERT_TRUE(writeLayers(folder / "cut.exr", picture(3)));
  std::filesystem::resize_file(folder / "cut.exr", std::filesystem::file_size(folder / "cut.exr") / 2);
  EXPECT_FALSE(readLayers(folder / "cut.exr"));
}

TEST(ImageLayers, refuseNamesAndSizesThatOthersWouldMisread) {
  TemporaryFolder folder;
  LayeredImage image = picture(2);
  image.layers[0].channel = "sofa.lamp";
  EXPECT_FALSE(writeLayers(folder / "a.exr", image));
  image.layers[0].channel = image.layers[1].channel;
  EXPECT_FALSE(writeLayers(folder / "a.exr", image));
  image = picture(2);
  image.layers[0].image = Image(4, 4);
  EXPECT_FALSE(writeLayers(folder / "a.exr", image));
  EXPECT_EQ(folder.fileCount(), 0u);
}

}  // namespace
}  // namespace roomlight
