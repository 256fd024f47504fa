#include "view/lit_home.h"

#include <fmt/format.h>

#include "base/parallel.h"

namespace roomlight::view {
namespace {

Result<std::unique_ptr<LitHome>> build(const ViewHome& home, const LightBuilder::Work& work,
                                       const RenderProgress& progress) {
  auto out = std::make_unique<LitHome>(work.key, work.state.sun);
  auto solution = std::make_shared<LightSolution>();
  Result<Scene> scene = sceneIn(home, work.state);
  if (!scene) return Error{scene.error()};
  solution->scene = std::move(scene).value(), solution->state = work.state;
  RenderStats stats;
  Stages stages(progress, stats);
  Result<std::unique_ptr<LitScene>> lit =
      lightScene(solution->scene, work.settings, stages,
                 {true, work.camera ? std::span(&*work.camera, 1) : std::span<const Camera>()});
  if (!lit) return Error{lit.error()};
  if (!lit.value() || stages.cancelled()) return std::unique_ptr<LitHome>();
  solution->lit = std::move(lit.value());
  out->followsSun = solution->lit->technique().followsDaylight;
  if (std::shared_ptr<const SlotSnapshot> light = solution->lit->snapshot()) {
    out->live = std::make_unique<LiveHome>(solution->scene, solution->state, stages);
    out->live->take(std::move(light), solution->scene);
  }
  out->solution = std::move(solution);
  return out;
}

}  // namespace

SceneChange LiveHome::follow(const ViewHome& home, HomeState wanted) {
  const SceneChange change = bring(home, state_, wanted, scene_);
  state_ = std::move(wanted);
  RenderStats stats;
  RenderProgress silent;
  Stages stages(silent, stats);
  base_.follow(change, stages);
  findMoved();
  return change;
}

void LiveHome::take(std::shared_ptr<const SlotSnapshot> light, const Scene& lit) {
  light_ = std::move(light);
  litPlaces_.clear();
  for (const Instance& i : lit.instances) litPlaces_.push_back(i.worldFromObject);
  findMoved();
}

void LiveHome::findMoved() {
  moved_.clear();
  for (uint32_t i = 0; i < litPlaces_.size(); ++i) {
    const Affine &now = scene_.instances[i].worldFromObject, &then = litPlaces_[i];
    if (now != then) moved_.emplace(i, then * inverse(now));
  }
}

Status LightBuilder::begin(const ViewHome& home, Work work, RenderProgress progress, std::function<void()> ready) {
  cancel();
  work_ = std::move(work);
  auto light = [this, &home, progress = std::move(progress)](const std::atomic<bool>& cancelled) mutable {
    progress.cancelled = &cancelled;
    try {
      inBackground(work_.settings.threads, [&] { result_ = build(home, work_, progress); });
    } catch (const std::bad_alloc&) {
      result_ = Result<std::unique_ptr<LitHome>>(Error{"not enough memory to light the home"});
    } catch (const std::exception& e) {
      result_ = Result<std::unique_ptr<LitHome>>(Error{fmt::format("the home could not be lit: {}", e.what())});
    }
  };
  return executor_.post(Role::BuildLight, std::move(light), std::move(ready), &job_);
}

std::optional<Result<std::unique_ptr<LitHome>>> LightBuilder::take() {
  if (!job_.done()) return {};
  job_.join();
  return std::exchange(result_, std::nullopt);
}

void LightBuilder::cancel() {
  job_.giveUp();
  job_.join();
  result_.reset();
}

}  // namespace roomlight::view
