#include <gtest/gtest.h>

#include "optimise/toml_tree.h"

namespace roomlight::optimise {
namespace {

constexpr size_t kDeep = 32;  // what is allowed

// `count` times `part`, with `between` between them.
std::string repeated(const std::string& part, size_t count, const std::string& between = "") {
  std::string out;
  for (size_t i = 0; i < count; ++i) out += (i ? between : "") + part;
  return out;
}

std::string nestedKey(size_t count) { return repeated("a", count, "."); }

// What lies as deep as `count` tables and lists, in several ways; all in line 3.
std::vector<std::string> nested(size_t count) {
  const size_t half = count / 2;
  const std::string begin = "# first\nfirst = 1\n";
  return {
      begin + "[" + nestedKey(count) + "]\nb = 1\n",
      begin + "[[" + nestedKey(count - 1) + "]]\nb = 1\n",
      begin + "[ \"a.b\" . 'c\"' . " + nestedKey(count - 2) + " ] # [[[\nb = 1\n",
      begin + nestedKey(count + 1) + " = 1\n",
      begin + "b = " + repeated("[", count) + repeated("]", count) + "\n",
      begin + "b = " + repeated("{ a = ", count) + "1" + repeated(" }", count) + "\n",
      begin + "b = [\"]\", " + repeated("[1.5, ", count - 1) + "2" + repeated("]", count) + "\n",
      begin + "b = { " + nestedKey(count) + " = 1, c = [0] }\n",
      begin + nestedKey(half) + " = { " + nestedKey(count - half + 1) + " = 1 }\n",
  };
}

TEST(Toml, DeepNestingIsRefusedWithItsLine) {
  for (const size_t count : {kDeep + 1, size_t{50'000}}) {
    for (const std::string& text : nested(count)) {
      const Result<TomlNode> tree = parseToml(text, "deep.toml");
      ASSERT_FALSE(tree) << text.substr(0, 60);
      EXPECT_EQ(tree.error(), "deep.toml:3: tables and lists are nested more than 32 deep") << text.substr(0, 60);
    }
  }
}

TEST(Toml, WhatIsNoTomlIsRefusedBeforeItIsNestedTooDeep) {
  for (const char* part : {"[", "{", "[[", "{ a = [", "a.", "[a.", "a = [", "a = { a."}) {
    const Result<TomlNode> tree = parseToml("# first\n" + repeated(part, 50'000), "deep.toml");
    ASSERT_FALSE(tree) << part;
    EXPECT_TRUE(tree.error().starts_with("deep.toml:2: ")) << tree.error();
  }
}

TEST(Toml, AsDeepAsIsAllowedIsRead) {
  for (const std::string& text : nested(kDeep)) {
    const Result<TomlNode> tree = parseToml(text, "deep.toml");
    ASSERT_TRUE(tree) << tree.error() << "\n" << text;
    EXPECT_EQ(tree.value().children.size(), 2u) << text;
  }
  // Side by side nothing is deep.
  const Result<TomlNode> wide =
      parseToml("[a.b.c]\n" + repeated("[[d.e]]\nf.g = [[1.5], { h.i = 2.5 }]\n", 100), "wide.toml");
  EXPECT_TRUE(wide) << wide.error();
}

TEST(Toml, DotsAndBracketsInTextsNumbersAndCommentsAreNoNesting) {
  const std::string many = repeated("[{.", 50), dots = repeated(".", 50);
  std::string text = "# " + many + "\n";
  text += "'" + dots + "' = '" + many + "' # " + many + "\n";
  text += "b = \"\\\"" + many + "\\\\\"\n";
  text += "c = \"\"\"" + many + "\n\"\" \\\"\"\" " + many + "\"\"\"\"\"\n";
  text += "d = '''\n" + many + "\\'''\n";
  text += "e = [ # " + many + "\n" + repeated("1.5", 50, ", ") + ", '" + many + "', ]\n";
  text += "f = \"\"\ng = 2.5e-3\n";
  text += "h = 1979-05-27T07:32:00.999999-07:00\n";
  text += "[\"x" + dots + "\".b] # " + many + "\nc = 1";
  const Result<TomlNode> tree = parseToml(text, "flat.toml");
  ASSERT_TRUE(tree) << tree.error() << "\n" << text;
  EXPECT_EQ(tree.value().children.size(), 9u);
}

}  // namespace
}  // namespace roomlight::optimise
