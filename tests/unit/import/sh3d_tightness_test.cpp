// No gap at joints: rays from inside closed rooms never get out but through doors and windows.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "trace/ray_scene.h"
#include "unit/import/sh3d_file.h"

namespace roomlight {
namespace {

using namespace testing;

// Where rays may get out: a box about a door or window, deep enough for reveals. Plan in metres, turned by an angle.
struct Hole {
  float x = 0, z = 0, angleRad = 0, widthM = 0, depthM = 0, lowM = 0, highM = 0;
};

bool passes(const Ray& ray, const Hole& h) {
  const float c = std::cos(h.angleRad), s = std::sin(h.angleRad);
  const Vec3 o = ray.origin - Vec3(h.x, 0, h.z), d = ray.direction;
  const float from[3] = {o.x * c + o.z * s, o.y - (h.lowM + h.highM) / 2, o.z * c - o.x * s},
              along[3] = {d.x * c + d.z * s, d.y, d.z * c - d.x * s};
  const float half[3] = {h.widthM / 2 + 1e-3f, (h.highM - h.lowM) / 2 + 1e-3f, h.depthM / 2 + 1e-3f};
  float near = 0, far = kInfinity;
  for (int i = 0; i < 3; ++i) {
    const float a = (-half[i] - from[i]) / along[i], b = (half[i] - from[i]) / along[i];
    near = std::max(near, std::min(a, b)), far = std::min(far, std::max(a, b));
  }
  return near <= far;
}

struct Escapes {
  int anywhere = 0, atEdges = 0;
};

constexpr int kRays = 100'000;

// Of kRays in all directions, and of kRays at the edges of triangles, where joints are, off by about a tenth of a
// millimetre.
Escapes escapes(const std::string& elements, Vec3 from, const std::vector<Hole>& holes = {}) {
  Scene scene = homeScene(elements);
  std::erase_if(scene.instances, [](const Instance& i) { return i.name == "ground"; });
  const RayScene rays(scene);
  std::vector<std::pair<Vec3, Vec3>> edges;
  for (const Instance& i : scene.instances) {
    const Mesh& mesh = scene.meshes[static_cast<size_t>(i.mesh)];
    for (size_t k = 0; k < mesh.indices.size(); ++k) {
      const size_t next = k % 3 == 2 ? k - 2 : k + 1;
      edges.emplace_back(mesh.positions[mesh.indices[k]], mesh.positions[mesh.indices[next]]);
    }
  }
  std::mt19937 random(11);
  std::normal_distribution<float> normal;
  std::uniform_real_distribution<float> uniform;
  const auto jitter = [&] { return Vec3(normal(random), normal(random), normal(random)); };
  const auto getsOut = [&](Vec3 direction) {
    const Ray ray{from, normalize(direction)};
    return !rays.intersect(ray).valid() &&
           std::none_of(holes.begin(), holes.end(), [&](const Hole& h) { return passes(ray, h); });
  };
  Escapes out;
  for (int i = 0; i < kRays; ++i) out.anywhere += getsOut(jitter());
  for (int i = 0; i < kRays; ++i) {
    const auto& [a, b] = edges[static_cast<size_t>(uniform(random) * static_cast<float>(edges.size())) % edges.size()];
    out.atEdges += getsOut(lerp(a, b, uniform(random)) + jitter() * 1e-4f - from);
  }
  return out;
}

// Sums over a test, for scripts/measure_geometry.
struct Tally {
  int rooms = 0, anywhere = 0, atEdges = 0;
};

class Sh3dTightness : public ::testing::Test {
 protected:
  // Floors that end where a wall begins share but a line with it: of the rays at that line a few in a million find it
  // open in floats.
  void expectTight(const std::string& elements, Vec3 from, const std::vector<Hole>& holes = {}, int mostAtEdges = 0) {
    const Escapes out = escapes(elements, from, holes);
    EXPECT_EQ(out.anywhere, 0);
    EXPECT_LE(out.atEdges, mostAtEdges);
    ++tally_.rooms, tally_.anywhere += out.anywhere, tally_.atEdges += out.atEdges;
    RecordProperty("rooms", tally_.rooms), RecordProperty("anywhere", tally_.anywhere),
        RecordProperty("atEdges", tally_.atEdges);
  }

