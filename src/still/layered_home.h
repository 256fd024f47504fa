// A layered picture opened for mixing, and how bright each of its layers shall be.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/image_layers.h"
#include "engine/sights.h"
#include "look/display.h"
#include "look/edges.h"
#include "mix/layer_info.h"
#include "mix/mixer.h"

namespace roomlight {

struct MixHome {
  std::vector<LayerInfo> layers;  // in the file's order, as those of the stack
  LayerStack stack;            // of what is left of each pixel beside sections and backdrop
  Sights sights;
  std::optional<Vec3> lightColour;  // of the unmixed picture
  std::vector<EdgePixel> edges;     // of the unmixed picture, once its look is applied;
  LayerStack sides;                 // three rows, a pixel an edge: the rest, the bright side, both
};
// The mix as the file has it: light of whole pixels.
Image linearMix(const MixHome& home, std::span<const Vec3> gains);
// As it is looked at: sections drawn in, over paper; with `transparent` an empty backdrop is the picture's fourth
// channel instead.
ByteImage displayMix(const MixHome& home, std::span<const Vec3> gains, const Look& look, bool transparent);

// Errors: of the file; layers that are not those it tells of.
Result<MixHome> openLayers(const std::string& file);
// The same of a picture in memory; `name` begins the error's line.
Result<MixHome> layersOf(LayeredImage picture, const std::string& name);

struct DialOptions {
  std::vector<std::string> lamps;  // NAME=DIAL, the later ones go first
  std::optional<double> kelvin;    // of all lamps
  std::optional<std::string> sun, sky;
};

struct Mixture {
  std::vector<Vec3> gains, hues;  // a layer; hues of luminance 1
};
Result<Mixture> mixtureOf(const std::vector<LayerInfo>& layers, const DialOptions& options);

// How a mix is shown. Exposure and white are those of the unmixed picture where options do not fix them, or of this mix
// where that is wished; local exposure follows the same picture as exposure.
struct ShownMix {
  Look look;
  White white;
  Retouch retouch;
  std::vector<EdgePixel> edges;
};
struct FollowMix {
  bool exposure = false, white = false;
};
ShownMix showMix(const MixHome& home, const Mixture& mixture, const Display& display, const FollowMix& follow);
// Whether pictures can be made without applyLook().
bool isPlain(const ShownMix& shown);
// Applies local exposure, glare and vignette to every layer in place, and parts edges. Write linear (.exr) mixes
// before: afterwards the layers no longer hold cd/m².
void applyLook(MixHome& home, const ShownMix& shown);

// The name before the last '=', and what is behind it.
struct Assignment {
  std::string name, value;
};
Result<Assignment> splitAssignment(const std::string& option, const std::string& text);

}  // namespace roomlight
