#include "optimise/candidates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "measure/lattice.h"
#include "scene/surface.h"
#include "scene/outline.h"

namespace roomlight::optimise {
namespace {

constexpr float kLookUpFrom =
    0.6f;              // of the room's height: where the search for a ceiling starts, so that lower ones are met
constexpr float kAboveCeilingM = 0.7f;           // and how far above the room it ends
constexpr float kAroundM = 0.3f,
                kHangsM = 0.02f;  // what is lower than most of what is so far around it hangs from the ceiling
constexpr size_t kMostPlaces = 100'000;          // of a rule's grid
constexpr float kBeforeWallM = 0.5f, kBehindWallM = 0.15f;
constexpr float kTableLowM = 0.3f, kTableHighM = 1.3f;  // tops above the floor
constexpr float kFlatM = 0.01f;
constexpr float kLevel = 0.99f;                  // cosine of what counts as level
constexpr int kRound = 8;                        // directions in which a luminaire's room is checked

Vec3 at(Vec2 p, float y) { return {p.x, y, p.y}; }

// How many points evenly() makes.
double countOf(float length, double spacing) {
  return length < 0 ? 0 : std::floor(static_cast<double>(length) / spacing + 1e-6) + 1;
}

// Even points from `low` to `high`, as far as `spacing` apart at least, in the middle.
std::vector<float> evenly(float low, float high, double spacing) {
  const int n = static_cast<int>(countOf(high - low, spacing));
  std::vector<float> out;
  for (int i = 0; i < n; ++i)
    out.push_back((low + high) / 2 +
                  (static_cast<float>(i) - static_cast<float>(n - 1) / 2) * static_cast<float>(spacing));
  return out;
}

// The rectangle around a floor, along its longest side.
struct Around {
  Vec2 u, v, low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
  explicit Around(const std::vector<Vec2>& floor) : u(longestSide(floor)), v{-u.y, u.x} {
    for (const Vec2 p : floor) {
      const float a = p.x * u.x + p.y * u.y, b = p.x * v.x + p.y * v.y;
      low = {std::min(low.x, a), std::min(low.y, b)}, high = {std::max(high.x, a), std::max(high.y, b)};
    }
  }
};

// Over the floor, at least `fromWalls` from every wall.
std::vector<Vec2> gridOver(const std::vector<Vec2>& floor, double spacing, double fromWalls) {
  const Around r(floor);
  const auto in = static_cast<float>(fromWalls);
  std::vector<Vec2> out;
  for (const float b : evenly(r.low.y + in, r.high.y - in, spacing)) {
    for (const float a : evenly(r.low.x + in, r.high.x - in, spacing)) {
      const Vec2 p = r.u * a + r.v * b;
      if (contains(floor, p) && distanceToEdgeM(floor, p) >= in - 1e-4f) out.push_back(p);
    }
  }
  return out;
}

// A wall of a room from inside.
struct Side {
  Vec2 from, along;  // unit
  Vec3 away;         // unit, into the room
  float lengthM = 0;
  float distanceM(Vec2 p) const {
    const Vec2 d = p - from;
    const float t = std::clamp(d.x * along.x + d.y * along.y, 0.0f, lengthM);
    return std::hypot(d.x - t * along.x, d.y - t * along.y);
  }
};

std::vector<Side> sidesOf(const std::vector<Vec2>& floor) {
  std::vector<Side> out;
  const float turn = signedAreaM2(floor) > 0 ? 1.0f : -1.0f;
  for (size_t i = 0; i < floor.size(); ++i) {
    const Vec2 side = floor[(i + 1) % floor.size()] - floor[i];
    const float l = std::hypot(side.x, side.y);
    if (l >= 1e-3f) out.push_back({floor[i], side * (1 / l), Vec3{side.y, 0, -side.x} * (turn / l), l});
  }
  return out;
}

// Of a rule's grid, before any is looked at.
double gridSizeOf(const PlaceRule& rule) {
  const auto in = static_cast<float>(rule.fromWallsM);
  if (rule.on == Mounting::Wall) {
    double sum = 0;
    for (const Side& s : sidesOf(rule.room.floor)) sum += countOf(s.lengthM - 2 * in, rule.spacingM);
    return sum;
  }
  const Around r(rule.room.floor);
  return countOf(r.high.x - r.low.x - 2 * in, rule.spacingM) * countOf(r.high.y - r.low.y - 2 * in, rule.spacingM);
}

class Search {
 public:
  Search(const StudyFile& study, const RayScene& rays) : study_(study), rays_(rays) {}

