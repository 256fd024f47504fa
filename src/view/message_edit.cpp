#include "view/message_edit.h"

#include <charconv>
#include <chrono>

namespace roomlight::view {
namespace {

constexpr double kMostFluxLm = 1e6;

std::optional<float> number(const JsonPlace& j, const char* key, double low, double high) {
  if (!j.has(key)) return {};
  return static_cast<float>(j[key].number(low, high));
}

std::optional<Vec3> place(const JsonPlace& j, const char* key) {
  if (!j.has(key)) return {};
  return j[key].vector(-kFarthestM, kFarthestM);
}

std::optional<bool> flag(const JsonPlace& j, const char* key) {
  if (!j.has(key)) return {};
  return j[key].flag();
}

template <class T>
bool digits(std::string_view text, T& value) {
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  return code == std::errc() && end == text.data() + text.size();
}

// "2026-06-21"; the sun's formulas hold from 1950 to 2050.
void readDate(const JsonPlace& j, EditFields& out) {
  const std::string text = j.text();
  int year = 0;
  unsigned month = 0, day = 0;
  const std::string_view t = text;
  const bool shaped = t.size() == 10 && t[4] == '-' && t[7] == '-' && digits(t.substr(0, 4), year) &&
                      digits(t.substr(5, 2), month) && digits(t.substr(8, 2), day);
  const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(month), std::chrono::day(day)};
  if (!shaped || !date.ok() || year < 1950 || year > 2050)
    return j.fail("must be a date from 1950 to 2050 as \"2026-06-21\"");
  out.year = year, out.month = static_cast<int>(month), out.day = static_cast<int>(day);
}

}  // namespace

EditFields readEditFields(const JsonPlace& j) {
  EditFields out;
  out.position = place(j, "position"), out.move = place(j, "move");
  if (j.has("direction")) {
    const Vec3 d = j["direction"].vector(-kFarthestM, kFarthestM);
    if (!(length(d) > 1e-6f)) j["direction"].fail("must have a length");
    out.direction = normalize(d);
  }
  if (j.has("color")) out.color = j["color"].vector(0, 1e6);
  out.dim = number(j, "dim", 0, 1), out.open = number(j, "open", 0, 1);
  out.temperatureK = number(j, "temperatureK", 1000, 40000);
  out.fluxLm = number(j, "fluxLm", 0, kMostFluxLm);
  out.turnDeg = number(j, "turn", -36000, 36000);
  out.on = flag(j, "on"), out.hidden = flag(j, "hidden"), out.alone = flag(j, "alone");
  if (j.has("alone") && !j.has("move") && !j.has("turn")) j["alone"].fail("needs a move or a turn");
  if (j.has("material")) out.material = j["material"].text();
  if (j.has("material") && !j.has("color")) j["material"].fail("needs a color");
  if (j.has("color") && j.has("temperatureK")) j["temperatureK"].fail("give a color or a temperature, not both");
  if (j.has("date")) readDate(j["date"], out);
  if (j.has("hour")) out.hour = j["hour"].number(0, 24);
  return out;
}

}  // namespace roomlight::view
