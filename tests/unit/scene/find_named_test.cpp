#include "scene/find_named.h"

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

TEST(FindRoom, listsNumbersWhereNamesDoNotTell) {
  std::vector<Room> rooms(3);
  rooms[0].name = "Bath", rooms[1].name = "Bed";
  EXPECT_EQ(findRoom(rooms, "bed").value(), 1u);
  EXPECT_EQ(findRoom(rooms, "2").value(), 2u);
  EXPECT_EQ(findRoom(rooms, "Attic").error(), "no room 'Attic'; there are 0 'Bath', 1 'Bed', 2 ''");
  EXPECT_EQ(findRoom({}, "Bath").error(), "no room 'Bath': the scene knows no rooms and none were found");
}

}  // namespace
}  // namespace roomlight
