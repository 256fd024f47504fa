#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "engine/technique.h"
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
  int measured = 0;
  for (const Technique* t : techniques()) {
    const MeterAccuracy& a = t->meters;
    if (a.places == 0) continue;
    ++measured;
    const size_t at = page.find(fmt::format("\n| {} | ", t->name));
    ASSERT_NE(at, std::string::npos) << t->name;
    const std::vector<std::string> row = cells(page.substr(at + 1, page.find('\n', at + 1) - at - 1));
    ASSERT_GT(row.size(), 4u);
    EXPECT_EQ(std::stoi(row[3]), a.places) << t->name;
    EXPECT_NEAR(std::abs(std::stod(row[4])), a.worstPercent, 1e-9) << t->name;
  }
  EXPECT_EQ(measured, 3);
  double within = 0, mean = 0;
  std::stringstream meters(testing::readFile(ROOMLIGHT_SOURCE_DIR "/docs/measured/meters.md"));
  for (std::string line; std::getline(meters, line);) {
    if (!line.starts_with("| evening") && !line.starts_with("| day")) continue;
    mean = std::max(mean, std::abs(std::stod(cells(line)[5]))), within = std::max(within, std::stod(cells(line)[7]));
  }
  EXPECT_NEAR(within, kHybridTechnique.meters.furnishedWithinPercent, 1e-9);
  EXPECT_NEAR(mean, kHybridTechnique.meters.furnishedMeanPercent, 1e-9);
}

}  // namespace
}  // namespace roomlight
