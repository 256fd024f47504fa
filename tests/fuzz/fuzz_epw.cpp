// Any bytes as a weather file: no crash, no hang; an error is one short line, and what is accepted is in range.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "photometry/epw.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace roomlight;
  const Result<Epw> weather = parseEpw({reinterpret_cast<const char*>(data), size});
  if (!weather) {
    if (weather.error().empty() || weather.error().size() > 500 || weather.error().find('\n') != std::string::npos)
      std::abort();
    return 0;
  }
  for (const EpwHour& h : weather.value().hours) {
    for (const auto& v : {h.directNormalWm2, h.diffuseHorizontalWm2, h.directNormalLux, h.diffuseHorizontalLux}) {
      if (v && !(*v >= 0 && *v < 1e6)) std::abort();
    }
  }
  for (const int month : {1, 2, 12}) hourAt(weather.value(), {2024, month, 29, 23.5});
  return 0;
}
