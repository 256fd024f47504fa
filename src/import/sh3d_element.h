// One element of Home.xml: its attributes as checked values, and where it stands.
#pragma once

#include <pugixml.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace roomlight::importers::sh3d {

constexpr double kFarthestCm = 1e7;  // no home is larger than 100 km

// Lines of a text by byte offset.
class LineNumbers {
 public:
  explicit LineNumbers(std::string_view text);
  size_t at(size_t offset) const;  // from 1

 private:
  std::vector<size_t> starts_;
};

class Element {
 public:
  Element(pugi::xml_node node, const LineNumbers& lines) : node_(node), lines_(&lines) {}

  std::string_view kind() const { return node_.name(); }
  std::string place() const;  // "line 12: wall 'wall3'"
  bool has(const char* key) const { return !node_.attribute(key).empty(); }
  [[noreturn]] void failAt(const char* key, std::string_view what) const;

  std::string text(const char* key, const char* absent = "") const { return node_.attribute(key).as_string(absent); }
  bool flag(const char* key, bool absent) const;
  // Finite and within [low, high]; without `absent` the attribute is required.
  double number(const char* key, double low, double high, std::optional<double> absent = {}) const;
  std::optional<double> numberIfAny(const char* key, double low, double high) const;
  double lengthCm(const char* key, std::optional<double> absent = {}) const {
    return number(key, -kFarthestCm, kFarthestCm, absent);
  }
  double sizeCm(const char* key, std::optional<double> absent = {}) const {
    return number(key, 0, kFarthestCm, absent);
  }
  double angleRad(const char* key, std::optional<double> absent = {}) const { return number(key, -1e4, 1e4, absent); }
  std::optional<uint32_t> colour(const char* key) const;  // AARRGGBB or RRGGBB
  std::optional<int64_t> integerIfAny(const char* key) const;
  // Exactly out.size() numbers between white space; as `out` is where the attribute is absent.
  template <class Array>
  void numbers(const char* key, Array& out) const {
    if (has(key)) readNumbers(key, out.data(), out.size());
  }

  template <class Visit>
  void children(Visit&& visit) const {
    for (const pugi::xml_node child : node_.children()) {
      if (child.type() == pugi::node_element) visit(Element(child, *lines_));
    }
  }

 private:
  void readNumbers(const char* key, double* out, size_t count) const;

  pugi::xml_node node_;
  const LineNumbers* lines_;
};

}  // namespace roomlight::importers::sh3d
