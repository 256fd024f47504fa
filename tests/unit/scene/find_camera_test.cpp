#include "scene/find_camera.h"

#include <gtest/gtest.h>

namespace roomlight {
namespace {

Scene withCameras(const std::vector<std::string>& names) {
  Scene scene;
  for (const std::string& name : names) scene.cameras.emplace_back().name = name;
  return scene;
}

TEST(FindCamera, takesNamesNumbersAndWhatOnlyOneNameCanMean) {
  const Scene scene = withCameras({"Kitchen", "Living room", "Living corner", "2", "Küche"});
  EXPECT_EQ(findCamera(scene, "Kitchen").value().name, "Kitchen");
  EXPECT_EQ(findCamera(scene, "1").value().name, "Living room");
  EXPECT_EQ(findCamera(scene, "2").value().name, "2") << "a name goes before a number";
  EXPECT_EQ(findCamera(scene, "kitchen").value().name, "Kitchen");
  EXPECT_EQ(findCamera(scene, "KÜCHE").value().name, "Küche");
  EXPECT_EQ(findCamera(scene, "living r").value().name, "Living room");
}

TEST(FindCamera, saysWhatMayHaveBeenMeant) {
  const Scene scene = withCameras({"Kitchen", "Living room", "Living corner"});
  EXPECT_EQ(findCamera(scene, "Kitchn").error(),
            "no camera 'Kitchn'; did you mean 'Kitchen'? There are 'Kitchen', 'Living room', 'Living corner'");
  EXPECT_EQ(findCamera(scene, "living").error(), "camera 'living' may be any of 'Living room', 'Living corner'");
}

}  // namespace
}  // namespace roomlight
