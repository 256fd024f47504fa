#include "view/sun_by_date.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <deque>
#include <memory>
#include <mutex>
#include <utility>

#include "import/lighting_daylight.h"
#include "photometry/epw.h"
#include "photometry/sun.h"

namespace roomlight::view {
namespace {

using nlohmann::json;

constexpr size_t kRemembered = 4;

// Of "..T17:00+02:00" or "..Z", which parseMoment() has taken already.
double utcOffsetOf(const std::string& text) {
  const size_t sign = text.find_last_of("+-");
  if (text.ends_with('Z') || sign == std::string::npos || sign + 6 != text.size()) return 0;
  int hours = 0, minutes = 0;
  std::from_chars(text.data() + sign + 1, text.data() + sign + 3, hours);
  std::from_chars(text.data() + sign + 4, text.data() + sign + 6, minutes);
  return (text[sign] == '-' ? -1 : 1) * (hours + minutes / 60.0);
}

std::optional<double> number(const json& j, const char* key) {
  return j.contains(key) && j[key].is_number() ? std::optional(j[key].get<double>()) : std::nullopt;
}

// The weather of a `daylight`: no moment reads its file again. Null: it goes by none, or by one that cannot be read.
std::shared_ptr<const Epw> weatherOf(const json& daylight, const std::filesystem::path& folder) {
  if (!daylight.is_object() || !daylight.contains("weather")) return {};
  std::string ignored;  // what is wrong is told where a moment is asked for
  std::optional<Epw> weather = readWeather(JsonPlace(daylight["weather"], "weather", ignored), folder);
  return weather ? std::make_shared<const Epw>(std::move(*weather)) : nullptr;
}

// By place and time; none where the source knows no time or goes by a direction. Without a place it is that of the
// weather, if not null.
std::optional<SunByDate> byDate(const json& source, const Epw* weather) {
  if (!source.is_object() || !source.contains("time") || !source["time"].is_string()) return {};
  const std::string text = source["time"].get<std::string>();
  const Result<Moment> moment = parseMoment(text);
  const auto latitude = number(source, "latitude"), longitude = number(source, "longitude");
  if (!moment || ((!latitude || !longitude) && !weather)) return {};
  SunByDate out;
  out.latitudeDeg = latitude ? *latitude : weather->latitudeDeg;
  out.longitudeDeg = longitude ? *longitude : weather->longitudeDeg;
  out.utcOffsetH = utcOffsetOf(text);
  out.source = source;
  const Moment& m = moment.value();  // its date is the local one, its hour that of UTC
  out.atStart = {m.year, m.month, m.day, m.hour + out.utcOffsetH};
  return out;
}

json atTime(const SunByDate& sun, const SunState& state) {
  json source = sun.source;
  source["time"] = timeText(state, sun.utcOffsetH);
  return source;
}

// Asked of a moment again, a function of those of late answers from memory: an hour that was set is asked for by all
// who follow it. From any thread.
std::function<Result<SunLight>(const SunState&)> remembering(std::function<Result<SunLight>(const SunState&)> find) {
  struct Memory {
    std::mutex mutex;
    std::deque<std::pair<SunState, Result<SunLight>>> found;
  };
  return [find = std::move(find), memory = std::make_shared<Memory>()](const SunState& state) -> Result<SunLight> {
    const std::lock_guard lock(memory->mutex);
    for (const auto& [at, light] : memory->found) {
      if (at == state) return light;
    }
    if (memory->found.size() >= kRemembered) memory->found.pop_front();
    return memory->found.emplace_back(state, find(state)).second;
  };
}

// Where a lighting file says that a home stands, though no date moves its sun: keys of a `daylight`. Null: nowhere.
json mentionedPlace(const json& document) {
  json sources = json::array();
  if (document.is_object() && document.contains("daylight")) sources.push_back(document["daylight"]);
  if (document.is_object() && document.contains("sun")) {
    const json& sun = document["sun"];
    if (sun.is_array()) {
      sources.insert(sources.end(), sun.begin(), sun.end());
    } else {
      sources.push_back(sun);
    }
  }
  for (const json& s : sources) {
    if (!s.is_object() || !number(s, "latitude") || !number(s, "longitude")) continue;
    json place;
    for (const char* key : {"latitude", "longitude", "north", "time"}) {
      if (s.contains(key)) place[key] = s[key];
    }
    return place;
  }
  return {};
}

std::string skyInWords(const json& sky) {
  if (sky.is_string()) return sky.get<std::string>();
  return sky.is_number() ? fmt::format("CIE type {}", sky.get<double>()) : "perez";
}

}  // namespace

std::string timeText(const SunState& s, double utcOffsetH) {
  const int seconds = std::min(86399, static_cast<int>(std::lround(s.hour * 3600)));
  const int offset = static_cast<int>(std::lround(std::abs(utcOffsetH) * 60));
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}{}{:02}:{:02}", s.year, s.month, s.day, seconds / 3600,
                     seconds / 60 % 60, seconds % 60, utcOffsetH < 0 ? '-' : '+', offset / 60, offset % 60);
}

