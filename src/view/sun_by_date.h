// The sun of a home that follows date and hour, if its lighting knows a place and a time.
#pragma once

#include "view/home.h"

namespace roomlight::view {

// Of a lighting file: its `daylight`, or its one `sun`. Paths in it are relative to `folder`.
std::optional<SunByDate> sunOfLighting(const nlohmann::json& document, const std::filesystem::path& folder);
// Of a `daylight` that was found elsewhere.
std::optional<SunByDate> sunOfDaylight(const nlohmann::json& daylight, const std::filesystem::path& folder);

// Of a home whose light no date moves: off at first. It stands where its lighting file says, else where the home's file
// does, else where `assumed` does. `home`: the `daylight` of the home's file; null: there is none. `assumed` has all
// that a `daylight` needs.
SunByDate sunOffAtFirst(const nlohmann::json& document, const nlohmann::json& home, const nlohmann::json& assumed);

// "2026-06-21T17:30:00+02:00"
std::string timeText(const SunState& state, double utcOffsetH);

}  // namespace roomlight::view
