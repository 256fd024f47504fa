#include "report_picture.h"

#include <fmt/format.h>

#include <ctime>

#include "base/image_io.h"
#include "base/platform/machine.h"
#include "look/display.h"
#include "engine/settings.h"
#include "engine/render.h"
#include "exit_status.h"

namespace roomlight::cli {
namespace {

constexpr int kWidth = 1120, kHeight = 504;  // wide: half a page of A4 is for the plan
constexpr double kMostS = 6;
constexpr int kJpegQuality = 84;

}  // namespace

ReportPicture pictureFor(const Scene& scene, int threads) {
  Camera camera = defaultCamera(scene);
  if (camera.projection != Projection::Perspective && camera.projection != Projection::Orthographic)
    camera.projection = Projection::Perspective;
  RenderSettings settings;
  applyQuality("draft", settings);
  settings.width = kWidth, settings.height = kHeight, settings.timeLimitS = kMostS, settings.blend = false,
  settings.threads = threads;
  RenderProgress progress;
  progress.cancelled = &interrupted();
  const Result<Rendered> rendered = render(scene, camera, settings, progress);
  if (!rendered || rendered.value().image.pixels.empty()) return {};
  const Image& image = rendered.value().image;
  const Display display = usualDisplay();
  Result<std::string> jpeg = encodeJpeg(
      displayed(image, display, whiteOf(display, rendered.value().lightColour), ev100Of(display, image)), kJpegQuality);
  if (!jpeg) return {};
  return {std::move(jpeg.value()), camera.name.empty()
                                       ? "View of the home, exposed for the eye"
                                       : fmt::format("View from '{}', exposed for the eye", camera.name)};
}

std::string today() {
  const std::tm local = localTime(std::time(nullptr));
  static constexpr const char* kMonths[] = {"January", "February", "March",     "April",   "May",      "June",
                                            "July",    "August",   "September", "October", "November", "December"};
  return fmt::format("{} {} {}", local.tm_mday, kMonths[local.tm_mon], local.tm_year + 1900);
}

}  // namespace roomlight::cli
