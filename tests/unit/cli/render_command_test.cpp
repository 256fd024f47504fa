// `roomlight render` from outside: exit statuses, what is written and what is not.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/image_formats.h"
#include "base/image_io.h"
#include "support/homes.h"
#include "support/rooms.h"
#include "unit/cli/program.h"

namespace roomlight {
namespace {

using Json = nlohmann::json;
using testing::ProgramRun;
using testing::readFile;
using testing::runProgram;
using testing::TemporaryFolder;
using testing::writeFile;

class RenderCommand : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
  const std::string scene_ = testing::writeRoom(folder_).string();

  std::string path(const std::string& name) const { return folder_ / name; }
  // A picture small enough for a test.
  ProgramRun render(std::vector<std::string> more, const std::string& interruptAt = "") const {
    std::vector<std::string> arguments = {"render", scene_, "--size", "32x18"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runProgram(arguments, interruptAt);
  }
  Image picture(const std::string& name) const {
    const Result<Image> image = readImage(path(name));
    EXPECT_TRUE(image.ok()) << image.error();
    return image.ok() ? image.value() : Image();
  }
  Metadata metadata(const std::string& name) const {
    const Result<Metadata> read = readMetadata(path(name));
    EXPECT_TRUE(read.ok()) << read.error();
    return read.ok() ? read.value() : Metadata();
  }
};

TEST_F(RenderCommand, writesLinearAndToneMappedPicturesThatSayHowTheyWereMade) {
  const ProgramRun run =
      render({"-o", path("a.exr"), "-o", path("a.png"), "--technique", "path", "--samples", "8", "--seed", "7"});
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  const Image image = picture("a.exr");
  EXPECT_EQ(image.width, 32);
  EXPECT_EQ(image.height, 18);
  EXPECT_TRUE(
      std::all_of(image.pixels.begin(), image.pixels.end(), [](Vec3 p) { return isFinite(p) && luminance(p) > 0; }));
  EXPECT_EQ(picture("a.png").width, 32);
  for (const char* name : {"a.exr", "a.png"}) {
    const Metadata m = metadata(name);
    for (const char* key : {"roomlight.version", "roomlight.timesMs", "roomlight.exposureEv100"})
      EXPECT_TRUE(m.count(key)) << key;
    EXPECT_EQ(m.at("roomlight.seed"), "7");
    const Json settings = Json::parse(m.at("roomlight.settings"));
    EXPECT_EQ(settings["technique"], "path");
    EXPECT_EQ(settings["samples"], 8);
    EXPECT_GT(Json::parse(m.at("roomlight.timesMs")).size(), 1u);
    EXPECT_NE(m.at("roomlight.scene").find("room.gltf"), std::string::npos);
  }
}

TEST_F(RenderCommand, statisticsNameTimeAndMemoryOfEachStage) {
  const ProgramRun run = render({"-o", path("a.png"), "--samples", "2", "--stats", path("s.json")});
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  const Json stats = Json::parse(readFile(path("s.json")));
  double sum = 0;
  ASSERT_GE(stats["stages"].size(), 3u);
  for (const Json& stage : stats["stages"]) {
    EXPECT_FALSE(stage["name"].get<std::string>().empty());
    EXPECT_GT(stage["peakMemoryMiB"], 1);
    EXPECT_GE(stage["cpuMs"].get<double>(), 0);
    sum += stage["timeMs"].get<double>();
  }
  EXPECT_LE(sum, stats["totalMs"].get<double>() * 1.01);
  EXPECT_EQ(stats["numbers"]["triangles"], 24);
  EXPECT_EQ(stats["numbers"]["brokenPixels"], 0);
}

TEST_F(RenderCommand, sameSeedGivesTheSameBitsWithOneAndTwoThreads) {
  for (const char* technique : {"path", "cone"}) {
    for (const char* threads : {"1", "2"}) {
      const ProgramRun run = render({"-o", path(std::string(threads) + ".exr"), "--technique", technique, "--samples",
                                     "4", "--seed", "3", "--threads", threads});
      ASSERT_EQ(run.exitStatus, 0) << technique << ": " << run.err;
    }
    EXPECT_TRUE(picture("1.exr").pixels == picture("2.exr").pixels) << technique;
  }
}

TEST_F(RenderCommand, theSeedMatters) {
  for (const char* seed : {"1", "2"}) {
    ASSERT_EQ(render({"-o", path(std::string(seed) + ".exr"), "--technique", "path", "--samples", "1", "--seed", seed})
                  .exitStatus,
              0);
  }
  EXPECT_FALSE(picture("1.exr").pixels == picture("2.exr").pixels);
}

TEST_F(RenderCommand, settingsFromAPictureMakeThePictureAgain) {
  ASSERT_EQ(render({"-o", path("a.exr"), "--technique", "path", "--samples", "3", "--seed", "11"}).exitStatus, 0);
  writeFile(path("settings.json"), metadata("a.exr").at("roomlight.settings"));
  const ProgramRun again = runProgram({"render", scene_, "-o", path("b.exr"), "--settings", path("settings.json")});
  ASSERT_EQ(again.exitStatus, 0) << again.err;
  EXPECT_TRUE(picture("a.exr").pixels == picture("b.exr").pixels);
  // An option goes before the file.
  ASSERT_EQ(runProgram({"render", scene_, "-o", path("c.exr"), "--settings", path("settings.json"), "--seed", "12"})
                .exitStatus,
            0);
  EXPECT_EQ(metadata("c.exr").at("roomlight.seed"), "12");
  EXPECT_EQ(Json::parse(metadata("c.exr").at("roomlight.settings"))["samples"], 3);
}

TEST_F(RenderCommand, camerasGoByNameOrNumber) {
  const auto shot = [&](const char* camera, const char* name) {
    const ProgramRun run = render({"-o", path(name), "--technique", "path", "--samples", "1", "--camera", camera});
    EXPECT_EQ(run.exitStatus, 0) << run.err;
    return picture(name);
  };
  const Image front = shot("Front", "f.exr"), back = shot("Back", "b.exr"), second = shot("1", "s.exr");
  EXPECT_TRUE(back.pixels == second.pixels);
  EXPECT_FALSE(front.pixels == back.pixels);
}

TEST_F(RenderCommand, severalCamerasMakeAPictureEach) {
  const auto only = [&](const char* camera, const char* name) {
    EXPECT_EQ(render({"-o", path(name), "--camera", camera}).exitStatus, 0);
  };
  only("Front", "f.exr"), only("Back", "b.exr");
  const ProgramRun both = render({"-o", path("p.exr"), "-o", path("p.png"), "--stats", path("s.json"), "--camera",
                                  "Back", "--camera", "front", "--camera", "1"});
  ASSERT_EQ(both.exitStatus, 0) << both.err;
  // As one by one, up to noise: light is found for what both show.
  for (const auto& [one, other] : {std::pair("p_Front.exr", "f.exr"), {"p_Back.exr", "b.exr"}})
    EXPECT_NEAR(test::meanLuminance(picture(one)) / test::meanLuminance(picture(other)), 1, 0.01);
  EXPECT_TRUE(std::filesystem::exists(path("p_Front.png")) && std::filesystem::exists(path("p_Back.png")));
  EXPECT_FALSE(std::filesystem::exists(path("p.exr")) || std::filesystem::exists(path("p_Back_2.exr")));
  const auto lit = [&](const char* stats) {
    const Json json = Json::parse(readFile(path(stats)));
    return std::any_of(json["stages"].begin(), json["stages"].end(),
                       [](const Json& s) { return s["name"] == "illuminate"; });
  };
  EXPECT_TRUE(lit("s_Back.json"));
  EXPECT_FALSE(lit("s_Front.json")) << "light is found once";
  // Names are checked as they will be, with the camera's.
  writeFile(path("l_Back.json"), R"({"lamps": []})");
  const ProgramRun over = render({"-o", path("l.png"), "--stats", path("l.json"), "--lighting", path("l_Back.json"),
                                  "--camera", "Front", "--camera", "Back"});
  EXPECT_EQ(over.exitStatus, 2) << over.err;
  EXPECT_EQ(readFile(path("l_Back.json")), R"({"lamps": []})");
  const ProgramRun all = render({"-o", path("a.png"), "--camera", "all"});
  ASSERT_EQ(all.exitStatus, 0) << all.err;
  EXPECT_TRUE(std::filesystem::exists(path("a_Front.png")) && std::filesystem::exists(path("a_Back.png")));
}

TEST_F(RenderCommand, processesShareLightAndTakeThePicturesOfOne) {
  const auto stagesIn = [&](const std::string& stats) {
    std::vector<std::string> names;
    const Json json = Json::parse(readFile(path(stats)));
    for (const Json& s : json["stages"]) names.push_back(s["name"]);
    return names;
  };
  const auto has = [](const std::vector<std::string>& names, const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  const auto shared = [&](const char* camera, const char* name) {
    const ProgramRun run = render({"-o", path(name), "--camera", camera, "--light-for", "all", "--light-cache",
                                   path("lights"), "--light-cache-size", "50MB", "--stats", path("s.json")});
    EXPECT_EQ(run.exitStatus, 0) << run.err;
    return run.err;
  };
  ASSERT_EQ(render({"-o", path("one.exr"), "--camera", "all"}).exitStatus, 0);
  shared("Front", "f.exr");
  EXPECT_TRUE(has(stagesIn("s.json"), "illuminate"));
  shared("Back", "b.exr");
  EXPECT_TRUE(has(stagesIn("s.json"), "light read"));
  EXPECT_FALSE(has(stagesIn("s.json"), "voxelise") || has(stagesIn("s.json"), "illuminate"));
  EXPECT_TRUE(picture("f.exr").pixels == picture("one_Front.exr").pixels);
  EXPECT_TRUE(picture("b.exr").pixels == picture("one_Back.exr").pixels);

  const std::filesystem::path file = std::filesystem::directory_iterator(folder_ / "lights")->path();
  writeFile(file, readFile(file).substr(1));
  const std::string err = shared("Back", "c.exr");
  EXPECT_NE(err.find("warning: " + file.string() + ": is damaged"), std::string::npos) << err;
  EXPECT_TRUE(picture("c.exr").pixels == picture("b.exr").pixels);
  EXPECT_EQ(shared("Back", "c.exr").find("warning"), std::string::npos);

  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--technique", "path", "--samples", "1"}, {"--time-limit", "0.2"}}) {
    std::vector<std::string> arguments = {"-o", path("d.exr"), "--light-cache", path("none")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun run = render(arguments);
    EXPECT_EQ(run.exitStatus, 0);
    EXPECT_NE(run.err.find("warning: --light-cache: is"), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(path("none")));
  }
}

TEST_F(RenderCommand, aLightingFileReplacesTheScenesLight) {
  const auto meanLuminance = [&](const std::string& lamps, const std::string& name) {
    writeFile(path("rig.json"), R"({"scene": {"lamps": "off"}, "lamps": [)" + lamps + "]}");
    const ProgramRun run =
        render({"-o", path(name), "--technique", "path", "--samples", "16", "--lighting", path("rig.json")});
    EXPECT_EQ(run.exitStatus, 0) << run.err;
    EXPECT_EQ(metadata(name).at("roomlight.lighting"), path("rig.json"));
    double sum = 0;
    const Image image = picture(name);
    for (const Vec3 p : image.pixels) sum += luminance(p);
    return sum / static_cast<double>(image.pixels.size());
  };
  const std::string at = R"({"type": "point", "position": [0, 2.5, 0], )";
  EXPECT_EQ(meanLuminance("", "dark.exr"), 0);
  const double one = meanLuminance(at + R"("flux": "800 lm"})", "one.exr");
  EXPECT_GT(one, 1);
  EXPECT_NEAR(meanLuminance(at + R"("flux": "1600 lm"})", "two.exr") / one, 2, 1e-3) << "light is linear";
  EXPECT_NEAR(meanLuminance(at + R"("intensity": "63.662 cd"})", "candela.exr") / one, 1, 1e-3) << "800 lm / 4 pi";
}

// The room is 4 x 4 m: at 0.1 m a pixel, with 0.3 m around everything, 46 pixels.
TEST_F(RenderCommand, planHasItsScaleAndATransparentBackdrop) {
  const ProgramRun run = runProgram(
      {"render", scene_, "-o", path("p.png"), "--view", "plan", "--metres-per-pixel", "0.1", "--samples", "2"});
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  EXPECT_NE(run.err.find("one pixel is 0.1 m"), std::string::npos) << run.err;
  EXPECT_NEAR(picture("p.png").width, 46, 1);
  EXPECT_EQ(metadata("p.png").at("roomlight.metresPerPixel"), "0.1");
  const std::string file = readFile(path("p.png"));
  const std::span<const uint8_t> bytes(reinterpret_cast<const uint8_t*>(file.data()), file.size());
  const std::vector<uint8_t> rgba = formats::readPngTexels(bytes, formats::readPngSize(bytes));
  EXPECT_EQ(rgba[3], 0) << "the corner lies outside";
  const auto width = static_cast<size_t>(picture("p.png").width), height = rgba.size() / 4 / width;
  EXPECT_EQ(rgba[4 * (height / 2 * width + width / 2) + 3], 255);
}

TEST_F(RenderCommand, panoramaTellsViewersWhatItIs) {
  const ProgramRun run = runProgram({"render", scene_, "-o", path("p.jpg"), "-o", path("p.png"), "--view", "panorama",
                                     "--size", "64x32", "--samples", "2"});
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  EXPECT_NE(readFile(path("p.jpg")).find("GPano:FullPanoWidthPixels=\"64\""), std::string::npos);
  EXPECT_NE(metadata("p.png").at("XML:com.adobe.xmp").find("GPano:ProjectionType=\"equirectangular\""),
            std::string::npos);
}

TEST_F(RenderCommand, eyeAndTargetMakeACamera) {
  const ProgramRun run = render({"-o", path("e.exr"), "--eye", "0,1.5,1.9", "--target", "0,1.5,0", "--samples", "2"});
  ASSERT_EQ(run.exitStatus, 0) << run.err;
  const Image eye = picture("e.exr");
  EXPECT_EQ(eye.width, 32);
  EXPECT_TRUE(std::all_of(eye.pixels.begin(), eye.pixels.end(), [](Vec3 p) { return luminance(p) > 0; }));
}

TEST_F(RenderCommand, badInputIsOneLineExitStatusTwoAndNothingWritten) {
  writeFile(path("broken.glb"), "glTF but not really");
  writeFile(path("unknown.json"), R"({"sampels": 3})");
  writeFile(path("limits.json"), R"({"voxel": {"smallestM": 0.2, "largestM": 0.1}})");
  writeFile(path("odd.json"), R"({"vxgi": {"resolution": 33}})");
  writeFile(path("rig.json"), R"({"lamps": [{"type": "point", "position": [0, 0, 0], "flux": 800}]})");
  const std::string a = path("a.png");
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"render", path("missing.glb"), "-o", a}, "missing.glb"},
      {{"render", path("broken.glb"), "-o", a}, "broken.glb"},
      {{"render", scene_, "-o", path("a.gif")}, ".exr, .png or .jpg"},
      {{"render", scene_, "-o", path("a.jpg"), "--output-kind", "falsecolour"}, "use .png"},
      {{"render", scene_, "-o", path("nowhere/a.png")}, "nowhere/a.png"},
      {{"render", scene_, "-o", a, "--stats", path("nowhere/s.json")}, "nowhere/s.json"},
      {{"render", scene_, "-o", folder_.path().string() + "/.png/../"}, ""},
      {{"render", scene_}, "output"},
      {{"render", scene_, "-o", a, "--size", "32"}, "--size"},
      {{"render", scene_, "-o", a, "--size", "0x10"}, "width"},
      {{"render", scene_, "-o", a, "--size", "65536x65536"}, "pixels"},
      {{"render", scene_, "-o", a, "--technique", "magic"}, "hybrid, cone, vxgi, lpv, photon, path"},
      {{"render", scene_, "-o", a, "--quality", "perfect"}, "draft, good, best"},
      {{"render", scene_, "-o", a, "--camera", "Side"}, "'Front', 'Back'"},
      {{"render", scene_, "-o", a, "--camera", "7"}, "'Front', 'Back'"},
      {{"render", scene_, "-o", a, "--light-for", "Side"}, "--light-for: "},
      {{"render", scene_, "-o", a, "--light-cache-size", "1GB"}, "--light-cache-size: goes with --light-cache DIR"},
      {{"render", scene_, "-o", a, "--light-cache", path("lights"), "--light-cache-size", "much"}, "such as 2GB"},
      {{"render", scene_, "-o", a, "--samples", "-1"}, "samples"},
      {{"render", scene_, "-o", a, "--samples", "many"}, "samples"},
      {{"render", scene_, "-o", a, "--samples", ""}, "empty"},
      {{"render", scene_, "-o", a, "--seed", "-1"}, "--seed -1"},
      {{"render", scene_, "-o", a, "--seed", "18446744073709551616"}, "--seed 18446744073709551616"},
      {{"render", scene_, "-o", a, "-o", a}, "named twice"},
      {{"render", scene_, "-o", a, "--stats", folder_.path().string() + "/./a.png"}, "named twice"},
      {{"render", scene_, "-o", a, "--stats", scene_}, "named twice"},
      {{"render", scene_, "-o", a, "--exposure", "bright"}, "--exposure"},
      {{"render", scene_, "-o", a, "--tone", "sepia"}, "neutral, agx, filmic, clip"},
      {{"render", scene_, "-o", a, "--white-balance", "warm"}, "auto, none, a warmth"},
      {{"render", scene_, "-o", a, "--white-balance", "100"}, "1667 to 25000 K"},
      {{"render", scene_, "-o", a, "--white-balance", "nan"}, "--white-balance"},
      {{"render", scene_, "-o", a, "--voxel-size", "-1"}, "voxelSizeM"},
      {{"render", scene_, "-o", a, "--metres-per-unit", "0"}, "--metres-per-unit"},
      {{"render", scene_, "-o", a, "--settings", path("unknown.json")}, "sampels"},
      {{"render", scene_, "-o", a, "--settings", path("limits.json")},
       "voxel.smallestM: must not be above voxel.largestM: 0.2 > 0.1"},
      {{"render", scene_, "-o", a, "--settings", path("odd.json")}, "vxgi.resolution: must be even"},
      {{"render", scene_, "-o", a, "--settings", path("missing.json")}, "missing.json"},
      {{"render", scene_, "-o", a, "--lighting", path("rig.json")},
       "rig.json: lamps[0].flux: has no unit; write \"800 lm\""},
      {{"render", scene_, "-o", a, "--lighting", path("missing.json")}, "missing.json: no such file"},
      {{"render", scene_, "-o", a, "--view", "side"}, "camera, top, plan, panorama, stereo"},
      {{"render", scene_, "-o", a, "--view", "panorama", "--cut", "2"}, "--cut: is of no use with --view panorama"},
      {{"render", scene_, "-o", a, "--view", "panorama", "--size", "64x30"}, "twice as wide as high; write 64x32"},
      {{"render", scene_, "-o", a, "--view", "plan", "--cut", "-1"}, "--cut -1"},
      {{"render", scene_, "-o", a, "--view", "plan", "--level", "3"},
       "--level 3: no such level; there are 0 at 0.00 m"},
      {{"render", scene_, "-o", a, "--view", "plan", "--room", "Attic"}, "--room: no room 'Attic'"},
      {{"render", scene_, "-o", a, "--view", "plan", "--camera", "Front"}, "--camera: is of no use with --view plan"},
      {{"render", scene_, "-o", a, "--view", "plan", "--metres-per-pixel", "0"}, "--metres-per-pixel 0"},
      {{"render", scene_, "-o", a, "--view", "top", "--metres-per-pixel", "0.01"}, "goes with plan"},
      {{"render", scene_, "-o", a, "--eye", "1,1,1"}, "give --target as well"},
      {{"render", scene_, "-o", a, "--eye", "1,1", "--target", "0,0,0"}, "--eye 1,1: write x,y,z in metres"},
      {{"render", scene_, "-o", a, "--target", "1,1,1"}, "give --eye as well"},
      {{"render", scene_, "-o", a, "--eye", "1,1,1", "--target", "0,0,0", "--camera", "Front"}, "give one of them"},
      {{"render", scene_, "-o", a, "--fov", "180"}, "--fov 180"},
      {{"render", scene_, "-o", a, "--backdrop", "white"}, "sky or none"},
      {{"render", scene_, "-o", a, "--no-such-option"}, "--no-such-option"},
      {{"paint", scene_}, ""},
      {{}, ""},
  };
  const size_t before = folder_.fileCount();
  for (const auto& [arguments, expected] : cases) {
    const ProgramRun run = runProgram(arguments);
    std::string shown;
    for (const std::string& word : arguments) shown += word + " ";
    EXPECT_EQ(run.exitStatus, 2) << shown << run.err;
    EXPECT_NE(run.err.find(expected), std::string::npos) << shown << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << shown << run.err;
    EXPECT_EQ(run.out, "") << shown;
    EXPECT_EQ(folder_.fileCount(), before) << shown;
  }
}

