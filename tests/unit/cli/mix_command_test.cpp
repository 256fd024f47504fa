// `roomlight mix` from outside.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/image_io.h"
#include "base/image_layers.h"
#include "base/tone.h"
#include "unit/cli/program.h"

namespace roomlight {
namespace {

using testing::ProgramRun;
using testing::readFile;
using testing::runProgram;
using testing::TemporaryFolder;

constexpr int kWidth = 16, kHeight = 9;
constexpr const char* kLayers = R"({"version": 1, "camera": "", "layers": [
  {"channel": "lamp_01", "name": "Sofa lamp", "kind": "lamp", "colour": [1, 1, 1], "kelvin": 6504, "fluxLm": 470, "room": "Living", "position": null, "pixel": [0.25, 0.5]},
  {"channel": "lamp_02", "name": "Desk", "kind": "lamp", "colour": [1, 1, 1], "kelvin": null, "fluxLm": 800, "room": null, "position": null, "pixel": null},
  {"channel": "sky", "name": "Sky", "kind": "sky", "colour": [1, 1, 1], "kelvin": null, "fluxLm": null, "room": null, "position": null, "pixel": null}]})";

// Sofa lamp: 10 cd/m² on the left half; desk: 20 on the right half; sky: 1 everywhere.
std::filesystem::path writeHome(const TemporaryFolder& folder, const std::string& json = kLayers) {
  LayeredImage picture;
  picture.whole = Image(kWidth, kHeight);
  for (const char* channel : {"lamp_01", "lamp_02", "sky"}) picture.layers.push_back({channel, Image(kWidth, kHeight)});
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      if (2 * x < kWidth) picture.layers[0].image.at(x, y) = Vec3(10);
      if (2 * x >= kWidth) picture.layers[1].image.at(x, y) = Vec3(20);
      picture.layers[2].image.at(x, y) = Vec3(1);
    }
  }
  for (const PictureLayer& layer : picture.layers) {
    for (size_t i = 0; i < picture.whole.pixels.size(); ++i) picture.whole.pixels[i] += layer.image.pixels[i];
  }
  picture.metadata[kLayersKey] = json;
  EXPECT_TRUE(writeLayers(folder / "layers.exr", picture));
  return folder / "layers.exr";
}

TEST(MixCommand, withoutDialsTheMixIsTheWholePicture) {
  const TemporaryFolder folder;
  const auto layers = writeHome(folder);
  const ProgramRun run = runProgram({"mix", layers, "-o", folder / "mix.exr"});
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  const Image mixed = readImage(folder / "mix.exr").value(), whole = readImage(layers).value();
  for (size_t i = 0; i < whole.pixels.size(); ++i) ASSERT_NEAR(mixed.pixels[i].y / whole.pixels[i].y, 1, 1e-5f);
}

TEST(MixCommand, dimsSwitchesAndColours) {
  const TemporaryFolder folder;
  const auto layers = writeHome(folder);
  ASSERT_EQ(
      runProgram({"mix", layers, "--lamp", "sofa=60%", "--lamp", "Desk=off", "--sky", "50%", "-o", folder / "a.exr"})
          .exitStatus,
      0);
  const Image a = readImage(folder / "a.exr").value();
  EXPECT_NEAR(a.at(1, 1).x, 6.5f, 1e-3f);
  EXPECT_NEAR(a.at(14, 1).x, 0.5f, 1e-4f);
  ASSERT_EQ(runProgram({"mix", layers, "--kelvin", "2700", "--lamp", "Desk=100%,#0000ff", "--sky", "off", "--sun",
                        "off", "-o", folder / "b.exr"})
                .exitStatus,
            0);
  const Image b = readImage(folder / "b.exr").value();
  EXPECT_NEAR(luminance(b.at(1, 1)), 10, 1e-3f) << "the flux stays";
  EXPECT_GT(b.at(1, 1).x, 2 * b.at(1, 1).z) << "and turns warm";
  EXPECT_NEAR(luminance(b.at(14, 1)), 20, 2e-3f);
  EXPECT_EQ(b.at(14, 1).x, 0);
}

