#include "base/utf8.h"

#include <gtest/gtest.h>

namespace roomlight {
namespace {

TEST(Utf8, isToldFromOtherBytes) {
  EXPECT_TRUE(
      isUtf8("k\xc3\xbc"
             "che \xe2\x82\xac \xf0\x9f\x92\xa1"));
  EXPECT_FALSE(
      isUtf8("k\xfc"
             "che"));         // Latin-1
  EXPECT_FALSE(isUtf8("\xe2\x82"));            // cut short
  EXPECT_FALSE(isUtf8("\xc0\xaf"));            // overlong
  EXPECT_FALSE(isUtf8("\xe0\x80\xaf"));        // overlong
  EXPECT_FALSE(isUtf8("\xed\xa0\x80"));        // a surrogate
  EXPECT_FALSE(isUtf8("\xf4\x90\x80\x80"));    // beyond U+10FFFF
}

TEST(Utf8, otherBytesAreTakenAsLatin1) {
  EXPECT_EQ(asUtf8("k\xfc"
                   "che"),
            "k\xc3\xbc"
            "che");
  EXPECT_EQ(asUtf8("k\xc3\xbc"
                   "che"),
            "k\xc3\xbc"
            "che");
}

TEST(Utf8, textForMessagesIsOneLineCutBetweenCharacters) {
  EXPECT_EQ(printable("a\nb\tc\x7f"), "a b c ");
  EXPECT_EQ(printable("abc", 3), "abc");
  EXPECT_EQ(printable("abcd", 3), "abc...");
  EXPECT_EQ(printable("ab\xc3\xbc", 3), "ab...");
}

}  // namespace
}  // namespace roomlight