TEST_F(RenderCommand, interruptKeepsTheBestPictureSoFar) {
  const ProgramRun run =
      render({"-o", path("a.exr"), "-o", path("a.png"), "--technique", "path", "--time-limit", "100"}, "lights");
  EXPECT_EQ(run.exitStatus, 130) << run.err;
  EXPECT_NE(run.err.find("stopped early"), std::string::npos) << run.err;
  EXPECT_EQ(picture("a.exr").width, 32);
  EXPECT_EQ(picture("a.png").width, 32);
  EXPECT_EQ(metadata("a.exr").at("roomlight.complete"), "false");
}

TEST_F(RenderCommand, bestGoesOnUntilInterruptedAndTellsTheErrorThatIsLeft) {
  writeFile(path("endless.json"), R"({"blendUntilMse": 1e-12})");
  const ProgramRun run =
      render({"-o", path("a.exr"), "--quality", "best", "--settings", path("endless.json"), "--stats", path("s.json")},
             "gather");
  EXPECT_EQ(run.exitStatus, 130) << run.err;
  EXPECT_EQ(picture("a.exr").width, 32);
  const ProgramRun limited = render({"-o", path("b.exr"), "--time-limit", "2", "--stats", path("s.json")});
  ASSERT_EQ(limited.exitStatus, 0) << limited.err;
  EXPECT_NE(limited.err.find("estimated error"), std::string::npos) << limited.err;
  EXPECT_GT(Json::parse(readFile(path("s.json")))["numbers"]["estimatedMse"], 0);
}

