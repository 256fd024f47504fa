// The program's version, as in CMakeLists.txt.
#pragma once

namespace roomlight {

const char* version();  // "0.1.0"

}  // namespace roomlight
