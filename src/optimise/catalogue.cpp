#include "optimise/catalogue.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/utf8.h"
#include "import/photometric_file.h"
#include "photometry/colour_temperature.h"

namespace roomlight::optimise {
namespace {

constexpr double kMostLumen = 1e6, kMostWatts = 1e5, kMostPrice = 1e7;
constexpr double kTuningSteps[] = {1800, 2200, 2700, 3000, 3500, 4000, 5000, 5700, 6500};

std::vector<double> kelvins(const TomlPlace& j) {
  std::vector<double> out;
  if (j.has("tunable")) {
    const TomlPlace range = j["tunable"];
    if (range.size() != 2)
      return range.fail("must be [coldest \"K\", warmest \"K\"] of two texts, such as [\"2200 K\", \"4000 K\"]"),
             std::vector<double>{3000};
    const double low = range.at(0).quantity(Unit::Kelvin, kLowestKelvin, kHighestKelvin),
                 high = range.at(1).quantity(Unit::Kelvin, kLowestKelvin, kHighestKelvin);
    if (low >= high) range.fail("must rise");
    out.push_back(low);
    for (const double step : kTuningSteps) {
      if (step > low && step < high) out.push_back(step);
    }
    out.push_back(high);
    if (j.has("kelvin")) j["kelvin"].fail("means nothing beside 'tunable'");
    return out;
  }
  if (!j.has("kelvin")) return {3000};
  const TomlPlace k = j["kelvin"];
  if (!k.isArray()) return {k.quantity(Unit::Kelvin, kLowestKelvin, kHighestKelvin)};
  for (size_t i = 0, n = k.size(); i < n; ++i)
    out.push_back(k.at(i).quantity(Unit::Kelvin, kLowestKelvin, kHighestKelvin));
  if (out.empty()) k.fail("must not be empty");
  return out;
}

Luminaire readLuminaire(const TomlPlace& j, const std::filesystem::path& folder, importers::PhotometricFiles& files) {
  Luminaire l;
  l.line = j.line();
  if (!j.isTable({"name", "type", "file", "flux", "beam", "watts", "standby", "price", "kelvin", "tunable", "dimmable",
                  "mounting", "size", "fromWalls", "drop", "comment"}))
    return l;
  l.name = j["name"].text();
  if (j.has("type")) l.type = j["type"].oneOf({"photometric", "point", "spot"});
  if (l.type == "photometric") {
    const TomlPlace file = j["file"];
    l.file = std::filesystem::absolute(folder / file.text()).lexically_normal();
    const auto web = files.read(l.file);
    if (!web) file.fail(fmt::format("'{}': {}", printable(file.text()), printable(web.error(), 300)));
    if (web && !j.has("watts")) l.wattsW = web.value()->watts;
  } else if (j.has("file")) {
    j["file"].fail(fmt::format("means nothing for type {}", l.type));
  }
  if (j.has("flux") || l.type != "photometric") l.fluxLm = j["flux"].quantity(Unit::Lumen, 1e-3, kMostLumen);
  if (j.has("beam") && l.type != "spot") j["beam"].fail(fmt::format("means nothing for type {}", l.type));
  l.beamDeg = j.number("beam", 2, 90, l.beamDeg);
  if (j.has("watts") || l.wattsW <= 0) l.wattsW = j["watts"].number(1e-3, kMostWatts);
  l.standbyW = j.number("standby", 0, kMostWatts, 0);
  l.price = j["price"].number(0, kMostPrice);
  l.kelvin = kelvins(j);
  l.dimmable = j.flag("dimmable", true);
  const TomlPlace mounting = j["mounting"];
  for (const std::string& name : mounting.texts()) {
    const auto m = mountingNamed(name);
    if (!m)
      mounting.fail(fmt::format("must be of 'ceiling', 'wall', 'table', 'floor', but there is '{}'", printable(name)));
    if (m) l.mountings.push_back(*m);
  }
  if (l.mountings.empty()) mounting.fail("must name at least one");
  l.sizeM = j.number("size", 0, 10, l.sizeM), l.fromWallsM = j.number("fromWalls", 0, 10, 0),
  l.dropM = j.number("drop", 0.005, 5, l.dropM);
  return l;
}

}  // namespace

const char* nameOf(Mounting mounting) {
  switch (mounting) {
    case Mounting::Ceiling: return "ceiling";
    case Mounting::Wall: return "wall";
    case Mounting::Table: return "table";
    case Mounting::Floor: return "floor";
  }
  return "";
}

std::optional<Mounting> mountingNamed(const std::string& name) {
  for (const Mounting m : {Mounting::Ceiling, Mounting::Wall, Mounting::Table, Mounting::Floor}) {
    if (name == nameOf(m)) return m;
  }
  return std::nullopt;
}

const Luminaire* Catalogue::find(const std::string& name) const {
  const auto l = std::find_if(luminaires.begin(), luminaires.end(), [&](const Luminaire& x) { return x.name == name; });
  return l == luminaires.end() ? nullptr : &*l;
}

std::string Catalogue::names() const {
  std::string out;
  for (const Luminaire& l : luminaires) out += (out.empty() ? "'" : ", '") + l.name + "'";
  return out;
}

Result<Catalogue> readCatalogue(const std::filesystem::path& file) {
  const Result<TomlNode> tree = readToml(file);
  if (!tree) return Error{tree.error()};
  TomlError error{file.string(), {}};
  const TomlPlace root(tree.value(), "", error);
  Catalogue out;
  out.file = file;
  importers::PhotometricFiles files;
  if (root.isTable({"version", "comment", "currency", "luminaire"})) {
    if (root.has("version")) root["version"].number(1, 1);
    out.currency = root.text("currency", out.currency);
    const TomlPlace list = root["luminaire"];
    for (size_t i = 0, n = list.size(); i < n; ++i) {
      Luminaire l = readLuminaire(list.at(i), file.parent_path(), files);
      if (out.find(l.name)) list.at(i).fail(fmt::format("the name '{}' is there twice", printable(l.name)));
      out.luminaires.push_back(std::move(l));
    }
    if (out.luminaires.empty()) root.fail("has no luminaire");
  }
  if (!error.first.empty()) return Error{error.first};
  return out;
}

nlohmann::json lampEntry(const Luminaire& l, Vec3 position, Vec3 direction) {
  const auto list = [](Vec3 v) {
    const auto rounded = [](float x) { return std::round(static_cast<double>(x) * 1e5) / 1e5; };
    return nlohmann::json{rounded(v.x), rounded(v.y), rounded(v.z)};
  };
  nlohmann::json lamp = {{"name", l.name}, {"position", list(position)}, {"watts", l.wattsW}};
  if (l.fluxLm > 0) lamp["flux"] = fmt::format("{:.6g} lm", l.fluxLm);
  if (l.type == "point") {
    lamp["type"] = "point";
    return lamp;
  }
  lamp["direction"] = list(direction);
  if (l.type == "photometric") {
    lamp["type"] = "photometric", lamp["file"] = l.file.string();
    return lamp;
  }
  lamp["type"] = "spot";
  // Half of the peak at half of the beam: t² = 1/2 where t = (cos θ − cos outer) / (1 − cos outer).
  const double half = std::cos(l.beamDeg / 2 * static_cast<double>(kPi) / 180),
               outer = (half - std::sqrt(0.5)) / (1 - std::sqrt(0.5));
  lamp["innerCone"] = 0,
  lamp["outerCone"] = std::clamp(std::acos(std::clamp(outer, 0.0, 1.0)) * 180 / static_cast<double>(kPi), 0.5, 90.0);
  return lamp;
}

}  // namespace roomlight::optimise
