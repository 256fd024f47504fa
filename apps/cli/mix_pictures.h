// Pictures of many states of the lamps of a layered picture.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "base/image_io.h"
#include "console.h"
#include "mix/overlays.h"
#include "still/layered_home.h"

namespace roomlight::cli {

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
