// How far a place's clocks were from UTC.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace roomlight::importers::sh3d {

// Seconds to add to UTC for the clock at `wallSeconds` since 1970-01-01 00:00 on that clock, by the time zone's rules
// (RFC 8536, TZif) in `folder`; none where the zone is unknown there. "Europe/Paris", "UTC".
std::optional<int> utcOffsetSeconds(const std::string& zone, int64_t wallSeconds,
                                    const std::filesystem::path& folder = "/usr/share/zoneinfo");

}  // namespace roomlight::importers::sh3d