TEST(MixCommand, aFixedExposureShowsStatesAlike) {
  const TemporaryFolder folder;
  const auto layers = writeHome(folder);
  for (const char* name : {"c.png", "c.jpg", "c.webp"}) {
    ASSERT_EQ(runProgram({"mix", layers, "--look", "technical", "--exposure", "5", "--tone", "clip", "--white-balance",
                          "none", "-o", folder / name})
                  .exitStatus,
              0);
    EXPECT_GT(std::filesystem::file_size(folder / name), 30u);
  }
  const Image png = readImage(folder / "c.png").value();
  EXPECT_NEAR(png.at(1, 1).x, 11 * exposureFromEv100(5), 0.004f);
  EXPECT_EQ(readMetadata(folder / "c.png").value().at("roomlight.exposureEv100"), "5");
}

// Windows are held and corners opened as in the unmixed picture, by the same gain in every mix.
TEST(MixCommand, localExposureIsThatOfTheUnmixedPicture) {
  const TemporaryFolder folder;
  const auto layers = writeHome(folder);
  const auto shown = [&](std::vector<std::string> options) {
    std::vector<std::string> arguments = {
        "mix",    layers.string(), "--look",          "technical", "--exposure", "6",
        "--tone", "clip",          "--white-balance", "none",      "-o",         (folder / "m.png").string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    EXPECT_EQ(runProgram({arguments.begin(), arguments.end()}).exitStatus, 0);
    return readImage(folder / "m.png").value();
  };
  const Image plain = shown({}), local = shown({"--local-exposure", "1"}),
              half = shown({"--local-exposure", "1", "--lamp", "*=50%", "--sky", "50%"});
  EXPECT_LT(local.at(14, 4).y / local.at(1, 4).y, 0.97f * plain.at(14, 4).y / plain.at(1, 4).y);
  for (size_t i = 0; i < half.pixels.size(); ++i) ASSERT_NEAR(half.pixels[i].y, 0.5f * local.pixels[i].y, 0.003f);
}

TEST(MixCommand, listsLayers) {
  const TemporaryFolder folder;
  const ProgramRun run = runProgram({"mix", writeHome(folder), "--list"});
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  EXPECT_NE(run.out.find("Sofa lamp  lamp     6504 K    470 lm"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("Living"), std::string::npos);
}

TEST(MixCommand, everyStateIsItsOwnMix) {
  const TemporaryFolder folder;
  const auto layers = writeHome(folder);
  const ProgramRun run = runProgram({"mix", layers, "--states", folder / "s", "--format", "png", "--exposure", "4",
                                     "--white-balance", "none", "--quiet"});
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  const auto index = nlohmann::json::parse(readFile(folder / "s/states.json"));
  ASSERT_EQ(index.at("states").size(), 4u);
  EXPECT_EQ(index.at("lamps"), (std::vector<std::string>{"Sofa lamp", "Desk"}));
  for (const auto& state : index.at("states")) {
    const int mask = state.at("mask");
    const std::string file = state.at("file");
    EXPECT_EQ(file, std::string(mask & 1 ? "1" : "0") + (mask & 2 ? "1" : "0") + ".png");
    ASSERT_EQ(runProgram({"mix", layers, "--lamp", mask & 1 ? "Sofa lamp=on" : "Sofa lamp=off", "--lamp",
                          mask & 2 ? "Desk=on" : "Desk=off", "--exposure", "4", "--white-balance", "none", "-o",
                          folder / "one.png"})
                  .exitStatus,
              0);
    EXPECT_TRUE(readImage(folder / "s" / file).value().pixels == readImage(folder / "one.png").value().pixels) << file;
  }
  ASSERT_EQ(runProgram({"mix", layers, "--states", folder / "t", "--only", "desk", "--quiet"}).exitStatus, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "t/0.webp") && std::filesystem::exists(folder / "t/1.webp"));
}

TEST(MixCommand, overlaysComeWithPageIndexAndCard) {
  const TemporaryFolder folder;
  const ProgramRun run =
      runProgram({"mix", writeHome(folder), "--overlays", folder / "o", "--home-assistant", folder / "card.yaml",
                  "--dimmed", "--entity", "Desk=switch.desk", "--url-prefix", "/local/home"});
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  for (const char* file : {"o/base.png", "o/sofa_lamp.png", "o/desk.png", "o/index.html", "o/overlays.json",
                           "card.yaml", "card_sensors.yaml"})
    EXPECT_TRUE(std::filesystem::exists(folder / file)) << file;
  const std::string card = readFile(folder / "card.yaml");
  EXPECT_NE(card.find("image: \"/local/home/base.png\""), std::string::npos);
  EXPECT_NE(card.find("entity: switch.desk"), std::string::npos);
  EXPECT_NE(run.err.find("root mean square"), std::string::npos);
}

TEST(MixCommand, statesAndOverlaysShareAFolderAndLeaveNothingOld) {
  const TemporaryFolder folder;
  const auto layers = writeHome(folder);
  ASSERT_EQ(runProgram({"mix", layers, "--states", folder / "o", "--quiet"}).exitStatus, 0);
  ASSERT_EQ(runProgram({"mix", layers, "--overlays", folder / "o", "--quiet"}).exitStatus, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "o/states.json") && std::filesystem::exists(folder / "o/11.webp"));
  ASSERT_EQ(runProgram({"mix", layers, "--overlays", folder / "o", "--only", "Desk", "--quiet"}).exitStatus, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "o/desk.png"));
  EXPECT_FALSE(std::filesystem::exists(folder / "o/sofa_lamp.png"));
  EXPECT_TRUE(std::filesystem::exists(folder / "o/11.webp")) << "a state";
}

