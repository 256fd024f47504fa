#include "import/gltf_json.h"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "import/failure.h"

namespace roomlight::importers {
namespace {

constexpr size_t kLongestName = 256;

}  // namespace

void Json::fail(std::string_view what) const { importers::fail(path_, what); }

std::optional<Json> Json::find(const char* key) const {
  if (!value_->is_object()) fail("is not an object");
  const auto it = value_->find(key);
  if (it == value_->end() || it->is_null()) return std::nullopt;
  return Json(*it, path_.empty() ? key : path_ + "." + key);
}

Json Json::at(const char* key) const {
  auto member = find(key);
  if (!member) fail(fmt::format("'{}' is missing", key));
  return *member;
}

std::optional<Json> Json::extension(const char* name) const {
  const auto extensions = find("extensions");
  auto found = extensions ? extensions->find(name) : std::nullopt;
  if (found && !found->raw().is_object()) found->fail("is not an object");
  return found;
}

size_t Json::size() const {
  if (!value_->is_array()) fail("is not an array");
  return value_->size();
}

Json Json::operator[](size_t i) const {
  if (i >= size()) fail(fmt::format("has {} elements, more are needed", size()));
  return Json((*value_)[i], fmt::format("{}[{}]", path_, i));
}

Json Json::list(const char* key) const {
  static const nlohmann::json kEmpty = nlohmann::json::array();
  auto member = find(key);
  if (!member) return Json(kEmpty, path_.empty() ? key : path_ + "." + key);
  member->size();
  return *member;
}

double Json::number() const {
  if (!value_->is_number()) fail("is not a number");
  const double v = value_->get<double>();
  if (!std::isfinite(v)) fail("is not a finite number");
  return v;
}

uint64_t Json::integer(uint64_t max) const {
  // Some exporters write whole numbers as 5.0.
  const double v = number();
  if (v < 0 || v != std::floor(v)) fail("is not a whole number from 0");
  if (v > 9007199254740992.0 || static_cast<uint64_t>(v) > max) fail(fmt::format("is above {}", max));
  return static_cast<uint64_t>(v);
}

const std::string& Json::text() const {
  if (!value_->is_string()) fail("is not text");
  return value_->get_ref<const std::string&>();
}

bool Json::boolean() const {
  if (!value_->is_boolean()) fail("is neither true nor false");
  return value_->get<bool>();
}

Vec3 Json::vec3() const {
  if (size() < 3) fail("has fewer than three numbers");
  Vec3 v;
  for (int i = 0; i < 3; ++i) {
    const double d = (*this)[static_cast<size_t>(i)].number();
    if (std::abs(d) > std::numeric_limits<float>::max()) fail("holds a number too large");
    v[i] = static_cast<float>(d);
  }
  return v;
}

float Json::number(const char* key, float fallback) const {
  const auto member = find(key);
  if (!member) return fallback;
  const double v = member->number();
  if (std::abs(v) > std::numeric_limits<float>::max()) member->fail("is too large");
  return static_cast<float>(v);
}

float Json::number(const char* key, float fallback, float min, float max) const {
  const float v = number(key, fallback);
  if (v < min || v > max) at(key).fail(fmt::format("is {}, outside {} to {}", v, min, max));
  return v;
}

uint64_t Json::integer(const char* key, uint64_t fallback, uint64_t max) const {
  const auto member = find(key);
  return member ? member->integer(max) : fallback;
}

std::string Json::text(const char* key, const char* fallback) const {
  const auto member = find(key);
  return member ? member->text() : fallback;
}

std::string Json::name() const { return printable(text("name"), kLongestName); }

bool Json::boolean(const char* key, bool fallback) const {
  const auto member = find(key);
  return member ? member->boolean() : fallback;
}

Vec3 Json::vec3(const char* key, Vec3 fallback) const {
  const auto member = find(key);
  return member ? member->vec3() : fallback;
}

int Json::index(const char* key, size_t count) const {
  const auto member = find(key);
  return member ? member->index(count) : -1;
}

int Json::looseIndex(const char* key, size_t count, bool& isBroken) const {
  const auto member = find(key);
  if (!member) return -1;
  const double v = member->number();
  if (v >= 0 && v < static_cast<double>(count)) return member->index(count);
  isBroken = isBroken || v != -1;  // which some exporters write for none
  return -1;
}

int Json::index(size_t count) const {
  const uint64_t i = integer(uint64_t{1} << 53);
  if (i >= count || i > static_cast<uint64_t>(std::numeric_limits<int>::max()))
    fail(fmt::format("is {}, but there are only {}", i, count));
  return static_cast<int>(i);
}

}  // namespace roomlight::importers
