// Names in files, whatever their encoding.
#pragma once

#include <string>
#include <string_view>

namespace roomlight::importers {

bool isUtf8(std::string_view text);

// The text itself where it is UTF-8, otherwise its bytes taken as Latin-1.
std::string asUtf8(std::string_view text);

}  // namespace roomlight::importers
