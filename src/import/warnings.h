// What a file asks for and an importer cannot honour: one line for each kind, with how often it occurred.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace roomlight::importers {

class Warnings {
 public:
  void add(const std::string& kind, size_t times = 1) {
    for (auto& [known, count] : kinds_) {
      if (known == kind) {
        count += times;
        return;
      }
    }
    if (times > 0) kinds_.emplace_back(kind, times);
  }
  void add(const Warnings& others) {
    for (const auto& [kind, count] : others.kinds_) add(kind, count);
  }
  std::vector<std::string> lines() const {
    std::vector<std::string> out;
    for (const auto& [kind, count] : kinds_) {
      out.push_back(count == 1 ? kind + " (once)" : kind + " (" + std::to_string(count) + " times)");
    }
    return out;
  }

 private:
  std::vector<std::pair<std::string, size_t>> kinds_;  // in the order they were met
};

}  // namespace roomlight::importers
