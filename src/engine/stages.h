// Runs the stages of a technique one after the other and writes down what each cost.
#pragma once

#include <string>

#include "base/platform/machine.h"
#include "base/progress.h"
#include "engine/render.h"

namespace roomlight {

class Stages {
 public:
  Stages(const RenderProgress& progress, RenderStats& stats) : progress_(progress), stats_(stats) {}

  // work(Progress) -> value. The stage's last report, and only that, says 1; a stage whose Result is an error never
// does.
  template <class Work>
  auto run(const std::string& name, Work&& work) {
    const Stopwatch watch;
    const double cpuBefore = processCpuSeconds();
    report(name, 0);
    Progress inner;
    inner.cancelled = progress_.cancelled;
    if (progress_.report) inner.report = [this, &name](float fraction) { report(name, std::min(fraction, 0.999f)); };
    auto value = work(inner);
    stats_.stages.push_back({name, watch.seconds() * 1e3, (processCpuSeconds() - cpuBefore) * 1e3, peakMemoryMiB()});
    if constexpr (requires { value.error(); }) {
      if (!value) return value;
    }
    report(name, 1);
    return value;
  }
  // Of the error that is left, so far.
  void estimate(double relativeError, double srgbMse) const {
    if (progress_.estimate) progress_.estimate(relativeError, srgbMse);
  }
  void number(const std::string& name, double value) { stats_.numbers.emplace_back(name, value); }
  bool cancelled() const { return progress_.cancelled && progress_.cancelled->load(std::memory_order_relaxed); }

 private:
  void report(const std::string& name, float fraction) const {
    if (progress_.report) progress_.report(name, fraction);
  }
  const RenderProgress& progress_;
  RenderStats& stats_;
};

}  // namespace roomlight
