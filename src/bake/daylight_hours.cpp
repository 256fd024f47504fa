#include "bake/daylight_hours.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "import/lighting_daylight.h"

namespace roomlight::bake {
namespace {

// Where the clock stands in "2026-06-21T17:00+02:00".
constexpr size_t kHourAt = 11, kMinuteAt = 14, kClockEnd = 16;

std::optional<int> twoDigits(const std::string& text, size_t at) {
  int value = 0;
  const auto [end, code] = std::from_chars(text.data() + at, text.data() + at + 2, value);
  return code == std::errc() && end == text.data() + at + 2 ? std::optional(value) : std::nullopt;
}

std::optional<std::string> timeOf(const nlohmann::json& daylight) {
  if (!daylight.is_object() || !daylight.contains("time") || !daylight["time"].is_string()) return {};
  std::string time = daylight["time"].get<std::string>();
  return time.size() >= kClockEnd ? std::optional(std::move(time)) : std::nullopt;
}

}  // namespace

std::optional<double> hourOf(const nlohmann::json& daylight) {
  const std::optional<std::string> time = timeOf(daylight);
  if (!time) return {};
  const std::optional<int> hour = twoDigits(*time, kHourAt), minute = twoDigits(*time, kMinuteAt);
  if (!hour || !minute) return {};
  return *hour + *minute / 60.0;
}

Result<DaylightHour> daylightAt(const nlohmann::json& daylight, const std::filesystem::path& folder, double hour) {
  const std::optional<std::string> time = timeOf(daylight);
  if (!time) return Error{"the home's daylight has no time; give it one in a lighting file"};
  const int minutes = std::min(24 * 60 - 1, static_cast<int>(std::lround(hour * 60)));
  nlohmann::json at = daylight;
  at["time"] =
      fmt::format("{}{:02}:{:02}{}", time->substr(0, kHourAt), minutes / 60, minutes % 60, time->substr(kClockEnd));
  std::string error;
  Daylight light = readDaylight(JsonPlace(at, "daylight", error), folder);
  if (!error.empty()) return Error{error};
  DaylightHour out{hour, {}, std::move(light.sky)};
  if (!isBlack(light.sun.illuminanceLux)) out.suns.push_back(light.sun);
  return out;
}

}  // namespace roomlight::bake
