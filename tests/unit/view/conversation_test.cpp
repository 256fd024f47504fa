// What browsers say and are told, without threads, clock and network.
#include "view/conversation.h"

#include <gtest/gtest.h>

#include <utility>

#include "support/techniques.h"
#include "unit/view/furnished_room.h"
#include "unit/view/lit_room.h"

namespace roomlight::view {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;

const TimePoint kStart{std::chrono::hours(1000)};

struct Talk {
  explicit Talk(Scene scene = roomWithALamp()) : home("My room", std::move(scene)) {}

  ViewHome home;
  std::vector<std::pair<Connection, json>> told;
  std::vector<RenderWork> wishes;
  double bytesToSpare = 1e12;
  TimePoint now = kStart;
  Conversation conversation{home,
                            settings(),
                            [this](Connection c, const std::string& text) { told.emplace_back(c, json::parse(text)); },
                            {[this](RenderWork w) {
                               wishes.push_back(std::move(w));
                               return Status(Ok{});
                             },
                             [](const std::string&) { return false; }, [](const std::string&) { return true; },
                             [this] { return bytesToSpare; }}};

  static RenderSettings settings() {
    RenderSettings s;
    s.technique = "hybrid";
    return s;
  }
  void open(Connection c, const std::string& name = "") { conversation.opened(c, name, now); }
  void say(Connection c, const json& message) {
    now += milliseconds(10);
    conversation.said(c, readMessage(message.dump()), now);
  }
  // The last that was told, which is taken.
  json hear(Connection c) {
    for (auto t = told.rbegin(); t != told.rend(); ++t) {
      if (t->first != c) continue;
      const json out = t->second;
      told.clear();
      return out;
    }
    return {};
  }
  Window& window() { return conversation.windows().front(); }
};

json dimTo(double dim, const char* gesture = "") {
  json edit = {{"type", "edit"}, {"id", 1}, {"target", "lamp:0"}, {"dim", dim}};
  if (*gesture) edit["gesture"] = gesture;
  return edit;
}

TEST(Conversation, welcomesAndKnowsAWindowThatComesBack) {
  Talk talk;
  talk.open(1);
  const json welcome = talk.hear(1);
  EXPECT_EQ(welcome["type"], "welcome");
  EXPECT_EQ(welcome["lamps"].size(), 1u);
  talk.say(1, {{"type", "viewport"}, {"width", 320}, {"height", 200}, {"pixelRatio", 1}});
  talk.conversation.closed(1, talk.now);
  EXPECT_EQ(talk.window().leftAt, talk.now);
  talk.open(2, welcome["window"]);
  EXPECT_EQ(talk.conversation.windows().size(), 1u);
  EXPECT_EQ(talk.window().viewport.width, 320);
}

TEST(Conversation, anInputNeedsAnotherPicture) {
  Talk talk;
  talk.open(1);
  const uint32_t serial = talk.window().serial;
  talk.say(1, {{"type", "viewport"}, {"width", 320}, {"height", 200}, {"pixelRatio", 1}});
  EXPECT_GT(talk.window().serial, serial);
  EXPECT_EQ(talk.window().inputAt, talk.now);
  EXPECT_TRUE(talk.window().takesFrames());
}

TEST(Conversation, anEditIsToldToAllAndCanBeTakenBack) {
  Talk talk;
  talk.open(1), talk.open(2);
  const uint32_t revision = talk.conversation.revision();
  talk.say(1, dimTo(0.25));
  EXPECT_FLOAT_EQ(talk.conversation.stateOf("").lamps[0].dim, 0.25f);
  EXPECT_GT(talk.conversation.revision(), revision);
  EXPECT_EQ(talk.hear(2)["type"], "state");
  talk.say(2, {{"type", "undo"}, {"id", 2}});
  EXPECT_FLOAT_EQ(talk.conversation.stateOf("").lamps[0].dim, 1);
  talk.say(2, {{"type", "undo"}, {"id", 3}});
  EXPECT_EQ(talk.hear(2)["code"], "notPossible");
}

// A book on the left one of two tables of one height, a lamp in mid-air.
Scene roomWithTables() {
  Scene scene = emptyRoom();
  addTable(scene, "Table", 1, 1);
  addTable(scene, "Other table", 3, 1);
  addThing(scene, "Book", {{{1.5f, 0.75f, 1.3f}, {1.7f, 0.78f, 1.5f}}});
  scene.lamps = {test::pointLamp({1.5f, 2, 1.5f}, 100)};
  return scene;
}

json move(const Talk& talk, const std::string& name, double x, const char* gesture = "", bool alone = false) {
  json edit = {{"type", "edit"}, {"id", 1}, {"move", {x, 0, 0}}};
  edit["target"] = objectId(thingNamed(talk.home.editable, name));
  if (*gesture) edit["gesture"] = gesture;
  if (alone) edit["alone"] = true;
  return edit;
}

TEST(Conversation, whatStandsOnAThingGoesAlongAsOneStep) {
  Talk talk(roomWithTables());
  talk.open(1);
  const size_t book = thingNamed(talk.home.editable, "Book"), other = thingNamed(talk.home.editable, "Other table");
  const auto bookAt = [&] { return talk.conversation.stateOf("").objects[book].move.x; };
  talk.say(1, move(talk, "Table", 0.25, "drag"));
  const json state = talk.hear(1);
  ASSERT_EQ(state["objects"].size(), 2u);
  EXPECT_EQ(bookAt(), 0.25f);
  talk.say(1, move(talk, "Table", 1.5, "drag"));  // into the other one, which must not take the book
  EXPECT_EQ(bookAt(), 1.5f);
  talk.say(1, move(talk, "Table", 0.5, "drag", true));  // Shift is held down now
  EXPECT_EQ(bookAt(), 0);
  talk.say(1, move(talk, "Table", 0.5, "drag"));
  EXPECT_EQ(bookAt(), 0.5f);
  talk.say(1, {{"type", "undo"}, {"id", 2}});
  EXPECT_EQ(bookAt(), 0);
  talk.say(1, move(talk, "Table", 0.5, "", true));
  EXPECT_EQ(bookAt(), 0);
  talk.say(1, {{"type", "undo"}, {"id", 3}});
  talk.say(1, move(talk, "Book", 2));  // to the other table, with which it goes from then on
  talk.say(1, move(talk, "Table", 0.1));
  EXPECT_EQ(bookAt(), 2);
  talk.say(1, move(talk, "Other table", 0.5));
  EXPECT_EQ(bookAt(), 2.5f);
  EXPECT_EQ(talk.conversation.stateOf("").objects[other].move.x, 0.5f);
}

TEST(Conversation, tellsWhatRunsIntoWhat) {
  Talk talk(roomWithTables());
  talk.open(1);
  EXPECT_EQ(talk.hear(1)["overlaps"], json::array());
  talk.say(1, move(talk, "Table", 1.5));
  const json pair = {{"object", objectId(thingNamed(talk.home.editable, "Table"))},
                     {"into", objectId(thingNamed(talk.home.editable, "Other table"))}};
  EXPECT_EQ(talk.hear(1)["overlaps"], json::array({pair}));
  talk.say(1, dimTo(0.5));
  EXPECT_EQ(talk.hear(1)["overlaps"], json::array({pair}));
  talk.say(1, {{"type", "undo"}, {"id", 2}});
  talk.say(1, {{"type", "undo"}, {"id", 3}});
  EXPECT_EQ(talk.hear(1)["overlaps"], json::array());
}

TEST(Conversation, aPlanKeepsItsLampsWhileTheHomeIsEdited) {
  Talk talk;
  talk.open(1);
  talk.say(1, dimTo(0.5));
  talk.say(1, {{"type", "plan"}, {"id", 2}, {"do", "keep"}, {"name", "dim"}});
  ASSERT_EQ(talk.hear(1)["type"], "state");
  talk.say(1, dimTo(0.75));
  EXPECT_FLOAT_EQ(talk.conversation.stateOf("dim").lamps[0].dim, 0.5f);
  EXPECT_FLOAT_EQ(talk.conversation.stateOf("start").lamps[0].dim, 1);
  EXPECT_FLOAT_EQ(talk.conversation.stateOf("").lamps[0].dim, 0.75f);
}

TEST(Conversation, anotherListOfPlansLeavesFramesAsNewAsTheyWere) {
  Talk talk;
  talk.open(1);
  Side& side = talk.window().sides[0];
  side.shownRevision = talk.conversation.revision();
  talk.say(1, {{"type", "plan"}, {"id", 2}, {"do", "keep"}, {"name", "as it is"}});
  EXPECT_EQ(side.shownRevision, talk.conversation.revision());
  talk.say(1, dimTo(0.5));
  EXPECT_LT(side.shownRevision, talk.conversation.revision());
}

TEST(Conversation, aFailureIsWorthAnotherTryAfterAWish) {
  Talk talk;
  talk.open(1);
  const uint64_t wishes = talk.conversation.wishes();
  talk.say(1, {{"type", "camera"}, {"number", 1}, {"position", {1, 1, 1}}, {"target", {1, 1, 0}}});
  EXPECT_EQ(talk.conversation.wishes(), wishes);
  talk.say(1, {{"type", "technique"}, {"id", 1}, {"technique", "path"}});
  EXPECT_GT(talk.conversation.wishes(), wishes);
}

TEST(Conversation, windowsShowAFewTechniquesAtOnce) {
  Talk talk;
  const std::vector<std::string> names = test::allTechniques();
  Connection c = 0;
  for (const std::string& name : names) {
    talk.open(++c);
    talk.say(c, {{"type", "technique"}, {"id", 1}, {"technique", name}});
    EXPECT_EQ(talk.hear(c)["type"], "ok") << name;
  }
  const json split = {{"left", json::object()}, {"right", {{"technique", "hybrid"}, {"plan", "start"}}}};
  talk.say(c, {{"type", "split"}, {"id", 2}, {"split", split}});
  EXPECT_EQ(talk.hear(c)["code"], "notPossible");
  EXPECT_EQ(talk.conversation.windowNamed(talk.conversation.windows().back().name)->technique, names.back());
}

TEST(Conversation, ofPointsTheNewestWaits) {
  Talk talk;
  talk.open(1);
  const auto meter = [](int id) { return json{{"type", "meter"}, {"id", id}, {"x", 0.5}, {"y", 0.5}}; };
  talk.say(1, meter(4));
  talk.say(1, meter(5));
  const json answer = talk.hear(1);
  EXPECT_EQ(answer["type"], "metered");
  EXPECT_EQ(answer["id"], 4);
  EXPECT_TRUE(answer["hit"].is_null());
  ASSERT_TRUE(talk.window().meter);
  EXPECT_EQ(talk.window().meter->id, 5u);
  EXPECT_EQ(talk.window().meterAt, talk.now);
}

TEST(Conversation, finalPicturesAreAskedForAsTheWindowShowsThem) {
  Talk talk;
  talk.open(1);
  talk.say(1, {{"type", "viewport"}, {"width", 320}, {"height", 160}, {"pixelRatio", 1}});
  const json wish = {{"type", "render"}, {"id", 1}, {"kind", "picture"}};
  talk.say(1, wish);
  ASSERT_EQ(talk.wishes.size(), 1u);
  EXPECT_EQ(talk.wishes[0].settings.height, talk.wishes[0].settings.width / 2);
  EXPECT_EQ(talk.wishes[0].fileName, "My_room-picture.png");
  talk.bytesToSpare = 1e6;
  talk.say(1, wish);
  EXPECT_EQ(talk.hear(1)["code"], "notPossible");
  EXPECT_EQ(talk.wishes.size(), 1u);
}

TEST(Conversation, framesComeBackOnlyOnceTheyWentOut) {
  Talk talk;
  talk.open(1);
  talk.window().underWay.push_back({7, 0, talk.now});
  talk.say(1, {{"type", "ack"}, {"frame", 7}});
  EXPECT_EQ(talk.hear(1)["code"], "badField");
  talk.conversation.packed(1, 7, 1000, talk.now);
  talk.say(1, {{"type", "ack"}, {"frame", 7}});
  EXPECT_TRUE(talk.window().underWay.empty());
}

TEST(Conversation, whoWasServedWaitsLongest) {
  Talk talk;
  talk.open(1), talk.open(2);
  const std::string first = talk.window().name;
  talk.conversation.serveLast(talk.window());
  EXPECT_EQ(talk.conversation.windows().back().name, first);
  talk.conversation.forget(first);
  EXPECT_EQ(talk.conversation.windows().size(), 1u);
  EXPECT_FALSE(talk.conversation.windowNamed(first));
}

}  // namespace
}  // namespace roomlight::view
