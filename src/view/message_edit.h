// The fields of an edit as a message has them.
#pragma once

#include "json/json_reader.h"
#include "view/message.h"

namespace roomlight::view {

constexpr double kFarthestM = 1e5;

EditFields readEditFields(const JsonPlace& j);

}  // namespace roomlight::view
