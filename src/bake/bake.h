// A lit home as one file: what is seen of it, with the light of every lamp and of daylight as layers.
#pragma once

#include <string>
#include <vector>

#include "bake/atlas.h"
#include "bake/daylight_hours.h"
#include "bake/glb.h"
#include "bake/layers.h"
#include "engine/stages.h"

namespace roomlight::bake {

struct BakeSettings {
  ChartSettings charts;
  AtlasSettings atlas;
  LayerSettings layers;
  GlbSettings glb;
  float simplifyM = 0.001f;     // how far surfaces may be from where they are
  float placesApartM = 0.08f;   // where vertices share light
  size_t seenRays = size_t{1} << 21, raysAnEye = 4096;  // at least, that tell what can be seen
};

// By name of a quality, as pictures have it. Errors: an unknown name.
Result<BakeSettings> bakeSettings(const std::string& quality);

struct BakeWish {
  std::vector<Lamp> offLamps;       // baked as well, off at first
  std::vector<DaylightHour> hours;  // none: no daylight
  std::vector<size_t> rooms = {};        // that are walked in, numbers; none: all
  size_t budgetBytes = 0;           // for the file, 0: as large as it gets
  bool asText = false;              // it will be written compressed, as text in a page
};

struct BakedHome {
  Glb glb;  // the file (docs/reference/baked.md); empty once cancelled
  size_t triangles = 0, places = 0, layers = 0;
  int atlasWidth = 0, atlasHeight = 0;
  ShownAs shown;
  BakeSettings settings;  // as they were for the budget
};

// Stages "simplify", "seen", "charts", those of lighting, "lamps", "sun mask", "sun", "sky", "exposure", "pack".
// Errors: nothing can be seen; what glbOf() and lighting say.
Result<BakedHome> bakeHome(const Scene& scene, const BakeWish& wish, const BakeSettings& settings, Stages& stages);

}  // namespace roomlight::bake
