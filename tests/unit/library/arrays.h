// A room as arrays, for tests of the library.
#pragma once

#include <roomlight/roomlight.h>

#include <vector>

namespace roomlight::test {

// Faces look inwards.
struct BoxRoom {
  std::vector<float> positions;
  std::vector<uint32_t> triangles = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                                     2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};

  BoxRoom(Vec3 lo, Vec3 hi) {
    for (unsigned corner = 0; corner < 8; ++corner) {
      positions.push_back(corner & 1u ? hi.x : lo.x);
      positions.push_back(corner & 2u ? hi.y : lo.y);
      positions.push_back(corner & 4u ? hi.z : lo.z);
    }
  }
  HomeArrays arrays(const MaterialValues& material = {}) const {
    HomeArrays arrays;
    arrays.materials = {material};
    arrays.meshes.resize(1);
    arrays.meshes[0].name = "room", arrays.meshes[0].positions = positions, arrays.meshes[0].triangles = triangles;
    arrays.cameras = {{"corner", {0.3f, 1.5f, 0.3f}, {3, 1, 2}, 60}, {"door", {3.7f, 1.5f, 2.7f}, {1, 1, 1}, 60}};
    return arrays;
  }
};

inline BoxRoom smallRoom() { return BoxRoom({0, 0, 0}, {4, 2.5f, 3}); }

inline OpenOptions twoLamps() {
  OpenOptions options;
  options.lighting = R"({"lamps": [
    {"name": "Left", "type": "point", "position": [1, 2, 1.5], "flux": "500 lm"},
    {"name": "Right", "type": "point", "position": [3, 2, 1.5], "flux": "900 lm", "temperature": "2700 K"}]})";
  return options;
}

inline Settings quick() {
  Settings settings;
  settings.quality = "draft";
  settings.width = 64, settings.height = 48;
  return settings;
}

}  // namespace roomlight::test
