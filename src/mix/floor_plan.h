// Pages that show a home by overlays: a page of its own and a card of Home Assistant.
#pragma once

#include <map>

#include "mix/layer_info.h"
#include "mix/overlays.h"

namespace roomlight {

struct PlanLamp {
  std::string name, file;
  std::string entity;          // of Home Assistant
  std::optional<Vec2> pixel;   // shares of width and height
  std::array<float, 11> opacities{};
};

struct FloorPlan {
  int width = 0, height = 0;
  std::string baseFile;
  BlendMode blend = BlendMode::Screen;
  std::vector<PlanLamp> lamps;
};

// Small letters, digits and underscores, as Home Assistant makes entity ids from names: "Küche, Decke" becomes
// kuche_decke. Never empty.
std::string slugOf(std::string_view name);

// Plan with a file name and an entity (light.<slug>) for every switched lamp; equal slugs are numbered. `entities`: by
// layer, where given.
FloorPlan planOf(const std::vector<LayerInfo>& layers, const Switches& switches,
                 const std::map<size_t, std::string>& entities, const std::string& extension);

// index.html: the pictures beside it, a switch and a dimmer a lamp. No scripts from elsewhere.
std::string pageOf(const FloorPlan& plan);

// The card's YAML. With `dimmed`, overlays follow sensors that sensorsOf() declares, in steps of 10 %.
std::string cardOf(const FloorPlan& plan, const std::string& urlPrefix, bool dimmed);

// Template sensors for configuration.yaml that tell each lamp's level as 0, 10, .. 100.
std::string sensorsOf(const FloorPlan& plan);

// Who is in the folder and how to blend it, as JSON for programs.
std::string overlayIndexOf(const FloorPlan& plan, const OverlayTrial& trial);

}  // namespace roomlight
