// A small room with a study of it, for tests.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "optimise/candidates.h"
#include "optimise/meters.h"
#include "optimise/model.h"
#include "scene/primitives.h"
#include "unit/temporary_folder.h"

namespace roomlight::testing {

constexpr const char* kCatalogue = R"(
currency = "EUR"
[[luminaire]]
name = "Bulb"
type = "point"
flux = "800 lm"
watts = 8
price = 20
kelvin = "3000 K"
mounting = ["ceiling", "table"]
size = 0.1
drop = 0.3
[[luminaire]]
name = "Spot"
type = "spot"
flux = "500 lm"
beam = 60
watts = 6
price = 40
kelvin = ["3000 K", "4000 K"]
mounting = ["ceiling"]
size = 0.1
drop = 0.05
[[luminaire]]
name = "Wall light"
type = "spot"
flux = "300 lm"
beam = 80
watts = 4
price = 30
mounting = ["wall"]
size = 0.1
drop = 0.1
)";

constexpr const char* kStudy = R"(
catalogue = "catalogue.toml"
objectives = ["targetMiss", "energy", "cost"]
[[condition]]
name = "night"
daylight = "none"
hours = 1000
[[zone]]
name = "Room"
room = "Room"
mean = "100 lx"
uniformity = 0.4
spacing = 0.8
[[eye]]
name = "Chair"
position = [0.5, 1.2, 2]
lookAt = [4, 1.2, 2]
ugr = 19
[[place]]
name = "Ceiling"
on = "ceiling"
room = "Room"
luminaires = ["Bulb", "Spot"]
spacing = 1.5
fromWalls = 0.8
apart = 0.5
[[place]]
name = "Wall"
on = "wall"
room = "Room"
luminaires = ["Wall light"]
aims = ["up", "out"]
spacing = 2
height = 1.8
)";

// 5 × 2.6 × 4 m, white walls, a table in a corner.
inline Scene smallRoom() {
  Scene scene;
  const int white = addMaterial(scene, lambertian(0.7f)), wood = addMaterial(scene, lambertian(0.4f));
  addRoom(scene, {0, 0, 0}, {5, 2.6f, 4}, {white, white, wood, white, white, white});
  addBox(scene, {3.8f, 0, 0.1f}, {4.8f, 0.7f, 0.9f}, wood);
  Room room;
  room.name = "Room", room.floor = {{0, 0}, {0, 4}, {5, 4}, {5, 0}}, room.heightM = 2.6f;
  scene.rooms.push_back(room);
  return scene;
}

// A study read from text, beside kCatalogue.
class SmallStudy {
 public:
  explicit SmallStudy(const std::string& study = kStudy, const std::string& catalogue = kCatalogue)
      : home(smallRoom()) {
    writeFile(folder_ / "catalogue.toml", catalogue);
    writeFile(folder_ / "study.toml", study);
    read = optimise::readStudy(folder_ / "study.toml", home.rooms);
  }
  const optimise::StudyFile& study() const { return read.value(); }
  const std::filesystem::path& folder() const { return folder_.path(); }

  Scene home;
  Result<optimise::StudyFile> read = Error{""};

 private:
  TemporaryFolder folder_;
};

// A response made up: lamps that light as the distance says, so that no light has to be computed.
inline optimise::Response simpleResponse(const optimise::StudyFile& study, const optimise::Candidates& candidates,
                                         const optimise::Meters& meters) {
  optimise::Response r;
  r.elements = meters.elements.size(), r.eyes = study.eyes.size();
  for (const optimise::Candidate& c : candidates.candidates) {
    const double flux = study.catalogue.luminaires[c.luminaire].fluxLm;
    for (const SurfaceElement& e : meters.elements) {
      const Vec3 to = c.position - e.position;
      const float d2 = std::max(0.05f, dot(to, to));
      r.lux.push_back(
          Vec3(static_cast<float>(flux) * (std::max(0.0f, dot(normalize(to), e.normal)) / (12 * d2) + 0.004f)));
    }
    for (size_t e = 0; e < r.eyes; ++e) r.glare.push_back({0.001 * flux, 0.2 * flux});
  }
  for (size_t c = 0; c < study.conditions.size(); ++c) {
    optimise::Base base;
    base.lux.assign(r.elements, Vec3(study.conditions[c].daylight.is_null() ? 0.5f : 40.0f)),
        base.glare.assign(r.eyes, {0, 0});
    r.base.push_back(base);
  }
  return r;
}

// All of it for a study, without any light computed.
struct SmallProblem {
  explicit SmallProblem(const std::string& text = kStudy) : file(text), rays(file.home) {
    if (!file.read) {
      ADD_FAILURE() << file.read.error();
      return;
    }
    auto c = optimise::findCandidates(file.study(), rays);
    auto m = optimise::placeMeters(file.study(), rays);
    if (!c || !m) {
      ADD_FAILURE() << (c ? m.error() : c.error());
      return;
    }
    candidates = c.value(), meters = m.value();
    response = simpleResponse(file.study(), candidates, meters);
    model = optimise::makeModel(file.study(), candidates, meters, response);
  }
  SmallStudy file;
  RayScene rays;
  optimise::Candidates candidates;
  optimise::Meters meters;
  optimise::Response response;
  optimise::Model model;
};

// Designs of a model, without lamps and dark.
inline search::Genomes darkDesigns(const optimise::Model& m, size_t count) {
  search::Genomes out;
  out.integersEach = m.places(), out.realsEach = m.places() * m.levels();
  out.resize(count);
  return out;
}

inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

}  // namespace roomlight::testing
