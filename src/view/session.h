// One home looked at through several windows. Knows messages and frames, no network: who owns it hands in what browsers
// say and carries away what they are told. Of its threads the loop (session.cpp) makes quick frames and owns windows
// and state; others work in the background and wake it: one lights homes anew (LightBuilder), one brings their light to
// where the home is (LightFollower), one refines a picture (Refiner), one makes final pictures (RenderJobs), one packs
// frames (FrameSender).
#pragma once

#include <condition_variable>
#include <functional>
#include <list>
#include <map>
#include <mutex>
#include <set>
#include <thread>

#include "view/apply_edit.h"
#include "view/describe.h"
#include "view/frame_sender.h"
#include "view/history.h"
#include "view/light_follower.h"
#include "view/refiner.h"
#include "view/render_jobs.h"
#include "view/start_thread.h"
#include "view/window.h"

namespace roomlight::view {

// Called from the session's threads, until its destructor has returned.
struct Outbox {
  std::function<void(Connection, std::string text)> text;
  std::function<void(Connection, std::string bytes)> frame;
  std::function<void(const std::string& line)> failed;  // the home could not be lit; for whoever started the session
};

class Session {
 public:
  // `settings`: technique, quality and threads count. Throws std::system_error where there is no thread for the loop
  // or the frames; those that are missing later are tried again.
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
  struct Opened {
    std::string window;
  };
  struct Closed {};
  struct Packed {  // a frame that goes out now; of no bytes: it could not be packed
    uint32_t number;
    size_t bytes;
  };
  using What = std::variant<Opened, Closed, Packed, Message>;
  struct Event {
    Connection connection;
    TimePoint at;
    What what;
  };

  // session.cpp: the loop
  void push(Connection connection, What what);
  static bool isOfFrames(const What& what);
  Event* outdatedBy(const Event& event);
  void runWithThreads();
  void run();
  bool workOn();
  bool handleEvents();
  bool work();
  void tellFailure(const std::string& what);
  bool mayStart() const;
  bool started(const char* what, const Status& begun);
  void takeNews(const JobNews& news);
  void tellProgress(const std::string& stage, float fraction);

  // session_light.cpp: lit homes
  HomeState stateOf(const LightKey& key) const;
  LitHome* litFor(const LightKey& key);
  bool needs(const LightKey& key) const;
  bool isShown(const LightKey& key) const;
  size_t lightsNeeded() const;
  void beginBuilding();
  void adoptBuilt();
  bool refinerLeaves(const LitHome& home);
  void dropLights();
  void dropLight(const LitHome& home);
  HomeState wantedOf(const LitHome& home) const;
  bool isUpToDate(const LitHome& home) const;
  bool canBeShown(const LitHome& home) const;
  bool isOwedAFrame(const LitHome& home) const;
  void followFront(LitHome& home);
  void followLight();
  bool takeLight();

  // session_messages.cpp: what each message does
  void handle(const Event& event);
  void openWindow(const Event& event, const std::string& wanted);
  void closeWindow(Window& window, TimePoint at);
  std::optional<ViewError> tooFar(const Edit& edit, const HomeState& next) const;
  std::optional<ViewError> noLightAt(const Edit& edit, const HomeState& next) const;
  void on(Window& window, const Event& event, const Viewport& m);
  void on(Window& window, const Event& event, const ViewCamera& m);
  void on(Window& window, const Event& event, const DisplayChange& m);
  void on(Window& window, const Event& event, const ChooseTechnique& m);
  void on(Window& window, const Event& event, const ChooseSplit& m);
  void on(Window& window, const Event& event, const Edit& m);
  void on(Window& window, const Event& event, const StepHistory& m);
  void on(Window& window, const Event& event, const EditPlan& m);
  void on(Window& window, const Event& event, const Point& m);
  void on(Window& window, const Event& event, const Ack& m);
  void on(Window& window, const Event& event, const RenderWish& m);
  void on(Window& window, const Event& event, const CancelJob& m);
  void on(Window& window, const Event& event, const SaveLighting& m);
  void on(Window& window, const Event& event, const Ping& m);
  void on(Window& window, const Event& event, const ViewError& m);
  void setState(HomeState next, const Window& by);
  Json stateJson(const std::vector<size_t>& lamps, const std::vector<size_t>& objects, bool sun) const;
  void forgetLostWindows();

  // session_jobs.cpp
  void tellJobs(const std::vector<JobNews>& news);
  void tellJobsAgain(Window& window);
  void forgetJobs(Window& window, bool told);

  // session_frames.cpp
  Window* windowOf(Connection connection);
  Window* windowNamed(const std::string& name);
  void chooseSides(Window& window);
  void newInput(Window& window, TimePoint at);
  void lookFrom(LitHome& home, const Camera& camera);
  FrameHistory* historyOf(Side& side, Window& window);
  bool showQuick(Window& window, Side& side, LitHome& home, const Camera& camera);
  enum class Next {
    Nothing,
    Wait,  // for rest, or for light
    Again,  // the same picture is shown otherwise
    Quick,
    Better
  };
  Next nextOf(const Window& window, const Side& side, const LitHome& home) const;
  bool somebodyMoves() const;
  bool makeFrame(Window& window);
  bool stepSide(Window& window, size_t index);
  void sendFrame(Window& window, size_t index, LitHome& home);
  void packed(Window& window, const Packed& p, TimePoint at);
  void tell(const Window& window, std::string text) const;
  void tellAll(const std::string& text) const;

  // session_points.cpp: picking and metering
  bool canBeMetered(const Window& window, const LitHome& home) const;
  bool meterIsDue(const LitHome& home) const;
  bool answerPoints(Window& window);

  // session_refine.cpp
  bool refines(const Window& window, const Side& side) const;
  std::pair<Window*, size_t> nextToRefine();
  bool isTurnOver(const Side& next);
  void beginRefining();
  bool takeRefined();
  void tellRefined();

  const ViewHome home_;
  const Bounds3 reach_;  // how far things may be moved
  const RenderSettings settings_;  // of renders
  const RenderSettings frames_;  // of what is shown meanwhile
  const Outbox outbox_;
  HomeState state_;
  uint32_t revision_ = 1;
  History history_;
  std::map<std::string, HomeState> plans_;
  std::list<Window> windows_;
  std::list<std::unique_ptr<LitHome>> lit_;
  LightBuilder builder_;
  std::set<std::string> failedBuilds_;  // techniques that could not be lit: not tried again until something changes
  Json homeJson_;
  LightFollower follower_;
  uint64_t followings_ = 0;  // so far
  uint32_t followed_ = 0;  // revision to which it follows
  bool soon_ = false;  // a window rests in a moment
  struct Refining {  // whose picture it is; of an older serial it is of no more use
    std::string window;
    size_t side = 0;
    uint32_t serial = 0;
    uint32_t turn = 0, samples = 0;  // how many it has before another picture's turn may come, and so far
  };
  std::optional<Refining> refining_;
  int nextJob_ = 1;
  TimePoint startAgainAt_{};  // after a thread could not be started
  bool toldNoThread_ = false;  // since the last that could

  std::mutex mutex_;  // of what follows
  std::optional<std::pair<std::string, float>> progress_;  // not told yet
  TimePoint progressAt_;
  std::condition_variable wake_;
  std::vector<Event> events_;
  std::vector<JobNews> jobNews_;  // not told yet
  bool built_ = false, refinedReady_ = false, lightReady_ = false;
  std::atomic<bool> stop_{false}, newer_{false};
  Refiner refiner_;
  RenderJobs jobs_;
  FrameSender sender_;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace roomlight::view
