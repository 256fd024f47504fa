// Puts a picture right by path tracing, in the background, so that the session can answer meanwhile.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "engine/settings.h"
#include "view/executor.h"
#include "view/lit_home.h"

namespace roomlight {

class PathTracer;

namespace view {

struct RefinedPicture {
  Image image;  // cd/m²
  uint32_t samples = 0;
  float relativeError = 0;  // estimate: root mean square
  bool last = false;        // as good as it gets
};

class Refiner {
 public:
  static constexpr int kFewestSamples = 4;  // before the first blend of a picture that was not refined yet

  // `ready` is called from its thread when there is another picture to take, and when it has ended.
  Refiner(std::function<void()> ready, Executor& executor) : ready_(std::move(ready)), executor_(executor) {}
  ~Refiner() { stop(); }

  // Begins anew with a picture that has little noise; the solution must stay as it is until it was let go. Tells of the
  // first picture after so many samples. Waits for what is still working. Error: there is no thread; it may be tried
  // again.
  Status begin(std::shared_ptr<const LightSolution> solution, const Camera& camera, const PathSettings& settings,
               int threads, Image first, int firstLook);
  const LightSolution* solution() const { return solution_.get(); }  // null: none
  bool working() const { return job_.busy(); }
  bool failed() const { return failed_; }  // no further picture comes of what was begun last
  std::optional<RefinedPicture> take();
  // Asks it to end, and does not wait.
  void giveUp() { job_.giveUp(); }
  // Ends its use of the solution, which may change from then on. Waits for a pass to be given up.
  void letGo();
  // The same without waiting. False: not yet; it was asked to end.
  bool tryLetGo();
  // Waits for all of it: a blend takes about a second for a large picture.
  void stop();

 private:
  void run(const LitScene& lit, const Camera& camera, const PathSettings& settings, const Image& first, int firstLook,
           const std::atomic<bool>& cancelled);
  bool tracePasses(PathTracer& tracer, int until, const std::atomic<bool>& cancelled);

  const std::function<void()> ready_;
  Executor& executor_;
  std::shared_ptr<const LightSolution> solution_;
  std::atomic<bool> failed_{false};
  std::mutex looks_;  // held while the solution is looked at
  std::mutex mutex_;  // of the picture
  std::optional<RefinedPicture> picture_;
  Job job_;
};

}  // namespace view
}  // namespace roomlight