 private:
  Tally tally_;
};

using Corners = std::vector<std::pair<double, double>>;

// Joined walls around a polygon, on its sides as axes, thick and thin in turn.
std::string ringWalls(const Corners& at, double first, double second, const std::string& more = "",
                      const std::string& prefix = "w") {
  std::string out;
  const size_t n = at.size();
  for (size_t i = 0; i < n; ++i) {
    const auto [x0, y0] = at[i];
    const auto [x1, y1] = at[(i + 1) % n];
    out +=
        wallXml(prefix + std::to_string(i), x0, y0, x1, y1, i % 2 ? second : first,
                fmt::format("wallAtStart='{0}{1}' wallAtEnd='{0}{2}' {3}", prefix, (i + n - 1) % n, (i + 1) % n, more));
  }
  return out;
}

// With a room whose floor reaches to the axes.
std::string ring(const Corners& at, double first, double second) { return ringWalls(at, first, second) + roomXml(at); }

TEST_F(Sh3dTightness, cornersOfEveryAngle) {
  // Triangles and quadrilaterals with angles from 20 to 170 degrees; thick walls beside thin ones.
  for (const auto& [first, second] : std::vector<std::pair<double, double>>{{20, 20}, {40, 8}, {10, 35}}) {
    expectTight(ring({{0, 0}, {600, 0}, {600, 218.4}}, first, second), {4.5f, 1.2f, 0.8f});
    expectTight(ring({{13, 7}, {500, -60}, {820, 20}, {410, 431}}, first, second), {4.3f, 1.2f, 1.2f});
    expectTight(ring({{0, 0}, {300, -20}, {610, 0}, {640, 300}, {330, 190}, {20, 340}}, first, second),
                {3.3f, 1.2f, 0.8f});
  }
}

TEST_F(Sh3dTightness, directionsOfDrawingChangeNothing) {
  for (int turned = 0; turned < 16; ++turned) {
    const Corners at{{0, 0}, {400, 30}, {420, 310}, {-20, 280}};
    std::string walls;
    for (size_t i = 0; i < 4; ++i) {
      const bool back = (turned >> i) & 1;
      const std::string id = fmt::format("w{}", i), before = fmt::format("w{}", (i + 3) % 4),
                        after = fmt::format("w{}", (i + 1) % 4);
      const auto &p = at[i], &q = at[(i + 1) % 4], &a = back ? q : p, &b = back ? p : q;
      walls += wallXml(id, a.first, a.second, b.first, b.second, 15,
                       fmt::format("wallAtStart='{}' wallAtEnd='{}'", back ? after : before, back ? before : after));
    }
    expectTight(walls + roomXml(at), {2, 1.2f, 1.5f});
  }
}

// Rooms as Sweet Home 3D finds them: their corners are those of the walls' inner sides.
TEST_F(Sh3dTightness, floorsThatEndAtTheWalls) {
  expectTight(boxWalls(400, 300, 20) + roomXml({{10, 10}, {390, 10}, {390, 290}, {10, 290}}), {2, 1.2f, 1.5f}, {}, 3);
}

TEST_F(Sh3dTightness, wallsThatEndOnOthers) {
  // T and X joints, by name or not, that part a room in four.
  const std::string parts =
      wallXml("t", 250, 0, 250, 300, 10, "wallAtStart='w0' wallAtEnd='w2'") + wallXml("x", 0, 140, 400, 170, 12);
  for (const Vec3 from : {Vec3(1, 1, 0.7f), Vec3(3.4f, 1, 0.7f), Vec3(1, 1, 2.4f), Vec3(3.4f, 1, 2.4f)}) {
    const std::string home = boxWalls(400, 300, 20) + parts + roomXml({{0, 0}, {400, 0}, {400, 300}, {0, 300}});
    expectTight(home, from);
  }
}

TEST_F(Sh3dTightness, roundWalls) {
  const auto home = [](const std::string& arcs, const std::string& more) {
    return wallXml("a", 0, 0, 400, 0, 20, "wallAtStart='d' wallAtEnd='b'") +
           wallXml("b", 400, 0, 400, 400, 10, "wallAtStart='a' wallAtEnd='c' " + arcs) +
           wallXml("c", 400, 400, 0, 400, 30, "wallAtStart='b' wallAtEnd='d'") +
           wallXml("d", 0, 400, 0, 0, 15, "wallAtStart='c' wallAtEnd='a' " + arcs) +
           roomXml({{-400, -50}, {800, -50}, {800, 450}, {-400, 450}}, "ceilingFlat='true'") + more;
  };
  for (const char* arcs : {"arcExtent='1.2'", "arcExtent='-0.6'", "arcExtent='3.1'", "arcExtent='4'"})
    expectTight(home(arcs, ""), {2, 1.2f, 2});
}

TEST_F(Sh3dTightness, slopes) {
  // A flat ceiling at the lowest walls' tops, on the only level.
  const std::string level = "<level id='l' name='l' elevation='0' floorThickness='12' height='200'/>",
                    on = "level='l' ";
  const std::string walls =
      wallXml("a", 0, 0, 300, 0, 20, on + "height='200' heightAtEnd='300' wallAtStart='e' wallAtEnd='b'") +
      wallXml("b", 300, 0, 600, 0, 20, on + "height='300' heightAtEnd='200' wallAtStart='a' wallAtEnd='c'") +
      wallXml("c", 600, 0, 600, 400, 12, on + "height='200' wallAtStart='b' wallAtEnd='d'") +
      wallXml("d", 600, 400, 0, 400, 20, on + "height='200' wallAtStart='c' wallAtEnd='e'") +
      wallXml("e", 0, 400, 0, 0, 12, on + "height='200' wallAtStart='d' wallAtEnd='a'");
  expectTight(level + walls + roomXml({{-5, -5}, {605, -5}, {605, 405}, {-5, 405}}, on + "ceilingFlat='true'"),
              {3, 1, 2});
}

TEST_F(Sh3dTightness, levelsThatStandOnEachOther) {
  const std::string levels =
      "<level id='l0' name='0' elevation='0' floorThickness='12' height='250'/><level id='l1' name='1' elevation='270' "
      "floorThickness='20' height='240'/>";
  std::string home = levels;
  for (const char* level : {"l0", "l1"}) {
    const std::string on = std::string("level='") + level + "'";
    home += ringWalls({{0, 0}, {400, 0}, {400, 300}, {0, 300}}, 20, 20,
                      on + (level[1] == '0' ? " height='250'" : " height='240'"), level) +
            roomXml({{10, 10}, {390, 10}, {390, 290}, {10, 290}}, on);
  }
  expectTight(home, {2, 1.2f, 1.5f}, {}, 3);
  expectTight(home, {2, 3.9f, 1.5f}, {}, 3);
}

std::string pieceXml(const Hole& h, const std::string& more = "") {
  const auto n = [](float v) { return std::to_string(v); };
  return "<doorOrWindow name='hole' x='" + n(h.x * 100) + "' y='" + n(h.z * 100) + "' width='" + n(h.widthM * 100) +
         "' depth='" + n(h.depthM * 100) + "' height='" + n((h.highM - h.lowM) * 100) + "' elevation='" +
         n(h.lowM * 100) + "' angle='" + n(h.angleRad) + "' " + more + "/>";
}

TEST_F(Sh3dTightness, openingsAreTheOnlyWayOut) {
  const float quarter = std::numbers::pi_v<float> / 2;
  const std::string home = boxWalls(400, 300, 20) + roomXml({{-5, -5}, {405, -5}, {405, 305}, {-5, 305}});
  const std::vector<Hole> holes{{1, 0, 0, 1, 0.2f, 0.8f, 2},
                                {4, 1.2f, quarter, 0.9f, 0.2f, 0, 2.1f},
                                {2, 3, 2 * quarter, 1.5f, 0.3f, 0.5f, 1.7f},
                                {0, 2.65f, quarter, 0.9f, 0.2f, 0, 2.1f}};
  const std::string shapes[] = {"", "cutOutShape='M0,1 V0.4 C0,0.1 0.3,0 0.5,0 S1,0.1 1,0.4 V1 z'",
                                "cutOutShape='M0,0.5 A.5,.5 0 0 1 1,.5 a0.5 0.5 0 1 1 -1 0z'", ""};
  std::string pieces;
  for (size_t i = 0; i < holes.size(); ++i) pieces += pieceXml(holes[i], shapes[i]);
  expectTight(home + pieces, {2, 1.2f, 1.5f}, holes);
  // The holes are there: without leave, many rays get out.
  EXPECT_GT(escapes(home + pieces, {2, 1.2f, 1.5f}).anywhere, kRays / 100);
}

}  // namespace
}  // namespace roomlight
