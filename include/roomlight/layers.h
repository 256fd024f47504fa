// A picture in layers of light: every lamp, the sun and the sky apart. Light adds up, so any state of the lamps is a
 // sum.
#pragma once

#include "roomlight/picture.h"

namespace ROOMLIGHT_NAMESPACE {

struct LayerInfo {
  std::string name = {}, kind = {};  // kind: lamp, group, mesh, sun or sky
  Vec3 colour{1, 1, 1};  // linear Rec.709 of its light; luminance 1
  std::optional<double> kelvin = {}, fluxLm = {};
  std::string room = {};  // empty: of none
};

// How bright layers shall be. Later ones go first.
struct Dials {
  // A lamp's name, where * and ? stand for any text and letter, and "60%", "off", "2700K", "#ffd080", or several of
  // them with commas between.
  std::vector<std::pair<std::string, std::string>> lamps = {};
  std::optional<double> kelvin = {};  // of all lamps whose colour is not said
  std::string sun = {}, sky = {};  // like those of lamps; empty: as rendered
};

class ROOMLIGHT_API Layers {
 public:
  static Result<Layers> open(const std::string& file);  // .exr by `render --layers`
  int width() const;
  int height() const;
  const std::vector<LayerInfo>& list() const;
  // What each layer is multiplied by, linear Rec.709.
  Result<std::vector<Vec3>> gains(const Dials& dials) const;
  // One layer as it was rendered.
  Result<Image> image(size_t layer) const;
  Result<Image> mix(const Dials& dials = {}) const;
  // Exposure and white of "auto" are those of the unmixed picture, so that dimmed lamps look dimmed; of "mix", those of
  // this mix.
  Result<DisplayImage> display(const Dials& dials = {}, const DisplayOptions& options = {}) const;

  struct State;
  explicit Layers(std::shared_ptr<const State> state) : state_(std::move(state)) {}

 private:
  std::shared_ptr<const State> state_;
};

}  // namespace ROOMLIGHT_NAMESPACE
