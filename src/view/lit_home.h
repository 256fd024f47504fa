// A home lit by one technique, and how it is lit afresh in the background while an older one is looked at.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/technique.h"
#include "gather/quick_frames.h"
#include "view/executor.h"
#include "view/home.h"
#include "view/light_key.h"

namespace roomlight::view {

// The home as it is now, and the light of a moment ago: what frames in a few milliseconds are made of.
class LiveHome {
 public:
  // Of a copy of the scene.
  LiveHome(Scene scene, HomeState state, Stages& stages)
      : scene_(std::move(scene)), state_(std::move(state)), base_(scene_, true, stages) {}
  // Brings the home to a state and says what that changed.
  SceneChange follow(const ViewHome& home, HomeState wanted);
  // Light of the state that `lit` is in.
  void take(std::shared_ptr<const SlotSnapshot> light, const Scene& lit);

  const Scene& scene() const { return scene_; }
  const HomeState& state() const { return state_; }
  QuickScene quick(bool white) const { return {base_.rays(), base_.lights(), *light_, moved_, white}; }
  const RayScene& rays() const { return base_.rays(); }

 private:
  void findMoved();

  Scene scene_;
  HomeState state_;
  SceneRays base_;
  std::shared_ptr<const SlotSnapshot> light_;
  std::vector<Affine> litPlaces_;  // of all instances, where that light was found
  std::unordered_map<uint32_t, Affine> moved_;
};

// A home in a state, and its light as a technique has found it. Who changes it owns it (LightFollower takes it away and
// gives it back); who only looks at it shares it.
struct LightSolution {
  Scene scene;
  HomeState state;
  std::unique_ptr<LitScene> lit;  // of `scene`
};

struct LitHome {
  LitHome(LightKey lightKey, std::optional<SunState> sun) : key(std::move(lightKey)), sunAtFirst(std::move(sun)) {}
  // Whether light can follow to where the sun is wanted; else the home is lit anew.
  bool canFollow(const std::optional<SunState>& sun) const { return followsSun || sun == sunAtFirst; }
  // The scene to look at; not where there is neither.
  const RayScene& rays() const { return live ? live->rays() : solution->lit->rays(); }
  const HomeState& shownState() const { return live ? live->state() : solution->state; }

  LightKey key;
  const std::optional<SunState> sunAtFirst;
  bool followsSun = false;
  std::shared_ptr<LightSolution> solution;  // null while it follows a change
  std::unique_ptr<LiveHome> live;  // of techniques that have light in slots
  uint32_t revision = 0;  // of the session: the newest that its light knows of
  uint64_t followedAt = 0;  // counts followings of all homes: the last that was its own
};

class LightBuilder {
 public:
  explicit LightBuilder(Executor& executor) : executor_(executor) {}
  ~LightBuilder() { cancel(); }

  struct Work {
    LightKey key;
    HomeState state;
    RenderSettings settings;
    std::optional<Camera> camera;
    uint32_t revision = 0;
  };
  // One at a time. `home` must stay; `progress` and `ready` are called from the builder's thread. Error: there is no
  // thread; it may be tried again.
  Status begin(const ViewHome& home, Work work, RenderProgress progress, std::function<void()> ready);
  bool busy() const { return static_cast<bool>(job_); }
  const Work& work() const { return work_; }
  // What has come of it, once ready() was called; the builder is free then. An error's message, or the home; a null one
  // where it was given up.
  std::optional<Result<std::unique_ptr<LitHome>>> take();
  void giveUp() { job_.giveUp(); }  // and nobody waits
  void cancel();

 private:
  Executor& executor_;
  Work work_;
  Job job_;
  std::optional<Result<std::unique_ptr<LitHome>>> result_;
};

}  // namespace roomlight::view
