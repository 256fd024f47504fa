// Luminaires that a design may choose from: their light, watts, price, and where they may go. Schema:
 // docs/reference/optimise.md.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "optimise/toml_tree.h"

namespace roomlight::optimise {

enum class Mounting { Ceiling, Wall, Table, Floor };
const char* nameOf(Mounting mounting);
std::optional<Mounting> mountingNamed(const std::string& name);

struct Luminaire {
  std::string name;
  std::string type = "photometric";  // photometric, point, spot
  std::filesystem::path file;        // photometric: IES or EULUMDAT, absolute
  double fluxLm = 0;                 // 0: that of the file
  double beamDeg = 36;               // spot: full angle at half of the peak
  double wattsW = 0;                 // at full light
  double standbyW = 0;               // while dimmed to nothing, day and night
  double price = 0;                  // of one, mounted
  std::vector<double> kelvin{3000};  // colours that it is sold in or can be tuned to
  bool dimmable = true;              // else on or off
  std::vector<Mounting> mountings;
  double sizeM = 0.1;                // as much is kept free around its centre
  double fromWallsM = 0;             // kept from walls, on ceilings
  double dropM = 0.02;               // its light's centre below the ceiling, off the wall, above the table
  int line = 0;
};

struct Catalogue {
  std::filesystem::path file;
  std::string currency = "EUR";
  std::vector<Luminaire> luminaires;
  const Luminaire* find(const std::string& name) const;
  std::string names() const;  // for errors
};

// Every photometric file is looked at. The error is "file:line: place: what is wrong".
Result<Catalogue> readCatalogue(const std::filesystem::path& file);

// A lamp as lighting files have it, white (without temperature), undimmed. Photometric files by absolute path.
// `direction` is unit.
nlohmann::json lampEntry(const Luminaire& luminaire, Vec3 position, Vec3 direction);

}  // namespace roomlight::optimise
