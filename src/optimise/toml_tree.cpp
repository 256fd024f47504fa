#include "optimise/toml_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/utf8.h"

namespace roomlight::optimise {
namespace {

const TomlNode kNothing;  // stands for what is not there: an empty table

const char* nameOf(TomlNode::Kind kind) {
  switch (kind) {
    case TomlNode::Kind::Table: return "a table";
    case TomlNode::Kind::Array: return "a list";
    case TomlNode::Kind::Text: return "text";
    case TomlNode::Kind::Number: return "a number";
    case TomlNode::Kind::Flag: return "true or false";
    case TomlNode::Kind::Other: return "a date";
  }
  return "";
}

template <class Words>
std::string listOf(const Words& words) {
  std::string out;
  for (const auto& w : words) out += (out.empty() ? "'" : ", '") + std::string(w) + "'";
  return out;
}

}  // namespace

void TomlError::at(int line, const std::string& what) {
  if (first.empty()) first = fmt::format("{}:{}: {}", file, line, what);
}

void TomlPlace::fail(const std::string& what) const {
  error_->at(node_->line, path_.empty() ? what : path_ + ": " + what);
}

const TomlNode* TomlPlace::find(const char* key) const {
  if (node_->kind != TomlNode::Kind::Table) return nullptr;
  const auto child =
      std::find_if(node_->children.begin(), node_->children.end(), [&](const TomlNode& c) { return c.key == key; });
  return child == node_->children.end() ? nullptr : &*child;
}

bool TomlPlace::isTable(std::initializer_list<const char*> knownKeys) const {
  if (node_->kind != TomlNode::Kind::Table)
    return fail(fmt::format("must be a table, but is {}", nameOf(node_->kind))), false;
  for (const TomlNode& child : node_->children) {
    if (std::none_of(knownKeys.begin(), knownKeys.end(), [&](const char* k) { return child.key == k; })) {
      error_->at(child.line, fmt::format("{}unknown key '{}'; there are {}", path_.empty() ? "" : path_ + ": ",
                                         printable(child.key), listOf(knownKeys)));
      return false;
    }
  }
  return true;
}

TomlPlace TomlPlace::operator[](const char* key) const {
  const std::string path = path_.empty() ? key : path_ + "." + key;
  if (const TomlNode* child = find(key)) return {*child, path, *error_};
  fail(fmt::format("has no '{}'", key));
  return {kNothing, path, *error_};
}

size_t TomlPlace::size() const {
  if (isArray()) return node_->children.size();
  fail(fmt::format("must be a list, but is {}", nameOf(node_->kind)));
  return 0;
}

TomlPlace TomlPlace::at(size_t index) const {
  return {index < node_->children.size() ? node_->children[index] : kNothing, fmt::format("{}[{}]", path_, index),
          *error_};
}

std::string TomlPlace::text() const {
  if (node_->kind != TomlNode::Kind::Text)
    return fail(fmt::format("must be text, but is {}", nameOf(node_->kind))), std::string();
  if (node_->text.empty()) fail("must not be empty");
  return node_->text;
}

bool TomlPlace::flag() const {
  if (node_->kind != TomlNode::Kind::Flag) fail(fmt::format("must be true or false, but is {}", nameOf(node_->kind)));
  return node_->flag;
}

double TomlPlace::number(double low, double high) const {
  if (node_->kind != TomlNode::Kind::Number)
    return fail(fmt::format("must be a number, but is {}", nameOf(node_->kind))), low;
  if (!(node_->number >= low && node_->number <= high))
    return fail(fmt::format("must be from {:g} to {:g}, but is {:g}", low, high, node_->number)), low;
  return node_->number;
}

int TomlPlace::whole(int low, int high) const {
  const double value = number(low, high);
  if (value != std::floor(value)) fail(fmt::format("must be a whole number, but is {:g}", value));
  return static_cast<int>(value);
}

Vec3 TomlPlace::vector() const {
  if (!isArray() || node_->children.size() != 3) return fail("must be [x, y, z] in metres"), Vec3();
  return {static_cast<float>(at(0).number(-1e6, 1e6)), static_cast<float>(at(1).number(-1e6, 1e6)),
          static_cast<float>(at(2).number(-1e6, 1e6))};
}

double TomlPlace::quantity(Unit unit, double low, double high) const {
  if (node_->kind == TomlNode::Kind::Number)
    return fail(fmt::format("has no unit; write \"{:g} {}\"", node_->number, unitName(unit))), low;
  const Result<double> value = parseQuantity(text(), unit);
  if (!value) return fail(value.error()), low;
  if (!(value.value() >= low && value.value() <= high))
    return fail(fmt::format("must be from {:g} to {:g} {}, but is {:g}", low, high, unitName(unit), value.value())),
           low;
  return value.value();
}

std::string TomlPlace::oneOf(std::initializer_list<const char*> words) const {
  return oneOf(std::vector<std::string>(words.begin(), words.end()));
}

std::string TomlPlace::oneOf(std::span<const std::string> words) const {
  const std::string word = text();
  if (std::find(words.begin(), words.end(), word) == words.end())
    fail(fmt::format("must be one of {}, but is '{}'", listOf(words), printable(word)));
  return word;
}

std::vector<std::string> TomlPlace::texts() const {
  std::vector<std::string> out;
  for (size_t i = 0, n = size(); i < n; ++i) out.push_back(at(i).text());
  return out;
}

}  // namespace roomlight::optimise
