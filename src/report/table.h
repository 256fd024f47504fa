// Tables for pages and for terminals.
#pragma once

#include <concepts>
#include <string>
#include <utility>
#include <vector>

namespace roomlight::report {

struct Cell {
  std::string content;      // HTML on a page, text in a terminal
  std::string kind, title;  // its class, and text for who points at it; only on a page

  Cell(std::string c, std::string k = {}, std::string t = {})
      : content(std::move(c)), kind(std::move(k)), title(std::move(t)) {}
  Cell(const char* c) : content(c) {}
  Cell(std::integral auto count) : content(std::to_string(count)) {}
};

// With so many digits behind the point.
std::string fixed(double value, int digits);

// "✓ met" or "✗ missed" in the colours of that.
Cell verdict(bool met);

constexpr const char* kNoColumn = "\x01";  // above a column that is left out, with its cells

class Table {
 public:
  // What stands above each column; where all are empty, nothing does. "<" before a name: the column's cells are aligned
  // at the left, as the first column's always are, all others at the right.
  explicit Table(const std::vector<std::string>& heads);
  void column(const std::string& head);
  // Its cells, for more of them.
  std::vector<Cell>& row(std::vector<Cell> cells, const std::string& kind = {});

  bool isEmpty() const { return rows_.size() == 1; }
  std::string html() const;
  std::string wideHtml() const;  // in a box that scrolls where the window is too narrow
  std::string text() const;  // a line each row, columns two spaces apart

 private:
  struct Row {
    std::vector<Cell> cells;
    std::string kind;
  };
  std::vector<bool> left_, shown_;  // a column
  std::vector<Row> rows_{1};  // first the heads
};

// Names and values, both text.
std::string factsHtml(const std::vector<std::pair<std::string, std::string>>& facts);

}  // namespace roomlight::report
