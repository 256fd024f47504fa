// The picture of a home in a report.
#pragma once

#include <string>

#include "scene/scene.h"

namespace roomlight::cli {

struct ReportPicture {
  std::string jpeg;   // bytes; empty: there is none
  std::string title;  // from where
};

// By the scene's usual camera in draft quality, in a few seconds, six at most on machines that can; none if it fails or
// is interrupted.
ReportPicture pictureFor(const Scene& scene, int threads);

// "23 November 2026", here.
std::string today();

}  // namespace roomlight::cli
