// TOML as plain data that knows its lines, and strict reading of it: every key must be known, every value of its type
// and in its range.
#pragma once

#include <cstddef>
#include <deque>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "base/vec.h"
#include "photometry/quantity.h"

namespace roomlight::optimise {

struct TomlNode {
  enum class Kind { Table, Array, Text, Number, Flag, Other };  // dates and times
  Kind kind = Kind::Table;
  int line = 0;  // from 1
  std::string key;
  std::string text;
  double number = 0;
  bool flag = false;
  std::vector<TomlNode> children;  // of a table with their keys, in the order of the file
};

// The error is "file:line: what is wrong".
Result<TomlNode> readToml(const std::filesystem::path& file);
Result<TomlNode> parseToml(const std::string& text, const std::string& where);

// The first thing that is wrong in a file. Reading goes on with defaults; the caller asks once at the end.
struct TomlError {
  std::string file, first;
  void at(int line, const std::string& what);
};

// A place in the tree. Cheap to copy; lives no longer than the tree and the error.
class TomlPlace {
 public:
  TomlPlace(const TomlNode& node, std::string path, TomlError& error)
      : node_(&node), path_(std::move(path)), error_(&error) {}

  void fail(const std::string& what) const;  // "file:line: path: what"
  bool isTable(std::initializer_list<const char*> knownKeys) const;
  bool has(const char* key) const { return find(key) != nullptr; }
  TomlPlace operator[](const char* key) const;  // fails here where it is not there
  size_t size() const;                          // of an array; fails where it is none
  TomlPlace at(size_t index) const;
  bool isText() const { return node_->kind == TomlNode::Kind::Text; }
  bool isArray() const { return node_->kind == TomlNode::Kind::Array; }
  const std::string& path() const { return path_; }
  int line() const { return node_->line; }
  const TomlNode& node() const { return *node_; }

  std::string text() const;  // not empty
  bool flag() const;
  double number(double low, double high) const;
  int whole(int low, int high) const;
  Vec3 vector() const;                                        // [x, y, z], metres
  double quantity(Unit unit, double low, double high) const;  // "150 lx"
  std::string oneOf(std::initializer_list<const char*> words) const;
  std::string oneOf(std::span<const std::string> words) const;
  std::vector<std::string> texts() const;

  // With a default where the key is missing.
  double number(const char* key, double low, double high, double otherwise) const {
    return has(key) ? (*this)[key].number(low, high) : otherwise;
  }
  int whole(const char* key, int low, int high, int otherwise) const {
    return has(key) ? (*this)[key].whole(low, high) : otherwise;
  }
  std::string text(const char* key, const std::string& otherwise) const {
    return has(key) ? (*this)[key].text() : otherwise;
  }
  bool flag(const char* key, bool otherwise) const { return has(key) ? (*this)[key].flag() : otherwise; }

 private:
  const TomlNode* find(const char* key) const;
  const TomlNode* node_;
  std::string path_;
  TomlError* error_;
};

// How deep TOML is nested, found before it is parsed: parsers and trees go down by recursion. The line, from 1, where
// more than `most` tables and lists lie inside each other, made by headers, dotted keys or brackets; 0: nowhere. Of
// text that is no TOML it follows as much as could be.
int lineTooDeep(std::string_view text, size_t most);

}  // namespace roomlight::optimise
