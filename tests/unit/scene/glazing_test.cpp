#include "scene/glazing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace roomlight {
namespace {

float cosDeg(float degrees) { return std::cos(degrees * 3.14159265f / 180); }

// 6 mm clear glass: n = 1.52, 0.96 along the normal.
TEST(Glazing, aPaneLetsThroughWhatTheSlabDoes) {
  const Glazing pane{1, 1.52f, 0.96f};
  EXPECT_NEAR(glazingLight(pane, 1).transmitted, 0.881, 0.0006);
  EXPECT_NEAR(glazingLight(pane, cosDeg(60)).transmitted, 0.802, 0.0006);
  EXPECT_NEAR(glazingLight(pane, cosDeg(80)).transmitted, 0.425, 0.0006);
}

// Light followed to and fro between the faces of one pane or two, term by term.
TEST(Glazing, panesAreTheSumOfAllReflectionsInside) {
  for (const float degrees : {0.f, 40.f, 70.f, 85.f}) {
    const double c = std::cos(degrees * 3.14159265358979 / 180), n = 1.6, ct = std::sqrt(1 - (1 - c * c) / (n * n)),
                 a = std::pow(0.9, 1 / ct);
    double t[2] = {0, 0}, r[2] = {0, 0};  // one pane, two
    for (const double amplitude : {(c - n * ct) / (c + n * ct), (n * c - ct) / (n * c + ct)}) {
      const double f = amplitude * amplitude;
      for (int panes = 1; panes <= 2; ++panes) {
        // Energy going down and up in each layer: glass and air in turn; faces reflect f, glass keeps a.
        const int layers = 2 * panes - 1;
        std::vector<double> down(static_cast<size_t>(layers), 0), up(down);
        double through = 0, back = f;
        down[0] = 1 - f;
        for (int step = 0; step < 4000; ++step) {
          std::vector<double> nextDown(down.size(), 0), nextUp(down.size(), 0);
          for (size_t k = 0; k < down.size(); ++k) {
            const double keep = k % 2 == 0 ? a : 1;
            nextUp[k] += down[k] * keep * f;
            (k + 1 < down.size() ? nextDown[k + 1] : through) += down[k] * keep * (1 - f);
            nextDown[k] += up[k] * keep * f;
            (k > 0 ? nextUp[k - 1] : back) += up[k] * keep * (1 - f);
          }
          down = nextDown, up = nextUp;
        }
        t[panes - 1] += through / 2, r[panes - 1] += back / 2;
      }
    }
    for (int panes = 1; panes <= 2; ++panes) {
      const GlazingLight light = glazingLight({panes, 1.6f, 0.9f}, static_cast<float>(c));
      EXPECT_NEAR(light.transmitted, t[panes - 1], 1e-4) << degrees << ' ' << panes;
      EXPECT_NEAR(light.reflected, r[panes - 1], 1e-4) << degrees << ' ' << panes;
    }
  }
}

TEST(Glazing, losesNothingButWhatItAbsorbs) {
  for (int panes = 1; panes <= kMostGlazingPanes; ++panes) {
    for (int i = 0; i <= 100; ++i) {
      const float c = static_cast<float>(i) / 100;
      const GlazingLight clear = glazingLight({panes, 1.52f, 1}, c);
      EXPECT_NEAR(clear.transmitted + clear.reflected, 1, 1e-4) << panes << ' ' << c;
      const GlazingLight grey = glazingLight({panes, 1.52f, 0.7f}, c);
      EXPECT_LE(grey.transmitted + grey.reflected, 1.0001f);
      EXPECT_LE(grey.transmitted, clear.transmitted + 1e-6f);
      EXPECT_GE(grey.transmitted, 0);
    }
  }
}

TEST(Glazing, isDarkToGrazingLightAndAMirrorThere) {
  const GlazingLight grazing = glazingLight({1, 1.52f, 0.96f}, 0);
  EXPECT_LT(grazing.transmitted, 0.005f);
  EXPECT_GT(grazing.reflected, 0.99f);
}

// Of one interface without losses the hemispherical reflectance is known: n = 1.52 gives 0.0947 (Egan & Hilgeman 1973
// have the closed form); two faces with all reflections between them, of unpolarised light taken as one: 2 r / (1 + r)
// = 0.173. With s and p apart at each angle it is a little less.
TEST(Glazing, reflectsOfAnEvenSkyWhatIsExpected) {
  const float mean = glazingHemisphericalReflectance({1, 1.52f, 1});
  double sum = 0;
  constexpr int kSteps = 100'000;
  for (int i = 0; i < kSteps; ++i) {
    const float c = (static_cast<float>(i) + 0.5f) / kSteps;
    sum += static_cast<double>(glazingLight({1, 1.52f, 1}, c).reflected * 2 * c) / kSteps;
  }
  EXPECT_NEAR(mean, sum, 2e-4);
  EXPECT_GT(mean, 0.14f);
  EXPECT_LT(mean, 0.173f);
}

}  // namespace
}  // namespace roomlight
