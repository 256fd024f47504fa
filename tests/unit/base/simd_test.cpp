// Compiled twice: for the processor the program is built for, and for the oldest one.
#include "base/simd.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>

#if defined(ROOMLIGHT_WITHOUT_AVX2) && \
    (defined(__AVX2__) || defined(__FMA__) || defined(__F16C__) || defined(__SSE4_1__))
#error "compiled for a newer processor than asked for"
#endif

namespace roomlight {
namespace {

using Eight = std::array<float, 8>;

Eight lanes(Float8 v) {
  Eight out;
  v.store(out.data());
  return out;
}

const Eight kA{1, -2, 3.5f, 0, 1e-3f, -7, 100, 0.25f};
const Eight kB{4, 0.5f, -3, 2, 1e3f, -7, 101, 0.125f};

void expectEach(Float8 found, auto&& expected) {
  const Eight values = lanes(found);
  for (size_t i = 0; i < 8; ++i) EXPECT_FLOAT_EQ(values[i], expected(kA[i], kB[i])) << "lane " << i;
}

TEST(Simd, computesEachLane) {
  const Float8 a = Float8::load(kA.data()), b = Float8::load(kB.data());
  expectEach(a + b, [](float x, float y) { return x + y; });
  expectEach(a - b, [](float x, float y) { return x - y; });
  expectEach(a * b, [](float x, float y) { return x * y; });
  expectEach(a / b, [](float x, float y) { return x / y; });
  expectEach(min(a, b), [](float x, float y) { return x < y ? x : y; });
  expectEach(max(a, b), [](float x, float y) { return x > y ? x : y; });
  expectEach(fma(a, b, Float8(0.5f)), [](float x, float y) { return x * y + 0.5f; });
}

TEST(Simd, comparesEachLaneAndNeverNan) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const Eight values{1, 2, 3, kNan, 2, -1, 2.5f, kNan};
  const Float8 v = Float8::load(values.data());
  EXPECT_EQ(topBits(v < Float8(2.0f)), 0b00100001u);
  EXPECT_EQ(topBits(v <= Float8(2.0f)), 0b00110011u);
  EXPECT_EQ(topBits((Float8(1.0f) <= v) & (v < Float8(2.5f))), 0b00010011u);
}

TEST(Simd, takesEightApartIntoFours) {
  const Float8 a = Float8::load(kA.data());
  std::array<float, 4> low, high;
  a.low().store(low.data()), a.high().store(high.data());
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(low[i], kA[i]);
    EXPECT_EQ(high[i], kA[i + 4]);
  }
  EXPECT_EQ(a.low().x(), 1);
  EXPECT_EQ(a.high().everyW().x(), 0.25f);
}

TEST(Simd, dotAddsProductsOfFour) { EXPECT_FLOAT_EQ(dot(Float4(1, 2, 3, 4), Float4(5, -6, 7, 8)), 46); }

TEST(Simd, widensBytes) {
  const std::array<int8_t, 8> bytes{-128, -1, 0, 1, 127, 64, -64, 5};
  const std::array<uint8_t, 8> positive{255, 1, 0, 128, 127, 64, 254, 5};
  const Eight a = lanes(fromBytes(bytes.data())), b = lanes(fromBytes(positive.data()));
  for (size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(a[i], static_cast<float>(bytes[i]));
    EXPECT_EQ(b[i], static_cast<float>(positive[i]));
  }
}

TEST(Simd, joinsTopBits) {
  std::array<uint16_t, 8> high;
  std::array<uint8_t, 8> low;
  const Eight values{0, 1, 0.3f, 123456.7f, 1e-20f, 3e30f, 2.0f, 65504};
  for (size_t i = 0; i < 8; ++i) {
    const uint32_t bits = std::bit_cast<uint32_t>(values[i]);
    high[i] = static_cast<uint16_t>(bits >> 15), low[i] = static_cast<uint8_t>(bits >> 7);
  }
  const Eight joined = lanes(fromTopBits(high.data(), low.data()));
  for (size_t i = 0; i < 8; ++i)
    EXPECT_EQ(std::bit_cast<uint32_t>(joined[i]), std::bit_cast<uint32_t>(values[i]) & ~0x7fu);
}

// What IEEE 754 says a half is.
float valueOfHalf(uint16_t h) {
  const int exponent = h >> 10 & 31, mantissa = h & 1023;
  const float size = exponent == 31
                         ? (mantissa ? std::numeric_limits<float>::quiet_NaN() : std::numeric_limits<float>::infinity())
                     : exponent == 0 ? std::ldexp(static_cast<float>(mantissa), -24)
                                     : std::ldexp(static_cast<float>(1024 + mantissa), exponent - 25);
  return h & 0x8000 ? -size : size;
}

TEST(Half, everyHalfIsRead) {
  for (uint32_t h = 0; h < 0x10000; h += 8) {
    std::array<uint16_t, 8> halves;
    for (size_t i = 0; i < 8; ++i) halves[i] = static_cast<uint16_t>(h + i);
    const Eight found = lanes(fromHalf8(halves.data()));
    for (size_t i = 0; i < 8; ++i) {
      const float expected = valueOfHalf(halves[i]), one = fromHalf(halves[i]);
      if (std::isnan(expected)) {
        ASSERT_TRUE(std::isnan(found[i]) && std::isnan(one)) << halves[i];
      } else {
        ASSERT_TRUE(found[i] == expected && one == expected) << halves[i];
      }
    }
  }
}

TEST(Half, everyFiniteHalfComesBack) {
  for (uint32_t h = 0; h < 0x10000; ++h) {
    const auto half = static_cast<uint16_t>(h);
    if ((half & 0x7c00) == 0x7c00) continue;
    ASSERT_EQ(toHalf(fromHalf(half)), half);
  }
}

TEST(Half, roundsToTheNearestAndTiesToEven) {
  for (uint16_t h = 0; h < 0x7bff; ++h) {
    const float below = valueOfHalf(h), above = valueOfHalf(static_cast<uint16_t>(h + 1)),
                middle = 0.5f * (below + above);
    const auto even = static_cast<uint16_t>(h + (h & 1)), next = static_cast<uint16_t>(h + 1);
    ASSERT_EQ(toHalf(middle), even) << h;
    ASSERT_EQ(toHalf(-middle), even | 0x8000) << h;
    ASSERT_EQ(toHalf(std::nextafter(middle, 0.0f)), h) << h;
    ASSERT_EQ(toHalf(std::nextafter(middle, 1e9f)), next) << h;
  }
}

TEST(Half, beyondTheLargestOneIsBoundedAndFourAreInfinite) {
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  EXPECT_EQ(toHalf(1e9f), 0x7bff);
  EXPECT_EQ(toHalf(-kInfinite), 0xfbff);
  std::array<uint16_t, 8> out;
  toHalf8(Float8::load(Eight{65519.9f, 65520, -1e30f, kInfinite, 0, -0.0f, 1e-30f, 1}.data()), out.data());
  EXPECT_EQ(out, (std::array<uint16_t, 8>{0x7bff, 0x7c00, 0xfc00, 0x7c00, 0, 0x8000, 0, 0x3c00}));
  toHalf4(Float4(std::numeric_limits<float>::quiet_NaN()), out.data());
  EXPECT_TRUE(std::isnan(valueOfHalf(out[0])));
}

}  // namespace
}  // namespace roomlight
