// A home looked at and changed through the server.
#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <condition_variable>
#include <mutex>
#include <thread>

#include "seen.h"
#include "view/session.h"

namespace roomlight {
namespace {

using namespace roomlight::testing;
using nlohmann::json;

std::pair<int, int> jpegSize(const std::string& jpeg) {
  const std::unique_ptr<void, int (*)(tjhandle)> reader(tjInitDecompress(), tjDestroy);
  int width = 0, height = 0, sub = 0, space = 0;
  tjDecompressHeader3(reader.get(), reinterpret_cast<const unsigned char*>(jpeg.data()), jpeg.size(), &width, &height,
                      &sub, &space);
  return {width, height};
}

TEST(Session, welcomesWithTheHome) {
  const ServedHome home;
  Client client(home.port(), home.live());
  const json welcome = client.hear("welcome");
  EXPECT_EQ(welcome["protocol"], 1);
  EXPECT_EQ(welcome["home"], "test");
  EXPECT_EQ(named(welcome["cameras"], "Door")["verticalFov"].get<int>(), 51);
  const json lamp = named(welcome["lamps"], "Pendant");
  EXPECT_EQ(lamp["kind"], "point");
  EXPECT_NEAR(lamp["fluxLm"].get<double>(), 200 * 4 * 3.14159265, 0.1);
  EXPECT_EQ(named(welcome["lamps"], "Panel")["kind"], "glow");
  EXPECT_TRUE(named(welcome["objects"], "Box")["movable"].get<bool>());
  EXPECT_EQ(welcome["legend"].size(), 17u);
  EXPECT_TRUE(welcome["undo"].is_null());
}

TEST(Session, framesAreOfTheViewport) {
  const ServedHome home;
  Client client(home.port(), home.live());
  client.say(kViewport);
  const ReceivedFrame frame = client.see(isWhole);
  EXPECT_EQ(jpegSize(frame.jpeg), std::pair(96, 54));
  client.say({{"type", "camera"}, {"number", 7}, {"position", {2, 1.5, 4}}, {"target", {2, 1, 0}}});
  EXPECT_EQ(client.see([](const ReceivedFrame& f) { return f.camera == 7; }).width, 96);
  const ReceivedFrame better = client.see([](const ReceivedFrame& f) { return f.camera == 7 && f.samples >= 4; });
  EXPECT_TRUE(isWhole(better));
}

TEST(Session, atMostTwoFramesAreUnderWay) {
  const ServedHome home;
  Client client(home.port(), home.live());
  client.acknowledges = false;
  client.say(kViewport);
  client.see(isWhole);
  client.see(isWhole);
  expectNothingInTime([&] { client.see(isWhole, 1); });
}

TEST(Session, slowLinesGetSmallFramesWhileTheyMoveAndWholeOnesAtRest) {
  const ServedHome home;
  Client client(home.port(), home.live());
  client.acknowledges = false;
  client.say(kViewport);
  bool small = false, whole = false;
  for (int i = 0; i < 40 && !(small && whole); ++i) {
    if (i % 8 == 0)
      client.say({{"type", "camera"}, {"number", i + 1}, {"position", {2 + 0.05 * i, 1.5, 4}}, {"target", {2, 1, 0}}});
    const ReceivedFrame frame = client.see([](const ReceivedFrame&) { return true; });
    small |= frame.width < 96;
    if (frame.samples > 0) {
      EXPECT_EQ(frame.width, 96);
      whole = true;
    }
    // Now quicker, now slower.
    std::this_thread::sleep_for(std::chrono::milliseconds(i % 2 == 0 ? 150 : 350));
    client.say({{"type", "ack"}, {"frame", frame.number}});
  }
  EXPECT_TRUE(small);
  EXPECT_TRUE(whole);
}

TEST(Session, badMessagesAreAnswered) {
  const ServedHome home;
  Client client(home.port(), home.live());
  client.sayText("{ no json");
  EXPECT_EQ(client.hear("error")["code"], "badMessage");
  client.sayText("[1, 2]");
  EXPECT_EQ(client.hear("error")["code"], "badMessage");
  client.say({{"type", "edit"}, {"id", 5}, {"target", "lamp:0"}, {"dim", 2}});
  json error = client.hear("error", 5);
  EXPECT_EQ(error["field"], "dim");
  client.say({{"type", "edit"}, {"id", 6}, {"target", "lamp:99"}, {"dim", 1}});
  EXPECT_EQ(client.hear("error", 6)["code"], "unknownThing");
  client.say({{"type", "ping"}, {"id", 8}});
  client.hear("pong", 8);
}

TEST(Session, aDimmedLampDarkensTheMeterAndUndoBringsItBack) {
  const ServedHome home;
  Client client(home.port(), home.live());
  const std::string lamp = named(client.hear("welcome")["lamps"], "Pendant")["id"];
  client.say(kViewport);
  client.see(isWhole);
  const double before = lux(client, 1);
  client.say({{"type", "edit"}, {"id", 2}, {"target", lamp}, {"dim", 0.25}});
  client.hear("ok", 2);
  const json state = client.hear("state");
  EXPECT_EQ(state["lamps"][0]["dim"], 0.25);
  EXPECT_EQ(state["undo"], "Dim Pendant");
  const double dimmed = lux(client, 3);
  EXPECT_LT(dimmed, 0.6 * before);
  EXPECT_GT(dimmed, 0.2 * before);
  client.say({{"type", "undo"}, {"id", 4}});
  client.hear("ok", 4);
  EXPECT_NEAR(lux(client, 5), before, 0.03 * before);
}

TEST(Session, windowsSeeEachOthersEdits) {
  const ServedHome home;
  Client one(home.port(), home.live()), other(home.port(), home.live());
  one.hear("welcome");
  const json welcome = other.hear("welcome");
  const std::string box = named(welcome["objects"], "Box")["id"];
  one.say(kViewport);
  other.say(kViewport);
  other.see(isWhole);
  one.say({{"type", "edit"}, {"id", 1}, {"target", box}, {"move", {0.5, 0, 0.5}}, {"turn", 45}});
  const json state = other.hear("state");
  EXPECT_EQ(state["objects"][0]["id"], box);
  EXPECT_EQ(state["objects"][0]["turn"], 45);
  const uint32_t revision = state["revision"];
  EXPECT_TRUE(isWhole(other.see([&](const ReceivedFrame& f) { return f.revision == revision && f.samples > 0; })));
  other.say({{"type", "undo"}, {"id", 2}});
  one.hear("state");
  EXPECT_EQ(one.hear("state")["objects"][0]["turn"], 0);
}

TEST(Session, aGestureOnAnotherThingIsAnotherStep) {
  const ServedHome home;
  Client client(home.port(), home.live());
  const json welcome = client.hear("welcome");
  client.say({{"type", "edit"},
              {"id", 1},
              {"target", named(welcome["lamps"], "Pendant")["id"]},
              {"dim", 0.5},
              {"gesture", "slide 1"}});
  EXPECT_EQ(client.hear("state")["undo"], "Dim Pendant");
  client.say({{"type", "edit"},
              {"id", 2},
              {"target", named(welcome["objects"], "Box")["id"]},
              {"turn", 45},
              {"gesture", "slide 1"}});
  EXPECT_EQ(client.hear("state")["undo"], "Turn Box");
  client.say({{"type", "undo"}, {"id", 3}});
  const json state = client.hear("state");
  EXPECT_EQ(state["undo"], "Dim Pendant");
  EXPECT_TRUE(state["lamps"].empty());
}

TEST(Session, thingsStayNearTheHome) {
  const ServedHome home;
  Client client(home.port(), home.live());
  const json welcome = client.hear("welcome");
  const json box = named(welcome["objects"], "Box")["id"], lamp = named(welcome["lamps"], "Pendant")["id"];
  client.say({{"type", "edit"}, {"id", 1}, {"target", box}, {"move", {1000, 0, 0}}});
  EXPECT_EQ(client.hear("error", 1)["field"], "move");
  client.say({{"type", "edit"}, {"id", 2}, {"target", lamp}, {"position", {2, -200, 2}}});
  EXPECT_EQ(client.hear("error", 2)["field"], "position");
  client.say({{"type", "edit"}, {"id", 3}, {"target", box}, {"move", {50, 0, 0}}});
  client.hear("ok", 3);
}

TEST(Session, pickingFindsThings) {
  const ServedHome home;
  Client client(home.port(), home.live());
  const json welcome = client.hear("welcome");
  client.say(kViewport);
  client.say({{"type", "camera"}, {"position", {2, 1, 4.5}}, {"target", {2, 0.4, 1.5}}});
  client.say({{"type", "pick"}, {"id", 1}, {"x", 0.5}, {"y", 0.5}});
  const json hit = client.hear("picked", 1)["hit"];
  EXPECT_EQ(hit["object"], named(welcome["objects"], "Box")["id"]);
  EXPECT_EQ(hit["material"], "Wood");
  EXPECT_NEAR(hit["point"][2].get<double>(), 2, 0.01);
  client.say({{"type", "camera"}, {"position", {2, 1, 4.5}}, {"target", {2, 2.2, 2.5}}});
  client.say({{"type", "pick"}, {"id", 2}, {"x", 0.5}, {"y", 0.5}});
  EXPECT_EQ(client.hear("picked", 2)["hit"]["lamp"], named(welcome["lamps"], "Pendant")["id"]);
}

TEST(Session, aLostConnectionIsTakenUpAgain) {
  const ServedHome home;
  std::string window;
  {
    Client client(home.port(), home.live());
    window = client.hear("welcome")["window"];
    client.say(kViewport);
    client.say({{"type", "camera"}, {"position", {1, 1, 4}}, {"target", {2, 0.4, 1.5}}});
    client.say({{"type", "display"}, {"exposure", 5}});
    client.see(isWhole);
    client.drop();
  }
  Client again(home.port(), home.live(window));
  const json welcome = again.hear("welcome");
  EXPECT_EQ(welcome["window"], window);
  EXPECT_EQ(welcome["camera"]["position"][0], 1);
  EXPECT_EQ(welcome["display"]["exposure"], 5);
  EXPECT_EQ(again.see(isWhole).ev100, 5);
  Client stranger(home.port(), home.live("nobody"));
  EXPECT_NE(stranger.hear("welcome")["window"], window);
}

TEST(Session, aWindowIsNotTakenFromWhoLooksThroughIt) {
  const ServedHome home;
  Client client(home.port(), home.live());
  const std::string window = client.hear("welcome")["window"];
  Client copy(home.port(), home.live(window));
  EXPECT_NE(copy.hear("welcome")["window"], window);
  client.say(kViewport);
  EXPECT_TRUE(isWhole(client.see(isWhole)));
}

// The line takes the first frame and no other until it is let, so that the second is still to be packed.
TEST(Session, framesCannotBeAcknowledgedBeforeTheyAreSent) {
  constexpr int kAcks = 50;
  std::mutex mutex;
  std::condition_variable wake;
  bool open = false;
  int frames = 0, refused = 0;
  view::Outbox outbox;
  outbox.text = [&](view::Connection, const std::string& text) {
    const std::lock_guard lock(mutex);
    if (json::parse(text)["type"] == "error") ++refused;
    wake.notify_all();
  };
  outbox.frame = [&](view::Connection, const std::string&) {
    std::unique_lock lock(mutex);
    ++frames;
    wake.notify_all();
    wake.wait(lock, [&] { return open; });
  };
  view::Session session(view::ViewHome("test", servedScene()), servedSettings(), outbox);
  const auto comes = [&](const auto& condition) {
    std::unique_lock lock(mutex);
    return wake.wait_for(lock, std::chrono::seconds(20), condition);
  };
  session.open(1, "");
  session.receive(1, kViewport.dump());
  EXPECT_TRUE(comes([&] { return frames == 1; }));
  for (int i = 0; i < kAcks; ++i) {
    session.receive(1, R"({"type": "ack", "frame": 2})");
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_TRUE(comes([&] { return refused == kAcks; }));
  {
    const std::lock_guard lock(mutex);
    open = true;
  }
  wake.notify_all();
}

}  // namespace
}  // namespace roomlight
