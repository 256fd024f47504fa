// The library that traces rays.
#pragma once

#include <string>

namespace roomlight {

// As it is loaded, such as "3.13.5"; empty where it does not start.
std::string rayLibraryVersion();

}  // namespace roomlight
