// Words as people type them: without the difference between capital and small letters, and the one that was meant.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace roomlight {

// The candidate that fewest edits make of the word (letters changed, left out, added or swapped: Damerau and
// Levenshtein), if they are at most a third of its letters; else empty.
std::string nearestWord(const std::string& word, const std::vector<std::string>& candidates);

// Code points of UTF-8 text with simple case folding (Unicode's CaseFolding.txt, status C and S) of Latin, Greek and
// Cyrillic letters; other letters as they are. A byte that is no UTF-8 becomes U+DC00 plus the byte, which no text has.
std::u32string foldedCase(std::string_view text);

}  // namespace roomlight
