// Looks: settings of Display that go together, by name.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "look/display.h"

namespace roomlight {

// "natural", "bright", "evening", "technical", each with a line of explanation.
const std::vector<std::pair<std::string, std::string>>& lookNames();

Display usualDisplay();  // "natural"

// The error names them.
Result<Display> displayOfLook(const std::string& name);

}  // namespace roomlight
