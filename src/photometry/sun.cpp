#include "photometry/sun.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

namespace roomlight {
namespace {

constexpr double kRad = std::numbers::pi / 180;

// Days since 2000-01-01 12:00 UTC (J2000.0). Fliegel and van Flandern 1968.
double daysSinceJ2000(const Moment& t) {
  const int a = (t.month - 14) / 12;
  const int julianDay = 1461 * (t.year + 4800 + a) / 4 + 367 * (t.month - 2 - 12 * a) / 12 -
                        3 * ((t.year + 4900 + a) / 100) / 4 + t.day - 32075;
  return julianDay - 2451545 + (t.hour - 12) / 24;
}

int daysInMonth(int year, int month) {
  constexpr int kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
  return month == 2 && leap ? 29 : kDays[month - 1];
}

}  // namespace

Result<Moment> parseMoment(std::string_view text) {
  const std::string s(text);
  const Error wrong{fmt::format("'{}' is not a time; write for example '2026-06-21T14:30+02:00'", text)};
  int year, month, day, hour, minute, used = 0;
  if (std::sscanf(s.c_str(), "%4d-%2d-%2dT%2d:%2d%n", &year, &month, &day, &hour, &minute, &used) != 5) return wrong;
  double second = 0;
  std::string rest = s.substr(static_cast<size_t>(used));
  if (!rest.empty() && rest[0] == ':') {
    int whole;
    if (std::sscanf(rest.c_str(), ":%2d%n", &whole, &used) != 1) return wrong;
    second = whole;
    rest = rest.substr(static_cast<size_t>(used));
  }
  double offsetHours = 0;
  if (rest != "Z") {
    int h, m;
    char sign;
    if (std::sscanf(rest.c_str(), "%c%2d:%2d%n", &sign, &h, &m, &used) != 3 || (sign != '+' && sign != '-') ||
        static_cast<size_t>(used) != rest.size()) {
      return Error{fmt::format("'{}' has no offset from UTC; end it with 'Z' or for example '+02:00'", text)};
    }
    if (h < 0 || h > 14 || m < 0 || m > 59) return wrong;
    offsetHours = (sign == '-' ? -1 : 1) * (h + m / 60.0);
  }
  if (year < 1950 || year > 2050) return Error{fmt::format("'{}': the year must be from 1950 to 2050", text)};
  if (month < 1 || month > 12 || day < 1 || day > daysInMonth(year, month) || hour < 0 || hour > 23 || minute < 0 ||
      minute > 59 || second < 0 || second > 60)
    return wrong;
  return Moment{year, month, day, hour + minute / 60.0 + second / 3600 - offsetHours};
}

SunPosition sunPosition(const Moment& moment, double latitudeDeg, double longitudeDeg) {
  const double n = daysSinceJ2000(moment);
  const double meanLongitude = 280.460 + 0.9856474 * n, anomaly = (357.528 + 0.9856003 * n) * kRad;
  const double lambda = (meanLongitude + 1.915 * std::sin(anomaly) + 0.020 * std::sin(2 * anomaly)) * kRad;
  const double obliquity = (23.439 - 0.0000004 * n) * kRad;
  const double rightAscension = std::atan2(std::cos(obliquity) * std::sin(lambda), std::cos(lambda));
  const double declination = std::asin(std::sin(obliquity) * std::sin(lambda));
  const double siderealDeg = 15 * (18.697374558 + 24.06570982441908 * n) + longitudeDeg;
  const double hourAngle = siderealDeg * kRad - rightAscension, latitude = latitudeDeg * kRad;
  SunPosition p;
  p.altitudeRad = std::asin(std::sin(declination) * std::sin(latitude) +
                            std::cos(declination) * std::cos(latitude) * std::cos(hourAngle));
  const double east = -std::cos(declination) * std::sin(hourAngle);
  const double north =
      std::sin(declination) * std::cos(latitude) - std::cos(declination) * std::sin(latitude) * std::cos(hourAngle);
  p.bearingRad = std::atan2(east, north);
  if (p.bearingRad < 0) p.bearingRad += 2 * std::numbers::pi;
  return p;
}

double sunDistanceFactor(const Moment& moment) {
  const double dayOfYear = daysSinceJ2000(moment) - daysSinceJ2000({moment.year, 1, 1, 0}) + 1;
  return 1 + 0.034 * std::cos(2 * std::numbers::pi / 365 * (dayOfYear - 2));
}

double sunLux(const Moment& moment, double altitudeRad, double extinction) {
  const double s = std::sin(altitudeRad);
  return s > 0 ? 127.5e3 * sunDistanceFactor(moment) * std::exp(-extinction / s) : 0;
}

}  // namespace roomlight