TEST_F(RenderCommand, qualityIsAStartThatSingleSettingsChange) {
  ASSERT_EQ(
      render({"-o", path("a.exr"), "--quality", "draft", "--voxel-size", "0.3", "--stats", path("s.json")}).exitStatus,
      0);
  EXPECT_NEAR(Json::parse(readFile(path("s.json")))["numbers"]["voxelSizeM"].get<double>(), 0.3, 1e-6);
  const Json settings = Json::parse(metadata("a.exr").at("roomlight.settings"));
  EXPECT_EQ(settings["quality"], "draft");
  EXPECT_EQ(settings["hybrid"]["tolerance"], 0);
}

TEST_F(RenderCommand, interruptBeforeThereIsAPictureSaysSo) {
  const ProgramRun run =
      render({"-o", path("a.exr"), "--stats", path("a.json"), "--technique", "cone", "--voxel-size", "0.015"}, "bvh");
  EXPECT_EQ(run.exitStatus, 130) << run.err;
  EXPECT_NE(run.err.find("interrupted before there was a picture; nothing was written"), std::string::npos) << run.err;
  EXPECT_FALSE(std::filesystem::exists(path("a.exr")));
  EXPECT_FALSE(std::filesystem::exists(path("a.json")));
}

TEST_F(RenderCommand, timeLimitEndsWithAPictureAndSuccess) {
  for (const char* technique : {"path", "cone", "hybrid"}) {
    const ProgramRun run = render({"-o", path("a.exr"), "--technique", technique, "--time-limit", "0.3"});
    EXPECT_EQ(run.exitStatus, 0) << technique << ": " << run.err;
    EXPECT_EQ(picture("a.exr").width, 32);
  }
}

