#include "search/front.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "search/archive.h"

namespace roomlight::search {
namespace {

// Crowding distances of one front. An objective in which all of it are equal tells none apart.
void crowd(std::span<const double> objectives, size_t each, std::vector<uint32_t>& front,
           std::vector<double>& crowding) {
  for (size_t m = 0; m < each; ++m) {
    const auto f = [&](uint32_t i) { return objectives[i * each + m]; };
    std::sort(front.begin(), front.end(), [&](uint32_t a, uint32_t b) { return f(a) != f(b) ? f(a) < f(b) : a < b; });
    crowding[front.front()] = crowding[front.back()] = INFINITY;
    const double width = f(front.back()) - f(front.front());
    if (width <= 0) continue;
    for (size_t i = 1; i + 1 < front.size(); ++i) crowding[front[i]] += (f(front[i + 1]) - f(front[i - 1])) / width;
  }
}

}  // namespace

Ranking rankPoints(std::span<const double> objectives, size_t objectivesEach) {
  const size_t count = objectives.size() / objectivesEach;
  const auto point = [&](uint32_t i) { return objectives.subspan(i * objectivesEach, objectivesEach); };
  Ranking ranking{std::vector<uint32_t>(count), std::vector<double>(count)};
  // 1. In lexicographic order none is dominated by a later one.
  std::vector<uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    const auto fa = point(a), fb = point(b);
    for (size_t m = 0; m < objectivesEach; ++m)
      if (fa[m] != fb[m]) return fa[m] < fb[m];
    return a < b;
  });
  // 2. Each goes to the first front of which none dominates it: found by halving, for what dominates a point is itself
  // dominated by some of every front before its own. The last ones of a front are the likeliest to dominate.
  std::vector<std::vector<uint32_t>> fronts;
  for (uint32_t i : order) {
    const auto beaten = [&](const std::vector<uint32_t>& front) {
      return std::any_of(front.rbegin(), front.rend(),
                         [&](uint32_t other) { return dominates(point(other), point(i)); });
    };
    const auto place = std::partition_point(fronts.begin(), fronts.end(), beaten);
    ranking.rank[i] = static_cast<uint32_t>(place - fronts.begin());
    if (place == fronts.end())
      fronts.push_back({i});
    else
      place->push_back(i);
  }
  for (auto& front : fronts) crowd(objectives, objectivesEach, front, ranking.crowding);
  return ranking;
}

std::vector<size_t> selectBest(const Ranking& ranking, size_t count) {
  std::vector<size_t> order(ranking.rank.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return before(ranking, a, b); });
  order.resize(std::min(order.size(), count));
  return order;
}

}  // namespace roomlight::search
