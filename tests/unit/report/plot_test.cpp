#include "report/plot.h"

#include <gtest/gtest.h>

namespace roomlight::report {
namespace {

TEST(Plot, ALinearAxisIsEven) {
  const Axis axis{-12, 12, 100, 340};
  EXPECT_DOUBLE_EQ(axis.at(0), 220);
  EXPECT_DOUBLE_EQ(axis.at(6), 280);
}

TEST(Plot, LogarithmicAxesHaveTicksOfEveryDecade) {
  const Axis axis = logarithmicAxis(1, 100, 0, 200);
  EXPECT_DOUBLE_EQ(axis.at(10), 100);
  EXPECT_EQ(axis.decadeTicks(), (std::vector<double>{1, 2, 5, 10, 20, 50, 100}));
  EXPECT_EQ(logarithmicAxis(1, 10000, 0, 1).decadeTicks(), (std::vector<double>{1, 10, 100, 1000, 10000}));
  const Axis narrow = logarithmicAxis(10, 10, 0, 1);
  EXPECT_DOUBLE_EQ(narrow.at(10), 0.5);
}

TEST(Plot, IsAnSvgOfItsElements) {
  Plot plot(560, 300, "Error <x>");
  plot.line(1, 2, 3, 4, "class='grid'");
  plot.bar(1, 2, 30.25, 17, "#123456");
  plot.dot(1, 2, 3, "fill='#fff'", "a & b");
  plot.path("M1 2l3 4", "fill='none'");
  plot.text(1, 2.25, "<5", "text-anchor='end'");
  EXPECT_EQ(plot.svg(),
            "<svg viewBox='0 0 560 300' role='img' aria-label=\"Error &lt;x&gt;\">"
            "<line class='grid' x1='1.0' x2='3.0' y1='2.0' y2='4.0'/>"
            "<rect x='1.0' y='2.0' width='30.2' height='17' fill='#123456'/>"
            "<circle cx='1.0' cy='2.0' r='3' fill='#fff'><title>a &amp; b</title></circle>"
            "<path d='M1 2l3 4' fill='none'/><text x='1.0' y='2.2' text-anchor='end'>&lt;5</text></svg>");
}

}  // namespace
}  // namespace roomlight::report