TEST_F(RenderCommand, withoutATerminalProgressIsPlainLines) {
  const ProgramRun run = render({"-o", path("a.png"), "--technique", "path", "--samples", "2"});
  ASSERT_EQ(run.exitStatus, 0);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err.find('\r'), std::string::npos);
  EXPECT_EQ(run.err.find('\x1b'), std::string::npos);
  for (const char* stage : {"load", "bvh", "path"}) EXPECT_NE(run.err.find(stage), std::string::npos) << run.err;
  EXPECT_EQ(render({"-o", path("a.png"), "--technique", "path", "--samples", "2", "--quiet"}).err, "");
}

TEST_F(RenderCommand, exposureAndToneChangeThePngAndNotTheExr) {
  const std::vector<std::string> common = {"--technique", "path", "--samples", "2"};
  const auto shot = [&](std::vector<std::string> more, const std::string& name) {
    more.insert(more.end(), common.begin(), common.end());
    more.insert(more.end(), {"-o", path(name + ".exr"), "-o", path(name + ".png")});
    EXPECT_EQ(render(more).exitStatus, 0);
  };
  shot({"--exposure", "3"}, "a");
  shot({"--exposure", "6", "--tone", "agx"}, "b");
  EXPECT_TRUE(picture("a.exr").pixels == picture("b.exr").pixels);
  EXPECT_FALSE(picture("a.png").pixels == picture("b.png").pixels);
  EXPECT_EQ(metadata("b.png").at("roomlight.exposureEv100"), "6");
  EXPECT_EQ(metadata("b.png").at("roomlight.tone"), "agx");
}

