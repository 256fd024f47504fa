#include "arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "engine/settings.h"
#include "engine/technique.h"
#include "output_files.h"

namespace roomlight::cli {

Result<Size> parseSize(const std::string& option, const std::string& text) {
  const size_t x = text.find('x');
  const int width = parseNumber<int>(std::string_view(text).substr(0, x)).value_or(-1);
  const int height = x == std::string::npos ? -1 : parseNumber<int>(std::string_view(text).substr(x + 1)).value_or(-1);
  if (width < 0 || height < 0)
    return Error{fmt::format("{} {}: write WIDTHxHEIGHT, for example 960x540", option, text)};
  return Size{width, height};
}

Result<RenderSettings> readSettings(const SettingsOptions& o, RenderSettings s) {
  if (!o.quality.empty()) {
    if (const Status status = applyQuality(o.quality, s); !status) return Error{"--" + status.error()};
  }
  if (!o.settingsFile.empty()) {
    const Result<std::string> text = readTextFile(o.settingsFile);
    if (!text) return Error{text.error()};
    const Result<RenderSettings> read = settingsFromJson(text.value(), o.settingsFile, s, o.quality);
    if (!read) return Error{read.error()};
    s = read.value();
  }
  if (!o.size.empty()) {
    const Result<Size> size = parseSize("--size", o.size);
    if (!size) return Error{size.error()};
    s.width = size.value().width, s.height = size.value().height;
  }
  s.technique = o.technique.value_or(s.technique);
  s.samples = o.samples.value_or(s.samples);
  s.threads = o.threads.value_or(s.threads);
  if (o.seed) {
    const auto seed = parseNumber<uint64_t>(*o.seed);
    if (!seed) return Error{fmt::format("--seed {}: write a whole number from 0 to 18446744073709551615", *o.seed)};
    s.seed = *seed;
  }
  return s;
}

std::optional<double> parseBytes(const std::string& text) {
  const size_t unit = text.find_first_not_of("0123456789.");
  const std::optional<double> value = parseNumber<double>(std::string_view(text).substr(0, unit));
  const size_t name = text.find_first_not_of(' ', unit == std::string::npos ? text.size() : unit);
  constexpr std::pair<std::string_view, double> kUnits[] = {
      {"MB", 1e6}, {"MiB", 1 << 20}, {"GB", 1e9}, {"GiB", 1 << 30}};
  for (const auto& [word, bytes] : kUnits) {
    if (value && *value > 0 && name != std::string::npos && std::string_view(text).substr(name) == word)
      return *value * bytes;
  }
  return std::nullopt;
}

Result<std::vector<float>> parseList(const std::string& option, const std::string& text, const std::string& shape,
                                     std::initializer_list<size_t> counts) {
  std::vector<float> numbers;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(',', begin), text.size());
    const auto value = parseNumber<float>(std::string_view(text).substr(begin, end - begin));
    if (!value || !(std::abs(*value) <= 1e6f)) return Error{fmt::format("{} {}: write {}", option, text, shape)};
    numbers.push_back(*value);
    begin = end + 1;
  }
  if (std::find(counts.begin(), counts.end(), numbers.size()) == counts.end())
    return Error{fmt::format("{} {}: write {}", option, text, shape)};
  return numbers;
}

Status checkDistinct(const std::vector<std::string>& files) {
  std::set<std::filesystem::path> seen;
  for (const std::string& file : files) {
    std::error_code ignored;
    if (!file.empty() && !seen.insert(std::filesystem::weakly_canonical(file, ignored)).second)
      return Error{fmt::format("{}: is named twice; name different files", file)};
  }
  return Ok{};
}

Status checkTechnique(const std::string& wanted) {
  const Result<const Technique*> found = techniqueNamed(wanted);
  return found ? Status(Ok{}) : Error{found.error()};
}

std::string listed(std::string text, const std::vector<std::pair<std::string, std::string>>& choices) {
  for (const auto& [name, explanation] : choices)
    text += fmt::format(" {} ({}){}", name, explanation, name == choices.back().first ? "" : ";");
  return text;
}

}  // namespace roomlight::cli
