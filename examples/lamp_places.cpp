// Where shall the lamp hang? Illuminance on a desk for a row of places: lamp_places
#include <roomlight/roomlight.h>

#include <cstdio>
#include <string>
#include <vector>

namespace {

// A floor, a ceiling and a desk of 1.6 m by 0.8 m.
const std::vector<float> kPositions = {0, 0,    0, 0, 0,    3, 4, 0,    3, 4, 0,    0, 0, 2.5f, 0, 4, 2.5f, 0,
                                       4, 2.5f, 3, 0, 2.5f, 3, 1, 0.7f, 1, 1, 0.7f, 2, 3, 0.7f, 2, 3, 0.7f, 1};
const std::vector<uint32_t> kTriangles = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7, 8, 9, 10, 8, 10, 11};

}  // namespace

int main() {
  roomlight::HomeArrays room;
  room.meshes.resize(1);
  room.meshes[0].name = "room", room.meshes[0].positions = kPositions, room.meshes[0].triangles = kTriangles;

  // Three meters a hand's width above the desk, looking up.
  const std::vector<float> positions = {1.2f, 0.75f, 1.5f, 2, 0.75f, 1.5f, 2.8f, 0.75f, 1.5f},
                           normals = {0, 1, 0, 0, 1, 0, 0, 1, 0};
  for (int step = 0; step < 5; ++step) {
    const double x = 1 + 0.5 * step;
    roomlight::OpenOptions options;
    options.lighting = R"({"lamps": [{"name": "Pendant", "type": "point", "flux": "1000 lm", "position": [)" +
                       std::to_string(x) + ", 1.8, 1.5]}]}";
    const auto home = roomlight::Home::fromArrays(room, options);
    if (!home) return std::fprintf(stderr, "%s\n", home.error().message.c_str()), 1;
    roomlight::MeterOptions how;
    how.quality = "draft";
    const auto meters = roomlight::Meters::of(*home, how);
    if (!meters) return std::fprintf(stderr, "%s\n", meters.error().message.c_str()), 1;
    const auto readings = meters->illuminance(positions, normals);
    if (!readings) return std::fprintf(stderr, "%s\n", readings.error().message.c_str()), 1;
    std::printf("lamp at %.1f m:", x);
    for (const roomlight::Reading r : *readings)
      std::printf("  %.0f lx (+- %.0f)", static_cast<double>(r.lux), static_cast<double>(r.standardErrorLux));
    std::printf("\n");
  }
  return 0;
}
