#include "view/light_follower.h"

#include <utility>

#include "base/parallel.h"

namespace roomlight::view {

void LightFollower::begin(const EditableHome& editable, LitHome& home, HomeState wanted, int threads, std::function<void()> ready) {
  finish();
  home_ = &home, done_ = false;
  wanted.sun = home.state.sun;
  thread_ = std::thread([this, &editable, &home, wanted = std::move(wanted), threads, ready = std::move(ready)] {
    withThreads(threads, [&] {
      RenderStats stats;
      RenderProgress silent;
      Stages stages(silent, stats);
      const SceneChange change = stage(editable, home.state, wanted, home.scene);
      home.state = wanted;
      home.lit->update(change, stages);
      light_ = home.lit->snapshot();
    });
    done_ = true;
    ready();
  });
}

std::pair<LitHome*, std::shared_ptr<const SlotSnapshot>> LightFollower::finish() {
  if (!thread_.joinable()) return {};
  thread_.join();
  return {std::exchange(home_, nullptr), std::move(light_)};
}

}  // namespace roomlight::view
