// A room made of arrays of vertices and triangles, its lamps mixed after rendering: room_of_arrays FOLDER
#include <roomlight/roomlight.h>

#include <array>
#include <cstdio>
#include <string>
#include <vector>

namespace {

struct Mesh {
  std::vector<float> positions;
  std::vector<uint32_t> triangles;
};

// A box from `lo` to `hi`, whose faces look inwards.
Mesh box(std::array<float, 3> lo, std::array<float, 3> hi) {
  Mesh mesh;
  for (unsigned corner = 0; corner < 8; ++corner) {
    for (unsigned axis = 0; axis < 3; ++axis) mesh.positions.push_back(corner & (1u << axis) ? hi[axis] : lo[axis]);
  }
  mesh.triangles = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                    2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
  return mesh;
}

roomlight::MeshArrays arraysOf(const Mesh& mesh, const char* name, int material) {
  roomlight::MeshArrays arrays;
  arrays.name = name, arrays.material = material;
  arrays.positions = mesh.positions, arrays.triangles = mesh.triangles;
  return arrays;
}

int fail(const roomlight::Error& error) { return std::fprintf(stderr, "%s\n", error.message.c_str()), 1; }

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: room_of_arrays FOLDER\n"), 2;
  const std::string folder = argv[1];

  const Mesh walls = box({0, 0, 0}, {4, 2.5f, 3}), table = box({1.4f, 0, 1}, {2.6f, 0.75f, 1.8f});
  roomlight::HomeArrays room;
  room.materials.resize(2);
  room.materials[0].name = "plaster", room.materials[0].baseColour = {0.8f, 0.8f, 0.78f};
  room.materials[1].name = "oak", room.materials[1].baseColour = {0.45f, 0.3f, 0.18f};
  room.meshes = {arraysOf(walls, "walls", 0), arraysOf(table, "table", 1)};
  room.cameras = {{"door", {0.4f, 1.6f, 2.7f}, {2.4f, 0.8f, 1}, 60}};

  roomlight::OpenOptions options;
  options.lighting = R"({"lamps": [
    {"name": "Pendant", "type": "point", "position": [2, 1.9, 1.4], "flux": "800 lm", "temperature": "2700 K"},
    {"name": "Wall lamp", "type": "point", "position": [0.3, 1.7, 0.3], "flux": "400 lm", "temperature": "4000 K"}]})";
  const auto home = roomlight::Home::fromArrays(room, options);
  if (!home) return fail(home.error());

  roomlight::Settings settings;
  settings.quality = "draft";
  settings.width = 320, settings.height = 240;
  settings.layers = true;
  const auto picture = roomlight::render(*home, {}, settings);
  if (!picture) return fail(picture.error());
  const auto layers = picture->layers();
  if (!layers) return fail(layers.error());
  for (const auto& layer : layers->list()) std::printf("%s: %.0f lm\n", layer.name.c_str(), layer.fluxLm.value_or(0));

  // Any state of the lamps, without rendering again.
  const std::vector<std::pair<std::string, roomlight::Dials>> scenes = {
      {"both", {}},
      {"evening", {{{"Pendant", "30%,2200K"}}, {}, {}, {}}},
      {"wall_lamp", {{{"Pendant", "off"}}, {}, {}, {}}}};
  for (const auto& [name, dials] : scenes) {
    const auto display = layers->display(dials);
    if (!display) return fail(display.error());
    if (const auto s = roomlight::write(*display, folder + "/" + name + ".png"); !s) return fail(s.error());
  }
  return 0;
}
