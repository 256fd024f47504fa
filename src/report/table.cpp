#include "report/table.h"

#include <fmt/format.h>

#include <algorithm>

#include "report/page.h"

namespace roomlight::report {
namespace {

// Bytes that begin a character: what a column's width counts.
size_t width(const Cell& cell) {
  return static_cast<size_t>(std::count_if(cell.content.begin(), cell.content.end(),
                                           [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

}  // namespace

std::string fixed(double value, int digits) { return fmt::format("{:.{}f}", value, digits); }

Cell verdict(bool met) { return met ? Cell("✓ met", "met") : Cell("✗ missed", "missed"); }

Table::Table(const std::vector<std::string>& heads) {
  for (const std::string& head : heads) column(head);
}

void Table::column(const std::string& head) {
  left_.push_back(head.starts_with('<')), shown_.push_back(head != kNoColumn);
  rows_[0].cells.emplace_back(head.substr(left_.back()));
}

std::vector<Cell>& Table::row(std::vector<Cell> cells, const std::string& kind) {
  return rows_.emplace_back(std::move(cells), kind).cells;
}

std::string Table::html() const {
  std::string s = "<table>";
  for (const Row& row : rows_) {
    const bool isHead = &row == rows_.data();
    if (isHead && std::all_of(row.cells.begin(), row.cells.end(), [](const Cell& c) { return c.content.empty(); }))
      continue;
    s += (isHead ? "<thead><tr" : "<tr") + attribute("class", row.kind) + ">";
    for (size_t i = 0; i < row.cells.size(); ++i) {
      const Cell& c = row.cells[i];
      const std::string kind = !left_[i] ? c.kind : c.kind.empty() ? "l" : "l " + c.kind;
      if (shown_[i])
        s += fmt::format("<{0}{1}{2}>{3}</{0}>", isHead ? "th" : "td", attribute("class", kind),
                         attribute("title", c.title), c.content);
    }
    s += isHead ? "</tr></thead>\n" : "</tr>\n";
  }
  return s + "</table>";
}

std::string Table::wideHtml() const { return "<div class=\"wide\">" + html() + "</div>\n"; }

std::string Table::text() const {
  std::vector<size_t> widths(left_.size());
  for (const Row& row : rows_) {
    for (size_t i = 0; i < row.cells.size(); ++i) widths[i] = std::max(widths[i], width(row.cells[i]));
  }
  std::string text;
  for (const Row& row : rows_) {
    std::string line;
    for (size_t i = 0; i < row.cells.size(); ++i) {
      const std::string gap(widths[i] - width(row.cells[i]), ' '), &content = row.cells[i].content;
      if (shown_[i]) line += (i ? "  " : "") + (i == 0 || left_[i] ? content + gap : gap + content);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

std::string factsHtml(const std::vector<std::pair<std::string, std::string>>& facts) {
  Table table({"", "<"});
  for (const auto& [name, value] : facts) table.row({escaped(name), escaped(value)});
  return table.html() + "\n";
}

}  // namespace roomlight::report
