// Light in a home, and pictures of it.
#pragma once

#include "roomlight/home.h"
#include "roomlight/picture.h"

namespace ROOMLIGHT_NAMESPACE {

struct Settings {
  std::string technique = {};  // hybrid, cone, vxgi, lpv, photon or path; empty: hybrid
  std::string quality = {};  // draft, good or best; empty: as the home says for its photo, else good
  int width = 0, height = 0;  // pixels; 0: as the home or the view says, else 960 and 540
  int samples = 0;  // a pixel; 0: the technique's
  uint64_t seed = 0;  // the same seed gives the same picture, with any number of threads
  int threads = 0;  // 0: all cores
  double timeLimitS = 0;  // 0: none
  double noiseLevel = 0;  // 0: not asked for
  bool layers = false;  // the light of every lamp, sun and sky apart as well
  bool layersByRoom = false;  // and lamps of a room together
  // All else, as a JSON object like those of `render --settings` (docs/reference/command-line.md); members above that
  // are said go first.
  std::string json = {};
};

// From where a home is shown. What is empty is chosen.
struct View {
  std::string camera = {};  // by name or number from 0
  std::string kind = "camera";  // camera, top, plan, panorama or stereo
  std::string level = {}, room = {};  // of top and plan, room of panorama and stereo too
  std::optional<Vec3> eye = {}, target = {};  // look from there instead
  std::optional<float> verticalFovDeg = {}, cutM = {}, metresPerPixel = {};
  std::string backdrop = {};  // sky or none
};

// A home lit for pictures: light is found with the first of them and kept.
class ROOMLIGHT_API Renderer {
 public:
  // `views`: all that pictures will be taken of; none: the default camera. Light that they do not show is found with
  // fewer rays.
  static Result<Renderer> of(const Home& home, const Settings& settings = {}, const std::vector<View>& views = {});
  size_t viewCount() const;
  // Of one of the views, by its number. One at a time: others wait, and a progress function that asks the renderer it
  // tells of would wait for ever. Once cancelled, the best picture so far.
  Result<Picture> picture(size_t view = 0, const Progress& progress = {});

  struct State;
  explicit Renderer(std::shared_ptr<State> state) : state_(std::move(state)) {}

 private:
  std::shared_ptr<State> state_;
};

// One picture.
ROOMLIGHT_API Result<Picture> render(const Home& home, const View& view = {}, const Settings& settings = {},
                                     const Progress& progress = {});

// Names and what they are: techniques, qualities.
ROOMLIGHT_API std::vector<std::pair<std::string, std::string>> techniques();
ROOMLIGHT_API std::vector<std::pair<std::string, std::string>> qualities();

}  // namespace ROOMLIGHT_NAMESPACE
