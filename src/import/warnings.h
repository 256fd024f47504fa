// What an importer says about a file: one line for each kind, with how often it occurred. Warnings are what somebody
// must know: what the file asks for and the scene does not have. Faults are small things that were mended and that
// nobody sees.
#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace roomlight::importers {

// Kinds in the order they were met.
class CountedKinds {
 public:
  void add(const std::string& kind, size_t times) {
    if (times == 0) return;
    const auto [entry, isNew] = numbers_.emplace(kind, kinds_.size());
    if (isNew) kinds_.emplace_back(kind, 0);
    kinds_[entry->second].second += times;
  }
  void add(const CountedKinds& others) {
    for (const auto& [kind, count] : others.kinds_) add(kind, count);
  }
  std::vector<std::string> lines() const {
    std::vector<std::string> out;
    for (const auto& [kind, count] : kinds_) {
      out.push_back(count == 1 ? kind + " (once)" : kind + " (" + std::to_string(count) + " times)");
    }
    return out;
  }
  size_t total() const {
    size_t sum = 0;
    for (const auto& [kind, count] : kinds_) sum += count;
    return sum;
  }

 private:
  std::vector<std::pair<std::string, size_t>> kinds_;
  std::unordered_map<std::string, size_t> numbers_;  // a hostile file has as many kinds as things with names
};

class Warnings {
 public:
  void add(const std::string& kind, size_t times = 1) { warnings_.add(kind, times); }
  void say(std::string line) { said_.push_back(std::move(line)); }  // what is about the file as a whole
  void mended(const std::string& kind, size_t times = 1) { faults_.add(kind, times); }
  void add(const Warnings& others) {
    warnings_.add(others.warnings_), faults_.add(others.faults_);
    said_.insert(said_.end(), others.said_.begin(), others.said_.end());
  }
  std::vector<std::string> lines() const {
    std::vector<std::string> out = said_, counted = warnings_.lines();
    out.insert(out.end(), counted.begin(), counted.end());
    return out;
  }
  const CountedKinds& faults() const { return faults_; }

 private:
  std::vector<std::string> said_;
  CountedKinds warnings_, faults_;
};

// Names for one warning: the first few, and how often all of them occurred.
class Listed {
 public:
  void add(const std::string& name, size_t times = 1) {
    if (named_ < 6) names_ += (named_ > 0 ? ", " : "") + name;
    if (named_ == 6) names_ += ", ...";
    ++named_;
    times_ += times;
  }
  void addTo(Warnings& warnings, const std::string& what) const { warnings.add(what + names_, times_); }

 private:
  std::string names_;
  size_t named_ = 0, times_ = 0;
};

}  // namespace roomlight::importers
