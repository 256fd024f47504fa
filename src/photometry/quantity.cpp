#include "photometry/quantity.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace roomlight {
namespace {

struct Spelling {
  std::string_view text;
  Unit unit;
  double factor;
};
constexpr Spelling kSpellings[] = {
    {"lm", Unit::Lumen, 1},
    {"klm", Unit::Lumen, 1000},
    {"cd", Unit::Candela, 1},
    {"kcd", Unit::Candela, 1000},
    {"lx", Unit::Lux, 1},
    {"lux", Unit::Lux, 1},
    {"klx", Unit::Lux, 1000},
    {"cd/m2", Unit::CandelaPerM2, 1},
    {"cd/m^2", Unit::CandelaPerM2, 1},
    {"cd/m\u00b2", Unit::CandelaPerM2, 1},
    {"nit", Unit::CandelaPerM2, 1},
    {"kcd/m2", Unit::CandelaPerM2, 1000},
    {"K", Unit::Kelvin, 1},
    {"W/m2", Unit::WattPerM2, 1},
    {"W/m^2", Unit::WattPerM2, 1},
    {"W/m\u00b2", Unit::WattPerM2, 1},
};

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && s.front() == ' ') s.remove_prefix(1);
  while (!s.empty() && s.back() == ' ') s.remove_suffix(1);
  return s;
}

}  // namespace

std::string_view unitName(Unit unit) {
  switch (unit) {
    case Unit::Lumen: return "lm";
    case Unit::Candela: return "cd";
    case Unit::Lux: return "lx";
    case Unit::CandelaPerM2: return "cd/m2";
    case Unit::Kelvin: return "K";
    case Unit::WattPerM2: return "W/m2";
  }
  return "";
}

Result<double> parseQuantity(std::string_view text, Unit unit) {
  const std::string_view all = trimmed(text);
  double value = 0;
  const auto [end, error] = std::from_chars(all.data(), all.data() + all.size(), value);
  if (error != std::errc() || !std::isfinite(value))
    return Error{fmt::format("'{}' is not a number with a unit; write for example '1 {}'", text, unitName(unit))};
  const std::string_view written = trimmed(all.substr(static_cast<size_t>(end - all.data())));
  if (written.empty()) return Error{fmt::format("'{}' has no unit; write '{} {}'", text, all, unitName(unit))};
  for (const Spelling& s : kSpellings) {
    if (s.text != written) continue;
    if (s.unit == unit) return value * s.factor;
    return Error{fmt::format("'{}' is in {}, where {} is needed", text, unitName(s.unit), unitName(unit))};
  }
  return Error{fmt::format("'{}' has the unknown unit '{}'; {} is needed", text, written, unitName(unit))};
}

}  // namespace roomlight
