#include "bake/page.h"

#include <gtest/gtest.h>

#include <set>

namespace roomlight::bake {
namespace {

std::string textOfBytes(std::initializer_list<int> bytes) {
  const std::string given(bytes.begin(), bytes.end());
  return textOf(given);
}

TEST(PageText, isSevenCharactersForSixBytes) {
  EXPECT_EQ(textOf({}), "");
  EXPECT_EQ(textOfBytes({0}), "\x01\x01");
  EXPECT_EQ(textOfBytes({255}), "\x03\x06");  // 255 = 2 x 125 + 5
  EXPECT_EQ(textOfBytes({0, 0, 0, 0, 0, 124}), "\x01\x01\x01\x01\x01\x01\x7f");
  EXPECT_EQ(textOfBytes({0, 0, 0, 0, 0, 12}).back(), '\x0e');  // not carriage return
  EXPECT_EQ(textOfBytes({0, 0, 0, 0, 0, 57}).back(), ';');
  EXPECT_EQ(textOfBytes({0, 0, 0, 0, 0, 58}).back(), '=');  // not '<'
  EXPECT_EQ(textOf(std::string(600, 'a')).size(), 700u);
  EXPECT_EQ(textOf(std::string(604, 'a')).size(), 705u);
}

TEST(PageText, hasNothingThatHtmlChanges) {
  std::string bytes;
  for (int i = 0; i < 60000; ++i) bytes += static_cast<char>(i * 2654435761u >> 16);
  const std::string text = textOf(bytes);
  const std::set<char> used(text.begin(), text.end());
  EXPECT_EQ(used.size(), 125u);
  for (const char c : {'\0', '\r', '<'}) EXPECT_FALSE(used.contains(c)) << int{c};
  EXPECT_GT(*used.begin(), 0);
}

TEST(BakedPage, takesTheHomeOrALinkInItsPlace) {
  const std::string page = "<title>roomlight</title><!--roomlight-home-->";
  const std::string whole = pageWithHome(page, "Anna & Ben", std::string(1000, 'a')).value();
  EXPECT_TRUE(
      whole.starts_with("<title>Anna &amp; Ben</title><script type=\"application/octet-stream\" "
                        "id=\"roomlight-home\" data-bytes=\"1000\">"));
  EXPECT_TRUE(whole.ends_with("</script>"));
  EXPECT_LT(whole.size(), 200u);  // packed
  EXPECT_EQ(pageWithLink(page, "flat", "home-1.glb").value(),
            "<title>flat</title><link id=\"roomlight-home\" href=\"home-1.glb\">");
  EXPECT_FALSE(pageWithHome("<title>roomlight</title>", "flat", "abc"));
}

}  // namespace
}  // namespace roomlight::bake
