#include "import/lighting_values.h"

#include <fmt/format.h>

#include "photometry/colour_temperature.h"

namespace roomlight {

Vec3 readDirection(const JsonPlace& j) {
  const Vec3 v = j.vector(-kFarthestM, kFarthestM);
  const float l = length(v);
  if (l > 1e-6f) return v / l;
  j.fail("must not be zero");
  return {0, -1, 0};
}

Vec3 readColour(const JsonPlace& j) {
  if (j.has("temperature") && j.has("color")) j.fail("give 'temperature' or 'color', not both");
  if (j.has("temperature"))
    return blackBodyColour(j["temperature"].quantity(Unit::Kelvin, kLowestKelvin, kHighestKelvin));
  if (!j.has("color")) return Vec3(1);
  const Vec3 c = j["color"].vector(0, kMostLight);
  if (luminance(c) >= 1e-6f) return c / luminance(c);
  j["color"].fail("must not be black");
  return Vec3(1);
}

std::string theOne(const JsonPlace& j, std::initializer_list<const char*> keys) {
  std::string found, all;
  int count = 0;
  for (const char* key : keys) {
    all += (all.empty() ? "" : ", ") + std::string(key);
    if (j.has(key)) found = key, ++count;
  }
  if (count != 1) j.fail(fmt::format("give exactly one of {}", all));
  return count == 1 ? found : std::string();
}

void forbid(const JsonPlace& j, std::initializer_list<const char*> keys, const std::string& why) {
  for (const char* key : keys) {
    if (j.has(key)) j[key].fail("means nothing " + why);
  }
}

}  // namespace roomlight
