// The session's loop beside all of its threads: what scripts/test_threads runs under the thread sanitizer.
#include <gtest/gtest.h>

#include "support/one_window.h"
#include "view/frame.h"

namespace roomlight::view {
namespace {

using nlohmann::json;
using testing::OneWindow;
using testing::WindowFrame;

class SessionLoop : public ::testing::Test {
 protected:
  SessionLoop() {
    window_.open();
    welcome_ = window_.hear("welcome");
    window_.say({{"type", "viewport"}, {"width", 48}, {"height", 27}});
    window_.see([](const WindowFrame&) { return true; });
  }
  uint32_t ask(json message) {
    message["id"] = ++id_;
    window_.say(message);
    return id_;
  }
  void edit(const json& target, const std::string& key, const json& value) {
    ask({{"type", "edit"}, {"target", target}, {key, value}});
  }
  void look(double x) {
    window_.say({{"type", "camera"}, {"number", ++camera_}, {"position", {x, 1.5, 4}}, {"target", {2, 1, 0}}});
  }
  json answer(const std::string& type, uint32_t id) {
    json heard;
    do {
      heard = window_.hear(type);
    } while (heard["id"] != id);
    return heard;
  }
  // Everything has come to rest, as it was asked for last.
  void expectRest() {
    window_.see([&](const WindowFrame& f) {
      return f.camera == camera_ && (f.flags & kRefined) && !(f.flags & kLightIsBehind);
    });
  }

  OneWindow window_{testing::underTheSun("test", testing::servedScene())};
  json welcome_;
  uint32_t id_ = 0, camera_ = 0;
};

TEST_F(SessionLoop, editsAreFollowedWhileTheViewMoves) {
  const json lamp = welcome_["lamps"][0]["id"], thing = welcome_["objects"][0]["id"];
  for (const int round : {0, 1, 2}) {
    edit(lamp, "dim", 0.25 * (1 + round));
    look(1.5 + 0.2 * round);
    edit(thing, "move", {0.1 * round, 0, 0});
    edit("sun", "hour", 10 + round);
    look(1.6 + 0.2 * round);
    const uint32_t meter = ask({{"type", "meter"}, {"x", 0.5}, {"y", 0.9}});
    EXPECT_FALSE(answer("metered", meter)["hit"].is_null());
  }
  ask({{"type", "undo"}});
  look(2);
  expectRest();
}

TEST_F(SessionLoop, picturesAreMadeBesideTechniquesSideBySide) {
  ask({{"type", "render"}, {"kind", "picture"}, {"width", 32}, {"height", 18}, {"quality", "draft"}, {"seconds", 1}});
  ask({{"type", "split"}, {"split", {{"left", {{"technique", "cone"}}}, {"right", json::object()}}}});
  edit(welcome_["lamps"][0]["id"], "on", false);
  look(1.8);
  json news;
  do {
    news = window_.hear("job");
  } while (news["state"] == "waiting" || news["state"] == "running");
  EXPECT_EQ(news["state"], "done");
  ask({{"type", "split"}, {"split", nullptr}});
  look(2);
  expectRest();
}

TEST_F(SessionLoop, itEndsAmidWork) {
  ask({{"type", "render"}, {"kind", "picture"}, {"width", 64}, {"height", 36}, {"quality", "good"}});
  edit(welcome_["objects"][0]["id"], "turn", 20);
  edit("sun", "hour", 15);
  look(1.8);
}

}  // namespace
}  // namespace roomlight::view
