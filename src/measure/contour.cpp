#include "measure/drawings.h"

#include <cmath>

namespace roomlight {
namespace {

// Sides of a square of four neighbouring nodes.
enum Side { kTop, kRight, kBottom, kLeft, kNone };
struct Pieces {
  Side from1, to1, from2, to2;
};

// By which nodes are inside (1 top left, 2 top right, 4 bottom right, 8 bottom left): lines that keep the inside on the
// same hand.
constexpr Pieces kPieces[16] = {
    {kNone, kNone, kNone, kNone},  {kLeft, kTop, kNone, kNone},     {kTop, kRight, kNone, kNone},
    {kLeft, kRight, kNone, kNone}, {kRight, kBottom, kNone, kNone}, {kLeft, kTop, kRight, kBottom},
    {kTop, kBottom, kNone, kNone}, {kLeft, kBottom, kNone, kNone},  {kBottom, kLeft, kNone, kNone},
    {kBottom, kTop, kNone, kNone}, {kTop, kRight, kBottom, kLeft},  {kBottom, kRight, kNone, kNone},
    {kRight, kLeft, kNone, kNone}, {kRight, kTop, kNone, kNone},    {kTop, kLeft, kNone, kNone},
    {kNone, kNone, kNone, kNone}};
// Where opposite nodes are inside and the middle is too.
constexpr Pieces kJoined5 = {kLeft, kBottom, kRight, kTop}, kJoined10 = {kTop, kLeft, kBottom, kRight};

// The field with a rim of nodes below every level around it.
struct Nodes {
  std::span<const float> values;
  int columns, rows;
  float level;

  bool rim(int x, int y) const { return x < 0 || y < 0 || x >= columns || y >= rows; }
  float at(int x, int y) const {
    return rim(x, y) ? -kInfinity
                     : values[static_cast<size_t>(y) * static_cast<size_t>(columns) + static_cast<size_t>(x)];
  }
  bool inside(int x, int y) const { return at(x, y) >= level; }
  // Nodes are numbered with the rim; two edges belong to each, to the right and down.
  size_t edge(int x, int y, Side side) const {
    if (side == kRight) ++x;
    if (side == kBottom) ++y;
    const bool down = side == kLeft || side == kRight;
    return 2 * (static_cast<size_t>(y + 1) * static_cast<size_t>(columns + 2) + static_cast<size_t>(x + 1)) +
           (down ? 1 : 0);
  }
  ContourPoint point(size_t edge) const {
    const auto width = static_cast<size_t>(columns + 2);
    const int x = static_cast<int>(edge / 2 % width) - 1, y = static_cast<int>(edge / 2 / width) - 1,
              dx = edge % 2 ? 0 : 1, dy = 1 - dx;
    const bool onRim = rim(x, y) || rim(x + dx, y + dy);
    const float a = at(x, y), b = at(x + dx, y + dy), t = onRim ? 0.5f : (level - a) / (b - a);
    return {{static_cast<float>(x) + 0.5f + t * static_cast<float>(dx),
             static_cast<float>(y) + 0.5f + t * static_cast<float>(dy)},
            onRim};
  }
};

constexpr size_t kEnd = ~size_t{0};

}  // namespace

std::vector<std::vector<ContourPoint>> contours(std::span<const float> values, int columns, int rows, float level) {
  const Nodes nodes{values, columns, rows, level};
  std::vector<size_t> next(
      2 * static_cast<size_t>(columns + 2) * static_cast<size_t>(rows + 2) + 2 * static_cast<size_t>(columns + 3),
      kEnd);
  for (int y = -1; y < rows; ++y) {
    for (int x = -1; x < columns; ++x) {
      const int code = (nodes.inside(x, y) ? 1 : 0) + (nodes.inside(x + 1, y) ? 2 : 0) +
                       (nodes.inside(x + 1, y + 1) ? 4 : 0) + (nodes.inside(x, y + 1) ? 8 : 0);
      Pieces p = kPieces[code];
      if (code == 5 || code == 10) {
        const float middle = (nodes.at(x, y) + nodes.at(x + 1, y) + nodes.at(x, y + 1) + nodes.at(x + 1, y + 1)) / 4;
        if (middle >= level) p = code == 5 ? kJoined5 : kJoined10;
      }
      if (p.from1 != kNone) next[nodes.edge(x, y, p.from1)] = nodes.edge(x, y, p.to1);
      if (p.from2 != kNone) next[nodes.edge(x, y, p.from2)] = nodes.edge(x, y, p.to2);
    }
  }
  std::vector<std::vector<ContourPoint>> loops;
  for (size_t start = 0; start < next.size(); ++start) {
    if (next[start] == kEnd) continue;
    std::vector<ContourPoint> loop;
    for (size_t edge = start; next[edge] != kEnd;) {
      loop.push_back(nodes.point(edge));
      const size_t to = next[edge];
      next[edge] = kEnd;
      edge = to;
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

std::vector<float> withoutGaps(std::span<const float> values, int columns, int rows) {
  std::vector<float> filled(values.begin(), values.end());
  for (bool gaps = true, progress = true; gaps && progress;) {
    gaps = progress = false;
    const std::vector<float> before = filled;
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < columns; ++x) {
        float& here = filled[static_cast<size_t>(y) * static_cast<size_t>(columns) + static_cast<size_t>(x)];
        if (!std::isnan(here)) continue;
        float sum = 0;
        int count = 0;
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            if (x + dx < 0 || y + dy < 0 || x + dx >= columns || y + dy >= rows) continue;
            const float v =
                before[static_cast<size_t>(y + dy) * static_cast<size_t>(columns) + static_cast<size_t>(x + dx)];
            if (!std::isnan(v)) sum += v, ++count;
          }
        }
        if (count > 0) here = sum / static_cast<float>(count), progress = true;
        gaps = gaps || count == 0;
      }
    }
  }
  return filled;
}

}  // namespace roomlight