TEST(MixCommand, onlyNamesLampsWithCommas) {
  const TemporaryFolder folder;
  std::string json = kLayers;
  json.replace(json.find("Desk"), 4, "Desk, left");
  const auto layers = writeHome(folder, json);
  for (const char* name : {"Desk, left", "desk\\, left", "Desk*"}) {
    std::filesystem::remove_all(folder / "s");
    const ProgramRun run = runProgram({"mix", layers, "--states", folder / "s", "--only", name, "--quiet"});
    ASSERT_EQ(run.exitStatus, 0) << run.err;
    EXPECT_EQ(nlohmann::json::parse(readFile(folder / "s/states.json")).at("lamps"),
              (std::vector<std::string>{"Desk, left"}))
        << name;
  }
  ASSERT_EQ(runProgram({"mix", layers, "--states", folder / "s", "--only", "Desk\\, left,sofa", "--quiet"}).exitStatus,
            0);
  EXPECT_EQ(nlohmann::json::parse(readFile(folder / "s/states.json")).at("lamps").size(), 2u);
  ASSERT_EQ(runProgram({"mix", layers, "--states", folder / "s", "--only", "sofa", "--only", "Desk, left", "--quiet"})
                .exitStatus,
            0);
  EXPECT_EQ(nlohmann::json::parse(readFile(folder / "s/states.json")).at("lamps").size(), 2u);
}

