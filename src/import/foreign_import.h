// Files of formats that a library reads for us, as scenes.
#pragma once

#include "import/assimp_model.h"
#include "import/import.h"

namespace roomlight::importers {

Result<Imported> importForeign(const std::filesystem::path& file, AssimpFormat format, const ImportOptions& options);

}  // namespace roomlight::importers
