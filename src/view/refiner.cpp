#include "view/refiner.h"

#include <exception>

#include "base/parallel.h"
#include "filter/blend.h"
#include "reference/path_tracer.h"

namespace roomlight::view {
namespace {

constexpr double kLookAgain = 1.5;     // times the samples of the last
constexpr int kMostSamples = 1 << 14;
constexpr float kGoodEnough = 0.002f;  // relative error: less cannot be seen

}  // namespace

Status Refiner::begin(std::shared_ptr<const LightSolution> solution, const Camera& camera, const PathSettings& settings,
                      int threads, Image first, int firstLook) {
  stop();
  failed_ = false;
  auto work = [this, &lit = *solution->lit, camera, settings, threads, first = std::move(first),
               firstLook](const std::atomic<bool>& cancelled) {
    try {
      withThreads(threads, [&] { run(lit, camera, settings, first, firstLook, cancelled); });
    } catch (const std::exception&) {  // out of memory: the picture stays as it is
      failed_ = true;
    }
  };
  Status posted = executor_.post(Role::Refine, std::move(work), ready_, &job_);
  if (posted) solution_ = std::move(solution);
  return posted;
}

// False: given up.
bool Refiner::tracePasses(PathTracer& tracer, int until, const std::atomic<bool>& cancelled) {
  Progress progress;
  progress.cancelled = &cancelled;
  const std::lock_guard lock(looks_);
  while (tracer.samples() < until) {
    if (!tracer.pass(progress, true)) return false;
  }
  return !cancelled;
}

void Refiner::run(const LitScene& lit, const Camera& camera, const PathSettings& settings, const Image& first,
                  int firstLook, const std::atomic<bool>& cancelled) {
  std::optional<PathTracer> made;
  {
    const std::lock_guard lock(looks_);
    if (cancelled) return;
    made.emplace(lit.rays(), lit.lights(), camera, settings, true);
  }
  PathTracer& tracer = *made;
  for (int samples = firstLook; tracePasses(tracer, samples, cancelled);
       samples = std::min(kMostSamples, static_cast<int>(kLookAgain * samples))) {
    Blend best = blend(first, tracer.mean(), tracer.variance(), tracer.features());
    const auto error = static_cast<float>(best.relativeError);
    const bool last = samples >= kMostSamples || error < kGoodEnough;
    {
      const std::lock_guard lock(mutex_);
      picture_ = RefinedPicture{std::move(best.image), static_cast<uint32_t>(samples), error, last};
    }
    ready_();
    if (last) return;
  }
}

std::optional<RefinedPicture> Refiner::take() {
  const std::lock_guard lock(mutex_);
  std::optional<RefinedPicture> out = std::move(picture_);
  picture_.reset();
  return out;
}

void Refiner::letGo() {
  giveUp();
  const std::lock_guard lock(looks_);
  solution_ = nullptr;
}

bool Refiner::tryLetGo() {
  giveUp();
  const std::unique_lock lock(looks_, std::try_to_lock);
  if (lock) solution_ = nullptr;
  return lock.owns_lock();
}

void Refiner::stop() {
  giveUp();
  job_.join();
  solution_ = nullptr;
  picture_.reset();
}

}  // namespace roomlight::view
