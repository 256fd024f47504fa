#include "base/tone.h"

#include <gtest/gtest.h>

#include "unit/temporary_folder.h"

namespace roomlight {
namespace {

std::string sourceText(const std::string& file) {
  return testing::readFile(std::string(ROOMLIGHT_SOURCE_DIR "/") + file);
}

Image constant(Vec3 value) {
  Image image(10, 10);
  for (Vec3& p : image.pixels) p = value;
  return image;
}

TEST(Tone, srgbRoundTripAndKnownValues) {
  for (int i = 0; i <= 255; ++i) {
    const float v = static_cast<float>(i) / 255;
    EXPECT_NEAR(srgbEncode(srgbDecode(v)), v, 1e-6f);
  }
  EXPECT_NEAR(srgbEncode(0.18f), 0.46136f, 1e-4f);
  EXPECT_NEAR(srgbDecode(0.5f), 0.21404f, 1e-5f);
  EXPECT_EQ(srgbEncode(-1), 0);
  EXPECT_FLOAT_EQ(srgbEncode(7), 1);
}

TEST(Tone, fastPowersAreAsGoodAsFloats) {
  for (float x = 1e-6f; x < 1e6f; x *= 1.013f) {
    EXPECT_NEAR(fastLog2(x), std::log2(x), 2e-7f + 1e-7f * std::abs(std::log2(x))) << x;
    EXPECT_NEAR(fastPow(x, 1 / 2.4f) / std::pow(static_cast<double>(x), 1 / 2.4), 1, 2e-6) << x;
  }
  for (float y = -20; y < 20; y += 0.0137f)
    EXPECT_NEAR(static_cast<double>(fastExp2(y)) / std::exp2(static_cast<double>(y)), 1, 2e-7) << y;
}

TEST(FastMath, arcTangentIsAsGoodAsAFloat) {
  for (double angle = -3.1415; angle < 3.1416; angle += 0.00137) {
    for (const double r : {1e-20, 1.0, 7e12}) {
      EXPECT_NEAR(static_cast<double>(
                      fastAtan2(static_cast<float>(r * std::sin(angle)), static_cast<float>(r * std::cos(angle)))),
                  angle, 5e-7)
          << angle;
    }
  }
  for (const auto& [y, x] : {std::pair{0.0f, 0.0f}, {0.0f, 1.0f}, {0.0f, -1.0f}, {1.0f, 0.0f}, {-1.0f, 0.0f}})
    EXPECT_FLOAT_EQ(fastAtan2(y, x), std::atan2(y, x));
}

TEST(Tone, whatIsNotANumberStaysSo) {
  EXPECT_TRUE(std::isnan(srgbEncode(std::nanf(""))));
  EXPECT_TRUE(std::isnan(toneMap(constant({1, std::nanf(""), 1}), 0, ToneCurve::Clip).pixels[0].y));
}

TEST(Tone, exposureMapsItsMaximumLuminanceToOne) {
  for (float ev : {-3.0f, 0.0f, 6.91f, 15.0f}) EXPECT_NEAR(exposureFromEv100(ev) * 1.2f * std::exp2(ev), 1, 1e-5f);
}

TEST(Tone, automaticExposurePutsTheGeometricMeanAtEighteenPercent) {
  const Image grey = constant(Vec3(17.19f));
  EXPECT_NEAR(exposureFromEv100(automaticEv100(grey)) * 17.19f, 0.18f, 1e-4f);
  Image two = grey;  // half at a quarter, half at four times: the same geometric mean
  for (size_t i = 0; i < two.pixels.size(); ++i) two.pixels[i] *= i % 2 ? 4.0f : 0.25f;
  EXPECT_NEAR(automaticEv100(two), automaticEv100(grey), 1e-4f);
}

TEST(Tone, automaticExposureIgnoresBlackPixelsAndAFewLamps) {
  Image image = constant(Vec3(50));
  const float ev = automaticEv100(image);
  image.pixels[0] = Vec3(1e6f);  // one percent
  for (size_t i = 50; i < 100; ++i) image.pixels[i] = Vec3(0);
  EXPECT_NEAR(automaticEv100(image), ev, 0.3f);
  EXPECT_EQ(automaticEv100(constant(Vec3(0))), 0);
}

TEST(Tone, curvesStayWithinZeroAndOneAndRiseWithLight) {
  for (const std::string& name : toneCurveNames()) {
    const ToneCurve curve = toneCurveFromName(name).value();
    float last = -1;
    for (float ev = -14; ev < 20; ev += 0.25f) {
      const Vec3 v = toneMap(constant(Vec3(std::exp2(ev))), 0, curve).pixels[0];
      EXPECT_GE(v.x, 0);
      EXPECT_LE(v.x, 1);
      EXPECT_GE(v.x, last - 1e-4f) << toneCurveName(curve) << " at " << ev;
      last = v.x;
      EXPECT_NEAR(v.x, v.y, 2e-3f) << "grey stays grey";
      EXPECT_NEAR(v.x, v.z, 2e-3f) << "grey stays grey";
    }
    EXPECT_GT(last, 0.97f) << toneCurveName(curve);
  }
}

TEST(Tone, neutralKeepsBaseColoursUpToItsOffset) {
  // Khronos' specification: a base colour between 0.08 and 0.8 comes out lowered by 0.04 in every channel.
  const Image out = toneMap(constant(Vec3(0.5f, 0.3f, 0.2f) * 1.2f), 0, ToneCurve::PbrNeutral);
  EXPECT_NEAR(srgbDecode(out.pixels[0].x), 0.46f, 1e-5f);
  EXPECT_NEAR(srgbDecode(out.pixels[0].y), 0.26f, 1e-5f);
  EXPECT_NEAR(srgbDecode(out.pixels[0].z), 0.16f, 1e-5f);
}

// Ratios of what differs from the smallest channel are the hue.
TEST(Tone, neutralAndFilmicKeepHues) {
  const auto hue = [](Vec3 v) {
    const float low = minComponent(v), high = maxComponent(v);
    return (v.y - low) / (high - low);
  };
  for (const ToneCurve curve : {ToneCurve::PbrNeutral, ToneCurve::Filmic}) {
    for (const float light : {0.05f, 0.5f, 2.0f, 8.0f}) {
      const Vec3 in{light, 0.45f * light, 0.1f * light},
          out = toneMap(constant(in), std::log2(1 / 1.2f), curve).pixels[0];
      const Vec3 linear{srgbDecode(out.x), srgbDecode(out.y), srgbDecode(out.z)};
      if (maxComponent(linear) - minComponent(linear) < 0.03f) continue;  // as good as white
      EXPECT_NEAR(hue(linear), hue(in), 0.02f) << toneCurveName(curve) << " at " << light;
    }
  }
}

TEST(Tone, contrastTurnsAboutMiddleGreyAndSaturationAboutGrey) {
  const float ev100 = std::log2(1 / 1.2f);
  const auto shown = [&](Vec3 light, float contrast, float saturation) {
    const Vec3 v = toneMap(constant(light), ev100, {ToneCurve::Clip, contrast, saturation}).pixels[0];
    return Vec3{srgbDecode(v.x), srgbDecode(v.y), srgbDecode(v.z)};
  };
  EXPECT_NEAR(shown(Vec3(0.18f), 1.5f, 1).y, 0.18f, 1e-3f);
  EXPECT_NEAR(shown(Vec3(0.36f), 1.5f, 1).y, 0.18f * std::pow(2.0f, 1.5f), 2e-3f);
  EXPECT_NEAR(shown(Vec3(0.09f), 1.5f, 1).y, 0.18f / std::pow(2.0f, 1.5f), 2e-3f);
  const Vec3 red{0.4f, 0.1f, 0.1f}, grey = shown(red, 1, 0);
  EXPECT_NEAR(grey.x, luminance(red), 1e-3f);
  EXPECT_NEAR(grey.z, luminance(red), 1e-3f);
  EXPECT_NEAR(luminance(shown(red, 1, 1.3f)), luminance(red), 2e-3f);
  EXPECT_GT(shown(red, 1, 1.3f).x, 0.42f);
}

TEST(Tone, namesRoundTripAndUnknownNamesListTheChoice) {
  EXPECT_EQ(toneCurveNames(), (std::vector<std::string>{"neutral", "agx", "filmic", "clip"}));
  EXPECT_EQ(toneCurveName(Tone().curve), toneCurveNames().front());
  for (const std::string& name : toneCurveNames()) EXPECT_EQ(toneCurveName(toneCurveFromName(name).value()), name);
  const auto wrong = toneCurveFromName("sepia");
  ASSERT_FALSE(wrong.ok());
  EXPECT_NE(wrong.error().find("neutral, agx, filmic, clip"), std::string::npos);
}

// Pages that list the curves, and what baked pages take.
TEST(Tone, documentationAndBakedPagesNameEveryCurve) {
  std::string list;
  for (const std::string& name : toneCurveNames()) {
    list += (list.empty() ? "\"" : ", \"") + name + "\"";
    for (const char* page : {"docs/reference/command-line.md", "docs/reference/conventions.md"})
      EXPECT_NE(sourceText(page).find("`" + name + "`"), std::string::npos) << name << " is not in " << page;
  }
  EXPECT_NE(sourceText("docs/reference/view-protocol.md").find("\"curves\": [" + list + "]"), std::string::npos);
  EXPECT_NE(sourceText("viewer/baked/src/document.ts").find("tone: v.picklist([" + list + "])"), std::string::npos);
}

}  // namespace
}  // namespace roomlight
