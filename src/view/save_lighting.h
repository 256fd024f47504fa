// Lamps and the sun as they are, as a lighting file.
#pragma once

#include "view/home.h"

namespace roomlight::view {

// The file that the home was opened with, its lamps and its time as they are now, and what was changed in lamps that
// the scene brought along. Relative paths become absolute: it may lie anywhere.
std::string lightingFile(const ViewHome& home, const HomeState& state);

// Takes out of a lighting file what lamps can be put to again by hand, their dimming and the changes to the scene's
// own, so that they are known undimmed.
nlohmann::json withoutDimming(nlohmann::json document);
// The home's state as the file that it was opened with says.
HomeState stateOfFile(const ViewHome& home, const nlohmann::json& document);

}  // namespace roomlight::view
