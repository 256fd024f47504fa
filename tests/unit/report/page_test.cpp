#include "report/page.h"

#include <gtest/gtest.h>

namespace roomlight::report {
namespace {

TEST(Page, EscapesTextForTagsAndAttributes) {
  EXPECT_EQ(escaped("a<b> & \"c\" 'd'\n"), "a&lt;b&gt; &amp; &quot;c&quot; &#39;d&#39; ");
  EXPECT_EQ(attribute("title", "\"x\""), " title=\"&quot;x&quot;\"");
  EXPECT_EQ(attribute("title", ""), "");
}

TEST(Page, HasItsOwnStyleAfterTheSharedOneAndTheBodyInAColumn) {
  const std::string html = page("A & B", "p{color:red}", "<p>x</p>\n");
  EXPECT_EQ(html.substr(0, 15), "<!doctype html>");
  EXPECT_NE(html.find("<title>A &amp; B</title>"), std::string::npos);
  EXPECT_NE(html.find("}\np{color:red}</style>"), std::string::npos);
  EXPECT_NE(html.find("<body><main>\n<p>x</p>\n</main></body></html>\n"), std::string::npos);
  const std::string plain = plainPage("A", "p{color:red}", "<p>x</p>");
  EXPECT_NE(plain.find("<style>p{color:red}</style></head>\n<body><p>x</p></body>"), std::string::npos);
}

TEST(Page, CarriesWhatDrawsPlotsWhereItHasAny) {
  const std::string script = "<script>draw()</script>", shown = plot("front", "All <designs>", R"({"a":"</script>"})");
  EXPECT_NE(shown.find("data-plot=\"front\" role=\"group\" aria-label=\"All &lt;designs&gt;\""), std::string::npos);
  EXPECT_NE(shown.find(R"(<script type="application/json">{"a":"\u003c/script>"}</script>)"), std::string::npos);
  EXPECT_NE(page("A", "", shown, script).find("</main>" + script + "</body>"), std::string::npos);
  EXPECT_NE(plainPage("A", "", shown, script).find(script + "</body>"), std::string::npos);
  EXPECT_EQ(page("A", "", "<p>plot</p>", script).find(script), std::string::npos);
}

// The vectors of RFC 4648.
TEST(Page, PicturesAreInThePageAsBase64) {
  const std::pair<std::string, std::string> vectors[] = {
      {"", ""}, {"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : vectors)
    EXPECT_EQ(jpegPicture("a<b", bytes), "<img alt=\"a&lt;b\" src=\"data:image/jpeg;base64," + text + "\">");
}

TEST(Page, FiguresHaveACaptionAndAClassOnlyIfGiven) {
  EXPECT_EQ(figure("x"), "<figure>x</figure>");
  EXPECT_EQ(figure("x", "<b>y</b>", "shot"), "<figure class=\"shot\">x<figcaption><b>y</b></figcaption></figure>");
}

}  // namespace
}  // namespace roomlight::report
