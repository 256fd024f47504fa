#include "batch/inputs.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <set>
#include <string_view>

#include "base/hash.h"
#include "batch/durable.h"

namespace roomlight::batch {
namespace {

namespace fs = std::filesystem;

constexpr uintmax_t kLargestText = 64u << 20;
constexpr size_t kLongestName = 255, kMostNamed = 10000;

std::string extensionOf(const fs::path& file) {
  std::string e = file.extension().string();
  std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return e;
}

// Texts between quotes of this kind that could be names of files.
void addQuoted(std::string_view text, char quote, std::set<std::string>& names) {
  for (size_t from = text.find(quote); from != std::string_view::npos; from = text.find(quote, from + 1)) {
    const size_t end = text.find(quote, from + 1);
    if (end == std::string_view::npos) return;
    const std::string_view name = text.substr(from + 1, end - from - 1);
    if (name.size() <= kLongestName && name.find('.') != std::string_view::npos) names.emplace(name);
    from = end;
  }
}

// The last word, and all after the first, of lines that begin with mtllib or map_.
void addModelLines(std::string_view text, std::set<std::string>& names) {
  for (size_t from = 0; from < text.size();) {
    const size_t end = std::min(text.find('\n', from), text.size());
    std::string_view line = text.substr(from, end - from);
    from = end + 1;
    if (!line.starts_with("mtllib") && line.find("map_") == std::string_view::npos) continue;
    while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back()))) line.remove_suffix(1);
    const size_t first = line.find(' '), last = line.rfind(' ');
    if (first == std::string_view::npos) continue;
    names.emplace(line.substr(first + 1)), names.emplace(line.substr(last + 1));
  }
}

std::set<std::string> namesIn(const fs::path& file) {
  std::set<std::string> names;
  const std::string e = extensionOf(file);
  const bool quoted = e == ".gltf" || e == ".json" || e == ".toml", lines = e == ".obj" || e == ".mtl";
  std::error_code code;
  if ((!quoted && !lines) || fs::file_size(file, code) > kLargestText || code) return names;
  const std::string text = textOf(file);
  if (quoted) addQuoted(text, '"', names);
  if (e == ".toml") addQuoted(text, '\'', names);
  if (lines) addModelLines(text, names);
  return names;
}

}  // namespace

std::string InputHashes::of(const fs::path& file) {
  std::error_code code;
  if (!fs::is_regular_file(file, code)) return {};
  const uintmax_t size = fs::file_size(file, code);
  const int64_t time = fs::last_write_time(file, code).time_since_epoch().count();
  Known& known = known_[file];
  if (!known.hash.empty() && known.size == size && known.time == time) return known.hash;
  std::ifstream in(file, std::ios::binary);
  if (!in) return {};
  Hash hash;
  std::string block(size_t{1} << 20, '\0');
  while (in.read(block.data(), static_cast<std::streamsize>(block.size())), in.gcount() > 0)
    hash.bytes({block.data(), static_cast<size_t>(in.gcount())});
  known = {size, time, hash.text()};
  return known.hash;
}

const std::vector<fs::path>& InputHashes::named(const fs::path& file) {
  const auto found = named_.find(file);
  if (found != named_.end()) return found->second;
  std::set<fs::path> all;
  std::vector<fs::path> open = {file};
  while (!open.empty() && all.size() < kMostNamed) {
    const fs::path from = open.back();
    open.pop_back();
    for (const std::string& name : namesIn(from)) {
      std::error_code code;
      const fs::path path = (from.parent_path() / name).lexically_normal();
      if (path != file && fs::is_regular_file(path, code) && all.insert(path).second) open.push_back(path);
    }
  }
  return named_[file] = {all.begin(), all.end()};
}

}  // namespace roomlight::batch
