// A session on a machine that has no threads left for a while.
#include <gtest/gtest.h>

#include <system_error>

#include "base/result.h"
#include "seen.h"
#include "support/one_window.h"
#include "support/threads.h"
#include "view/frame.h"

namespace roomlight {
namespace {

using namespace roomlight::testing;
using nlohmann::json;

constexpr char kNoThread[] = "no thread can be started";

view::ViewHome home() { return view::ViewHome("test", servedScene()); }

TEST(SessionThreads, withoutAnyItDoesNotBegin) {
  test::Threads threads;
  threads.none = true;
  EXPECT_THROW(OneWindow(home(), threads.starter()), ResourceError);
  std::atomic<bool> stop{false};
  server::Served tell;
  tell.start = threads.starter();
  tell.listening = [](const server::Links&) {
    ADD_FAILURE() << "nobody is served";
    return Status(Error{""});
  };
  EXPECT_THROW(static_cast<void>(server::serveHome(home(), servedSettings(), {}, {}, tell, stop)), ResourceError);
}

TEST(SessionThreads, withTooFewItDoesNotBeginEither) {
  int started = 0;
  const view::StartThread onlyOne = [&](std::function<void()> work) {
    if (started++ > 0) throw std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again));
    return std::thread(std::move(work));
  };
  EXPECT_THROW(OneWindow window(home(), onlyOne), ResourceError);
  EXPECT_EQ(started, 2);
}

TEST(SessionThreads, aHomeIsLitLater) {
  test::Threads threads;
  OneWindow window(home(), threads.starter());
  threads.none = true;
  window.open();
  window.say(kViewport);
  const json error = window.hear("error");
  EXPECT_EQ(error["code"], "failed");
  EXPECT_NE(error["message"].get<std::string>().find(kNoThread), std::string::npos);
  threads.none = false;
  window.see([](const WindowFrame&) { return true; });
  EXPECT_EQ(window.failures(), 1);  // once, however often it was tried
}

TEST(SessionThreads, lightFollowsLaterAndFramesAreShownMeanwhile) {
  test::Threads threads;
  OneWindow window(home(), threads.starter());
  window.open();
  const json welcome = window.hear("welcome");
  const json lamp = named(welcome["lamps"], "Pendant")["id"];
  const uint32_t revision = welcome["revision"].get<uint32_t>() + 1;  // after the edit
  window.say(kViewport);
  window.see([](const WindowFrame& f) { return !(f.flags & view::kLightIsBehind); });
  threads.none = true;
  window.say({{"type", "edit"}, {"id", 1}, {"target", lamp}, {"dim", 0.25}});
  window.see([&](const WindowFrame& f) { return f.revision == revision && (f.flags & view::kLightIsBehind); });
  EXPECT_NE(window.hear("error")["message"].get<std::string>().find(kNoThread), std::string::npos);
  threads.none = false;
  window.see([&](const WindowFrame& f) { return f.revision == revision && !(f.flags & view::kLightIsBehind); });
}

TEST(SessionThreads, aPictureIsRefinedLater) {
  test::Threads threads;
  OneWindow window(home(), threads.starter());
  window.open();
  window.say(kViewport);
  window.see([](const WindowFrame& f) { return f.samples > 0; });  // all the light is there
  threads.none = true;
  window.say({{"type", "camera"}, {"number", 9}, {"position", {2, 1.5, 4}}, {"target", {2, 1, 0}}});
  const std::string message = window.hear("error")["message"];
  EXPECT_NE(message.find("refined"), std::string::npos) << message;
  EXPECT_NE(message.find(kNoThread), std::string::npos) << message;
  threads.none = false;
  window.see([](const WindowFrame& f) { return f.camera == 9 && (f.flags & view::kRefined); });
}

TEST(SessionThreads, aFinalPictureIsRefusedAndMayBeAskedForAgain) {
  test::Threads threads;
  OneWindow window(home(), threads.starter());
  window.open();
  window.hear("welcome");
  const json wish = {{"type", "render"}, {"id", 1},      {"kind", "picture"}, {"width", 48},
                     {"height", 27},     {"seconds", 1}, {"quality", "draft"}};
  threads.none = true;
  window.say(wish);
  json error = window.hear("error");
  while (error["id"].is_null()) error = window.hear("error");  // of the home, which cannot be lit either
  EXPECT_EQ(error["code"], "notPossible");
  EXPECT_NE(error["message"].get<std::string>().find(kNoThread), std::string::npos);
  threads.none = false;
  window.say(wish);
  json news;
  do {
    news = window.hear("job");
  } while (news["state"] == "running");
  EXPECT_EQ(news["state"], "done");
}

}  // namespace
}  // namespace roomlight