TEST_F(RenderCommand, whiteBalanceTurnsLampLightTowardsWhiteInThePngAlone) {
  writeFile(
      path("warm.json"),
      R"({"scene": {"lamps": "off"}, "lamps": [{"type": "point", "position": [0, 2.5, 0], "flux": "800 lm", "temperature": "2700 K"}]})");
  const auto redOverBlue = [&](const std::string& white) {
    const ProgramRun run =
        render({"-o", path(white + ".exr"), "-o", path(white + ".png"), "--technique", "path", "--samples", "16",
                "--exposure", "7", "--tone", "clip", "--lighting", path("warm.json"), "--white-balance", white});
    EXPECT_EQ(run.exitStatus, 0) << run.err;
    Vec3 sum;
    for (const Vec3 p : picture(white + ".png").pixels) sum += p;
    return sum.x / sum.z;
  };
  const float none = redOverBlue("none"), automatic = redOverBlue("auto"), own = redOverBlue("0%"),
              full = redOverBlue("2700");
  EXPECT_GT(none, 1.5f * full);
  EXPECT_GT(full, automatic) << "light between warm walls is warmer than their lamp";
  EXPECT_NEAR(own, 0.7f / 0.5f, 0.1f) << "walls look like their albedo";
  EXPECT_GT(automatic, 1.05f * own) << "and a little warmer";
  EXPECT_TRUE(picture("none.exr").pixels == picture("auto.exr").pixels);
  EXPECT_TRUE(picture("none.exr").pixels == picture("2700.exr").pixels);
  EXPECT_LT(std::stod(metadata("auto.png").at("roomlight.whiteK")), 2700);
  EXPECT_EQ(metadata("none.png").at("roomlight.whiteGains"), "1.0000 1.0000 1.0000");
}

