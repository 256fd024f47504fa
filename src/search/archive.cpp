#include "search/archive.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace roomlight::search {
namespace {

// Keeps the designs for which keep[i], in their order.
void compact(Archive& archive, const std::vector<char>& keep) {
  const size_t m = archive.objectivesEach;
  size_t to = 0;
  for (size_t i = 0; i < archive.size(); ++i) {
    if (!keep[i]) continue;
    if (to != i) {
      archive.designs.assign(to, std::as_const(archive.designs)[i]);
      std::copy_n(archive.objectives.begin() + static_cast<ptrdiff_t>(i * m), m,
                  archive.objectives.begin() + static_cast<ptrdiff_t>(to * m));
    }
    ++to;
  }
  archive.designs.resize(to);
  archive.objectives.resize(to * m);
}

// Nearest and second nearest of a point among those alive.
struct Neighbours {
  double nearest = std::numeric_limits<double>::infinity(), second = nearest;
  size_t nearestAt = 0, secondAt = 0;
  void see(double distance, size_t at) {
    if (distance < nearest)
      second = nearest, secondAt = nearestAt, nearest = distance, nearestAt = at;
    else if (distance < second)
      second = distance, secondAt = at;
  }
};

class Crowd {
 public:
  explicit Crowd(const Archive& archive)
      : m_(archive.objectivesEach), points_(archive.objectives), alive_(archive.size(), 1), around_(archive.size()) {
    const Range range = rangeOf(archive);
    for (size_t i = 0; i < points_.size(); ++i) {
      const double width = range.highest[i % m_] - range.lowest[i % m_];
      points_[i] = width > 0 ? (points_[i] - range.lowest[i % m_]) / width : 0;
    }
    for (size_t i = 0; i < alive_.size(); ++i) around_[i] = lookAround(i);
  }
  bool closer(size_t a, size_t b) const {
    return around_[a].nearest != around_[b].nearest ? around_[a].nearest < around_[b].nearest
                                                    : around_[a].second < around_[b].second;
  }
  void remove(size_t gone) {
    alive_[gone] = 0;
    for (size_t i = 0; i < alive_.size(); ++i)
      if (alive_[i] && (around_[i].nearestAt == gone || around_[i].secondAt == gone)) around_[i] = lookAround(i);
  }
  const std::vector<char>& alive() const { return alive_; }

 private:
  Neighbours lookAround(size_t i) const {
    Neighbours found;
    for (size_t j = 0; j < alive_.size(); ++j) {
      if (!alive_[j] || j == i) continue;
      double squares = 0;
      for (size_t k = 0; k < m_; ++k) {
        const double d = points_[i * m_ + k] - points_[j * m_ + k];
        squares += d * d;
      }
      found.see(squares, j);
    }
    return found;
  }

  size_t m_;
  std::vector<double> points_;  // in ranges of the front
  std::vector<char> alive_;
  std::vector<Neighbours> around_;
};

}  // namespace

bool dominates(std::span<const double> a, std::span<const double> b) {
  bool better = false;
  for (size_t m = 0; m < a.size(); ++m) {
    if (a[m] > b[m]) return false;
    better |= a[m] < b[m];
  }
  return better;
}

Range rangeOf(const Archive& archive) {
  Range range;
  if (archive.size() == 0) return range;
  range.lowest.assign(archive.objectivesOf(0).begin(), archive.objectivesOf(0).end());
  range.highest = range.lowest;
  for (size_t i = 1; i < archive.size(); ++i)
    for (size_t m = 0; m < archive.objectivesEach; ++m) {
      range.lowest[m] = std::min(range.lowest[m], archive.objectivesOf(i)[m]);
      range.highest[m] = std::max(range.highest[m], archive.objectivesOf(i)[m]);
    }
  return range;
}

void thin(Archive& archive, size_t most) {
  if (archive.size() <= most) return;
  Crowd crowd(archive);
  std::vector<char> best(archive.size(), 0);
  for (size_t m = 0; m < archive.objectivesEach; ++m) {
    size_t at = 0;
    for (size_t i = 1; i < archive.size(); ++i)
      if (archive.objectivesOf(i)[m] < archive.objectivesOf(at)[m]) at = i;
    best[at] = 1;
  }
  for (size_t left = archive.size(); left > most; --left) {
    size_t gone = archive.size();
    for (size_t i = 0; i < archive.size(); ++i)
      if (crowd.alive()[i] && !best[i] && (gone == archive.size() || crowd.closer(i, gone))) gone = i;
    if (gone == archive.size()) break;  // only the best of each objective are left
    crowd.remove(gone);
  }
  compact(archive, crowd.alive());
}

void add(Archive& archive, const Genomes& designs, std::span<const double> objectives) {
  const size_t m = archive.objectivesEach;
  std::vector<char> keep(archive.size(), 1);
  for (size_t c = 0; c < designs.count; ++c) {
    const std::span<const double> f = objectives.subspan(c * m, m);
    bool beaten = false;
    for (size_t i = 0; i < keep.size() && !beaten; ++i) {
      if (!keep[i]) continue;
      // One pass tells how the two stand to one another.
      bool better = false, worse = false;
      const double* g = &archive.objectives[i * m];
      for (size_t k = 0; k < m; ++k) better |= f[k]<g[k], worse |= f[k]> g[k];
      beaten = !better;  // dominated, or equal to one that was there before
      keep[i] = !better || worse;
    }
    if (beaten) continue;
    archive.designs.append(designs[c]);
    archive.objectives.insert(archive.objectives.end(), f.begin(), f.end());
    keep.push_back(1);
  }
  compact(archive, keep);
  if (archive.size() > archive.limit + archive.limit / 5) thin(archive, archive.limit);
}

std::vector<size_t> sorted(const Archive& archive) {
  std::vector<size_t> order(archive.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    const auto fa = archive.objectivesOf(a), fb = archive.objectivesOf(b);
    return std::lexicographical_compare(fa.begin(), fa.end(), fb.begin(), fb.end());
  });
  return order;
}

}  // namespace roomlight::search
