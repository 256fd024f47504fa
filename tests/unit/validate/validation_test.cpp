#include "validate/validation.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace roomlight {
namespace {

TEST(Validation, unknownTechniquesAreRefused) {
  ValidationSettings settings;
  settings.techniques = {"guessing"};
  const Result<Validation> v = validateTechniques(settings);
  ASSERT_FALSE(v);
  EXPECT_NE(v.error().find("guessing"), std::string::npos);
}

TEST(Validation, stopsWhenAsked) {
  const std::atomic<bool> stop = true;
  Progress progress;
  progress.cancelled = &stop;
  const Validation v = validateTechniques({}, progress).value();
  EXPECT_FALSE(v.complete);
  EXPECT_TRUE(v.rows.empty());
}

// The whole of it, in short: every technique keeps its promise.
TEST(Validation, techniquesKeepWhatTheyPromise) {
  ValidationSettings settings;
  settings.brief = true;
  const Validation v = validateTechniques(settings).value();
  for (const ValidationRow& r : v.rows)
    EXPECT_TRUE(r.pass) << r.name << ", " << r.place << ", " << r.technique << ": " << r.got << " for " << r.expected;
  EXPECT_TRUE(v.pass());
  ASSERT_EQ(v.techniques.size(), 3u);
  EXPECT_EQ(v.techniques[0].places, v.techniques[2].places);
  EXPECT_GT(v.techniques[0].places, 25);

  const auto json = nlohmann::json::parse(validationJson(v));
  EXPECT_TRUE(json["pass"]);
  EXPECT_EQ(json["rows"].size(), v.rows.size());
  const std::string html = validationHtml(v, "1");
  EXPECT_NE(html.find("5.8 albedo 0.95"), std::string::npos);
  EXPECT_EQ(html.find("http"), std::string::npos) << "needs nothing else";
}

// A value that is off is told so.
TEST(Validation, missesAreMisses) {
  Validation v;
  v.rows = {{"case", "", "lx", "", "here", "path", 100, 102, 2, "%", false}};
  v.techniques = {{"path", 1, false, 2, "case, here", 0, 1}};
  EXPECT_FALSE(v.pass());
  EXPECT_NE(validationHtml(v, "1").find("missed"), std::string::npos);
}

}  // namespace
}  // namespace roomlight