// The technical look has no local exposure, so that picture and mix can be compared pixel by pixel; the technical look
// has none.
TEST(MixCommand, plansShowSectionsAndBackdropAsTheirRenderDoes) {
  const TemporaryFolder folder;
  const auto room = testing::writeRoom(folder);
  const ProgramRun rendered = runProgram(
      {"render",    room, "--view",         "plan",   "--cut",          "1.2",        "--size", "60x60",
       "--samples", "4",  "--layers",       "--look", "technical",      "--exposure", "6",      "--white-balance",
       "none",      "-o", folder / "l.exr", "-o",     folder / "l.png", "--quiet"});
  ASSERT_EQ(rendered.exitStatus, 0) << rendered.err;
  const ProgramRun mixed =
      runProgram({"mix", folder / "l.exr", "--look", "technical", "--exposure", "6", "--white-balance", "none", "-o",
                  folder / "m.png", "-o", folder / "m.exr", "--quiet"});
  ASSERT_EQ(mixed.exitStatus, 0) << mixed.err;
  const Image wanted = readImage(folder / "l.png").value(), got = readImage(folder / "m.png").value();
  const Image light = readImage(folder / "l.exr").value(), same = readImage(folder / "m.exr").value();
  int sections = 0;
  size_t dark = 0;
  for (size_t i = 0; i < wanted.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(srgbEncode(got.pixels[i][c]), srgbEncode(wanted.pixels[i][c]), 1.6f / 255) << i;
    // Beside walls without thickness a sample may see light in a pixel that is otherwise all section: the mix shows
    // none there.
    if (same.pixels[i].y > 0)
      EXPECT_NEAR(same.pixels[i].y, light.pixels[i].y, 1e-4f * light.pixels[i].y + 1e-6f);
    else
      dark += light.pixels[i].y > 0;
    sections += std::abs(srgbEncode(wanted.pixels[i].x) - 0.2f) < 0.01f &&
                std::abs(srgbEncode(wanted.pixels[i].z) - 0.22f) < 0.01f;
  }
  EXPECT_LT(dark, wanted.pixels.size() / 50);
  EXPECT_GT(sections, 10) << "the pillar is cut";
}

TEST(MixCommand, badInputIsOneLineAndExitStatusTwo) {
  const TemporaryFolder folder;
  const std::string layers = writeHome(folder), out = folder / "o.png";
  const auto refused = [&](std::vector<std::string> arguments, const std::string& says) {
    arguments.insert(arguments.begin(), "mix");
    const ProgramRun run = runProgram(arguments);
    EXPECT_EQ(run.exitStatus, 2) << run.err;
    EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_FALSE(std::filesystem::exists(out));
  };
  refused({layers}, "nothing to do");
  refused({folder / "none.exr", "-o", out}, "no such file");
  refused({layers, "--lamp", "Hall=50%", "-o", out}, "no lamp 'Hall'; there are 'Sofa lamp', 'Desk'");
  refused({layers, "--lamp", "Desk", "-o", out}, "write NAME=VALUE");
  refused({layers, "--lamp", "Desk=bright", "-o", out}, "write on, off, a percentage");
  refused({layers, "--kelvin", "10", "-o", out}, "must be from 1000 to 40000 K");
  refused({layers, "--sun", "50%", "-o", out}, "has no layer of the sun");
  refused({layers, "--overlays", folder / "plan", "--home-assistant", out}, "name a .yaml file");
  refused({layers, "--overlays", folder / "plan", "--home-assistant", folder / "card.yaml", "--entity", "Desk=sofa"},
          "write an entity id");
  refused({layers, "-o", folder / "o.gif"}, "unknown kind of picture");
  refused({layers, "-o", out, "--tone", "sepia"}, "unknown tone curve");
  refused({layers, "--lamp", "*=off", "--states", folder / "s"}, "no lamp to switch");
  refused({layers, "--lamp", "Desk=off", "--only", "Desk", "--states", folder / "s"}, "is switched off by --lamp");
  refused({layers, "--overlays", folder / "s", "--format", "jpg"}, "overlays are transparent");
  refused({layers, "-o", out, "--home-assistant", folder / "c.yaml"}, "go with --overlays");
  refused({layers, "--overlays", folder / "s", "--home-assistant", folder / "c.yaml", "--entity", "Desk=Light Desk"},
          "write an entity id");
  refused({layers, "--overlays", folder / "s", "--blend", "multiply"}, "write auto, screen");
  refused({layers, "--overlays", folder / "s", "--url-prefix", "/local/a\"b"}, "--url-prefix");
  refused({layers, "--overlays", folder / "s", "--url-prefix", "/a\nb/"}, "--url-prefix");
  EXPECT_FALSE(std::filesystem::exists(folder / "s"));
  testing::writeFile(folder / "file", "text");
  refused({layers, "--states", folder / "file"}, "is a file; name a folder");
  refused({layers, "--overlays", folder / "file"}, "is a file; name a folder");
  refused({writeHome(folder, R"({"version": 1, "layers": []})"), "-o", out}, "tells of 0 layers and holds 3");
}

}  // namespace
}  // namespace roomlight
