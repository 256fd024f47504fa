// Text files of Java's class Properties: "key = value" a line.
#pragma once

#include <map>
#include <span>
#include <string>

#include "import/file_access.h"

namespace roomlight::importers {

// ISO 8859-1 with \uXXXX for the rest, comments after # and !, lines that go on behind a backslash; keys and values
// come out as UTF-8. Of equal keys the last counts. Throws Failure that names the line: an escape that is none.
std::map<std::string, std::string> javaProperties(std::span<const uint8_t> bytes);

}  // namespace roomlight::importers
