// The meter file: JSON that says what to measure. Schema: docs/reference/meters.md.
#pragma once

#include <filesystem>
#include <span>

#include "base/result.h"
#include "measure/meter_plan.h"

namespace roomlight {

// Rooms that the file only names are those of the scene. Unknown keys, wrong types, missing units and values out of
// range are errors that name the file and the JSON path.
Result<MeterPlan> readMeterFile(const std::filesystem::path& file, std::span<const Room> sceneRooms);

}  // namespace roomlight
