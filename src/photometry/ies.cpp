// LM-63 in six lines: a first line that names the edition (none in 1986); lines of text, from 1991 on "[KEYWORD] text";
// TILT=NONE, TILT=INCLUDE with a table, or TILT=<file>; then numbers, separated by blanks, commas or line ends: lamps,
// lumens per lamp (-1: absolute), multiplier, count of vertical and of horizontal angles, type 1 C, 2 B, 3 A, unit 1
// feet, 2 metres, width, length, height of the opening; ballast factor, ballast-lamp factor (until 1995), watts;
// vertical angles, horizontal angles, and candela for every vertical angle of the first horizontal one, of the second,
// and so on.
#include "photometry/web_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "photometry/web_planes.h"

namespace roomlight {
namespace {

using namespace photometric;

constexpr double kMetresPerFoot = 0.3048;
constexpr size_t kMostAngles = 4000;
constexpr double kAngleSlackDeg = 0.01;

std::string upper(std::string_view s) {
  std::string out(s);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return out;
}

// Without blanks around it.
std::string inner(std::string_view s) {
  const size_t from = s.find_first_not_of(" \t"), to = s.find_last_not_of(" \t");
  return from == std::string_view::npos ? std::string() : std::string(s.substr(from, to - from + 1));
}

struct Edition {
  const char* name;
  int year;
};

Edition editionOf(const std::string& firstLine, Oddities& odd) {
  const std::string s = upper(firstLine);
  if (s.starts_with("IESNA91")) return {"1991", 1991};
  if (s.starts_with("IESNA:LM-63-1995") || s.starts_with("IESNA95")) return {"1995", 1995};
  if (s.starts_with("IESNA:LM-63-2002")) return {"2002", 2002};
  if (s.starts_with("IES:LM-63-2019")) return {"2019", 2019};
  if (!s.starts_with("IES")) return {"1986", 1986};
  odd.add(fmt::format("'{}' names no known edition; read as LM-63-2002", firstLine.substr(0, 40)));
  return {"2002", 2002};
}

// Names from the lines before TILT=; returns the index of that line and what stands behind the sign.
std::pair<size_t, std::string> readHeader(const std::vector<Line>& lines, const Edition& edition, PhotometricWeb& web) {
  std::string catalogue;
  for (size_t i = 0; i < lines.size(); ++i) {
    const std::string& s = lines[i].text;
    if (upper(s).starts_with("TILT")) {
      const size_t sign = s.find('=');
      if (sign != std::string::npos && inner(s.substr(4, sign - 4)).empty()) {
        if (web.name.empty()) web.name = catalogue;
        return {i, inner(s.substr(sign + 1))};
      }
    }
    const size_t close = s.find(']');
    if (s.starts_with('[') && close != std::string::npos) {
      const std::string key = upper(s.substr(1, close - 1)), value = inner(s.substr(close + 1));
      if (key == "LUMINAIRE" && web.name.empty()) web.name = value;
      if (key == "MANUFAC" && web.manufacturer.empty()) web.manufacturer = value;
      if (key == "LUMCAT" && catalogue.empty()) catalogue = value;
    } else if (edition.year == 1986 && web.name.empty()) {
      web.name = s;
    }
  }
  damage(lines.empty() ? 1 : lines.back().number, "there is no line TILT=; this is no IES file, or it is cut short");
}

// How the lamp stands in the luminaire, angles, and what part of the flux is left at each.
void readTiltTable(Words& words, PhotometricWeb& web) {
  words.number("the lamp-to-luminaire geometry of TILT");
  const size_t count = words.count("the number of tilt angles", kMostAngles);
  std::vector<double> angles = words.numbers(count, "tilt angles");
  checkAngles(angles, words.lineNumber(), "tilt angle", 0, 180);
  for (const double a : angles) web.tiltRad.push_back(static_cast<float>(a * kPi / 180));
  for (const double f : words.numbers(count, "tilt factors")) {
    if (f < 0 || f > 10) damage(words.lineNumber(), fmt::format("tilt factor {} is not between 0 and 10", f));
    web.tiltFactor.push_back(static_cast<float>(f));
  }
}

void readTilt(const std::string& tilt, const Line& line, const TiltFile& tiltFile, Words& words, PhotometricWeb& web,
              Oddities& odd) {
  const std::string kind = upper(tilt);
  if (kind == "NONE") return;
  if (kind == "INCLUDE") return readTiltTable(words, web);
  if (tilt.empty()) damage(line.number, "TILT= must be followed by NONE, INCLUDE or the name of a file");
  const Result<std::string> text = tiltFile ? tiltFile(tilt) : Error{"files beside it are not read"};
  if (!text) damage(line.number, fmt::format("TILT file: {}", text.error()));
  try {
    const std::vector<Line> lines = linesOf(text.value(), odd);
    Words table(lines, 0);
    readTiltTable(table, web);
  } catch (const Damage& d) {
    damage(line.number, fmt::format("TILT file: {}", d.what()));
  }
}

// Length lies along C0-C180, width across; a negative number means that the shape is round there (LM-63-2002, luminous
// openings).
void readOpening(double width, double length, double height, double metres, PhotometricWeb& web) {
  const bool round = width < 0 || length < 0;
  // Files of 1986 and 1991 write a disc as one negative diameter.
  if (round && width == 0) width = length;
  if (round && length == 0) length = width;
  // One negative only is a lying cylinder, whose outline is a rectangle.
  web.round = width < 0 && length < 0;
  web.sizeC0M = static_cast<float>(std::abs(length) * metres);
  web.sizeC90M = static_cast<float>(std::abs(width) * metres);
  web.heightM = static_cast<float>(std::abs(height) * metres);
  if (!web.hasOpening()) web.sizeC0M = web.sizeC90M = 0;
}

Symmetry symmetryOf(const std::vector<double>& c, size_t line, Oddities& odd) {
  const auto is = [](double a, double b) { return std::abs(a - b) <= kAngleSlackDeg; };
  const double first = c.front(), last = c.back();
  if (c.size() == 1) return Symmetry::Rotation;
  if (is(first, 90) && is(last, 270)) return Symmetry::AboutC90;
  if (is(first, 0) && is(last, 90)) return Symmetry::Quadrants;
  if (is(first, 0) && is(last, 180)) return Symmetry::AboutC0;
  if (is(first, 0) && is(last, 360)) return Symmetry::None;
  if (is(first, -90) && is(last, 90))
    return odd.add("horizontal angles go from -90 to 90; read as symmetric about C90-C270"), Symmetry::AboutC90;
  if (last - first > 180)
    return odd.add(fmt::format("horizontal angles end at {}; the circle is closed", last)), Symmetry::None;
  damage(line,
         fmt::format("horizontal angles from {} to {} do not tell what is symmetric; they end at 0, 90, 180 or 360",
                     first, last));
}

std::vector<std::vector<double>> readCandela(Words& words, size_t planes, size_t inPlane, double factor,
                                             Oddities& odd) {
  std::vector<std::vector<double>> out;
  for (size_t i = 0; i < planes; ++i) {
    std::vector<double>& plane =
        out.emplace_back(words.numbers(inPlane, fmt::format("candela of horizontal angle {}", i + 1)));
    for (double& v : plane) {
      if (v < 0) odd.add("negative candela count as 0");
      v = std::max(0.0, v) * factor;
      if (v > 1e12) damage(words.lineNumber(), "an intensity is above 1e12 cd");
    }
  }
  return out;
}

void readWeb(Words& words, const Edition& edition, PhotometricWeb& web, Oddities& odd) {
  const size_t lamps = words.count("the number of lamps", 100'000);
  const double lumens = words.number("lumens per lamp"), multiplier = words.number("the multiplier");
  const size_t vertical = words.count("the number of vertical angles", kMostAngles),
               horizontal = words.count("the number of horizontal angles", kMostAngles);
  const size_t type = words.count("the photometric type", 3), unit = words.count("the unit of lengths", 2);
  const double width = words.number("the width"), length = words.number("the length"),
               height = words.number("the height");
  const double ballast = words.number("the ballast factor"), ballastLamp = words.number("the ballast-lamp factor");
  web.watts = words.number("the watts");
  const double metres = unit == 1 ? kMetresPerFoot : 1;
  if (std::max({std::abs(width), std::abs(length), std::abs(height)}) * metres > 1000)
    damage(words.lineNumber(), "the opening is larger than 1 km");
  readOpening(width, length, height, metres, web);
  // Since 2002 the second factor is set aside, and in 2019 tells how the file was made.
  const double factor = multiplier * ballast * (edition.year <= 1995 ? ballastLamp : 1);
  if (!(factor > 0))
    damage(words.lineNumber(),
           fmt::format("the multiplier times the ballast factors is {}; it must be above 0", factor));
  if (vertical < 2) damage(words.lineNumber(), "there must be two vertical angles or more");

  Planes planes;
  planes.inPlaneDeg = words.numbers(vertical, "vertical angles");
  checkAngles(planes.inPlaneDeg, words.lineNumber(), "vertical angle", type == 1 ? 0 : -90, type == 1 ? 180 : 90);
  planes.angleDeg = words.numbers(horizontal, "horizontal angles");
  planes.line = words.lineNumber();
  checkAngles(planes.angleDeg, planes.line, "horizontal angle", type == 1 ? -90 : -180, type == 1 ? 360 : 180);
  if (horizontal * vertical > words.left())
    damage(words.lineNumber(),
           fmt::format("{} intensities should follow, but the file is too short", horizontal * vertical));
  planes.candela = readCandela(words, horizontal, vertical, factor, odd);
  if (!words.atEnd()) odd.add("goes on after the last intensity; the rest is ignored");
  if (type == 1) {
    const Symmetry symmetry = symmetryOf(planes.angleDeg, planes.line, odd);
    fillWeb(std::move(planes), symmetry, web, odd);
  } else {
    if (horizontal < 2) damage(planes.line, "types A and B need two horizontal angles or more");
    resampleWeb(planes, type == 2 ? System::B : System::A, web);
  }
  const double stated = static_cast<double>(lamps) * lumens * ballast;
  web.statedFluxLm = lumens > 0 ? stated : 0;
  web.format = fmt::format("IES LM-63-{}, type {}", edition.name, "CBA"[type - 1]);
  checkFlux(web, lumens > 0 ? "its lamps" : "", odd);
}

}  // namespace

Result<WebFile> parseIes(std::string_view text, const TiltFile& tiltFile) {
  try {
    WebFile out;
    Oddities odd;
    const std::vector<Line> lines = linesOf(text, odd);
    if (lines.empty()) damage(0, "is empty");
    const Edition edition = editionOf(lines.front().text, odd);
    const auto [tiltLine, tilt] = readHeader(lines, edition, out.web);
    Words words(lines, tiltLine + 1);
    readTilt(tilt, lines[tiltLine], tiltFile, words, out.web, odd);
    readWeb(words, edition, out.web, odd);
    out.warnings = odd.lines();
    return out;
  } catch (const Damage& d) {
    return Error{d.what()};
  }
}

}  // namespace roomlight
