// A session on a machine that has no threads left for a while.
#include <gtest/gtest.h>

#include <condition_variable>
#include <cstring>
#include <deque>
#include <mutex>
#include <system_error>

#include "base/result.h"
#include "seen.h"
#include "support/threads.h"
#include "view/frame.h"
#include "view/session.h"

namespace roomlight {
namespace {

using namespace roomlight::testing;
using nlohmann::json;

constexpr char kNoThread[] = "no thread can be started";

view::ViewHome home() { return view::ViewHome("test", servedScene()); }

struct Frame {
  uint32_t revision = 0, camera = 0, samples = 0;
  int flags = 0;
};

// One window, without a network.
class OneWindow {
 public:
  explicit OneWindow(const view::StartThread& start) : session_(home(), servedSettings(), outbox(), start) {}

  void open() { session_.open(1, ""); }
  void say(const json& message) { session_.receive(1, message.dump()); }
  // The next message of the type; earlier ones are taken.
  json hear(const std::string& type) {
    return next<json>(texts_, [&](const json& t) { return t["type"] == type; });
  }
  Frame see(const std::function<bool(const Frame&)>& wanted) { return next<Frame>(frames_, wanted); }
  int failures() {
    const std::lock_guard lock(mutex_);
    return failures_;
  }

 private:
  view::Outbox outbox() {
    view::Outbox out;
    out.text = [this](view::Connection, const std::string& text) { add(texts_, json::parse(text)); };
    out.frame = [this](view::Connection, const std::string& bytes) {
      const auto at = [&](size_t from) {
        uint32_t value = 0;
        std::memcpy(&value, bytes.data() + from, sizeof value);
        return value;
      };
      say({{"type", "ack"}, {"frame", at(4)}});
      add(frames_, Frame{at(20), at(16), at(24), static_cast<unsigned char>(bytes[13])});
    };
    out.failed = [this](const std::string&) {
      const std::lock_guard lock(mutex_);
      ++failures_;
    };
    return out;
  }
  template <class T>
  void add(std::deque<T>& all, T one) {
    const std::lock_guard lock(mutex_);
    all.push_back(std::move(one));
    came_.notify_all();
  }
  template <class T>
  T next(std::deque<T>& all, const std::function<bool(const T&)>& wanted) {
    std::unique_lock lock(mutex_);
    while (true) {
      if (!came_.wait_for(lock, std::chrono::seconds(30), [&] { return !all.empty(); }))
        throw std::runtime_error("nothing came in time");
      const T one = std::move(all.front());
      all.pop_front();
      if (wanted(one)) return one;
    }
  }

  std::mutex mutex_;
  std::condition_variable came_;
  std::deque<json> texts_;
  std::deque<Frame> frames_;
  int failures_ = 0;
  view::Session session_;
};

TEST(SessionThreads, withoutAnyItDoesNotBegin) {
  test::Threads threads;
  threads.none = true;
  EXPECT_THROW(OneWindow(threads.starter()), std::system_error);
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
  EXPECT_THROW(OneWindow window(onlyOne), std::system_error);
  EXPECT_EQ(started, 2);
}

TEST(SessionThreads, aHomeIsLitLater) {
  test::Threads threads;
  OneWindow window(threads.starter());
  threads.none = true;
  window.open();
  window.say(kViewport);
  const json error = window.hear("error");
  EXPECT_EQ(error["code"], "failed");
  EXPECT_NE(error["message"].get<std::string>().find(kNoThread), std::string::npos);
  threads.none = false;
  window.see([](const Frame&) { return true; });
  EXPECT_EQ(window.failures(), 1);  // once, however often it was tried
}

TEST(SessionThreads, lightFollowsLaterAndFramesAreShownMeanwhile) {
  test::Threads threads;
  OneWindow window(threads.starter());
  window.open();
  const json welcome = window.hear("welcome");
  const json lamp = named(welcome["lamps"], "Pendant")["id"];
  const uint32_t revision = welcome["revision"].get<uint32_t>() + 1;  // after the edit
  window.say(kViewport);
  window.see([](const Frame& f) { return !(f.flags & view::kLightIsBehind); });
  threads.none = true;
  window.say({{"type", "edit"}, {"id", 1}, {"target", lamp}, {"dim", 0.25}});
  window.see([&](const Frame& f) { return f.revision == revision && (f.flags & view::kLightIsBehind); });
  EXPECT_NE(window.hear("error")["message"].get<std::string>().find(kNoThread), std::string::npos);
  threads.none = false;
  window.see([&](const Frame& f) { return f.revision == revision && !(f.flags & view::kLightIsBehind); });
}

TEST(SessionThreads, aPictureIsRefinedLater) {
  test::Threads threads;
  OneWindow window(threads.starter());
  window.open();
  window.say(kViewport);
  window.see([](const Frame& f) { return f.samples > 0; });  // all the light is there
  threads.none = true;
  window.say({{"type", "camera"}, {"number", 9}, {"position", {2, 1.5, 4}}, {"target", {2, 1, 0}}});
  const std::string message = window.hear("error")["message"];
  EXPECT_NE(message.find("refined"), std::string::npos) << message;
  EXPECT_NE(message.find(kNoThread), std::string::npos) << message;
  threads.none = false;
  window.see([](const Frame& f) { return f.camera == 9 && (f.flags & view::kRefined); });
}

TEST(SessionThreads, aFinalPictureIsRefusedAndMayBeAskedForAgain) {
  test::Threads threads;
  OneWindow window(threads.starter());
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
