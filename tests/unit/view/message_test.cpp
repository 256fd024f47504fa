// What browsers say is read strictly.
#include "view/message.h"

#include <gtest/gtest.h>

#include "view/view_camera.h"

namespace roomlight::view {
namespace {

template <class T>
T read(const std::string& text) {
  const Message m = readMessage(text);
  if (const auto* e = std::get_if<ViewError>(&m)) ADD_FAILURE() << e->field << ": " << e->message;
  return std::get<T>(m);
}

ViewError refused(const std::string& text) {
  const Message m = readMessage(text);
  const auto* e = std::get_if<ViewError>(&m);
  if (!e) ADD_FAILURE() << text << " was taken";
  return e ? *e : ViewError();
}

TEST(Message, camerasLookAtTargetsOrAlongDirections) {
  const auto a = read<ViewCamera>(
      R"({"type": "camera", "number": 3, "position": [1, 2, 3], "target": [1, 2, 1], "verticalFov": 60})");
  EXPECT_EQ(a.number, 3u);
  EXPECT_EQ(a.direction, Vec3(0, 0, -1));
  EXPECT_EQ(a.yFovDeg, 60);
  const auto b = read<ViewCamera>(R"({"type": "camera", "position": [0, 0, 0], "direction": [0, 4, 0]})");
  EXPECT_EQ(b.direction, Vec3(0, 1, 0));
  EXPECT_EQ(a.cutHeightM, kInfinity);
  const auto open =
      read<ViewCamera>(R"({"type": "camera", "position": [0, 9, 0], "direction": [0, -1, 0], "cutHeight": 2.5})");
  EXPECT_EQ(open.cutHeightM, 2.5f);
  EXPECT_EQ(cameraOf(open).cutHeightM, 2.5f);
  EXPECT_EQ(viewOf(cameraOf(open)).cutHeightM, 2.5f);
  const char* whole = R"({"type": "camera", "position": [0, 9, 0], "direction": [0, -1, 0], "cutHeight": null})";
  EXPECT_EQ(read<ViewCamera>(whole).cutHeightM, kInfinity);
  EXPECT_EQ(refused(R"({"type": "camera", "position": [0, 0, 0], "target": [0, 0, 0]})").field, "target");
  EXPECT_EQ(refused(R"({"type": "camera", "position": [0, 0], "direction": [0, 0, 1]})").field, "position");
  EXPECT_EQ(refused(R"({"type": "camera", "direction": [0, 0, 1]})").field, "position");
  EXPECT_EQ(refused(R"({"type": "camera", "position": [0, 0, 0], "direction": [0, 0, 1], "verticalFov": 1})").field,
            "verticalFov");
  EXPECT_NE(refused(R"({"type": "camera", "position": [0, 0, 0]})").message.find("target"), std::string::npos);
}

TEST(Message, unknownKeysAndTypesAreNamed) {
  EXPECT_EQ(refused(R"({"type": "ping", "id": 1, "colour": 2})").field, "colour");
  EXPECT_EQ(refused(R"({"type": "dance"})").field, "type");
  EXPECT_EQ(refused(R"({"id": 1})").field, "type");
  EXPECT_EQ(refused("nonsense").code, "badMessage");
  EXPECT_EQ(refused(R"({"type": "ping", "id": 1, "id": 2})").code, "badMessage");
  EXPECT_EQ(refused(std::string(40, '[') + std::string(40, ']')).code, "badMessage");
  EXPECT_EQ(refused(std::string(kMostMessageBytes + 1, ' ')).code, "badMessage");
}

TEST(Message, errorsCarryTheIdOfTheRequest) {
  EXPECT_EQ(refused(R"({"type": "undo", "id": 9, "x": 1})").id, 9u);
  EXPECT_EQ(refused(R"({"type": "undo", "id": -1})").field, "id");
  EXPECT_EQ(refused(R"({"type": "undo", "id": 1.5})").field, "id");
  EXPECT_EQ(refused(R"({"type": "undo", "id": 4294967296})").field, "id");
  EXPECT_EQ(refused(R"({"type": "undo"})").field, "id");
}

TEST(Message, editsSetWhatTheySay) {
  const auto e = read<Edit>(
      R"({"type": "edit", "id": 4, "target": "lamp:2", "dim": 0.5, "on": false, "temperatureK": 2700, "gesture": "g"})");
  EXPECT_EQ(e.target, "lamp:2");
  EXPECT_EQ(e.gesture, "g");
  EXPECT_EQ(e.set.dim, 0.5f);
  EXPECT_EQ(e.set.on, false);
  EXPECT_EQ(e.set.temperatureK, 2700);
  EXPECT_FALSE(e.set.position);
  EXPECT_EQ(refused(R"({"type": "edit", "id": 4, "target": "a", "on": 1})").field, "on");
  EXPECT_EQ(read<Edit>(R"({"type": "edit", "id": 4, "target": "a", "turn": 9, "alone": true})").set.alone, true);
  EXPECT_EQ(refused(R"({"type": "edit", "id": 4, "target": "a", "hidden": true, "alone": true})").field, "alone");
  EXPECT_EQ(refused(R"({"type": "edit", "id": 4, "target": "a", "color": [1, 1, 1], "temperatureK": 3000})").field,
            "temperatureK");
  EXPECT_EQ(refused(R"({"type": "edit", "id": 4, "target": "a", "direction": [0, 0, 0]})").field, "direction");
}

TEST(Message, datesAreRealDays) {
  const auto e = read<Edit>(R"({"type": "edit", "id": 1, "target": "sun", "date": "2028-02-29", "hour": 24})");
  EXPECT_EQ(e.set.year, 2028);
  EXPECT_EQ(e.set.day, 29);
  for (const char* date :
       {"2027-02-29", "2027-13-01", "1949-01-01", "27-01-01", "2027-1-1", "2027-01-01T", "aaaa-bb-cc"}) {
    EXPECT_EQ(refused(std::string(R"({"type": "edit", "id": 1, "target": "sun", "date": ")") + date + "\"}").field,
              "date")
        << date;
  }
}

TEST(Message, displaysChangeOnlyWhatIsSaid) {
  const auto d = read<DisplayChange>(
      R"({"type": "display", "exposure": "auto", "whiteBalance": 4000, "falseColor": "illuminance", "low": null})");
  ASSERT_TRUE(d.ev100);
  EXPECT_FALSE(*d.ev100);
  EXPECT_EQ(**d.whiteK, 4000);
  EXPECT_EQ(d.automaticWhite, false);
  EXPECT_EQ(d.falseColour, FalseColour::Illuminance);
  EXPECT_TRUE(d.low && !*d.low);
  EXPECT_FALSE(d.high);
  EXPECT_EQ(refused(R"({"type": "display", "exposure": "bright"})").field, "exposure");
  EXPECT_EQ(refused(R"({"type": "display", "low": 0})").field, "low");
}

TEST(Message, splitsNameTheirSides) {
  const auto s = read<ChooseSplit>(
      R"({"type": "split", "id": 1, "split": {"left": {"technique": "path"}, "right": {"plan": "start"}}})");
  EXPECT_EQ(s.split->left.technique, "path");
  EXPECT_EQ(s.split->right.plan, "start");
  EXPECT_FALSE(read<ChooseSplit>(R"({"type": "split", "id": 1, "split": null})").split);
  EXPECT_EQ(refused(R"({"type": "split", "id": 1, "split": {"left": {"plan": 3}, "right": {}}})").field,
            "split.left.plan");
}

TEST(Message, rendersAreBounded) {
  const auto r = read<RenderWish>(
      R"({"type": "render", "id": 1, "kind": "panorama", "width": 7680, "height": 3840, "seconds": 60, "format": "exr"})");
  EXPECT_TRUE(r.panorama);
  EXPECT_EQ(r.width, 7680);
  EXPECT_EQ(refused(R"({"type": "render", "id": 1, "kind": "picture", "width": 7681, "height": 100})").field, "width");
  EXPECT_NE(refused(R"({"type": "render", "id": 1, "kind": "picture", "width": 100})").message.find("height"),
            std::string::npos);
  EXPECT_EQ(refused(R"({"type": "render", "id": 1, "kind": "film"})").field, "kind");
}

}  // namespace
}  // namespace roomlight::view
