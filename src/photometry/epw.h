// Weather files of EnergyPlus (.epw): text, one record a line, fields parted by commas.
//   8 header records: "LOCATION,city,region,country,source,WMO,latitude,longitude,hours from UTC,elevation" comes
//   first, "DATA PERIODS,.." last
//   then one an hour: year, month, day, hour 1..24, minute, flags, dry bulb, dew point (°C) ..
//   field 15: direct normal, 16: diffuse horizontal (Wh/m²) ..
//   field 18: direct normal, 19: diffuse horizontal illuminance (lx)
// Hour h holds what fell from h - 1 to h of local standard time. Years are those the records were taken from: they
// differ from month to month. Missing: 9999 of irradiance, 999900 and more of illuminance, 99.9 of the dew point.
// Source: EnergyPlus, Auxiliary Programs, "EnergyPlus Weather File (EPW) Data Dictionary".
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "photometry/sun.h"

namespace roomlight {

struct EpwHour {
  int month = 1, day = 1, hour = 1;  // 1..24
  std::optional<double> directNormalWm2, diffuseHorizontalWm2;
  std::optional<double> directNormalLux,
      diffuseHorizontalLux;  // none, too, where the file has a 0 beside irradiance above it
  std::optional<double> dewPointC;
};

struct Epw {
  std::string city;
  double latitudeDeg = 0, longitudeDeg = 0, utcOffsetHours = 0;
  std::vector<EpwHour> hours;
};

// The error names the line: "line 12: ..".
Result<Epw> parseEpw(std::string_view text);

// The hour of the year in which the moment falls, whatever its year is (29 February counts as the 28th); null: the file
// has none of it.
const EpwHour* hourAt(const Epw& weather, const Moment& moment);

}  // namespace roomlight
