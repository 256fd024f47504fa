// The page of a baked home: one file with the home in it, or one that names a file beside it (docs/reference/baked.md).
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "base/result.h"

namespace roomlight::bake {

// Base 125: six bytes are seven characters, the first of which counts most; n bytes left over are n + 1 characters. The
// digits are ASCII but NUL, carriage return and '<', which HTML does not leave as they are.
std::string textOf(std::span<const char> bytes);
constexpr double kCharactersAByte = 7.0 / 6;

// `page`: the built page with its mark for the home; `title`: the home's name. The whole page with the home inside, or
// with a link to a file beside it. Errors: the mark is missing.
Result<std::string> pageWithHome(const std::string& page, const std::string& title, const std::string& glb);
Result<std::string> pageWithLink(const std::string& page, const std::string& title, const std::string& file);

}  // namespace roomlight::bake
