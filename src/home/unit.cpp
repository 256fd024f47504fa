#include "home/unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "base/parallel.h"

namespace roomlight::home {
namespace {

constexpr int kColumns = 80;           // along the longer side of the plan
constexpr int kMostHits = 32;          // of a column
constexpr int kAround = 12;            // level rays that tell whether a place is enclosed
constexpr double kEnclosed = 0.6;      // share of them that has to meet something
constexpr double kLeastEnclosedShare = 0.15;

struct Unit {
  double metres;
  const char* name;
  double ifNoneStated, ifMetresStated;  // how much less likely than metres, as logarithms
};
constexpr Unit kUnits[] = {{1, "metres", 0, 0},
                           {0.01, "centimetres", -1.5, -3},
                           {0.001, "millimetres", -1.5, -3},
                           {0.0254, "inches", -2.5, -3.5},
                           {0.3048, "feet", -4, -5.5}};

// How unlikely a length is that usually lies between low and high: a normal distribution of its logarithm beyond them.
double unlikely(double value, double low, double high, double sigma) {
  if (!(value > 0)) return 0;
  const double beyond = value < low ? std::log(low / value) : value > high ? std::log(value / high) : 0;
  return 0.5 * (beyond / sigma) * (beyond / sigma);
}

// Heights of things that people call by these words, m.
struct Word {
  const char* word;
  double low, high;
};
constexpr Word kWords[] = {{"door", 1.8, 2.4},   {"tuer", 1.8, 2.4},    {"porte", 1.8, 2.4},   {"puerta", 1.8, 2.4},
                           {"chair", 0.65, 1.3}, {"stuhl", 0.65, 1.3},  {"chaise", 0.65, 1.3}, {"silla", 0.65, 1.3},
                           {"sofa", 0.5, 1.2},   {"couch", 0.5, 1.2},   {"table", 0.35, 1.1},  {"tisch", 0.35, 1.1},
                           {"desk", 0.6, 1.3},   {"toilet", 0.35, 1.1}, {"fridge", 0.8, 2.1},  {"person", 1.4, 2.0},
                           {"human", 1.4, 2.0}};

bool isCalled(const std::string& name, const char* word) {
  std::string lower = name;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower.find(word) != std::string::npos;
}

bool overlap(const Bounds3& a, const Bounds3& b) {
  return minComponent(a.hi - b.lo) >= 0 && minComponent(b.hi - a.lo) >= 0;
}

// Boxes around all that bear the word; parts of one thing, such as "Chair leg" and "Chair seat", together.
std::vector<Bounds3> boxesOf(const std::vector<Proportions::Thing>& things, const char* word) {
  constexpr size_t kMost = 200;
  std::vector<Bounds3> boxes;
  for (const Proportions::Thing& thing : things) {
    if (boxes.size() >= kMost || !isCalled(thing.name, word)) continue;
    Bounds3 whole = thing.bounds;
    for (size_t i = 0; i < boxes.size();) {
      if (!overlap(boxes[i], whole)) {
        ++i;
        continue;
      }
      whole.add(boxes[i]);
      boxes.erase(boxes.begin() + static_cast<std::ptrdiff_t>(i));
      i = 0;
    }
    boxes.push_back(whole);
  }
  return boxes;
}

double unlikelyThings(const std::vector<Proportions::Thing>& things, double metres) {
  double sum = 0;
  int count = 0;
  for (const Word& word : kWords) {
    for (const Bounds3& box : boxesOf(things, word.word)) {
      sum += std::min(4.0, unlikely(static_cast<double>(box.size().y) * metres, word.low, word.high, 0.35)), ++count;
    }
  }
  return count > 0 ? sum / count * std::min(1.5, 0.5 * count) : 0;
}

// Seats, beds, tables and worktops are where people's knees and elbows are.
double unlikelySteps(const std::vector<float>& steps, double metres) {
  if (steps.size() < 20) return 0;
  const auto usual =
      std::count_if(steps.begin(), steps.end(), [&](float s) { return s * metres > 0.35 && s * metres < 1.1; });
  return -0.7 * std::log((static_cast<double>(usual) / static_cast<double>(steps.size()) + 0.05) / 1.05);
}

double unlikelihood(const Proportions& p, const Unit& unit, StatedUnit stated) {
  // A home with rooms, or a thing, a garden, the outside of a house.
  const double extentM = static_cast<double>(p.extent) * unit.metres;
  double size = 0.7 + unlikely(extentM, 0.25, 5, 1.5);
  if (p.roomHeight > 0) {
    const double asHome = unlikely(static_cast<double>(p.roomHeight) * unit.metres, 2.1, 4, 0.22) +
                          unlikely(extentM, 1.8, 120, 0.6) + unlikelySteps(p.steps, unit.metres);
    size = std::min(asHome, size + 8 * static_cast<double>(p.enclosedShare));
  }
  return size + unlikelyThings(p.things, unit.metres) -
         (stated == StatedUnit::Stated ? unit.ifMetresStated : unit.ifNoneStated);
}

struct Column {
  float low = 0, high = 0;  // of its highest free space
  float free = 0;           // of all spaces at least half as high together
  bool covered = false, enclosed = false;
};

Column lookAt(const RayScene& rays, float x, float z) {
  const Bounds3& b = rays.bounds();
  const float above = 0.01f * std::max(maxComponent(b.size()), 1e-6f);
  Column column;
  float from = b.hi.y + above, last = kInfinity;
  std::vector<float> gaps;
  for (int i = 0; i < kMostHits; ++i) {
    const Hit hit = rays.intersect({{x, from, z}, {0, -1, 0}, i == 0 ? 0 : 1e-4f * above, kInfinity});
    if (!hit.valid()) break;
    const float y = from - hit.t;
    column.covered = true;
    if (last < kInfinity) gaps.push_back(last - y);
    if (last < kInfinity && last - y > column.high - column.low) column.low = y, column.high = last;
    last = from = y;
  }
  if (!(column.high > column.low)) return column;
  for (const float gap : gaps) column.free += gap > 0.5f * (column.high - column.low) ? gap : 0;
  int met = 0;
  for (int i = 0; i < kAround; ++i) {
    const float angle = 2 * kPi * (static_cast<float>(i) + 0.5f) / kAround;
    met +=
        rays.intersect({{x, 0.5f * (column.low + column.high), z}, {std::cos(angle), 0, std::sin(angle)}, 0, kInfinity})
                .valid()
            ? 1
            : 0;
  }
  column.enclosed = met >= kEnclosed * kAround;
  return column;
}

// How high above the floor of its storey each place of the columns is: floors are the heights that many share.
std::vector<float> stepsOf(const std::vector<Column>& columns, float roomHeight) {
  const float bin = roomHeight / 50;
  std::map<int, int> floors;
  for (const Column& c : columns) ++floors[static_cast<int>(std::floor(c.low / bin))];
  std::vector<float> steps;
  for (const Column& c : columns) {
    int best = static_cast<int>(std::floor(c.low / bin)), most = floors[best];
    for (auto i = floors.lower_bound(best - 25); i != floors.end() && i->first <= best; ++i) {
      if (i->second > 2 * most) best = i->first, most = i->second;
    }
    const float step = c.low - (static_cast<float>(best) + 0.5f) * bin;
    if (step > 1.5f * bin) steps.push_back(step);
  }
  return steps;
}

// A home that is none of the units' size, but wide and furnished as homes are: a model of one, or scaled by mistake.
std::optional<UnitGuess> scaledHome(const Proportions& p) {
  constexpr float kRoomM = 2.6f, kWide = 2;
  constexpr double kLow = 0.25, kHigh = 15;
  if (!(p.roomHeight > 0) || (p.roomHeight > kLow && p.roomHeight < kHigh) || p.extent < kWide * p.roomHeight ||
      p.steps.size() < 40)
    return std::nullopt;
  const auto usual = std::count_if(p.steps.begin(), p.steps.end(),
                                   [&](float s) { return s > 0.13f * p.roomHeight && s < 0.42f * p.roomHeight; });
  if (2 * static_cast<size_t>(usual) < p.steps.size()) return std::nullopt;
  const double exact = static_cast<double>(kRoomM / p.roomHeight),
               power = std::pow(10, std::floor(std::log10(exact)) - 1);
  return UnitGuess{std::round(exact / power) * power, "another unit",
                   fmt::format("rooms would be {:.2g} m high", p.roomHeight)};
}

}  // namespace

Proportions proportionsOf(const RayScene& rays) {
  Proportions p;
  const Bounds3& b = rays.bounds();
  const Vec3 size = b.size();
  p.extent = maxComponent(size);
  const float cell = std::max(size.x, size.z) / kColumns;
  if (!(cell > 0)) return p;
  const int across = std::max(1, static_cast<int>(size.x / cell)), down = std::max(1, static_cast<int>(size.z / cell));
  std::vector<Column> columns(static_cast<size_t>(across * down));
  parallelFor(columns.size(), 16, [&](size_t i) {
    const int column = static_cast<int>(i) % across, row = static_cast<int>(i) / across;
    // Off the middle by a little, so that seams between equal parts are not met from end to end.
    columns[i] = lookAt(rays, b.lo.x + (static_cast<float>(column) + 0.487f) / static_cast<float>(across) * size.x,
                        b.lo.z + (static_cast<float>(row) + 0.513f) / static_cast<float>(down) * size.z);
  });
  const auto covered = std::count_if(columns.begin(), columns.end(), [](const Column& c) { return c.covered; });
  std::erase_if(columns, [](const Column& c) { return !c.enclosed; });
  float freeSum = 0;
  for (const Column& c : columns) freeSum += c.free;
  p.enclosedShare = covered > 0 && size.y > 0 ? freeSum / (static_cast<float>(covered) * size.y) : 0;
  if (p.enclosedShare >= kLeastEnclosedShare) {
    std::vector<float> heights;
    for (const Column& c : columns) heights.push_back(c.high - c.low);
    // Over furniture it is less high.
    const auto at = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() * 3 / 4);
    std::nth_element(heights.begin(), at, heights.end());
    p.roomHeight = *at;
    p.steps = stepsOf(columns, p.roomHeight);
  }
  const Scene& scene = rays.scene();
  std::map<int, Proportions::Thing> things;
  for (const Instance& instance : scene.instances) {
    if (instance.name.empty()) continue;
    things[instance.object].name = instance.name;
    things[instance.object].bounds.add(instanceBounds(scene, instance));
  }
  for (auto& [object, thing] : things) p.things.push_back(std::move(thing));
  return p;
}

UnitGuess guessUnit(const Proportions& p, StatedUnit stated) {
  const Unit* best = &kUnits[0];
  for (const Unit& unit : kUnits) {
    if (unlikelihood(p, unit, stated) < unlikelihood(p, *best, stated)) best = &unit;
  }
  const double roomM = static_cast<double>(p.roomHeight) * best->metres;
  if (roomM < 0.25 || roomM > 15) {
    if (const std::optional<UnitGuess> scaled = scaledHome(p)) return *scaled;
  }
  UnitGuess guess{best->metres, best->name, ""};
  if (best != &kUnits[0])
    guess.because = p.roomHeight > 0 ? fmt::format("rooms would be {:.3g} m high", p.roomHeight)
                                     : fmt::format("it would be {:.3g} m long", p.extent);
  return guess;
}

}  // namespace roomlight::home
