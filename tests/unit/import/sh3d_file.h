// A home from its XML, and what its objects measure.
#pragma once

#include <gtest/gtest.h>

#include "import/import.h"
#include "support/homes.h"
#include "unit/temporary_folder.h"

namespace roomlight::testing {

inline Result<Imported> importBytes(const std::string& bytes, const ImportOptions& options = {}) {
  const TemporaryFolder folder;
  writeFile(folder / "home.sh3d", bytes);
  return importScene(folder / "home.sh3d", options);
}

inline Result<Imported> importHome(const std::string& elements, const ZipEntries& more = {},
                                   const std::string& attributes = "wallHeight='250'") {
  ZipEntries entries{{"Home.xml", homeXml(elements, attributes)}};
  entries.insert(entries.end(), more.begin(), more.end());
  return importBytes(zipped(entries));
}

inline Scene homeScene(const std::string& elements, const std::string& attributes = "wallHeight='250'") {
  Result<Imported> imported = importHome(elements, {}, attributes);
  if (!imported) {
    ADD_FAILURE() << imported.error();
    return {};
  }
  return std::move(imported.value().scene);
}

// A triangle in the world.
struct Face {
  Vec3 a, b, c;
  int material = 0;
  float areaM2 = 0;
  Vec3 normal, centre;
};

inline std::vector<Face> facesOf(const Scene& scene, const std::string& name) {
  std::vector<Face> out;
  for (const Instance& i : scene.instances) {
    if (i.name != name) continue;
    const Mesh& mesh = scene.meshes[static_cast<size_t>(i.mesh)];
    for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
      Face f;
      f.a = i.worldFromObject.point(mesh.positions[mesh.indices[t]]);
      f.b = i.worldFromObject.point(mesh.positions[mesh.indices[t + 1]]);
      f.c = i.worldFromObject.point(mesh.positions[mesh.indices[t + 2]]);
      f.material = mesh.material;
      const Vec3 n = cross(f.b - f.a, f.c - f.a);
      f.areaM2 = length(n) / 2, f.normal = normalize(n), f.centre = (f.a + f.b + f.c) / 3;
      out.push_back(f);
    }
  }
  return out;
}

inline Bounds3 boundsOf(const Scene& scene, const std::string& name) {
  Bounds3 b;
  for (const Face& f : facesOf(scene, name)) b.add(f.a), b.add(f.b), b.add(f.c);
  return b;
}

// Of a closed body whose fronts look outwards; bottoms that openings leave lie at the body's lowest height and count
// nothing.
inline double volumeM3(const Scene& scene, const std::string& name) {
  const Bounds3 b = boundsOf(scene, name);
  const Vec3 o = b.lo;
  double sum = 0;
  for (const Face& f : facesOf(scene, name)) sum += static_cast<double>(dot(f.a - o, cross(f.b - o, f.c - o)));
  return sum / 6;
}

inline double areaFacing(const Scene& scene, const std::string& name, Vec3 direction) {
  double sum = 0;
  for (const Face& f : facesOf(scene, name)) {
    if (dot(f.normal, direction) > 0.5f) sum += static_cast<double>(f.areaM2);
  }
  return sum;
}

}  // namespace roomlight::testing