  Result<Candidates> all() {
    for (size_t r = 0; r < study_.places.size(); ++r) {
      const PlaceRule& rule = study_.places[r];
      const size_t before = out_.places.size();
      number_ = 0;
      if (rule.at.empty() && gridSizeOf(rule) > kMostPlaces)
        return Error{fmt::format("{}:{}: place '{}': its grid has more than {} places; set 'spacing' larger",
                                 study_.file.string(), rule.line, rule.name, kMostPlaces)};
      for (const Mount& m : mountsOf(rule)) add(r, m);
      if (out_.places.size() == before) {
        return Error{
            fmt::format("{}:{}: place '{}': there is no free place for any of its luminaires; set 'spacing' or "
                        "'fromWalls' smaller, or say where with 'at'",
                        study_.file.string(), rule.line, rule.name)};
      }
      if (out_.candidates.size() > kMostCandidates)
        return Error{fmt::format("{}:{}: place '{}': makes more than {} candidates; set 'spacing' larger",
                                 study_.file.string(), rule.line, rule.name, kMostCandidates)};
    }
    out_.firstOption.push_back(out_.options.size());
    findConflicts();
    return std::move(out_);
  }

 private:
  struct Mount {
    Vec3 p, away;
  };

  Hit look(Vec3 from, Vec3 direction, float most = kInfinity) const {
    return rays_.intersect({from, direction, 1e-4f, most});
  }

  std::vector<Mount> mountsOf(const PlaceRule& rule) const {
    std::vector<Mount> out;
    if (rule.on == Mounting::Wall) return wallMounts(rule);
    std::vector<Vec2> places;
    for (const Vec3 p : rule.at) places.push_back({p.x, p.z});
    if (rule.at.empty()) places = gridOver(rule.room.floor, rule.spacingM, rule.fromWallsM);
    for (const Vec2 p : places) {
      const auto m = rule.on == Mounting::Ceiling ? ceilingAt(rule, p) : topAt(rule, p);
      if (m) out.push_back(*m);
    }
    return out;
  }

  std::optional<Mount> ceilingAt(const PlaceRule& rule, Vec2 p) const {
    const float from = rule.room.elevationM + kLookUpFrom * rule.room.heightM,
                most = (1 - kLookUpFrom) * rule.room.heightM + kAboveCeilingM;
    const auto heightAt = [&](Vec2 q) {
      const Hit hit = look(at(q, from), {0, 1, 0}, most);
      return hit.valid() ? from + hit.t : kInfinity;
    };
    const float y = heightAt(p);
    if (y == kInfinity) return std::nullopt;
    int around = 0, higher = 0;
    for (const Vec2 d : {Vec2{kAroundM, 0}, Vec2{-kAroundM, 0}, Vec2{0, kAroundM}, Vec2{0, -kAroundM}}) {
      if (!contains(rule.room.floor, p + d)) continue;
      ++around, higher += heightAt(p + d) > y + kHangsM;
    }
    if (2 * higher > around) return std::nullopt;  // a lamp of the home, a shelf
    return Mount{at(p, y), {0, -1, 0}};
  }

  // The top of a table, or the floor.
  std::optional<Mount> topAt(const PlaceRule& rule, Vec2 p) const {
    const float from = rule.room.elevationM + rule.room.heightM - 0.05f;
    const auto heightAt = [&](Vec2 q) {
      const Hit hit = look(at(q, from), {0, -1, 0});
      return hit.valid() && std::abs(normalize(hit.ng).y) > kLevel ? from - hit.t : -kInfinity;
    };
    const float y = heightAt(p), above = y - rule.room.elevationM;
    const bool fits = rule.on == Mounting::Floor ? std::abs(above) < 0.03f : above > kTableLowM && above < kTableHighM;
    if (!fits) return std::nullopt;
    double half = 0;
    for (const size_t l : rule.luminaires) half = std::max(half, study_.catalogue.luminaires[l].sizeM / 2);
    for (const Vec2 d : {Vec2{1, 0}, Vec2{-1, 0}, Vec2{0, 1}, Vec2{0, -1}}) {
      if (std::abs(heightAt(p + d * static_cast<float>(half)) - y) > kFlatM) return std::nullopt;
    }
    return Mount{at(p, y), {0, 1, 0}};
  }

  // On the wall from inside the room; none in front of windows and openings.
  std::optional<Mount> wallAt(Vec3 p, Vec3 away) const {
    const Hit hit = look(p + away * kBeforeWallM, -away, kBeforeWallM + kBehindWallM);
    if (!hit.valid() || hit.t < kBeforeWallM - kBehindWallM) return std::nullopt;
    const Scene& scene = rays_.scene();
    const Mesh& mesh = scene.meshes[static_cast<size_t>(scene.instances[hit.instance].mesh)];
    if (letsLightThrough(scene.materials[static_cast<size_t>(mesh.material)])) return std::nullopt;
    return Mount{p + away * (kBeforeWallM - hit.t), away};
  }

