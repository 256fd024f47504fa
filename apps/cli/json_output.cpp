#include "json_output.h"

namespace roomlight::cli {

Json stagesJson(std::span<const StageStats> stages) {
  Json list = Json::array();
  for (const StageStats& s : stages)
    list.push_back({{"name", s.name}, {"timeMs", s.timeMs}, {"cpuMs", s.cpuMs}, {"peakMemoryMiB", s.peakMemoryMiB}});
  return list;
}

}  // namespace roomlight::cli
