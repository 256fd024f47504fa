#include "view/frame.h"

#include <gtest/gtest.h>

#include <bit>

namespace roomlight::view {
namespace {

uint32_t wholeAt(const std::string& bytes, size_t at, size_t count) {
  uint32_t out = 0;
  for (size_t k = count; k-- > 0;) out = out << 8 | static_cast<uint8_t>(bytes[at + k]);
  return out;
}

float realAt(const std::string& bytes, size_t at) { return std::bit_cast<float>(wholeAt(bytes, at, 4)); }

// As docs/reference/view-protocol.md has it.
TEST(Frame, everyFieldOfItsHeaderHasItsPlace) {
  FrameInfo info;
  info.number = 77, info.side = 2, info.flags = kQuick | kRefined, info.jpegQuality = 70;
  info.camera = 5, info.revision = 9, info.samples = 8, info.samplesInAll = 24;
  info.relativeError = 0.25f, info.whiteK = 2700;
  const Result<std::string> packed = packFrame(info, ByteImage(16, 8, 3));
  ASSERT_TRUE(packed) << packed.error();
  const std::string& bytes = packed.value();
  ASSERT_GT(bytes.size(), kFrameHeaderBytes + 2);
  EXPECT_EQ(wholeAt(bytes, 2, 2), kFrameHeaderBytes);
  EXPECT_EQ(wholeAt(bytes, 4, 4), 77u);
  EXPECT_EQ(wholeAt(bytes, 8, 2), 16u);
  EXPECT_EQ(wholeAt(bytes, 10, 2), 8u);
  EXPECT_EQ(wholeAt(bytes, 12, 1), 2u);
  EXPECT_EQ(wholeAt(bytes, 13, 1), 17u);
  EXPECT_EQ(wholeAt(bytes, 14, 2), 70u);
  EXPECT_EQ(wholeAt(bytes, 16, 4), 5u);
  EXPECT_EQ(wholeAt(bytes, 20, 4), 9u);
  EXPECT_EQ(wholeAt(bytes, 24, 4), 8u);
  EXPECT_EQ(realAt(bytes, 28), 0.25f);
  EXPECT_EQ(realAt(bytes, 52), 2700);
  EXPECT_EQ(wholeAt(bytes, 56, 4), 24u);
  EXPECT_EQ(wholeAt(bytes, 60, 4), 0u);
  EXPECT_EQ(wholeAt(bytes, kFrameHeaderBytes, 2), 0xd8ffu) << "where the JPEG begins";
}

}  // namespace
}  // namespace roomlight::view
