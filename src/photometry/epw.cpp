#include "photometry/epw.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace roomlight {
namespace {

constexpr size_t kHeaderFields = 10, kDataFields = 22, kMostHours = 1'000'000;

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && (s.front() == ' ' || s.front() == '\t')) s.remove_prefix(1);
  while (!s.empty() && (s.back() == ' ' || s.back() == '\t' || s.back() == '\r')) s.remove_suffix(1);
  return s;
}

std::vector<std::string_view> fieldsOf(std::string_view line) {
  std::vector<std::string_view> fields;
  for (size_t begin = 0; begin <= line.size();) {
    const size_t end = std::min(line.find(',', begin), line.size());
    fields.push_back(trimmed(line.substr(begin, end - begin)));
    begin = end + 1;
  }
  return fields;
}

// Reads the fields of one record; the first thing wrong is kept.
class Record {
 public:
  Record(std::string_view line, size_t number) : fields_(fieldsOf(line)), number_(number) {}

  size_t size() const { return fields_.size(); }
  std::string_view text(size_t i) const { return i < fields_.size() ? fields_[i] : std::string_view(); }
  double number(size_t i, const char* what, double low, double high) {
    double v = 0;
    const std::string_view s = text(i);
    const auto [end, code] = std::from_chars(s.data(), s.data() + s.size(), v);
    if (s.empty() || code != std::errc() || end != s.data() + s.size() || !std::isfinite(v)) {
      fail(fmt::format("field {} ({}) is not a number", i + 1, what));
    } else if (v < low || v > high) {
      fail(fmt::format("field {} ({}) is {}; it must be from {} to {}", i + 1, what, v, low, high));
    } else {
      return v;
    }
    return low;
  }
  std::optional<double> measured(size_t i, const char* what, double low, double high, double missing) {
    const double v = number(i, what, -1e9, 1e9);
    if (v >= missing) return {};
    if (v < low || v > high)
      fail(fmt::format("field {} ({}) is {}; it must be from {} to {}", i + 1, what, v, low, high));
    return v;
  }
  void fail(const std::string& what) {
    if (error_.empty()) error_ = fmt::format("line {}: {}", number_, what);
  }
  const std::string& error() const { return error_; }

 private:
  std::vector<std::string_view> fields_;
  size_t number_;
  std::string error_;
};

EpwHour readHour(Record& r) {
  EpwHour h;
  if (r.size() < kDataFields) r.fail(fmt::format("has {} fields; an hour has {} or more", r.size(), kDataFields));
  h.month = static_cast<int>(r.number(1, "month", 1, 12));
  h.day = static_cast<int>(r.number(2, "day", 1, 31));
  h.hour = static_cast<int>(r.number(3, "hour", 1, 24));
  h.dewPointC = r.measured(7, "dew point", -100, 70, 99.9);
  h.directNormalWm2 = r.measured(14, "direct normal irradiance", 0, 9999, 9999);
  h.diffuseHorizontalWm2 = r.measured(15, "diffuse horizontal irradiance", 0, 9999, 9999);
  h.directNormalLux = r.measured(17, "direct normal illuminance", 0, 999900, 999900);
  h.diffuseHorizontalLux = r.measured(18, "diffuse horizontal illuminance", 0, 999900, 999900);
  // Many files have nothing but zeros there.
  if (h.directNormalLux == 0 && h.directNormalWm2.value_or(0) > 0) h.directNormalLux.reset();
  if (h.diffuseHorizontalLux == 0 && h.diffuseHorizontalWm2.value_or(0) > 0) h.diffuseHorizontalLux.reset();
  return h;
}

std::string readLocation(Record& r, Epw& out) {
  if (r.text(0) != "LOCATION") return "line 1: does not begin with 'LOCATION'; this is no .epw weather file";
  if (r.size() < kHeaderFields) r.fail(fmt::format("has {} fields; LOCATION has {}", r.size(), kHeaderFields));
  out.city = r.text(1);
  out.latitudeDeg = r.number(6, "latitude", -90, 90);
  out.longitudeDeg = r.number(7, "longitude", -180, 180);
  out.utcOffsetHours = r.number(8, "hours from UTC", -14, 14);
  return r.error();
}

}  // namespace

Result<Epw> parseEpw(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  Epw out;
  bool inData = false;
  size_t number = 0;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = trimmed(text.substr(begin, end - begin));
    begin = end + 1;
    ++number;
    if (number > 1 && !inData) {
      inData = line.starts_with("DATA PERIODS");
      continue;
    }
    if (line.empty() && number > 1) continue;
    Record record(line, number);
    if (number == 1) {
      if (const std::string error = readLocation(record, out); !error.empty()) return Error{error};
      continue;
    }
    if (out.hours.size() == kMostHours) return Error{fmt::format("line {}: more than {} hours", number, kMostHours)};
    out.hours.push_back(readHour(record));
    if (!record.error().empty()) return Error{record.error()};
  }
  if (number == 0) return Error{"line 1: does not begin with 'LOCATION'; this is no .epw weather file"};
  if (out.hours.empty())
    return Error{fmt::format("line {}: the file ends without an hour of weather after 'DATA PERIODS'", number)};
  return out;
}

const EpwHour* hourAt(const Epw& weather, const Moment& moment) {
  constexpr std::array<int, 12> kDays{31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  int day = std::min(moment.day, kDays[static_cast<size_t>(moment.month - 1)]) - 1;
  for (int m = 1; m < moment.month; ++m) day += kDays[static_cast<size_t>(m - 1)];
  const double hours = day * 24 + moment.hour + weather.utcOffsetHours;
  const int ofYear = ((static_cast<int>(std::floor(hours)) % 8760) + 8760) % 8760;
  int month = 1, left = ofYear / 24;
  for (; left >= kDays[static_cast<size_t>(month - 1)]; ++month) left -= kDays[static_cast<size_t>(month - 1)];
  const auto isIt = [&](const EpwHour& h) {
    return h.month == month && h.day == left + 1 && h.hour == ofYear % 24 + 1;
  };
  const auto it = std::find_if(weather.hours.begin(), weather.hours.end(), isIt);
  return it == weather.hours.end() ? nullptr : &*it;
}

}  // namespace roomlight
