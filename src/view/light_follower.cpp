#include "view/light_follower.h"

#include <exception>
#include <utility>

#include "base/parallel.h"

namespace roomlight::view {

Status LightFollower::begin(const ViewHome& all, std::shared_ptr<LightSolution>& solution, HomeState wanted,
                            int threads, std::function<void()> ready) {
  finish();
  done_ = cancelled_ = false;
  solution_ = std::move(solution);
  auto work = [this, &all, wanted = std::move(wanted), threads, ready = std::move(ready)] {
    try {
      inBackground(threads, [&] { follow(all, wanted); });
    } catch (const std::exception& e) {
      change_.reset(), light_ = nullptr, error_ = e.what();
    }
    done_ = true;
    ready();
  };
  Result<std::thread> started = tryToStart(start_, std::move(work));
  if (!started) {
    solution = std::move(solution_);
    return Error{started.error()};
  }
  thread_ = std::move(started).value();
  return Ok{};
}

void LightFollower::follow(const ViewHome& all, const HomeState& wanted) {
  RenderStats stats;
  RenderProgress silent;
  silent.cancelled = &cancelled_;
  Stages stages(silent, stats);
  SceneChange change = bring(all, solution_->state, wanted, solution_->scene);
  solution_->state = wanted;
  solution_->lit->update(change, stages);
  if (cancelled_) return;
  change_ = std::move(change);
  light_ = solution_->lit->snapshot();
}

void LightFollower::cancel() {
  cancelled_ = true;
  finish();
}

FollowedLight LightFollower::finish() {
  if (!thread_.joinable()) return {};
  thread_.join();
  FollowedLight out{std::move(solution_), std::move(change_), std::exchange(light_, nullptr),
                    std::exchange(error_, {})};
  change_.reset();
  return out;
}

}  // namespace roomlight::view
