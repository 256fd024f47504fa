// Luminaires from files: which reader, each file once, and how a web becomes a lamp.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "scene/scene.h"

namespace roomlight::importers {

class PhotometricFiles {
 public:
  using Web = std::shared_ptr<const PhotometricWeb>;

  // .ies or .ldt. The error is one line, "line 12: what is wrong", without the file's name. A TILT file must lie in the
  // folder of its own.
  Result<Web> read(const std::filesystem::path& file);
  const std::vector<std::string>& warnings() const { return warnings_; }  // each "name.ies: what is odd"

 private:
  std::map<std::filesystem::path, Web> known_;
  std::vector<std::string> warnings_;
};

// Whether the name ends as those of photometric files do.
bool isPhotometric(const std::filesystem::path& file);

enum class LampSize {
  AsStated,  // as large as the file's opening where that is large enough to soften shadows in a room, else a point
  Point,
  Area,  // the file must state an opening
};

// Gives the lamp the web, for its position, direction and up. `fluxLm` replaces that of the web unless it is negative;
// `factor` is the rest, dimming and losses; of lamps that depend on their tilt, that counts too.
void setWeb(Lamp& lamp, const PhotometricFiles::Web& web, LampSize size, Vec3 colour, double fluxLm, double factor);

// Perpendicular to `direction`, as near to `wish` as can be; zero where that is along it.
Vec3 perpendicular(Vec3 wish, Vec3 direction);

}  // namespace roomlight::importers
