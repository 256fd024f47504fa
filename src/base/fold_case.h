// Text as people compare it: without the difference between capital and small letters.
#pragma once

#include <string>
#include <string_view>

namespace roomlight {

// Code points of UTF-8 text with simple case folding (Unicode's CaseFolding.txt, status C and S) of Latin, Greek and
// Cyrillic letters; other letters as they are. A byte that is no UTF-8 becomes U+DC00 plus the byte, which no text has.
std::u32string foldedCase(std::string_view text);

}  // namespace roomlight
