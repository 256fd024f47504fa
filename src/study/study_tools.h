// What a study asks for and gets back. Who runs it decides how: `roomlight study` starts a process for each, so that
// memory is that of one technique alone and a defect of one ends no study.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"

namespace roomlight {

struct StudyRender {
  std::filesystem::path scene, lighting;
  std::string camera;
  int width = 0, height = 0;
  std::string technique, settings = "{}";
  int samples = 0;         // per pixel; 0: as the technique has it
  double timeLimitS = 0;   // 0: none
  uint64_t seed = 0;
  std::filesystem::path picture;  // .exr
};

struct RenderCost {
  double seconds = 0;           // after loading, before writing
  double processorSeconds = 0;  // of all threads
  double memoryMiB = 0;         // peak of the process before writing
  double samples = 0;           // per pixel, as done
  std::vector<std::pair<std::string, double>> stages;  // seconds
};

struct StudyWalk {
  std::filesystem::path scene, lighting, walk;
  int width = 0, height = 0;
  std::string technique, settings = "{}";
};

struct WalkCost {
  int frames = 0;
  double framesPerSecond = 0;
  double updateMs = 0,
         pictureMs = 0;  // of a frame, median; framesPerSecond and these without the first frame where there are more
};

struct StudyTools {
  std::function<Result<RenderCost>(const StudyRender&)> render;
  std::function<Result<WalkCost>(const StudyWalk&)> walk;  // empty: no frames a second
};

// What long work says and hears: what it does now, the part done of all, and seconds left where that can be told (else
// negative).
struct StudyProgress {
  std::function<void(const std::string& now, double done, double secondsLeft)> report;
  const std::atomic<bool>* cancelled = nullptr;
  bool stop() const { return cancelled && cancelled->load(std::memory_order_relaxed); }
};

}  // namespace roomlight
