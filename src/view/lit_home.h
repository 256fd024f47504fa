// A home lit by one technique, and how it is lit afresh in the background while an older one is looked at.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "engine/lit_scene.h"
#include "view/home.h"

namespace roomlight::view {

// Which light: by what technique, of which plan.
struct LightKey {
  std::string technique, plan;  // plan empty: the one that is edited
  bool operator==(const LightKey&) const = default;
};

struct LitHome {
  LightKey key;
  Scene scene;
  HomeState state;  // that the scene and its light are in
  std::unique_ptr<LitScene> lit;
};

class LightBuilder {
 public:
  ~LightBuilder() { cancel(); }

  struct Work {
    LightKey key;
    HomeState state;
    RenderSettings settings;
    std::optional<Camera> camera;
  };
  // One at a time. `home` must stay; `progress` and `ready` are called from the builder's thread.
  void begin(const ViewHome& home, Work work, RenderProgress progress, std::function<void()> ready);
  bool busy() const { return thread_.joinable(); }
  const Work& work() const { return work_; }
  // What has come of it, once ready() was called; the builder is free then. An error's message, or the home.
  std::optional<Result<std::unique_ptr<LitHome>>> take();
  void cancel();

 private:
  Work work_;
  std::thread thread_;
  std::atomic<bool> cancelled_{false}, done_{false};
  std::optional<Result<std::unique_ptr<LitHome>>> result_;
};

}  // namespace roomlight::view
