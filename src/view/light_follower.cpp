#include "view/light_follower.h"

#include <exception>
#include <utility>

#include "base/parallel.h"

namespace roomlight::view {

Status LightFollower::begin(const ViewHome& all, LitHome& home, HomeState wanted, int threads,
                            std::function<void()> ready) {
  finish();
  done_ = cancelled_ = false;
  auto work = [this, &all, &home, wanted = std::move(wanted), threads, ready = std::move(ready)] {
    try {
      inBackground(threads, [&] { follow(all, home, wanted); });
    } catch (const std::exception& e) {
      change_.reset(), light_ = nullptr, error_ = e.what();
    }
    done_ = true;
    ready();
  };
  Result<std::thread> started = tryToStart(start_, std::move(work));
  if (!started) return Error{started.error()};
  home_ = &home, thread_ = std::move(started).value();
  return Ok{};
}

void LightFollower::follow(const ViewHome& all, LitHome& home, const HomeState& wanted) {
  RenderStats stats;
  RenderProgress silent;
  silent.cancelled = &cancelled_;
  Stages stages(silent, stats);
  SceneChange change = bring(all, home.state, wanted, home.scene);
  home.state = wanted;
  home.lit->update(change, stages);
  if (cancelled_) return;
  change_ = std::move(change);
  light_ = home.lit->snapshot();
}

void LightFollower::cancel() {
  cancelled_ = true;
  finish();
}

FollowedLight LightFollower::finish() {
  if (!thread_.joinable()) return {};
  thread_.join();
  FollowedLight out{std::exchange(home_, nullptr), std::move(change_), std::exchange(light_, nullptr),
                    std::exchange(error_, {})};
  change_.reset();
  return out;
}

}  // namespace roomlight::view
