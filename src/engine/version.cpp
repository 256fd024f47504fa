#include "engine/version.h"

namespace roomlight {

const char* version() { return ROOMLIGHT_VERSION; }

}  // namespace roomlight
