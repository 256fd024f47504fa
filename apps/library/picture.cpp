#include "roomlight/picture.h"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <regex>

#include "base/parallel.h"
#include "cli/output_files.h"
#include "cli/picture_options.h"
#include "conversions.h"
#include "still/developed.h"
#include "still/layers_file.h"
#include "still/picture_file.h"

namespace roomlight::v1 {
namespace {

constexpr float kWebpQuality = 90;

Development developmentOf(const Picture::State& s, const Display& display) {
  return roomlight::developmentOf(s.home.state().opened.scene, s.camera, *s.rendered, display);
}

LayeredImage layeredImageOf(const Picture::State& s, Metadata metadata) {
  Rendered copy = *s.rendered;
  return layeredImage(s.home.state().opened.scene, s.camera, copy, std::move(metadata));
}

// Of writing, which fails by a folder that is not there, a full disk, a size that a format does not take.
Status done(const roomlight::Status& status) { return status ? Status(Done{}) : badInput(status.error()); }

Metadata metadataOf(const Picture::State& s, const Development& how) {
  return roomlight::metadataOf({s.settings, s.home.state().file, s.home.state().lighting, s.view, false}, s.camera,
                               *s.rendered, how);
}

}  // namespace

std::string withoutDashes(std::string message) {
  static const std::regex option("(^|[ (])--([a-z])");
  return std::regex_replace(message, option, "$1$2");
}

Result<Display> toInternal(const DisplayOptions& o) {
  cli::DisplayOptions options;
  options.look = o.look, options.exposure = o.exposure, options.tone = o.tone, options.whiteBalance = o.whiteBalance;
  options.contrast = o.contrast, options.saturation = o.saturation, options.localExposure = o.localExposure;
  options.glare = o.glare, options.vignette = o.vignette;
  const auto inRange = [](const std::optional<float>& value, float low, float high) {
    return !value || (*value >= low && *value <= high);
  };
  if (!inRange(o.contrast, 0.5f, 2)) return badInput("contrast: must be from 0.5 to 2");
  if (!inRange(o.saturation, 0, 2)) return badInput("saturation: must be from 0 to 2");
  if (!inRange(o.localExposure, 0, 1)) return badInput("localExposure: must be from 0 to 1");
  if (!inRange(o.glare, 0, 0.5f)) return badInput("glare: must be from 0 to 0.5");
  if (!inRange(o.vignette, 0, 1)) return badInput("vignette: must be from 0 to 1");
  const roomlight::Result<Display> display = cli::readDisplay(options);
  if (!display) return badInput(display.error());
  return display.value();
}

Image toPublic(roomlight::Image image) {
  const auto owner = std::make_shared<const roomlight::Image>(std::move(image));
  return imageIn(owner, *owner);
}

Image imageIn(std::shared_ptr<const void> owner, const roomlight::Image& image) {
  return Image(std::make_shared<const Image::State>(Image::State{&image, std::move(owner)}));
}

Picture pictureOf(Rendered rendered, const Camera& camera, const std::string& view, const RenderSettings& settings,
                  const Home& home) {
  const auto light = std::make_shared<const Rendered>(std::move(rendered));
  return Picture(std::make_shared<const Picture::State>(
      Picture::State{imageIn(light, light->image), light, camera, view, settings, home}));
}

int Image::width() const { return state_->image->width; }
int Image::height() const { return state_->image->height; }

std::span<const float> Image::rgb() const {
  static_assert(sizeof(roomlight::Vec3) == 3 * sizeof(float));
  const std::vector<roomlight::Vec3>& pixels = state_->image->pixels;
  return {reinterpret_cast<const float*>(pixels.data()), 3 * pixels.size()};
}

Status Image::write(const std::string& file) const {
  return guarded([&]() -> Status {
    if (lowerExtension(file) != ".exr") return badInput(fmt::format("{}: linear light is written to .exr", file));
    return done(writeExr(file, *state_->image, {{"roomlight.version", roomlight::version()}}));
  });
}

const Image& Picture::image() const { return state_->image; }
bool Picture::complete() const { return state_->rendered->complete; }
const std::string& Picture::camera() const { return state_->camera.name; }

std::string Picture::stats() const {
  const RenderStats& stats = state_->rendered->stats;
  auto numbers = nlohmann::ordered_json::object();
  for (const auto& [name, value] : stats.numbers) numbers[name] = value;
  return nlohmann::ordered_json{{"stages", cli::stagesJson(stats.stages)}, {"numbers", numbers}}.dump(2) + "\n";
}

Result<DisplayImage> Picture::display(const DisplayOptions& options) const {
  return guardedOn(state_->settings.threads, [&]() -> Result<DisplayImage> {
    const Result<Display> display = toInternal(options);
    if (!display) return display.error();
    const Development how = developmentOf(*state_, *display);
    const std::vector<float> opacity = opacityOf(*state_->rendered, state_->camera);
    ByteImage bytes = bytesOf(developed(*state_->rendered, how, std::nullopt), opacity);
    return DisplayImage{bytes.width, bytes.height, bytes.channels, std::move(bytes.samples)};
  });
}

Status Picture::write(const std::string& file, const DisplayOptions& options) const {
  return guardedOn(state_->settings.threads, [&]() -> Status {
    const std::string extension = lowerExtension(file);
    if (extension != ".exr" && extension != ".png" && extension != ".jpg")
      return badInput(fmt::format("{}: unknown kind of picture '{}'; use .exr, .png or .jpg", file, extension));
    const Result<Display> display = toInternal(options);
    if (!display) return display.error();
    const Development how = developmentOf(*state_, *display);
    Metadata metadata = metadataOf(*state_, how);
    if (extension == ".exr" && !state_->rendered->layers.empty())
      return done(writeLayers(file, layeredImageOf(*state_, std::move(metadata))));
    return done(writePicture(file, state_->camera, *state_->rendered, how, std::move(metadata)));
  });
}

Result<Layers> Picture::layers() const {
  return guardedOn(state_->settings.threads, [&]() -> Result<Layers> {
    if (state_->rendered->layers.empty()) return badInput("the picture has no layers; render it with layers");
    const Development how = developmentOf(*state_, usualDisplay());
    return toPublic(layersOf(layeredImageOf(*state_, metadataOf(*state_, how)), state_->home.state().file));
  });
}

Status write(const DisplayImage& image, const std::string& file) {
  return guarded([&]() -> Status {
    const bool sound = image.width > 0 && image.height > 0 && (image.channels == 3 || image.channels == 4) &&
                       image.samples.size() == static_cast<size_t>(image.width) * static_cast<size_t>(image.height) *
                                                   static_cast<size_t>(image.channels);
    if (!sound) return badInput("the image's samples are not channels * width * height, with 3 or 4 channels");
    ByteImage bytes(image.width, image.height, image.channels);
    bytes.samples = image.samples;
    const std::string extension = lowerExtension(file);
    if (extension == ".png") return done(writePng(file, bytes, {}));
    if (extension == ".webp") return done(writeWebp(file, bytes, kWebpQuality));
    if (extension == ".jpg" && image.channels == 3)
      return done(writeJpeg(file, bytes, std::numeric_limits<size_t>::max()));
    return badInput(fmt::format("{}: use .png, .webp, or .jpg for three channels", file));
  });
}

}  // namespace roomlight::v1
