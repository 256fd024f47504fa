// Numbers with a unit as people write them: "800 lm", "2700K", "1.5e3 cd/m2".
#pragma once

#include <string_view>

#include "base/result.h"

namespace roomlight {

enum class Unit {
  Lumen,
  Candela,
  Lux,
  CandelaPerM2,
  Kelvin,
  WattPerM2,
};

// "lm", "cd", "lx", "cd/m2", "K", "W/m2".
std::string_view unitName(Unit unit);

// The number in `text`, whose unit must be `unit` ("cd/m²" and "nit" are read as cd/m2; "klx", "klm", "kcd" as
// thousands). The error says what is wrong without naming a place: "'800' has no unit; write '800 lm'".
Result<double> parseQuantity(std::string_view text, Unit unit);

}  // namespace roomlight
