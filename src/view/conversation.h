// What browsers say about a home and are told: windows and what they show, the home's state, its history and plans.
// Answers at once and makes no picture: what is to be made is decided from what stands here (schedule.h). Without
// threads, clock and network: who owns it hands in what happens, and when.
#pragma once

#include <functional>
#include <list>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/settings.h"
#include "view/arrangement.h"
#include "view/describe.h"
#include "view/history.h"
#include "view/render_jobs.h"
#include "view/window.h"

namespace roomlight::view {

class Conversation {
 public:
  // Final pictures, made elsewhere.
  struct Jobs {
    std::function<Status(RenderWork)> add;
    std::function<bool(const std::string& job)> cancel;
    std::function<bool(const std::string& fileId)> isKept;
    std::function<double()> bytesToSpare;  // of memory; infinite where nobody knows
  };
  using Tell = std::function<void(Connection, std::string text)>;

  // `home` must stay. `settings`: of final pictures, and the technique that a new window shows.
  Conversation(const ViewHome& home, const RenderSettings& settings, Tell tell, Jobs jobs);

  // What happens, in its order. `window`: that of an earlier connection, or empty.
  void opened(Connection connection, const std::string& window, TimePoint at);
  void closed(Connection connection, TimePoint at);
  void said(Connection connection, const Message& message, TimePoint at);
  void packed(Connection connection, uint32_t frame, size_t bytes, TimePoint at);  // no bytes: that failed
  void heard(const JobNews& news);
  void forget(const std::string& window);

  // To all windows that are connected.
  void tellAll(const std::string& text) const;
  void tell(const Window& window, std::string text) const;

  // Those that were served longest ago first.
  std::list<Window>& windows() { return windows_; }
  const std::list<Window>& windows() const { return windows_; }
  Window* windowNamed(const std::string& name);  // null: none, and for an empty name
  void serveLast(const Window& window);

  // Of a plan, as far as lamps and sun go; of none, or one that was dropped: as it is edited.
  const HomeState& stateOf(const std::string& plan) const;
  uint32_t revision() const { return revision_; }  // counts states and lists of plans
  uint64_t wishes() const { return wishes_; }  // counts changes after which what failed before is worth another try

 private:
  // conversation.cpp: windows and what they show
  Window* windowOf(Connection connection);
  void chooseSides(Window& window) const;
  size_t lightsNeeded() const;
  void on(Window& window, TimePoint at, const Viewport& m);
  void on(Window& window, TimePoint at, const ViewCamera& m);
  void on(Window& window, TimePoint at, const DisplayChange& m);
  void on(Window& window, TimePoint at, const ChooseTechnique& m);
  void on(Window& window, TimePoint at, const ChooseSplit& m);
  std::optional<ViewError> unknownIn(const ChooseSplit& m) const;
  struct Request {
    uint32_t id;
    const char* field;
  };
  template <class Choice>
  void choose(Window& window, TimePoint at, const Request& request, Choice& choice, const Choice& wanted);
  void on(Window& window, TimePoint at, const Point& m);
  void on(Window& window, TimePoint at, const Ack& m);
  void on(Window& window, TimePoint at, const Ping& m);
  void on(Window& window, TimePoint at, const ViewError& m);

  // conversation_edits.cpp: the home
  std::optional<ViewError> tooFar(const Edit& edit, const HomeState& next) const;
  std::optional<ViewError> noLightAt(const Edit& edit, const HomeState& next) const;
  void on(Window& window, TimePoint at, const Edit& m);
  void on(Window& window, TimePoint at, const StepHistory& m);
  void on(Window& window, TimePoint at, const EditPlan& m);
  std::optional<ViewError> refusalOf(const EditPlan& m) const;
  void dropPlan(const std::string& name, TimePoint at);
  void setState(HomeState next, const Window& by, TimePoint at);
  Json stateJson(const std::vector<size_t>& lamps, const std::vector<size_t>& objects, bool sun) const;
  Json wholeState() const;
  void on(Window& window, TimePoint at, const SaveLighting& m);

  // conversation_jobs.cpp: final pictures
  void on(Window& window, TimePoint at, const RenderWish& m);
  void on(Window& window, TimePoint at, const CancelJob& m);
  void tellJobsAgain(Window& window);
  void forgetJobs(Window& window, bool told);

  const ViewHome& home_;
  const Bounds3 reach_;  // how far things may be moved
  const RenderSettings settings_;
  const Tell tell_;
  const Jobs jobs_;
  const Json homeJson_;
  HomeState state_;
  Arrangement arrangement_;
  uint32_t revision_ = 1;
  uint64_t wishes_ = 0;
  History history_;
  std::map<std::string, HomeState> plans_;
  mutable std::map<std::string, HomeState>
      shown_;  // stateOf() of plans, as far as it was asked for since the last edit
  std::list<Window> windows_;
  int nextJob_ = 1;
};

}  // namespace roomlight::view
