#include "view/light_follower.h"

#include <exception>
#include <utility>

#include "base/parallel.h"

namespace roomlight::view {

Status LightFollower::begin(const ViewHome& all, std::shared_ptr<LightSolution>& solution, HomeState wanted,
                            int threads, std::function<void()> ready) {
  finish();
  followed_.solution = std::move(solution);
  auto work = [this, &all, wanted = std::move(wanted), threads](const std::atomic<bool>& cancelled) {
    try {
      inBackground(threads, [&] { follow(all, wanted, cancelled); });
    } catch (const std::exception& e) {
      followed_.change.reset(), followed_.light = nullptr, followed_.error = e.what();
    }
  };
  Status posted = executor_.post(Role::FollowLight, std::move(work), std::move(ready), &job_);
  if (!posted) solution = std::move(followed_.solution);
  return posted;
}

void LightFollower::follow(const ViewHome& all, const HomeState& wanted, const std::atomic<bool>& cancelled) {
  RenderStats stats;
  RenderProgress silent;
  silent.cancelled = &cancelled;
  Stages stages(silent, stats);
  LightSolution& solution = *followed_.solution;
  SceneChange change = bring(all, solution.state, wanted, solution.scene);
  solution.state = wanted;
  solution.lit->update(change, stages);
  if (cancelled) return;
  followed_.change = std::move(change);
  followed_.light = solution.lit->snapshot();
}

void LightFollower::cancel() {
  job_.giveUp();
  finish();
}

FollowedLight LightFollower::finish() {
  job_.join();
  return std::exchange(followed_, {});
}

}  // namespace roomlight::view
