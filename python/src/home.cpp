#include <roomlight/home.h>

#include "arrays.h"
#include "bindings.h"
#include "calls.h"

namespace roomlight::python {
namespace {

struct Mesh {
  std::string name;
  Floats positions;
  Indices triangles;
  Floats normals, uv;
  int material = 0;
};

struct Arrays {
  std::vector<Mesh> meshes;
  std::vector<MaterialValues> materials;
  std::vector<Bytes> textures;
  std::vector<CameraValues> cameras;
};

HomeArrays spansOf(const Arrays& arrays) {
  HomeArrays spans;
  for (const Mesh& m : arrays.meshes)
    spans.meshes.push_back(
        {m.name, spanOf(m.positions), spanOf(m.triangles), spanOf(m.normals), spanOf(m.uv), m.material});
  for (const Bytes& t : arrays.textures)
    spans.textures.push_back({static_cast<int>(t.shape(1)), static_cast<int>(t.shape(0)), spanOf(t)});
  spans.materials = arrays.materials, spans.cameras = arrays.cameras;
  return spans;
}

void bindOptions(py::module_& module) {
  py::class_<OpenOptions>(module, "OpenOptions")
      .def(py::init())
      .def_readwrite("lighting", &OpenOptions::lighting)
      .def_readwrite("light", &OpenOptions::light)
      .def_readwrite("cameras", &OpenOptions::cameras)
      .def_readwrite("metres_per_unit", &OpenOptions::metresPerUnit)
      .def_readwrite("up", &OpenOptions::up)
      .def_readwrite("lumen_at_full_power", &OpenOptions::lumenAtFullPower);
}

void bindMaterial(py::module_& module) {
  py::class_<MaterialValues>(module, "MaterialValues")
      .def(py::init())
      .def_readwrite("name", &MaterialValues::name)
      .def_readwrite("colour", &MaterialValues::baseColour)
      .def_readwrite("texture", &MaterialValues::baseColourTexture)
      .def_readwrite("alpha", &MaterialValues::alpha)
      .def_readwrite("metallic", &MaterialValues::metallic)
      .def_readwrite("roughness", &MaterialValues::roughness)
      .def_readwrite("transmission", &MaterialValues::transmission)
      .def_readwrite("index_of_refraction", &MaterialValues::indexOfRefraction)
      .def_readwrite("specular", &MaterialValues::specular)
      .def_readwrite("emission", &MaterialValues::emissionCdM2)
      .def_readwrite("double_sided", &MaterialValues::doubleSided);
}

void bindArrays(py::module_& module) {
  bindMaterial(module);
  py::class_<CameraValues>(module, "CameraValues")
      .def(py::init())
      .def_readwrite("name", &CameraValues::name)
      .def_readwrite("eye", &CameraValues::eye)
      .def_readwrite("target", &CameraValues::target)
      .def_readwrite("vertical_fov", &CameraValues::verticalFovDeg);
  py::class_<Mesh>(module, "MeshArrays")
      .def(py::init())
      .def_readwrite("name", &Mesh::name)
      .def_readwrite("vertices", &Mesh::positions)
      .def_readwrite("faces", &Mesh::triangles)
      .def_readwrite("normals", &Mesh::normals)
      .def_readwrite("uv", &Mesh::uv)
      .def_readwrite("material", &Mesh::material);
  py::class_<Arrays>(module, "HomeArrays")
      .def(py::init())
      .def_readwrite("meshes", &Arrays::meshes)
      .def_readwrite("materials", &Arrays::materials)
      .def_readwrite("textures", &Arrays::textures)
      .def_readwrite("cameras", &Arrays::cameras);
}

py::list cameras(const Home& home) {
  py::list out;
  for (const CameraInfo& c : home.cameras()) out.append(py::make_tuple(c.name, c.eye, c.forward, c.isProposed));
  return out;
}

py::list rooms(const Home& home) {
  py::list out;
  for (const RoomInfo& r : home.rooms()) out.append(py::make_tuple(r.name, r.use, r.floor, r.elevationM, r.heightM));
  return out;
}

py::list lamps(const Home& home) {
  py::list out;
  for (const LampInfo& l : home.lamps()) out.append(py::make_tuple(l.name, l.position, l.fluxLm, l.room));
  return out;
}

}  // namespace

void bindHome(py::module_& module) {
  bindOptions(module);
  bindArrays(module);
  py::class_<Home>(module, "Home")
      .def_static("open",
                  [](const std::string& file, const OpenOptions& options) {
                    return taken(unlocked([&] { return Home::open(file, options); }));
                  })
      .def_static("from_arrays",
                  [](const Arrays& arrays, const OpenOptions& options) {
                    const HomeArrays spans = spansOf(arrays);
                    return taken(unlocked([&] { return Home::fromArrays(spans, options); }));
                  })
      .def("cameras", &cameras)
      .def("default_camera", &Home::defaultCamera)
      .def("rooms", &rooms)
      .def("lamps", &lamps)
      .def("triangle_count", &Home::triangleCount)
      .def("bounds", &Home::bounds)
      .def("metres_per_unit", &Home::metresPerUnit)
      .def("warnings", &Home::warnings)
      .def("notes", &Home::notes)
      .def("added_lighting", &Home::addedLighting);
  module.def("supported_files", &supportedFiles);
}

}  // namespace roomlight::python
