#include "view/lit_home.h"

#include "base/parallel.h"

namespace roomlight::view {
namespace {

Result<std::unique_ptr<LitHome>> build(const ViewHome& home, const LightBuilder::Work& work, const RenderProgress& progress) {
  auto out = std::make_unique<LitHome>();
  out->key = work.key, out->state = work.state;
  Result<Scene> scene = sceneIn(home, work.state);
  if (!scene) return Error{scene.error()};
  out->scene = std::move(scene).value();
  RenderStats stats;
  Stages stages(progress, stats);
  Result<std::unique_ptr<LitScene>> lit = lightScene(out->scene, work.settings, stages, work.camera ? &*work.camera : nullptr);
  if (!lit) return Error{lit.error()};
  if (!lit.value() || stages.cancelled()) return Error{"cancelled"};
  out->lit = std::move(lit.value());
  return out;
}

}  // namespace

void LightBuilder::begin(const ViewHome& home, Work work, RenderProgress progress, std::function<void()> ready) {
  cancel();
  work_ = std::move(work);
  cancelled_ = false, done_ = false;
  progress.cancelled = &cancelled_;
  thread_ = std::thread([this, &home, progress = std::move(progress), ready = std::move(ready)] {
    withThreads(work_.settings.threads, [&] {
      try {
        result_ = build(home, work_, progress);
      } catch (const std::bad_alloc&) {
        result_ = Result<std::unique_ptr<LitHome>>(Error{"not enough memory to light the home"});
      }
    });
    done_ = true;
    ready();
  });
}

std::optional<Result<std::unique_ptr<LitHome>>> LightBuilder::take() {
  if (!thread_.joinable() || !done_) return {};
  thread_.join();
  auto out = std::move(result_);
  result_.reset();
  return out;
}

void LightBuilder::cancel() {
  if (!thread_.joinable()) return;
  cancelled_ = true;
  thread_.join();
  result_.reset();
}

}  // namespace roomlight::view
