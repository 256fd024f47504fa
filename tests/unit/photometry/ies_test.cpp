#include "photometry/web_files.h"

#include <gtest/gtest.h>

#include "unit/photometry/web_files.h"

namespace roomlight {
namespace {

using testing::IesText;
using testing::radians;
using testing::steps;

PhotometricWeb webOf(const std::string& text, const TiltFile& tilt = {}) {
  const Result<WebFile> file = parseIes(text, tilt);
  EXPECT_TRUE(file) << file.error();
  return file ? file.value().web : PhotometricWeb{};
}

std::string warningsOf(const std::string& text) {
  const Result<WebFile> file = parseIes(text);
  EXPECT_TRUE(file) << file.error();
  std::string all;
  if (file) {
    for (const std::string& w : file.value().warnings) all += w + "; ";
  }
  return all;
}

Vec3 towards(double cDeg, double gammaDeg) {
  const double c = radians(cDeg), g = radians(gammaDeg);
  return {static_cast<float>(std::sin(g) * std::cos(c)), static_cast<float>(std::sin(g) * std::sin(c)),
          static_cast<float>(-std::cos(g))};
}

TEST(Ies, everyEditionIsRead) {
  const std::pair<const char*, const char*> editions[] = {{"a downlight\nof 1986\n", "1986"},
                                                          {"IESNA91\n", "1991"},
                                                          {"IESNA:LM-63-1995\n", "1995"},
                                                          {"IESNA:LM-63-2002\n", "2002"},
                                                          {"IES:LM-63-2019\n", "2019"}};
  for (const auto& [first, name] : editions) {
    IesText file;
    file.edition = first;
    if (std::string(name) == "1986") file.keywords = "";
    const PhotometricWeb web = webOf(file.text());
    EXPECT_EQ(web.format, std::string("IES LM-63-") + name + ", type C");
    EXPECT_EQ(web.name, std::string(name) == "1986" ? "a downlight" : "test");
    EXPECT_FLOAT_EQ(web.peakCd, 1000);
    EXPECT_EQ(web.watts, 12);
    EXPECT_EQ(warningsOf(file.text()), "");
  }
}

// The second ballast factor was set aside in 2002 and tells of something else since 2019.
TEST(Ies, factorsMultiplyTheCandela) {
  for (const auto& [edition, expected] :
       {std::pair{"IESNA91\n", 1000 * 2 * 0.9 * 0.5}, std::pair{"IES:LM-63-2019\n", 1000 * 2 * 0.9}}) {
    IesText file;
    file.edition = edition;
    file.multiplier = 2, file.ballast = 0.9, file.ballastLamp = 0.5;
    EXPECT_NEAR(webOf(file.text()).peakCd, expected, 1e-3);
  }
}

// Piecewise linear in gamma, exactly: of a cosine it is less by a twelfth of the step squared.
TEST(Ies, fluxIsThatOfClosedForms) {
  IesText file;
  for (const double step : {1.0, 5.0}) {
    file.vertical = steps(0, 90, step);
    EXPECT_NEAR(webOf(file.text()).fluxLm / (std::numbers::pi * 1000), 1 - radians(step) * radians(step) / 12, 2e-5)
        << step;
  }
  file.vertical = steps(0, 180, 7.5);
  file.candela = [](double, double) { return 100; };
  EXPECT_NEAR(webOf(file.text()).fluxLm, 4 * std::numbers::pi * 100, 1e-3);
  // Half of the sphere, and a quarter of all directions about C0.
  file.vertical = {90, 135, 180};
  EXPECT_NEAR(webOf(file.text()).fluxLm, 2 * std::numbers::pi * 100, 1e-3);
  file.vertical = {0, 180}, file.horizontal = {0, 90, 180, 270, 360};
  file.candela = [](double c, double) { return c == 0 || c == 360 ? 100 : 0; };
  EXPECT_NEAR(webOf(file.text()).fluxLm, std::numbers::pi * 100, 1e-3);
}

// What a web of each symmetry shows, against the function that filled it.
TEST(Ies, symmetriesAreUnfolded) {
  const auto about = [](double c) { return std::cos(radians(c)); };
  struct Case {
    std::vector<double> horizontal;
    testing::Intensity candela;
  };
  const Case cases[] = {
      {{0}, [](double, double g) { return 100 + g; }},
      {steps(0, 90, 15), [&](double c, double g) { return 100 + g + 50 * about(2 * c); }},
      {steps(0, 180, 15), [&](double c, double g) { return 100 + g + 50 * about(c); }},
      {steps(0, 360, 15), [&](double c, double g) { return 100 + g + 50 * about(c - 60); }},
      {steps(90, 270, 15), [&](double c, double g) { return 100 + g + 50 * about(c - 90); }},
  };
  for (const Case& k : cases) {
    IesText file;
    file.horizontal = k.horizontal, file.candela = k.candela;
    const std::string text = file.text();
    const PhotometricWeb web = webOf(text);
    EXPECT_EQ(warningsOf(text), "");
    for (const double c : steps(0, 345, 15)) {
      for (const double g : {10.0, 45.0, 85.0})
        EXPECT_NEAR(intensityCd(web, towards(c, g)), k.candela(c, g), 2e-3)
            << k.horizontal.size() << " " << c << " " << g;
    }
    EXPECT_EQ(intensityCd(web, towards(0, 100)), 0);
  }
}

// Bilinear between the angles, and dark where the file says nothing.
TEST(Ies, betweenAnglesIntensityIsBilinear) {
  IesText file;
  file.vertical = {0, 30, 90}, file.horizontal = {0, 90};
  file.candela = [](double c, double g) { return g == 30 ? (c == 0 ? 100 : 300) : 0; };
  const PhotometricWeb web = webOf(file.text());
  EXPECT_NEAR(intensityCd(web, towards(45, 30)), 200, 1e-2);
  EXPECT_NEAR(intensityCd(web, towards(45, 60)), 100, 1e-2);
  EXPECT_NEAR(intensityCd(web, towards(135, 15)), 100, 1e-2);
}

// A beam that only one system of angles writes exactly, found where its angles say.
TEST(Ies, typesAAndBAreTurnedIntoC) {
  IesText file;
  file.vertical = steps(-90, 90, 2.5), file.horizontal = steps(-90, 90, 2.5);
  const auto beam = [](double h, double v) { return std::exp(-((h - 20) * (h - 20) + (v - 30) * (v - 30)) / 200); };
  file.candela = [&](double h, double v) { return 1000 * beam(h, v); };
  file.type = 2;
  const PhotometricWeb b = webOf(file.text());
  EXPECT_EQ(b.format, "IES LM-63-2002, type B");
  // Vertical 30 leans towards C0, horizontal 20 clockwise to C270: cos 30 (cos 20 down, sin 20 to C270), sin 30 to C0.
  const float up = static_cast<float>(std::sin(radians(30))), level = static_cast<float>(std::cos(radians(30)));
  const float ahead = static_cast<float>(std::cos(radians(20))), aside = static_cast<float>(std::sin(radians(20)));
  EXPECT_NEAR(intensityCd(b, {up, -level * aside, -level * ahead}), 1000, 10);
  file.type = 3;
  const PhotometricWeb a = webOf(file.text());
  EXPECT_NEAR(intensityCd(a, {level * ahead, -level * aside, up}), 1000, 10);
  // The same beam, so the same light.
  EXPECT_NEAR(a.fluxLm / b.fluxLm, 1, 2e-3);
  double exact = 0;
  for (const double h : steps(-89.75, 89.75, 0.5)) {
    for (const double v : steps(-89.75, 89.75, 0.5))
      exact += 1000 * beam(h, v) * std::cos(radians(v)) * radians(0.5) * radians(0.5);
  }
  EXPECT_NEAR(b.fluxLm / exact, 1, 5e-3);
  // From 0 on: both sides alike.
  file.type = 2, file.horizontal = steps(0, 90, 2.5);
  const PhotometricWeb alike = webOf(file.text());
  EXPECT_NEAR(intensityCd(alike, {up, level * aside, -level * ahead}), 1000, 10);
}

TEST(Ies, openingsAreMetresAndRoundWhereNegative) {
  IesText file;
  file.width = 0.5, file.length = 4, file.height = 0.1, file.unit = 1;
  PhotometricWeb web = webOf(file.text());
  EXPECT_FALSE(web.round);
  EXPECT_FLOAT_EQ(web.sizeC90M, 0.5f * 0.3048f);
  EXPECT_FLOAT_EQ(web.sizeC0M, 4 * 0.3048f);
  file.unit = 2;
  for (const auto& [width, length] : {std::pair{-0.2, -0.2}, std::pair{-0.2, 0.0}}) {
    file.width = width, file.length = length;
    web = webOf(file.text());
    EXPECT_TRUE(web.round);
    EXPECT_FLOAT_EQ(web.sizeC0M, 0.2f);
    EXPECT_FLOAT_EQ(web.sizeC90M, 0.2f);
  }
  file.width = file.length = 0;
  EXPECT_FALSE(webOf(file.text()).hasOpening());
}

TEST(Ies, tiltTablesAreRead) {
  const std::string table = "1\n3\n0 45 90\n1.0 0.9 0.6\n";
  IesText file;
  file.tilt = "TILT=INCLUDE\n" + table;
  const PhotometricWeb web = webOf(file.text());
  EXPECT_FLOAT_EQ(web.peakCd, 1000);
  EXPECT_FLOAT_EQ(tiltFactor(web, 0), 1);
  EXPECT_NEAR(tiltFactor(web, static_cast<float>(radians(67.5))), 0.75f, 1e-5f);
  EXPECT_NEAR(tiltFactor(web, kPi), 0.6f, 1e-5f);
  file.tilt = "TILT = lamp.tlt\n";
  std::string asked;
  const PhotometricWeb other =
      webOf(file.text(), [&](const std::string& name) { return asked = name, Result<std::string>(table); });
  EXPECT_EQ(asked, "lamp.tlt");
  EXPECT_EQ(other.tiltFactor, web.tiltFactor);
  EXPECT_EQ(parseIes(file.text()).error(), "line 5: TILT file: files beside it are not read");
}

TEST(Ies, oddFilesAreReadWithAWarning) {
  const std::string plain = IesText().text();
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string s = plain;
    for (size_t at = s.find(from); at != std::string::npos; at = s.find(from, at + to.size()))
      s.replace(at, from.size(), to);
    return s;
  };
  EXPECT_EQ(warningsOf(with("\n", "\r\n")), "");
  EXPECT_EQ(warningsOf(with("\n", "\r")), "");
  EXPECT_EQ(warningsOf(with("5 10 15 ", "5,10 ,  15,\n\n\t")), "");
  EXPECT_EQ(warningsOf(plain + "\x1a"), "");
  EXPECT_EQ(warningsOf("\xef\xbb\xbf" + plain), "begins with a byte-order mark; ");
  EXPECT_EQ(warningsOf(with("[LUMINAIRE] test",
                            "[LUMINAIRE] Stra\xdf"
                            "enleuchte")),
            "letters are read as Latin-1; ");
  EXPECT_EQ(webOf(with("[LUMINAIRE] test",
                       "[LUMINAIRE] Stra\xdf"
                       "enleuchte"))
                .name,
            "Stra\xc3\x9f"
            "enleuchte");
  EXPECT_EQ(warningsOf(plain + "7 7"), "goes on after the last intensity; the rest is ignored; ");
  EXPECT_NE(warningsOf(with("IESNA:LM-63-2002", "IESNA:LM-63-2050")).find("names no known edition"), std::string::npos);
  IesText open;
  open.horizontal = steps(0, 345, 15);
  EXPECT_EQ(warningsOf(open.text()), "horizontal angles end at 345; the circle is closed; ");
  open.horizontal = steps(15, 345, 15);
  EXPECT_EQ(warningsOf(open.text()),
            "horizontal angles end at 345; the circle is closed; there is no plane C0; it is interpolated; ");
  open.horizontal = steps(0, 360, 15);
  open.candela = [](double c, double) { return c < 360 ? 100 : 50; };
  EXPECT_EQ(warningsOf(open.text()), "plane 0 is there twice with different values; the first counts; ");
  open.candela = [](double, double g) { return g < 80 ? 100 : -1; };
  EXPECT_EQ(warningsOf(open.text()), "negative candela count as 0; ");
}

TEST(Ies, fluxThatIsNotAsStatedIsAWarning) {
  IesText file;
  file.vertical = steps(0, 90, 1);
  file.lumens = 3150;
  EXPECT_EQ(warningsOf(file.text()), "");
  file.lumens = 4000;
  EXPECT_EQ(warningsOf(file.text()),
            "the intensities add up to 3141.51 lm, 78.5 % of the 4000 lm stated for its lamps; ");
  file.lumens = -1;
  EXPECT_EQ(warningsOf(file.text()), "");
}

TEST(Ies, damagedFilesAreOneLineWithItsNumber) {
  IesText file;
  const auto errorOf = [&](const IesText& f) { return parseIes(f.text()).error(); };
  const auto cut = [&](size_t bytes) { return parseIes(file.text().substr(0, file.text().size() - bytes)).error(); };
  EXPECT_EQ(parseIes("").error(), "is empty");
  EXPECT_EQ(parseIes("hello\nworld").error(),
            "line 2: there is no line TILT=; this is no IES file, or it is cut short");
  EXPECT_EQ(cut(20), "line 10: the file ends before candela of horizontal angle 1");
  EXPECT_EQ(parseIes(std::string("IESNA91\0\n", 9)).error(), "line 1: holds a NUL character; it is no text");
  IesText bad = file;
  bad.type = 4;
  EXPECT_EQ(errorOf(bad), "line 6: the photometric type: 4 is not a whole number from 1 to 3");
  bad = file, bad.tilt = "TILT=\n";
  EXPECT_EQ(errorOf(bad), "line 5: TILT= must be followed by NONE, INCLUDE or the name of a file");
  bad = file, bad.vertical = {0, 20, 10, 90};
  EXPECT_EQ(errorOf(bad), "line 8: vertical angles must ascend, but 10 follows 20");
  bad = file, bad.vertical = {0, 200};
  EXPECT_EQ(errorOf(bad), "line 8: vertical angle 200 is not between 0 and 180");
  bad = file, bad.horizontal = {0, 30, 60};
  EXPECT_NE(errorOf(bad).find("line 9: horizontal angles from 0 to 60 do not tell what is symmetric"),
            std::string::npos);
  bad = file, bad.multiplier = 0;
  EXPECT_NE(errorOf(bad).find("must be above 0"), std::string::npos);
  bad = file, bad.candela = [](double, double) { return 0; };
  EXPECT_EQ(errorOf(bad), "all intensities are zero; there is no light");
  std::string text = file.text();
  text.replace(text.find("15 20"), 5, "15 x9");
  EXPECT_EQ(parseIes(text).error(), "line 8: vertical angles: 'x9' is not a number");
  bad = file, bad.vertical.assign(3999, 1);
  EXPECT_FALSE(parseIes(bad.text()));
}

}  // namespace
}  // namespace roomlight
