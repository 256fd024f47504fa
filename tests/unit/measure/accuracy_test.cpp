#include "measure/accuracy.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "unit/temporary_folder.h"

namespace roomlight {
namespace {

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> out;
  std::stringstream in(line);
  for (std::string cell; std::getline(in, cell, '|');) out.push_back(cell);
  return out;
}

TEST(Accuracy, isThatOfThePagesOfMeasuredFigures) {
  const std::string page = testing::readFile(ROOMLIGHT_SOURCE_DIR "/docs/measured/validation.md");
  for (const MeasuredAccuracy& a : kMeasuredAccuracy) {
    const size_t at = page.find(fmt::format("\n| {} | ", a.technique));
    ASSERT_NE(at, std::string::npos) << a.technique;
    const std::vector<std::string> row = cells(page.substr(at + 1, page.find('\n', at + 1) - at - 1));
    ASSERT_GT(row.size(), 4u);
    EXPECT_EQ(std::stoi(row[3]), a.places) << a.technique;
    EXPECT_NEAR(std::abs(std::stod(row[4])), a.worstPercent, 1e-9) << a.technique;
  }
  double within = 0, mean = 0;
  std::stringstream meters(testing::readFile(ROOMLIGHT_SOURCE_DIR "/docs/measured/meters.md"));
  for (std::string line; std::getline(meters, line);) {
    if (!line.starts_with("| evening") && !line.starts_with("| day")) continue;
    mean = std::max(mean, std::abs(std::stod(cells(line)[5]))), within = std::max(within, std::stod(cells(line)[7]));
  }
  EXPECT_NEAR(within, kFurnishedWithinPercent, 1e-9);
  EXPECT_NEAR(mean, kFurnishedMeanPercent, 1e-9);
}

}  // namespace
}  // namespace roomlight
