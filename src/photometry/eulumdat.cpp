// EULUMDAT in six lines: one value a line. 1 company, 2 kind, 3 symmetry (0 none, 1 rotation, 2 about C0-C180, 3 about
// C90-C270, 4 both), 4 and 5 count of C planes and degrees between them, 6 and 7 the same of gamma, 8 to 12 texts, 13
// to 15 size of the luminaire in mm, 16 and 17 length and width of the luminous area (width 0: a disc), 18 to 21 its
// heights, 22 and 23 downward flux and light output ratio in percent, 24 factor of the intensities, 25 tilt, 26 count
// of lamp sets; of each set: number of lamps (negative: absolute), kind, lumens of all, colour, rendering, watts; ten
// direct ratios; all C angles, all gammas, and the intensities in cd per 1000 lm of lamps, plane by plane, of the
// planes that symmetry leaves.
#include "photometry/web_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "photometry/web_planes.h"

namespace roomlight {
namespace {

using namespace photometric;

constexpr size_t kMostPlanes = 721, kMostGammas = 1801, kMostSets = 20;
constexpr size_t kDirectRatios = 10;
constexpr double kAngleSlackDeg = 0.01;

// Line by line.
class Items {
 public:
  Items(const std::vector<Line>& lines, Oddities& odd) : lines_(lines), odd_(odd) {}

  std::string text(const std::string& what) { return take(what).text; }
  // An empty line counts as `otherwise`.
  double numberOr(double otherwise, const std::string& what) {
    const Line& line = take(what);
    return line.text.empty() ? otherwise : number(line, what);
  }
  double number(const std::string& what) {
    const Line& line = take(what);
    if (line.text.empty()) damage(line.number, fmt::format("{} is missing", what));
    return number(line, what);
  }
  size_t count(const std::string& what, size_t low, size_t high) {
    const double v = number(what);
    if (!(v >= static_cast<double>(low) && v <= static_cast<double>(high)) || v != std::floor(v))
      damage(lineNumber(), fmt::format("{}: {} is not a whole number from {} to {}", what, v, low, high));
    return static_cast<size_t>(v);
  }
  // Where values follow each other, empty lines between them say nothing. At the end of the file, so many at most may
  // be missing: zeros.
  std::vector<double> numbers(size_t n, const std::string& what, size_t mayMiss = 0) {
    std::vector<double> out;
    out.reserve(std::min(n, lines_.size()));
    while (out.size() < n) {
      skipEmpty();
      if (at_ == lines_.size() && n - out.size() <= mayMiss) {
        odd_.add("the last values are missing; they count as 0");
        out.resize(n);
        break;
      }
      out.push_back(number(what));
    }
    return out;
  }
  size_t lineNumber() const { return at_ > 0 ? lines_[at_ - 1].number : 1; }
  bool atEnd() {
    while (at_ < lines_.size() && lines_[at_].text.empty()) ++at_;
    return at_ == lines_.size();
  }

 private:
  const Line& take(const std::string& what) {
    if (at_ == lines_.size())
      damage(lines_.empty() ? 1 : lines_.back().number, fmt::format("the file ends before {}", what));
    return lines_[at_++];
  }
  void skipEmpty() {
    const size_t from = at_;
    if (!atEnd() && at_ > from) odd_.add("empty lines between numbers are skipped");
  }
  double number(const Line& line, const std::string& what) {
    std::string s = line.text;
    if (const size_t comma = s.find(','); comma != std::string::npos) {
      odd_.add("numbers are written with a decimal comma");
      s[comma] = '.';
    }
    return numberIn(s, line.number, what);
  }