TEST(Program, helpHasExamplesAndVersionHasANumber) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"},
                                                    {"render", "--help"},
                                                    {"compare", "--help"},
                                                    {"develop", "--help"},
                                                    {"info", "--help"}}) {
    const ProgramRun run = runProgram(arguments);
    EXPECT_EQ(run.exitStatus, 0);
    EXPECT_NE(run.out.find("Example"), std::string::npos) << run.out;
    EXPECT_EQ(run.err, "");
  }
  const ProgramRun version = runProgram({"--version"});
  EXPECT_EQ(version.exitStatus, 0);
  EXPECT_EQ(version.out.find("roomlight "), 0u) << version.out;
}

TEST(RenderCommandOfHomes, takesSizeAndQualityOfTheHomesPhotoWhereNoneAreGiven) {
  const TemporaryFolder folder;
  writeFile(folder / "home.sh3d",
            testing::zipped(
                {{"Home.xml", testing::homeXml(testing::boxWalls(400, 300, 10) +
                                               testing::roomXml({{0, 0}, {400, 0}, {400, 300}, {0, 300}}) +
                                               "<environment photoWidth='48' photoHeight='27' photoQuality='1'/>")}}));
  const auto rendered = [&](std::initializer_list<std::string> more) {
    std::vector<std::string> words = {"render", folder / "home.sh3d", "-o", folder / "a.exr", "--quiet"};
    words.insert(words.end(), more);
    EXPECT_EQ(runProgram(words).exitStatus, 0);
    return readImage(folder / "a.exr").value();
  };
  const auto settings = [&] {
    return nlohmann::json::parse(readMetadata(folder / "a.exr").value().at("roomlight.settings"));
  };
  EXPECT_EQ(rendered({}).width, 48);
  EXPECT_EQ(settings()["quality"], "draft");
  EXPECT_EQ(rendered({"--size", "32x24", "--quality", "good"}).width, 32);
  EXPECT_EQ(settings()["quality"], "good");
}

TEST_F(RenderCommand, endsWithOneLineRatherThanTakeMoreMemoryThanAsked) {
  const ProgramRun run = runProgram(
      {"render", scene_, "-o", path("a.png"), "--memory", "200MB", "--size", "8000x8000", "--samples", "1", "--quiet"});
  EXPECT_EQ(run.exitStatus, 3) << run.err;
  EXPECT_NE(run.err.find("not enough memory within --memory 200MB"), std::string::npos) << run.err;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_FALSE(std::filesystem::exists(path("a.png")));
  EXPECT_EQ(render({"-o", path("b.png"), "--memory", "2GB"}).exitStatus, 0);
  for (const char* wrong : {"2", "much", "-1GB", "1kB", "nanGB", "1MB"})
    EXPECT_EQ(render({"-o", path("c.png"), "--memory", wrong}).exitStatus, 2) << wrong;
}

}  // namespace
}  // namespace roomlight
