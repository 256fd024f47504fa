#pragma once

#include <string>

namespace roomlight::view {

// Which light: by what technique, of which plan.
struct LightKey {
  std::string technique, plan;  // plan empty: the one that is edited
  bool operator==(const LightKey&) const = default;
};

}  // namespace roomlight::view
