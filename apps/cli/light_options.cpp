#include "light_options.h"

#include <fmt/format.h>

#include <algorithm>

#include "arguments.h"
#include "console.h"
#include "engine/technique.h"

namespace roomlight::cli {

void addLightOptions(CLI::App& app, LightOptions& o) {
  app.add_option("--light-cache", o.folder,
                 "Folder where processes that render views of one home on one machine share its light: the first finds "
                 "it, the others read it")
      ->type_name("DIR");
  app.add_option("--light-cache-size", o.size,
                 "Most that folder holds, such as 500MB; what was used longest ago is removed (2GB)");
  app.add_option("--light-for", o.lightFor,
                 "A camera that light is found for, as --camera takes it; repeated, or all: for processes that share "
                 "light, the cameras of all their pictures. The pictures are those of one process with these cameras")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

Result<std::optional<LightStore>> readLightStore(const LightOptions& o, const RenderSettings& settings) {
  if (o.folder.empty() && o.size) return Error{"--light-cache-size: goes with --light-cache DIR"};
  if (o.folder.empty()) return std::optional<LightStore>();
  LightStore store;
  store.folder = o.folder;
  store.warn = [](const std::string& line) { printWarnings({line}); };
  if (o.size) {
    const std::optional<double> bytes = parseBytes(*o.size);
    if (!bytes) return Error{fmt::format("--light-cache-size {}: write a size such as 2GB or 800MB", *o.size)};
    store.mostBytes = static_cast<uint64_t>(std::min(*bytes, 9e18));
  }
  if (!findTechnique(settings.technique)->sharesLight) {
    printWarnings({fmt::format("--light-cache: is of no use with technique {}; it goes with {}", settings.technique,
                               techniquesWith(&Technique::sharesLight))});
    return std::optional<LightStore>();
  }
  if (settings.timeLimitS > 0) {
    printWarnings({"--light-cache: is not used with a time limit, for which light is found as finely as time allows"});
    return std::optional<LightStore>();
  }
  return std::optional(std::move(store));
}

}  // namespace roomlight::cli