std::optional<SunByDate> sunOfDaylight(const json& daylight, const std::filesystem::path& folder) {
  const std::shared_ptr<const Epw> weather = weatherOf(daylight, folder);
  std::optional<SunByDate> out = byDate(daylight, weather.get());
  if (!out) return {};
  out->sky = daylight.contains("weather") ? "weather" : skyInWords(daylight.value("sky", json()));
  out->at = remembering([sun = *out, folder, weather](const SunState& state) -> Result<SunLight> {
    if (!state.on) return SunLight{{}, Sky()};
    std::string error;
    const json source = atTime(sun, state);
    Daylight light = readDaylight(JsonPlace(source, "daylight", error), folder, weather.get());
    if (!error.empty()) return Error{error};
    SunLight lit;
    if (!isBlack(light.sun.illuminanceLux)) lit.suns.push_back(light.sun);
    lit.sky = std::move(light.sky);
    return lit;
  });
  return out;
}

std::optional<SunByDate> sunOfLighting(const json& document, const std::filesystem::path& folder) {
  if (!document.is_object()) return {};
  if (document.contains("daylight")) return sunOfDaylight(document["daylight"], folder);
  if (!document.contains("sun")) return {};
  std::optional<SunByDate> out = byDate(document["sun"], nullptr);
  if (!out) return {};
  out->isDaylight = false;
  out->sky = "as it is";
  out->at = remembering([sun = *out](const SunState& state) -> Result<SunLight> {
    if (!state.on) return SunLight();
    std::string error;
    const json source = atTime(sun, state);
    const Sun light = readSun(JsonPlace(source, "sun", error));
    if (!error.empty()) return Error{error};
    SunLight lit;
    if (!isBlack(light.illuminanceLux)) lit.suns.push_back(light);
    return lit;
  });
  return out;
}

SunByDate sunOffAtFirst(const json& document, const json& home, const json& assumed) {
  json source = home.is_null() ? assumed : home;
  PlaceFrom from = home.is_null() ? PlaceFrom::Assumed : PlaceFrom::Home;
  if (const json place = mentionedPlace(document); !place.is_null()) {
    source.update(place), from = PlaceFrom::Lighting;
    const double hours = std::round(place["longitude"].get<double>() / 15);
    if (!place.contains("time")) source["time"] = timeText({2026, 6, 10, 12}, hours);
  }
  std::optional<SunByDate> sun = sunOfDaylight(source, {});
  if (!sun) sun = sunOfDaylight(assumed, {}), from = PlaceFrom::Assumed;
  sun->placeFrom = from, sun->atStart.on = false;
  return std::move(*sun);
}

}  // namespace roomlight::view
