#include "json/json_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/utf8.h"

namespace roomlight {
namespace {

template <class Words>
std::string joined(const Words& words) {
  std::string all;
  for (const auto& w : words) all += (all.empty() ? "" : ", ") + std::string(w);
  return all;
}

const nlohmann::json kNothing;

}  // namespace

void JsonPlace::fail(const std::string& what) const {
  if (error_->empty()) *error_ = (path_.empty() ? "" : path_ + ": ") + printable(what, 600);
}

bool JsonPlace::isObject(std::initializer_list<const char*> knownKeys) const {
  if (!value_->is_object()) {
    fail("must be an object");
    return false;
  }
  for (const auto& [key, value] : value_->items()) {
    if (std::any_of(knownKeys.begin(), knownKeys.end(), [&](const char* k) { return key == k; })) continue;
    fail(fmt::format("unknown key '{}'; there are {}", key.substr(0, 60), joined(knownKeys)));
    return false;
  }
  return true;
}

bool JsonPlace::has(const char* key) const { return value_->is_object() && value_->contains(key); }

JsonPlace JsonPlace::operator[](const char* key) const {
  const std::string path = path_.empty() ? key : path_ + "." + key;
  if (has(key)) return {(*value_)[key], path, *error_};
  fail(fmt::format("'{}' is missing", key));
  return {kNothing, path, *error_};
}

JsonPlace JsonPlace::operator[](size_t index) const {
  return {(*value_)[index], fmt::format("{}[{}]", path_, index), *error_};
}

bool JsonPlace::isArray() const { return value_->is_array(); }
bool JsonPlace::isNumber() const { return value_->is_number(); }
bool JsonPlace::isNull() const { return value_->is_null(); }
bool JsonPlace::isText(std::string_view text) const {
  return value_->is_string() && value_->get_ref<const std::string&>() == text;
}

std::string JsonPlace::json() const { return value_->dump(); }

size_t JsonPlace::arraySize() const {
  if (value_->is_array()) return value_->size();
  fail("must be a list");
  return 0;
}

std::string JsonPlace::text() const {
  if (value_->is_string()) return value_->get<std::string>();
  fail("must be a text in quotes");
  return {};
}

bool JsonPlace::flag() const {
  if (value_->is_boolean()) return value_->get<bool>();
  fail("must be true or false");
  return false;
}

double JsonPlace::number(double low, double high) const {
  if (!value_->is_number()) {
    fail("must be a number");
    return low;
  }
  const double v = value_->get<double>();
  if (v >= low && v <= high) return v;
  fail(fmt::format("{} is out of range; it must be from {} to {}", v, low, high));
  return low;
}

Vec3 JsonPlace::vector(double low, double high) const {
  if (!value_->is_array() || value_->size() != 3) {
    fail("must be a list of three numbers");
    return {};
  }
  Vec3 v;
  for (size_t k = 0; k < 3; ++k) v[static_cast<int>(k)] = static_cast<float>((*this)[k].number(low, high));
  return v;
}

double JsonPlace::quantity(Unit unit, double low, double high) const {
  if (value_->is_number()) {
    fail(fmt::format("has no unit; write \"{} {}\"", value_->get<double>(), unitName(unit)));
    return low;
  }
  const std::string written = text();
  const Result<double> q = parseQuantity(std::string_view(written).substr(0, 100), unit);
  if (!q) {
    fail(q.error());
    return low;
  }
  if (q.value() >= low && q.value() <= high) return q.value();
  fail(fmt::format("'{}' is out of range; it must be from {} to {} {}", written, low, high, unitName(unit)));
  return low;
}

std::string JsonPlace::oneOf(std::initializer_list<const char*> words) const {
  return oneOf(std::vector<std::string>(words.begin(), words.end()));
}

std::string JsonPlace::oneOf(std::span<const std::string> words) const {
  const std::string written = text();
  if (std::find(words.begin(), words.end(), written) != words.end()) return written;
  fail(fmt::format("unknown '{}'; there are {}", written.substr(0, 60), joined(words)));
  return words.front();
}

}  // namespace roomlight
