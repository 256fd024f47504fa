#include "base/result.h"

#include <gtest/gtest.h>

#include <memory>

namespace roomlight {
namespace {

Result<int> half(int n) {
  if (n % 2) return Error{"odd"};
  return n / 2;
}

TEST(Result, holdsAValueOrALine) {
  ASSERT_TRUE(half(6).ok());
  EXPECT_EQ(half(6).value(), 3);
  EXPECT_FALSE(half(5));
  EXPECT_EQ(half(5).error(), "odd");
}

TEST(Result, movesValuesThatCannotBeCopied) {
  Result<std::unique_ptr<int>> r(std::make_unique<int>(7));
  const std::unique_ptr<int> out = std::move(r).value();
  EXPECT_EQ(*out, 7);
}

}  // namespace
}  // namespace roomlight