  const std::vector<Line>& lines_;
  Oddities& odd_;
  size_t at_ = 0;
};

struct Header {
  Symmetry symmetry = Symmetry::None;
  size_t planes = 0, gammas = 0, written = 0, firstWritten = 0;  // planes of the circle, and those with intensities
  double factor = 1;  // cd per value
};

constexpr Symmetry kSymmetries[] = {Symmetry::None, Symmetry::Rotation, Symmetry::AboutC0, Symmetry::AboutC90,
                                    Symmetry::Quadrants};

Header readSymmetry(Items& items) {
  Header h;
  h.symmetry = kSymmetries[items.count("line 3, the symmetry", 0, 4)];
  h.planes = items.count("line 4, the number of C planes", 1, kMostPlanes);
  const size_t planesLine = items.lineNumber();
  items.numberOr(0, "line 5, the distance of C planes");
  h.gammas = items.count("line 6, the number of gammas", 2, kMostGammas);
  items.numberOr(0, "line 7, the distance of gammas");
  const auto divides = [&](size_t n) {
    if (h.planes % n != 0)
      damage(planesLine,
             fmt::format("{} C planes do not fit this symmetry; their number must be a multiple of {}", h.planes, n));
  };
  switch (h.symmetry) {
    case Symmetry::None: h.written = h.planes; break;
    case Symmetry::Rotation: h.written = 1; break;
    case Symmetry::AboutC0: divides(2), h.written = h.planes / 2 + 1; break;
    case Symmetry::AboutC90:
      divides(4), h.written = h.planes / 2 + 1, h.firstWritten = 3 * h.planes / 4;
      break;  // from C270 by C0 to C90
    case Symmetry::Quadrants: divides(4), h.written = h.planes / 4 + 1; break;
  }
  return h;
}

// The first set of lamps counts. Sizes in mm: the length lies along C90-C270 (CIE 121: C0 looks across the luminaire's
// long axis).
void readLuminaire(Items& items, Header& h, PhotometricWeb& web, Oddities& odd) {
  const auto millimetres = [&](const char* what) {
    const double v = items.numberOr(0, what);
    if (v < 0 || v > 1e6) damage(items.lineNumber(), fmt::format("{}: {} mm is not between 0 and 1 km", what, v));
    return static_cast<float>(v / 1000);
  };
  items.text("line 8, the report");
  web.name = items.text("line 9, the luminaire's name");
  for (const char* what : {"line 10, the luminaire's number", "line 11, the file's name", "line 12, the date"})
    items.text(what);
  for (const char* what : {"line 13, the length", "line 14, the width", "line 15, the height"}) millimetres(what);
  const float length = millimetres("line 16, the length of the luminous area"),
              width = millimetres("line 17, the width of the luminous area");
  web.round = length > 0 && width == 0;
  web.sizeC90M = length, web.sizeC0M = web.round ? length : width;
  if (!web.hasOpening()) web.sizeC0M = web.sizeC90M = 0;
  for (const char* what : {"line 18, the height of the luminous area", "line 19, the height of the luminous area",
                           "line 20, the height of the luminous area", "line 21, the height of the luminous area"}) {
    web.heightM = std::max(web.heightM, millimetres(what));
  }
  items.numberOr(0, "line 22, the downward flux");
  double outputRatio = items.numberOr(100, "line 23, the light output ratio");
  double factor = items.numberOr(1, "line 24, the factor of intensities");
  if (factor == 0) odd.add("the factor of intensities is 0; read as 1"), factor = 1;
  if (factor < 0) damage(items.lineNumber(), "line 24, the factor of intensities, is negative");
  if (items.numberOr(0, "line 25, the tilt at measurement") != 0)
    odd.add("was measured tilted; the tilt is not turned back");

  const size_t sets = items.count("line 26, the number of lamp sets", 1, kMostSets);
  if (sets > 1) odd.add(fmt::format("has {} sets of lamps; the first counts", sets));
  for (size_t i = 0; i < sets; ++i) {
    const double lamps = items.numberOr(1, "the number of lamps");
    items.text("the kind of lamps");
    const double lumens = items.number("the flux of the lamps");
    const size_t fluxLine = items.lineNumber();
    items.text("the colour of the lamps"), items.text("the rendering group of the lamps");
    // Text stands here in some files.
    const double watts = items.numberOr(0, "the watts of the lamps");
    if (i > 0) continue;
    if (!(lumens > 0))
      damage(fluxLine,
             fmt::format("the flux of the lamps is {} lm; without it intensities in cd/klm mean nothing", lumens));
    h.factor = factor * lumens / 1000;
    web.watts = watts;
    // Absolute: the flux is the luminaire's.
    if (lamps < 0) outputRatio = 100;
    web.statedFluxLm = lumens * outputRatio / 100;
  }
}

// C angles of the planes with intensities. Where the list makes no sense for the symmetry, planes are evenly spaced.
std::vector<double> writtenAngles(const Header& h, const std::vector<double>& listed, size_t line, Oddities& odd) {
  const double step = 360 / static_cast<double>(h.planes);
  std::vector<double> out;
  bool sound = true;
  for (size_t k = 0; k < h.written; ++k) {
    const size_t i = (h.firstWritten + k) % h.planes;
    double c = listed[i];
    if (c < -360 - kAngleSlackDeg || c > 360 + kAngleSlackDeg)
      damage(line, fmt::format("C angle {} is not between 0 and 360", c));
    // From C270 upwards: what follows C0 lies beyond 360.
    if (h.symmetry == Symmetry::AboutC90 && c < 180) c += 360;
    out.push_back(c);
  }
  const auto is = [](double a, double b) { return std::abs(a - b) <= kAngleSlackDeg; };
  if (h.symmetry == Symmetry::AboutC0) sound = is(out.front(), 0) && is(out.back(), 180);
  if (h.symmetry == Symmetry::AboutC90) sound = is(out.front(), 270) && is(out.back(), 450);
  if (h.symmetry == Symmetry::Quadrants) sound = is(out.front(), 0) && is(out.back(), 90);
  if (h.symmetry != Symmetry::None) sound = sound && std::is_sorted(out.begin(), out.end());
  if (sound) return out;
  odd.add("the C angles do not fit the symmetry; planes are taken as evenly spaced");
  for (size_t k = 0; k < h.written; ++k) out[k] = step * static_cast<double>(h.firstWritten + k);
  return out;
}

void readIntensities(Items& items, const Header& h, PhotometricWeb& web, Oddities& odd) {
  items.numbers(kDirectRatios, "the direct ratios");
  const std::vector<double> listed = items.numbers(h.planes, "the C angles");
  Planes planes;
  planes.line = items.lineNumber();
  planes.angleDeg =
      h.symmetry == Symmetry::Rotation ? std::vector<double>{0} : writtenAngles(h, listed, planes.line, odd);
  planes.inPlaneDeg = items.numbers(h.gammas, "the gammas");
  checkAngles(planes.inPlaneDeg, items.lineNumber(), "gamma", 0, 180);
  for (size_t k = 0; k < h.written; ++k) {
    const size_t mayMiss = k + 1 == h.written ? std::max<size_t>(1, h.gammas / 50) : 0;
    std::vector<double>& plane = planes.candela.emplace_back(
        items.numbers(h.gammas, fmt::format("the intensities of plane {}", k + 1), mayMiss));
    for (double& v : plane) {
      if (v < 0) odd.add("negative intensities count as 0");
      v = std::max(0.0, v) * h.factor;
      if (v > 1e12) damage(items.lineNumber(), "an intensity is above 1e12 cd");
    }
  }
  if (!items.atEnd()) odd.add("goes on after the last intensity; the rest is ignored");
  fillWeb(std::move(planes), h.symmetry, web, odd);
}

}  // namespace

Result<WebFile> parseEulumdat(std::string_view text) {
  try {
    WebFile out;
    Oddities odd;
    const std::vector<Line> lines = linesOf(text, odd);
    if (lines.empty()) damage(0, "is empty");
    Items items(lines, odd);
    out.web.manufacturer = items.text("line 1, the company");
    items.numberOr(0, "line 2, the kind of luminaire");
    Header header = readSymmetry(items);
    readLuminaire(items, header, out.web, odd);
    readIntensities(items, header, out.web, odd);
    out.web.format = "EULUMDAT";
    checkFlux(out.web, "the luminaire", odd);
    out.warnings = odd.lines();
    return out;
  } catch (const Damage& d) {
    return Error{d.what()};
  }
}

}  // namespace roomlight
