// A picture at rest: how far it is, and with how many samples its average is complete.
#include "view/growing_picture.h"

#include <gtest/gtest.h>

#include "unit/view/lit_room.h"

namespace roomlight::view {
namespace {

// Every picture of it is grey.
class GreyLight final : public LitScene {
 public:
  GreyLight(const Scene& scene, Stages& stages) : LitScene(kToldTechnique, scene, true, stages) {}
  std::vector<MeterReading> illuminance(std::span<const SurfaceElement>, const MeterSettings&,
                                        const Progress&) const override {
    return {};
  }
  Image pictureOf(const Camera&, const PictureWish& wish, const Progress&) const override {
    return Image(wish.width, wish.height);
  }
  Result<Picture> still(const Camera&, double, Stages&) override { return Picture{}; }

 private:
  void relight(const SceneChange&, Stages&) override {}
};

TEST(GrowingPicture, tellsWithHowManySamplesItsAverageIsComplete) {
  const Scene scene = roomWithALamp();
  RenderStats stats;
  const RenderProgress silent;
  Stages stages(silent, stats);
  const GreyLight light(scene, stages);
  const std::atomic<bool> newer{false};
  for (const bool refines : {false, true}) {
    GrowingPicture picture;
    picture.showQuick(Image(4, 2), 1, true);
    EXPECT_EQ(picture.samplesInAll(), 0u);
    picture.step(light, Camera(), {4, 2}, {false, refines}, newer);
    const uint32_t inAll = picture.samplesInAll();
    EXPECT_GT(inAll, picture.samples());
    for (uint32_t steps = 1; steps < inAll && !picture.averaged(); ++steps)
      picture.step(light, Camera(), {4, 2}, {false, refines}, newer);
    EXPECT_TRUE(picture.averaged());
    EXPECT_EQ(picture.samples(), inAll);
    EXPECT_EQ(picture.settled(), !refines);
    picture.refine(Image(4, 2), 60, 0.03f, false);
    EXPECT_EQ(picture.samplesInAll(), 0u) << "paths end by their error";
  }
}

}  // namespace
}  // namespace roomlight::view
