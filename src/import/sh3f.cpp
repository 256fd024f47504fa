// Furniture libraries of Sweet Home 3D: a zip file with PluginFurnitureCatalog.properties, in which the keys of piece 7
// end in "#7" (name, model, width, depth, height, elevation in cm, lightSourceX ...), and the models that it names.
// Shown as a home: all pieces in rows on a floor, by day.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "import/failure.h"
#include "import/file_access.h"
#include "import/guarded.h"
#include "import/import.h"
#include "import/java_properties.h"
#include "import/sh3d_archive.h"
#include "import/sh3d_scene.h"
#include "import/warnings.h"

namespace roomlight {
namespace importers {
namespace {

using namespace sh3d;

constexpr const char* kCatalogue = "PluginFurnitureCatalog.properties";
constexpr size_t kMaxCatalogueBytes = size_t{16} << 20, kMaxPieces = 10'000;
constexpr double kGapCm = 50, kMarginCm = 100, kLargestCm = 1e5;
// A day in June, at noon in Greenwich's time on 48° north.
constexpr int64_t kNoonMs = 1'718'971'200'000;
constexpr double kLatitudeRad = 48 * std::numbers::pi / 180;
constexpr double kViewRad = 1.1;

using Properties = std::map<std::string, std::string>;

// The values of one piece.
class Entry {
 public:
  Entry(const Properties& all, size_t number) : all_(all), suffix_(fmt::format("#{}", number)) {}

  std::string text(const char* key) const {
    const auto it = all_.find(key + suffix_);
    return it == all_.end() ? std::string() : it->second;
  }

  // Numbers between blanks, within what a piece may measure; throws Failure where one is none.
  std::vector<double> numbers(const char* key) const {
    std::vector<double> out;
    for (const std::string& word : words(key)) {
      double v = 0;
      const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), v);
      if (code != std::errc() || end != word.data() + word.size() || !(std::abs(v) <= kLargestCm)) {
        fail(std::string(key) + suffix_, fmt::format("is '{}', no number of centimetres", printable(word, 40)));
      }
      out.push_back(v);
    }
    return out;
  }
  double number(const char* key, double absent) const {
    const std::vector<double> all = numbers(key);
    return all.empty() ? absent : all[0];
  }

  std::vector<std::string> words(const char* key) const {
    const std::string all = text(key);
    std::vector<std::string> out;
    for (size_t at = all.find_first_not_of(" \t"); at != std::string::npos; at = all.find_first_not_of(" \t", at)) {
      const size_t end = std::min(all.find_first_of(" \t", at), all.size());
      out.push_back(all.substr(at, end - at));
      at = end;
    }
    return out;
  }