  std::vector<Mount> wallMounts(const PlaceRule& rule) const {
    std::vector<Mount> out;
    const std::vector<Side> sides = sidesOf(rule.room.floor);
    const auto hang = [&](const Side& s, float along, float y) {
      if (const auto m = wallAt(at(s.from + s.along * along, y), s.away)) out.push_back(*m);
    };
    for (const Side& s : sides) {
      if (!rule.at.empty()) break;
      for (const float along :
           evenly(static_cast<float>(rule.fromWallsM), s.lengthM - static_cast<float>(rule.fromWallsM), rule.spacingM))
        hang(s, along, rule.room.elevationM + static_cast<float>(rule.heightM));
    }
    for (const Vec3 p : rule.at) {
      // The nearest wall is theirs.
      const Vec2 q{p.x, p.z};
      const auto s = std::min_element(sides.begin(), sides.end(),
                                      [&](const Side& a, const Side& b) { return a.distanceM(q) < b.distanceM(q); });
      if (s == sides.end()) continue;
      const Vec2 d = q - s->from;
      hang(*s, std::clamp(d.x * s->along.x + d.y * s->along.y, 0.0f, s->lengthM), p.y);
    }
    return out;
  }

  bool isFree(Vec3 centre, Vec3 away, double sizeM) const {
    const auto radius = static_cast<float>(sizeM / 2);
    if (radius <= 0) return true;
    const Frame frame(away);
    for (int k = 0; k < kRound; ++k) {
      const float a = 2 * kPi * (static_cast<float>(k) + 0.5f) / kRound;
      if (look(centre, frame.t * std::cos(a) + frame.b * std::sin(a), radius).valid()) return false;
    }
    return !look(centre, away, radius).valid();
  }

  std::vector<std::pair<Vec3, std::string>> aimsOf(const PlaceRule& rule, Vec3 position, Vec3 away) const {
    std::vector<std::pair<Vec3, std::string>> out;
    for (const std::string& word : rule.aimWords)
      out.emplace_back(word == "down" ? Vec3{0, -1, 0} : word == "up" ? Vec3{0, 1, 0} : away, word);
    for (const Vec3 p : rule.aimPoints) {
      if (length(p - position) > 0.05f)
        out.emplace_back(normalize(p - position), fmt::format("at {:.2f}, {:.2f}, {:.2f}", p.x, p.y, p.z));
    }
    return out;
  }

  void add(size_t r, const Mount& mount) {
    const PlaceRule& rule = study_.places[r];
    const size_t place = out_.places.size(), firstOption = out_.options.size();
    bool inThing = false;
    for (const size_t l : rule.luminaires) {
      const Luminaire& luminaire = study_.catalogue.luminaires[l];
      const Vec3 position = mount.p + mount.away * static_cast<float>(luminaire.dropM);
      if (rule.on == Mounting::Ceiling &&
          static_cast<double>(distanceToEdgeM(rule.room.floor, {position.x, position.z})) < luminaire.fromWallsM)
        continue;
      if (insideThing(rays_, position)) {
        inThing = true;
        continue;
      }
      if (!isFree(position, mount.away, luminaire.sizeM)) continue;
      auto aims = aimsOf(rule, position, mount.away);
      if (luminaire.type == "point") aims.resize(std::min<size_t>(1, aims.size()));  // the same from all sides
      for (const auto& [direction, aim] : aims) {
        for (const double kelvin : luminaire.kelvin) out_.options.push_back({out_.candidates.size(), kelvin});
        out_.candidates.push_back({place, l, position, direction, aim});
      }
    }
    ++number_;
    if (out_.options.size() == firstOption) return void(++(inThing ? out_.inThings : out_.tooNear));
    out_.firstOption.push_back(firstOption);
    out_.places.push_back({fmt::format("{} {}", rule.name, number_), r, mount.p, mount.away});
  }

  double sizeAt(size_t place) const {
    double most = 0;
    for (size_t o = out_.firstOption[place]; o < out_.firstOption[place + 1]; ++o)
      most = std::max(most, study_.catalogue.luminaires[out_.candidates[out_.options[o].candidate].luminaire].sizeM);
    return most;
  }

  void findConflicts() {
    const size_t n = out_.places.size();
    out_.conflicts.resize(n);
    for (size_t a = 0; a < n; ++a) {
      for (size_t b = 0; b < n; ++b) {
        const bool same = out_.places[a].rule == out_.places[b].rule;
        const double apart =
            std::max((sizeAt(a) + sizeAt(b)) / 2, same ? study_.places[out_.places[a].rule].apartM : 0);
        if (a != b && static_cast<double>(length(out_.places[a].mount - out_.places[b].mount)) < apart)
          out_.conflicts[a].push_back(static_cast<uint32_t>(b));
      }
    }
  }

  const StudyFile& study_;
  const RayScene& rays_;
  Candidates out_;
  int number_ = 0;
};

}  // namespace

Result<Candidates> findCandidates(const StudyFile& study, const RayScene& rays) { return Search(study, rays).all(); }

}  // namespace roomlight::optimise
