#include "arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "engine/render.h"

namespace roomlight::cli {

Result<std::pair<int, int>> parseSize(const std::string& text) {
  const size_t x = text.find('x');
  const auto width = parseNumber<int>(std::string_view(text).substr(0, x));
  const auto height = x == std::string::npos ? std::nullopt : parseNumber<int>(std::string_view(text).substr(x + 1));
  if (!width || !height) return Error{fmt::format("--size {}: write WIDTHxHEIGHT, for example 960x540", text)};
  return std::pair(*width, *height);
}

std::string lowerExtension(const std::filesystem::path& file) {
  std::string e = file.extension().string();
  std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return e;
}

Result<std::vector<float>> parseList(const std::string& option, const std::string& text, const std::string& shape, std::initializer_list<size_t> counts) {
  std::vector<float> numbers;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(',', begin), text.size());
    const auto value = parseNumber<float>(std::string_view(text).substr(begin, end - begin));
    if (!value || !(std::abs(*value) <= 1e6f)) return Error{fmt::format("{} {}: write {}", option, text, shape)};
    numbers.push_back(*value);
    begin = end + 1;
  }
  if (std::find(counts.begin(), counts.end(), numbers.size()) == counts.end()) return Error{fmt::format("{} {}: write {}", option, text, shape)};
  return numbers;
}

Status checkDistinct(const std::vector<std::string>& files) {
  std::set<std::filesystem::path> seen;
  for (const std::string& file : files) {
    std::error_code ignored;
    if (!file.empty() && !seen.insert(std::filesystem::weakly_canonical(file, ignored)).second) return Error{fmt::format("{}: is named twice; name different files", file)};
  }
  return Ok{};
}

Status checkTechnique(const std::string& wanted) {
  std::string names;
  for (const auto& [name, explanation] : techniques()) {
    if (name == wanted) return Ok{};
    names += (names.empty() ? "" : ", ") + name;
  }
  return Error{fmt::format("unknown technique '{}'; there are {}", wanted, names)};
}

std::string listed(std::string text, const std::vector<std::pair<std::string, std::string>>& choices) {
  for (const auto& [name, explanation] : choices) text += fmt::format(" {} ({}){}", name, explanation, name == choices.back().first ? "" : ";");
  return text;
}

}  // namespace roomlight::cli
