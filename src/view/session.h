// One home looked at through several windows. Knows messages and frames, no network: who owns it hands in what browsers
// say and carries away what they are told. Its loop hands what happens to the Conversation, asks the schedule what to
// do and does it: frames itself, all else by jobs in the background, which tell it when they are done. They light homes
// anew (LightBuilder), bring their light to where the home is (LightFollower), refine a picture (Refiner), make final
// pictures (RenderJobs), pack and send frames; the threads of all, the loop's too, are an Executor's.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "view/conversation.h"
#include "view/executor.h"
#include "view/light_follower.h"
#include "view/lit_home.h"
#include "view/refiner.h"
#include "view/render_jobs.h"
#include "view/schedule.h"

namespace roomlight::view {

// Called from the session's threads, until its destructor has returned.
struct Outbox {
  std::function<void(Connection, std::string text)> text;
  std::function<void(Connection, std::string bytes)> frame;
  std::function<void(const std::string& line)> failed;  // the home could not be lit; for whoever started the session
};

class Session {
 public:
  // `settings`: technique, quality and threads count. Throws ResourceError where there is no thread for the loop or the
  // frames; those that are missing later are tried again.
  Session(ViewHome home, const RenderSettings& settings, Outbox outbox, const StartThread& start = systemThread);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // All from any thread. `window`: that of an earlier connection, or empty.
  void open(Connection connection, const std::string& window);
  void receive(Connection connection, const std::string& text);
  void close(Connection connection);
  // A finished picture, which is kept until it was sent.
  std::optional<FinishedFile> findFile(const std::string& id) { return jobs_.find(id); }
  void fileSent(const std::string& id) { jobs_.drop(id); }

 private:
  // What happens.
  struct Opened {
    Connection connection;
    std::string window;
  };
  struct Closed {
    Connection connection;
  };
  struct Said {
    Connection connection;
    Message message;
  };
  struct Packed {  // a frame goes out now; of no bytes: it could not be packed
    Connection connection;
    uint32_t number;
    size_t bytes;
  };
  struct BuildProgress {
    std::string stage;
    float fraction;
  };
  struct Built {};
  struct LightFollowed {};
  struct Refined {};  // or the refiner has ended
  using What = std::variant<Opened, Closed, Said, Packed, BuildProgress, Built, LightFollowed, Refined, JobNews>;
  struct Event {
    TimePoint at;
    What what;
  };

  // session.cpp: the loop
  void push(What what);
  static bool asksForPictures(const What& what);
  Event* outdatedBy(const What& what);
  void runWithThreads();
  void run();
  void handleEvents();
  void wait(TimePoint until);
  bool carryOutAll(const std::vector<Action>& actions);
  void tellFailure(const std::string& what);
  bool started(const char* what, const Status& begun);
  Conversation::Jobs finalPictures();
  void handle(const Event& event, const Opened& e) { conversation_.opened(e.connection, e.window, event.at); }
  void handle(const Event& event, const Closed& e) { conversation_.closed(e.connection, event.at); }
  void handle(const Event& event, const Said& e) { conversation_.said(e.connection, e.message, event.at); }
  void handle(const Event& event, const Packed& e) { conversation_.packed(e.connection, e.number, e.bytes, event.at); }
  void handle(const Event&, const JobNews& e) { conversation_.heard(e); }
  void handle(const Event&, const BuildProgress& e);
  void handle(const Event&, const Built&);
  void handle(const Event&, const LightFollowed&);
  void handle(const Event&, const Refined&);

  // session_facts.cpp: what stands where
  Situation situation() const;
  SideFacts factsOf(const Window& window, const Side& side) const;
  HomeFacts factsOf(const LitHome& home) const;
  bool isWanted(const HomeState& state, const LitHome& home) const;
  bool isUpToDate(const LitHome& home) const;

  // What was decided; each: whether that changed anything, so that there may be more to do at once.
  bool carryOut(const StopRefining&);
  bool carryOut(const GiveUpLighting&);
  bool carryOut(const LightHome& a);
  bool carryOut(const ForgetWindow& a);
  bool carryOut(const DropHome& a);
  bool carryOut(const FollowLight& a);
  bool carryOut(const AnswerPoints& a);
  bool carryOut(const MakeFrame& a);
  bool carryOut(const Refine& a);

  // session_light.cpp: lit homes
  LitHome* litFor(const LightKey& key);
  HomeState wantedOf(const LitHome& home) const;
  bool refinerLeaves(const LitHome& home);
  void dropLight(const LitHome& home);
  void followLive(LitHome& home);
  void tellProgress(const std::string& stage, float fraction);

  // session_frames.cpp
  FrameHistory* historyOf(Side& side, Window& window);
  void lookFrom(LitHome& home, const Camera& camera);
  bool makeFrame(Window& window, size_t index, FrameKind kind);
  bool showQuick(Window& window, Side& side, LitHome& home, const Camera& camera);
  bool refines(const Window& window, const Side& side) const;
  void sendFrame(Window& window, size_t index, LitHome& home);
  FrameInfo frameInfo(Window& window, size_t index, const LitHome& home) const;
  using MakeBytes = std::function<Result<std::string>()>;
  MakeBytes inDisplay(Window& window, size_t index, const RayScene& rays, FrameInfo info);

  // session_points.cpp: picking and metering
  bool answerPoints(Window& window, bool meter);

  const ViewHome home_;
  const RenderSettings settings_;  // of renders
  const RenderSettings frames_;  // of what is shown meanwhile
  const Outbox outbox_;
  Executor executor_;
  Conversation conversation_;
  std::list<std::unique_ptr<LitHome>> lit_;  // used last first
  LightBuilder builder_;
  std::vector<std::string> failedBuilds_;  // techniques that could not be lit: not tried again until something changes
  uint64_t failedAt_ = 0;  // wishes of the conversation at that time
  LightFollower follower_;
  LightKey followedKey_;  // of the home whose light follows
  uint64_t followings_ = 0;  // so far
  uint32_t followed_ = 0;  // revision to which it follows
  std::optional<RefiningFacts> refining_;
  TimePoint startAgainAt_{};  // after a thread could not be started
  bool toldNoThread_ = false;  // since the last that could

  std::mutex mutex_;  // of what follows
  TimePoint progressAt_;
  std::condition_variable wake_;
  std::vector<Event> events_;
  std::atomic<bool> stop_{false}, newer_{false};
  Refiner refiner_;
  RenderJobs jobs_;
};

}  // namespace roomlight::view
