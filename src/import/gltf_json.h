// A value inside a glTF file's JSON together with its path, so that every complaint says where. Reading a value of
// the wrong type, a missing one or a number out of range throws Failure with that path.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "base/vec.h"

namespace roomlight::importers {

class Json {
 public:
  Json(const nlohmann::json& value, std::string path) : value_(&value), path_(std::move(path)) {}

  const std::string& path() const { return path_; }
  const nlohmann::json& raw() const { return *value_; }
  [[noreturn]] void fail(std::string_view what) const;

  // Members of an object; null, which some exporters write for what they leave out, is none.
  std::optional<Json> find(const char* key) const;
  Json at(const char* key) const;
  std::optional<Json> extension(const char* name) const;  // extensions.<name>

  // Elements of an array; `list` gives an empty array where the key is absent.
  size_t size() const;
  Json operator[](size_t i) const;
  Json list(const char* key) const;

  // Values.
  double number() const;  // finite
  uint64_t integer(uint64_t max) const;
  const std::string& text() const;
  bool boolean() const;
  Vec3 vec3() const;

  // Values of members, with what holds where the member is absent.
  float number(const char* key, float fallback) const;
  float number(const char* key, float fallback, float min, float max) const;
  uint64_t integer(const char* key, uint64_t fallback, uint64_t max) const;
  std::string text(const char* key, const char* fallback = "") const;
  std::string name() const;  // the member "name", cut to a reasonable length: it is copied to every part of a thing
  bool boolean(const char* key, bool fallback) const;
  Vec3 vec3(const char* key, Vec3 fallback) const;
  // Index into a list of `count` things; -1 where absent.
  int index(const char* key, size_t count) const;
  int index(size_t count) const;
  // The same for references that a file can do without: -1 also where the thing does not exist, which `isBroken` then
  // tells.
  int looseIndex(const char* key, size_t count, bool& isBroken) const;

 private:
  const nlohmann::json* value_;
  std::string path_;
};

}  // namespace roomlight::importers
