// A layered picture opened for mixing, how bright each layer shall be, and pictures of many states.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/image_io.h"
#include "console.h"
#include "engine/sights.h"
#include "mix/layer_info.h"
#include "mix/mixer.h"
#include "mix/overlays.h"
#include "picture_options.h"

namespace roomlight::cli {

struct MixHome {
  std::vector<LayerInfo> layers;  // in the file's order, as those of the stack
  LayerStack stack;            // of what is left of each pixel beside sections and backdrop
  Sights sights;
  std::optional<Vec3> lightColour;  // of the unmixed picture
};
// The mix as the file has it: light of whole pixels.
Image linearMix(const MixHome& home, std::span<const Vec3> gains);
// As it is looked at: sections drawn in, over paper; with `transparent` an empty backdrop is the picture's fourth
// channel instead.
ByteImage displayMix(const MixHome& home, std::span<const Vec3> gains, const Look& look, bool transparent);

Result<MixHome> openLayers(const std::string& file);

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
};
struct FollowMix {
  bool exposure = false, white = false;
};
ShownMix showMix(const MixHome& home, const Mixture& mixture, const Display& display, const FollowMix& follow);
// Applies local exposure, glare and vignette to every layer in place. Write linear (.exr) mixes before: afterwards the
// layers no longer hold cd/m².
void retouch(MixHome& home, const Retouch& by);

// The name before the last '=', and what is behind it.
struct Assignment {
  std::string name, value;
};
Result<Assignment> splitAssignment(const std::string& option, const std::string& text);

std::string layerTable(const std::vector<LayerInfo>& layers);

// By the extension: .png, .webp or .jpg.
Status writeBytes(const std::filesystem::path& file, const ByteImage& image, const Metadata& metadata,
                  float webpQuality);

// Many pictures from one layered picture: every state of some lamps, or an overlay a lamp with what shows them.
struct StatesJob {
  std::filesystem::path folder;
  std::string extension;  // .png, .webp or .jpg
};
// Exit status of the program; errors are told. Ctrl-C ends it between two pictures.
int writeStates(const MixHome& home, const Switches& switches, const ShownMix& shown, const Metadata& metadata,
                const StatesJob& job, ProgressDisplay& display);

struct OverlaysJob {
  std::filesystem::path folder;
  std::string extension;  // .png or .webp
  std::optional<BlendMode> blend;  // none: that with the least error
  std::string cardFile, urlPrefix;  // of Home Assistant; no card where empty
  bool dimmed = false;
  std::map<size_t, std::string> entities;  // by layer
};
int writeOverlays(const MixHome& home, const Switches& switches, const ShownMix& shown, const Metadata& metadata,
                  const OverlaysJob& job, ProgressDisplay& display);

// The card's second file, "plan.yaml" -> "plan_sensors.yaml".
std::filesystem::path sensorsFileOf(const std::filesystem::path& cardFile);

}  // namespace roomlight::cli
