// The boundary of this folder: whatever a reader throws becomes one line that names the file.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <new>

#include "import/failure.h"
#include "import/import.h"
#include "import/warnings.h"
#include "scene/validate.h"

namespace roomlight::importers {

inline Imported importedScene(Scene scene, const Warnings& warnings, StatedUnit unit) {
  Imported imported;
  imported.scene = std::move(scene), imported.unit = unit, imported.warnings = warnings.lines();
  imported.faults = warnings.faults().lines(), imported.faultCount = warnings.faults().total();
  return imported;
}

// `read` returns an Imported or throws; its scene is validated.
template <class Read>
Result<Imported> guarded(const std::filesystem::path& file, Read&& read) {
  const auto error = [&](std::string_view what) {
    return Error{fmt::format("{}: {}", file.string(), printable(what, 600))};
  };
  try {
    Imported imported = read();
    const Status status = validate(imported.scene);
    if (!status) return error(status.error());
    return imported;
  } catch (const std::bad_alloc&) {
    return error("there is not enough memory to read it");
  } catch (const std::exception& e) {
    return error(e.what());
  } catch (...) {
    return error("cannot be read");
  }
}

}  // namespace roomlight::importers
