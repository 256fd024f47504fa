// The one place that knows toml++.
#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <toml++/toml.h>

#include "optimise/toml_tree.h"

namespace roomlight::optimise {
namespace {

constexpr uintmax_t kLargestBytes = 16u << 20;
constexpr size_t kDeepest = 32;

TomlNode copyOf(const toml::node& from, std::string key) {
  TomlNode out;
  out.key = std::move(key);
  out.line = static_cast<int>(from.source().begin.line);
  if (const toml::table* table = from.as_table()) {
    for (const auto& [name, value] : *table) out.children.push_back(copyOf(value, std::string(name.str())));
    // toml++ sorts by name; people read from above.
    std::stable_sort(out.children.begin(), out.children.end(),
                     [](const TomlNode& a, const TomlNode& b) { return a.line < b.line; });
  } else if (const toml::array* array = from.as_array()) {
    out.kind = TomlNode::Kind::Array;
    for (const toml::node& value : *array) out.children.push_back(copyOf(value, {}));
  } else if (from.is_string()) {
    out.kind = TomlNode::Kind::Text, out.text = from.value_or(std::string());
  } else if (from.is_number()) {
    out.kind = TomlNode::Kind::Number, out.number = from.value_or(0.0);
  } else if (from.is_boolean()) {
    out.kind = TomlNode::Kind::Flag, out.flag = from.value_or(false);
  } else {
    out.kind = TomlNode::Kind::Other;
  }
  return out;
}

}  // namespace

Result<TomlNode> parseToml(const std::string& text, const std::string& where) {
  if (const int line = lineTooDeep(text, kDeepest))
    return Error{fmt::format("{}:{}: tables and lists are nested more than {} deep", where, line, kDeepest)};
  try {
    const toml::table table = toml::parse(text);
    return copyOf(table, {});
  } catch (const toml::parse_error& e) {
    std::string what(e.description());
    for (char& c : what) c = static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    return Error{fmt::format("{}:{}: is no TOML: {}", where, e.source().begin.line, what)};
  }
}

Result<TomlNode> readToml(const std::filesystem::path& file) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(file, code)) return Error{fmt::format("{}: no such file", file.string())};
  if (std::filesystem::file_size(file, code) > kLargestBytes)
    return Error{fmt::format("{}: larger than 16 MiB", file.string())};
  std::ifstream in(file, std::ios::binary);
  if (!in) return Error{fmt::format("{}: cannot be read", file.string())};
  return parseToml({std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()}, file.string());
}

}  // namespace roomlight::optimise
