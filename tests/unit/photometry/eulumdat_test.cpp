#include "photometry/web_files.h"

#include <gtest/gtest.h>

#include "unit/photometry/web_files.h"

namespace roomlight {
namespace {

using testing::LdtText;
using testing::radians;
using testing::steps;

PhotometricWeb webOf(const std::string& text) {
  const Result<WebFile> file = parseEulumdat(text);
  EXPECT_TRUE(file) << file.error();
  return file ? file.value().web : PhotometricWeb{};
}

std::string warningsOf(const std::string& text) {
  const Result<WebFile> file = parseEulumdat(text);
  EXPECT_TRUE(file) << file.error();
  std::string all;
  if (file) {
    for (const std::string& w : file.value().warnings) all += w + "; ";
  }
  return all;
}

double at(const PhotometricWeb& web, double cDeg, double gammaDeg) {
  const double c = radians(cDeg), g = radians(gammaDeg);
  return intensityCd(web, {static_cast<float>(std::sin(g) * std::cos(c)), static_cast<float>(std::sin(g) * std::sin(c)),
                           static_cast<float>(-std::cos(g))});
}

// The n-th line, from 1, replaced.
std::string withLine(const std::string& text, int n, const std::string& line) {
  size_t from = 0;
  for (int i = 1; i < n; ++i) from = text.find('\n', from) + 1;
  return text.substr(0, from) + line + text.substr(text.find("\r\n", from));
}

TEST(Eulumdat, symmetriesAreUnfolded) {
  const auto about = [](double c) { return std::cos(radians(c)); };
  const testing::Intensity intensities[] = {[&](double c, double g) { return 100 + g + 50 * about(c - 60); },
                                            [](double, double g) { return 100 + g; },
                                            [&](double c, double g) { return 100 + g + 50 * about(c); },
                                            [&](double c, double g) { return 100 + g + 50 * about(c - 90); },
                                            [&](double c, double g) { return 100 + g + 50 * about(2 * c); }};
  for (int symmetry = 0; symmetry <= 4; ++symmetry) {
    LdtText file;
    file.symmetry = symmetry, file.candelaPerKlm = intensities[symmetry], file.lumens = 2000;
    const Result<WebFile> web = parseEulumdat(file.text());
    ASSERT_TRUE(web) << web.error();
    for (const double c : steps(0, 345, 15)) {
      for (const double g : {10.0, 45.0, 85.0})
        EXPECT_NEAR(at(web.value().web, c, g), 2 * file.candelaPerKlm(c, g), 4e-3) << symmetry << " " << c << " " << g;
    }
  }
}

TEST(Eulumdat, fluxIsThatOfTheLampsTimesTheRatio) {
  LdtText file;
  file.gammas = steps(0, 90, 1);
  PhotometricWeb web = webOf(file.text());
  EXPECT_NEAR(web.fluxLm, 1000, 0.1);
  EXPECT_EQ(web.statedFluxLm, 1000);
  EXPECT_EQ(web.name, "test");
  EXPECT_EQ(web.manufacturer, "Roomlight");
  EXPECT_EQ(web.watts, 11);
  EXPECT_EQ(warningsOf(file.text()), "");
  file.ratioPercent = 80;
  EXPECT_EQ(warningsOf(file.text()),
            "the intensities add up to 999.975 lm, 125 % of the 800 lm stated for the luminaire; ");
  file.factor = 0.8;
  EXPECT_EQ(warningsOf(file.text()), "");
  // Absolute: what is stated is the luminaire's.
  file.factor = 1, file.lamps = "-1", file.lumens = 1500;
  web = webOf(file.text());
  EXPECT_NEAR(web.fluxLm, 1500, 0.1);
  EXPECT_EQ(warningsOf(file.text()), "");
}

TEST(Eulumdat, theLengthOfTheOpeningLiesAlongC90) {
  LdtText file;
  file.lengthMm = 1200, file.widthMm = 60;
  PhotometricWeb web = webOf(file.text());
  EXPECT_FALSE(web.round);
  EXPECT_FLOAT_EQ(web.sizeC90M, 1.2f);
  EXPECT_FLOAT_EQ(web.sizeC0M, 0.06f);
  file.lengthMm = 150, file.widthMm = 0;
  web = webOf(file.text());
  EXPECT_TRUE(web.round);
  EXPECT_FLOAT_EQ(web.sizeC0M, 0.15f);
  file.lengthMm = 0;
  EXPECT_FALSE(webOf(file.text()).hasOpening());
}

TEST(Eulumdat, oddFilesAreReadWithAWarning) {
  LdtText file;
  file.gammas = steps(0, 90, 2.5);
  const std::string plain = file.text();
  std::string s = plain;
  for (size_t i = s.find('.', s.find("test.ldt") + 8); i != std::string::npos; i = s.find('.', i + 1)) s[i] = ',';
  EXPECT_EQ(warningsOf(s), "numbers are written with a decimal comma; ");
  EXPECT_NEAR(webOf(s).fluxLm, webOf(plain).fluxLm, 1e-9);
  EXPECT_EQ(warningsOf("\xef\xbb\xbf" + plain), "begins with a byte-order mark; ");
  EXPECT_EQ(warningsOf(withLine(plain, 9, "H\xe4ngeleuchte")), "letters are read as Latin-1; ");
  EXPECT_EQ(warningsOf(withLine(plain, 5, "")), "");
  EXPECT_EQ(warningsOf(withLine(plain, 24, "0")), "the factor of intensities is 0; read as 1; ");
  EXPECT_EQ(warningsOf(withLine(plain, 40, "0.5\r\n\r\n")), "empty lines between numbers are skipped; ");
  EXPECT_EQ(warningsOf(plain + "\r\n\r\n"), "");
  EXPECT_EQ(warningsOf(plain + "5\r\n"), "goes on after the last intensity; the rest is ignored; ");
  EXPECT_EQ(warningsOf(plain.substr(0, plain.size() - 2)), "");
  const std::string shorter = plain.substr(0, plain.rfind("\r\n", plain.size() - 3) + 2);
  EXPECT_EQ(warningsOf(shorter), "the last values are missing; they count as 0; ");
  file.symmetry = 0;
  file.planes = {15, 30, 0, 90, 180, 270};
  EXPECT_EQ(warningsOf(file.text()), "the planes are not in order of their angles; ");
  file.planes = {90, 180, 270};
  EXPECT_EQ(warningsOf(file.text()), "there is no plane C0; it is interpolated; ");
  file.symmetry = 2, file.planes = {90, 180, 270, 0};
  EXPECT_EQ(warningsOf(file.text()), "the C angles do not fit the symmetry; planes are taken as evenly spaced; ");
}

TEST(Eulumdat, damagedFilesAreOneLineWithItsNumber) {
  const LdtText file;
  const std::string plain = file.text();
  const auto errorOf = [](const std::string& text) { return parseEulumdat(text).error(); };
  EXPECT_EQ(errorOf(""), "is empty");
  EXPECT_EQ(errorOf("hello\n1\n"), "line 2: the file ends before line 3, the symmetry");
  EXPECT_EQ(errorOf(withLine(plain, 3, "7")), "line 3: line 3, the symmetry: 7 is not a whole number from 0 to 4");
  EXPECT_EQ(errorOf(withLine(plain, 6, "many")), "line 6: line 6, the number of gammas: 'many' is not a number");
  EXPECT_EQ(errorOf(withLine(plain, 29, "0")),
            "line 29: the flux of the lamps is 0 lm; without it intensities in cd/klm mean nothing");
  EXPECT_EQ(errorOf(withLine(plain, 4, "700")).substr(0, 34), "line 104: the file ends before the");
  EXPECT_EQ(errorOf(plain.substr(0, plain.size() / 2)).find("the file ends before") == std::string::npos, false);
  LdtText bad;
  bad.gammas = {0, 20, 10};
  EXPECT_EQ(errorOf(bad.text()), "line 69: gammas must ascend, but 10 follows 20");
  bad = file, bad.symmetry = 4, bad.planes = steps(0, 270, 45);
  EXPECT_EQ(errorOf(bad.text()), "line 4: 7 C planes do not fit this symmetry; their number must be a multiple of 4");
  bad = file, bad.candelaPerKlm = [](double, double) { return 0; };
  EXPECT_EQ(errorOf(bad.text()), "all intensities are zero; there is no light");
}

}  // namespace
}  // namespace roomlight