 private:
  const Properties& all_;
  std::string suffix_;
};

// Places are those of the piece in cm, colours "#RRGGBB".
void readLights(const Entry& e, Piece& p) {
  const std::vector<double> x = e.numbers("lightSourceX"), y = e.numbers("lightSourceY"), z = e.numbers("lightSourceZ"),
                            diameter = e.numbers("lightSourceDiameter");
  const std::vector<std::string> colours = e.words("lightSourceColor");
  if (x.empty() || !(p.widthCm > 0 && p.depthCm > 0 && p.heightCm > 0)) return;
  if (y.size() != x.size() || z.size() != x.size() || colours.size() != x.size())
    fail(p.place, "the light sources have different numbers of places and colours");
  p.kind = PieceKind::Light;
  for (size_t i = 0; i < x.size(); ++i) {
    LightSource s;
    s.x = x[i] / p.widthCm, s.y = y[i] / p.depthCm, s.z = z[i] / p.heightCm;
    const std::string hex = colours[i].starts_with('#')    ? colours[i].substr(1)
                            : colours[i].starts_with("0x") ? colours[i].substr(2)
                                                           : colours[i];
    const auto [end, code] = std::from_chars(hex.data(), hex.data() + hex.size(), s.colour, 16);
    if (code != std::errc() || end != hex.data() + hex.size())
      fail(p.place, fmt::format("'{}' is no colour", printable(colours[i], 40)));
    s.colour &= 0xffffff;
    if (i < diameter.size()) s.diameter = diameter[i] / p.widthCm;
    p.lightSources.push_back(s);
  }
}

Piece readPiece(const Entry& e, size_t number) {
  Piece p;
  p.name = e.text("name");
  p.place = fmt::format("piece {} '{}'", number, printable(p.name, 40));
  p.widthCm = e.number("width", 0), p.depthCm = e.number("depth", 0), p.heightCm = e.number("height", 0);
  if (!(p.widthCm >= 0 && p.depthCm >= 0 && p.heightCm >= 0)) fail(p.place, "has a negative size");
  p.elevationCm = e.number("elevation", 0);
  p.model = e.text("model");
  p.model.erase(0, std::min(p.model.find_first_not_of('/'), p.model.size()));
  const std::vector<double> rotation = e.numbers("modelRotation");
  if (rotation.size() == p.modelRotation.size()) std::copy(rotation.begin(), rotation.end(), p.modelRotation.begin());
  p.modelFlags = static_cast<int>(std::clamp(e.number("modelFlags", 0), 0.0, 1e6));
  readLights(e, p);
  return p;
}

// Every number that some "name#<number>" has, in their order.
std::vector<size_t> numbersOf(const Properties& all) {
  std::vector<size_t> out;
  for (auto it = all.lower_bound("name#"); it != all.end() && it->first.starts_with("name#"); ++it) {
    const std::string& key = it->first;
    size_t number = 0;
    const auto [end, code] = std::from_chars(key.data() + 5, key.data() + key.size(), number);
    if (code == std::errc() && end == key.data() + key.size()) out.push_back(number);
  }
  std::sort(out.begin(), out.end());
  if (out.size() > kMaxPieces) fail(kCatalogue, fmt::format("holds more than {} pieces", kMaxPieces));
  return out;
}

// In rows about as long as all rows are deep, those of the deepest pieces first; returns the floor's other corner.
PlanPoint layOut(std::vector<Piece>& pieces) {
  std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.depthCm > b.depthCm; });
  double area = 0;
  for (const Piece& p : pieces) area += (p.widthCm + kGapCm) * (p.depthCm + kGapCm);
  const double rowCm = std::sqrt(area) * 1.2;
  double x = kMarginCm, y = kMarginCm, row = 0, right = 0;
  for (Piece& p : pieces) {
    if (x > kMarginCm && x + p.widthCm > kMarginCm + rowCm) y += row + kGapCm, x = kMarginCm, row = 0;
    p.centre = {x + p.widthCm / 2, y + p.depthCm / 2};
    x += p.widthCm + kGapCm;
    row = std::max(row, p.depthCm), right = std::max(right, x - kGapCm);
  }
  return {right + kMarginCm, y + row + kMarginCm};
}

Home showroom(const Properties& all, Warnings& warnings) {
  Home home;
  for (const size_t number : numbersOf(all)) {
    try {
      home.pieces.push_back(readPiece(Entry(all, number), number));
    } catch (const Failure& failure) {
      warnings.add(fmt::format("{}: left out: {}", kCatalogue, printable(failure.what(), 200)));
    }
  }
  if (home.pieces.empty()) fail(kCatalogue, "holds no pieces of furniture");
  const PlanPoint far = layOut(home.pieces);
  sh3d::Room floor;
  floor.name = "showroom", floor.ceilingVisible = false;
  floor.points = {{0, 0}, {far.x, 0}, far, {0, far.y}};
  home.rooms.push_back(floor);
  home.compass = Compass{0, kLatitudeRad, 0, "UTC"};
  // Over the whole floor, from the front.
  const double size = std::max(far.x, far.y);
  sh3d::Camera camera;
  camera.name = "showroom", camera.kind = home.camera = "observerCamera";
  camera.x = far.x / 2, camera.y = far.y + 0.35 * size, camera.z = 0.6 * size;
  camera.yawRad = std::numbers::pi, camera.pitchRad = std::atan2(camera.z, camera.y - far.y / 2);
  camera.fieldOfViewRad = kViewRad, camera.timeMs = kNoonMs;
  home.cameras.push_back(camera);
  return home;
}

Imported readSh3f(const std::filesystem::path& file, const ImportOptions& options) {
  const Bytes bytes = readWholeFile(file, "");
  const Archive archive(bytes, "");
  Warnings warnings;
  warnings.add("entries whose names lead out of the file are left out", archive.refused());
  const auto catalogue = archive.read(kCatalogue);
  if (!catalogue) fail("", fmt::format("holds no {}, so it is no furniture library of Sweet Home 3D", kCatalogue));
  if (catalogue->size() > kMaxCatalogueBytes)
    fail(kCatalogue, fmt::format("is larger than {} MiB", kMaxCatalogueBytes >> 20));
  const Home home = showroom(javaProperties(*catalogue), warnings);
  Scene scene = sceneOfHome(home, archive, ContentDigests(), options, warnings).scene;
  return importedScene(std::move(scene), warnings, StatedUnit::Certain);
}

}  // namespace
}  // namespace importers

Result<Imported> importSh3f(const std::filesystem::path& file, const ImportOptions& options) {
  return importers::guarded(file, [&] { return importers::readSh3f(file, options); });
}

}  // namespace roomlight
