// What people call the things of a home where its file names them for programs: "Wall, Kitchen, north", not
// "wall-0-15". Files and options go on knowing things by their names.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "scene/scene_lamps.h"

namespace roomlight {

// Without the number of a copy ("Chair.001"), where no other name of the list would then be the same.
std::vector<std::string> withoutCopyNumbers(std::vector<std::string> names);

// Of each object, by its number: the label of its first instance, else that one's name without a copy's number.
std::map<int, std::string> shownObjectNames(const Scene& scene);

// Of each of `lamps`, which are the scene's: that of the thing whose name it bears, else its own without a copy's
// number.
std::vector<std::string> shownLampNames(const Scene& scene, const std::vector<SceneLamp>& lamps);

// Of a material painted in that colour (linear reflectance): its label, after the colour where it has no texture
// ("white wall paint"); else its name, unless that is a code for programs; else what it looks like ("dark red",
// "glass"); else its name.
std::string shownMaterialName(const Material& material, Vec3 baseColor);
inline std::string shownMaterialName(const Material& material) {
  return shownMaterialName(material, material.baseColor);
}

// "white", "light grey", "dark green": of a linear reflectance, 0 to 1.
std::string colourInWords(Vec3 reflectance);

}  // namespace roomlight
