// Reads hand-written JSON strictly: every key must be known, every value of its type and in its range. The first thing
// wrong is kept with its path ("lamps[2].flux: ..."); reading goes on with defaults, and the caller asks for the error
// once at the end.
#pragma once

#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>

#include "base/vec.h"
#include "photometry/quantity.h"

namespace roomlight {

// A place in the document. Cheap to copy; lives no longer than the document and the error it was made with.
class JsonPlace {
 public:
  JsonPlace(const nlohmann::json& value, std::string path, std::string& error)
      : value_(&value), path_(std::move(path)), error_(&error) {}

  void fail(const std::string& what) const;  // keeps the first
  bool isObject(std::initializer_list<const char*> knownKeys) const;
  bool has(const char* key) const;
  JsonPlace operator[](const char* key) const;  // the key must be there
  JsonPlace operator[](size_t index) const;
  size_t arraySize() const;  // fails where it is none
  bool isArray() const;
  bool isNumber() const;
  bool isNull() const;
  bool isText(std::string_view text) const;  // this one
  const std::string& path() const { return path_; }

  std::string text() const;
  std::string json() const;  // the value as it is, for another reader
  bool flag() const;  // true or false
  double number(double low, double high) const;
  Vec3 vector(double low, double high) const;             // [x, y, z]
  double quantity(Unit unit, double low, double high) const;  // "800 lm"
  std::string oneOf(std::initializer_list<const char*> words) const;
  std::string oneOf(std::span<const std::string> words) const;

  // With a default where the key is missing.
  double number(const char* key, double low, double high, double otherwise) const {
    return has(key) ? (*this)[key].number(low, high) : otherwise;
  }
  std::string text(const char* key, const std::string& otherwise) const {
    return has(key) ? (*this)[key].text() : otherwise;
  }

 private:
  const nlohmann::json* value_;
  std::string path_;
  std::string* error_;
};

}  // namespace roomlight
