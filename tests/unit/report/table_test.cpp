#include "report/table.h"

#include <gtest/gtest.h>

namespace roomlight::report {
namespace {

TEST(Table, AlignsHeadAndCellsOfAColumnAlike) {
  Table table({"room", "<use", "lx"});
  table.row({"Hall", "way", 20});
  table.row({"Bath", Cell("bath", "soft"), Cell("–", "", "not \"measured\"")}, "sum");
  EXPECT_EQ(table.html(),
            "<table><thead><tr><th>room</th><th class=\"l\">use</th><th>lx</th></tr></thead>\n"
            "<tr><td>Hall</td><td class=\"l\">way</td><td>20</td></tr>\n"
            "<tr class=\"sum\"><td>Bath</td><td class=\"l soft\">bath</td><td title=\"not "
            "&quot;measured&quot;\">–</td></tr>\n</table>");
}

TEST(Table, InATerminalColumnsAreAsWideAsTheirCharacters) {
  Table table({"room", "m²", "<note"});
  table.row({"Büro", fixed(12.345, 1), "x"});
  table.row({"Hall", 7, ""});
  EXPECT_EQ(table.text(), "room    m²  note\nBüro  12.3  x\nHall     7\n");
}

TEST(Table, LeavesOutColumnsOfThatName) {
  Table table({"a", kNoColumn, "c"});
  table.row({"1", "a long one", "3"});
  EXPECT_EQ(table.text(), "a  c\n1  3\n");
  EXPECT_EQ(table.html().find("long"), std::string::npos);
}

TEST(Table, GrowsByColumnsAndCells) {
  Table table({"scene"});
  table.column("cone");
  EXPECT_TRUE(table.isEmpty());
  table.row({"room"}).emplace_back(verdict(true));
  EXPECT_FALSE(table.isEmpty());
  EXPECT_NE(table.wideHtml().find("<td>room</td><td class=\"met\">✓ met</td>"), std::string::npos) << table.wideHtml();
}

TEST(Table, FactsHaveNoHeads) {
  EXPECT_EQ(factsHtml({{"seed", "<1>"}}), "<table><tr><td>seed</td><td class=\"l\">&lt;1&gt;</td></tr>\n</table>\n");
}

}  // namespace
}  // namespace roomlight::report
