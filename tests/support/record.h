// Rows for docs/measured/closed_forms.md: where ROOMLIGHT_RECORD names a file, tests append what they expected and
 // measured.
#pragma once

#include <cstdlib>
#include <fstream>
#include <string>

namespace roomlight::test {

// `measured` by `technique` ("path", "cone"). One line a row: group, place, technique, expected, measured, parted by
// tabs.
inline void record(const std::string& group, const std::string& place, const std::string& technique, double expected,
                   double measured) {
  const char* file = std::getenv("ROOMLIGHT_RECORD");
  if (!file) return;
  std::ofstream out(file, std::ios::app);
  out.precision(9);
  out << group << '\t' << place << '\t' << technique << '\t' << expected << '\t' << measured << '\n';
}

}  // namespace roomlight::test
