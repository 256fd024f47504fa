// Plans with one mistake each: one line that names the file, the line and what to do.
#include "unit/batch/small_batch.h"

namespace roomlight::batch {
namespace {

using testing::SmallBatch;
using testing::writeFile;

struct Mistake {
  const char* toml;
  int line;
  const char* what;  // a part of the message
};

const Mistake kMistakes[] = {
    {"", 1, "has no tasks"},
    {"name = 'x'\n", 1, "has no tasks"},
    {"name = 3\n[[pictures]]\nhomes = 'house.sh3d'\n", 1, "must be text"},
    {"[[pictures\n", 1, "is no TOML"},
    {"[[pictures]]\nhomes = \n", 2, "is no TOML"},
    {"[[pictures]]\nhomes = 'a'\nhomes = 'b'\n", 3, "is no TOML"},
    {"[[picture]]\nhomes = 'house.sh3d'\n", 1, "did you mean pictures?"},
    {"[[films]]\n", 1, "there are name, pictures, walks"},
    {"[pictures]\nhomes = 'house.sh3d'\n", 1, "write [[pictures]]"},
    {"pictures = 3\n", 1, "must be a list of tables"},
    {"pictures = [3]\n", 1, "must be a table"},
    {"[[pictures]]\n", 1, "has no 'homes'"},
    {"[[pictures]]\nhome = 'house.sh3d'\n", 2, "did you mean homes?"},
    {"[[pictures]]\nhomes = 'hosue.sh3d'\n", 2, "hosue.sh3d: no such file"},
    {"[[pictures]]\nhomes = ['house.sh3d', 'gone.sh3d']\n", 2, "gone.sh3d: no such file"},
    {"[[pictures]]\nhomes = 'street/*.sh3d'\n", 2, "no file is named so"},
    {"[[pictures]]\nhomes = []\n", 2, "must not be empty"},
    {"[[pictures]]\nhomes = ''\n", 2, "must not be empty"},
    {"[[pictures]]\nhomes = 5\n", 2, "must be text"},
    {"[[pictures]]\nhomes = 'house.sh3d'\ncameras = []\n", 3, "must not be empty"},
    {"[[pictures]]\nhomes = 'house.sh3d'\ncameras = [1]\n", 3, "must be text"},
    {"[[pictures]]\nhomes = 'house.sh3d'\ncamera = 'A'\n", 3, "did you mean cameras?"},
    {"[[pictures]]\nhomes = 'house.sh3d'\nlights = 'dusk'\n", 3, "lighting file that ends in .json"},
    {"[[pictures]]\nhomes = 'house.sh3d'\nlights = 'dusk.json'\n", 3, "dusk.json: no such file"},
    {"[[pictures]]\nhomes = 'house.sh3d'\nlights = ['day', 7]\n", 3, "must be text"},
    {"[[pictures]]\nhomes = 'house.sh3d'\ntechniques = 'raster'\n", 3, "raster"},
    {"[[pictures]]\nhomes = 'house.sh3d'\ntechniques = ['path', 'pth']\n", 3, "pth"},
    {"[[pictures]]\nhomes = 'house.sh3d'\nseeds = 0\n", 3, "must be from 1"},
    {"[[pictures]]\nhomes = 'house.sh3d'\nseeds = -3\n", 3, "must be from 1"},
    {"[[pictures]]\nhomes = 'house.sh3d'\nseeds = 1.5\n", 3, "whole number"},
    {"[[pictures]]\nhomes = 'house.sh3d'\nseeds = [1, -1]\n", 3, "must be from 0"},
    {"[[pictures]]\nhomes = 'house.sh3d'\nseeds = [1, 1]\n", 1, "asks twice"},
    {"[[pictures]]\nhomes = 'house.sh3d'\nseeds = []\n", 3, "must not be empty"},
    {"[[pictures]]\nhomes = 'house.sh3d'\nseeds = 'three'\n", 3, "must be a number"},
    {"[[pictures]]\nhomes = 'house.sh3d'\nsize = '960'\n", 3, "WIDTHxHEIGHT"},
    {"[[pictures]]\nhomes = 'house.sh3d'\nsize = '960x'\n", 3, "WIDTHxHEIGHT"},
    {"[[pictures]]\nhomes = 'house.sh3d'\nsize = '0x540'\n", 3, "WIDTHxHEIGHT"},
    {"[[pictures]]\nhomes = 'house.sh3d'\nsize = [960, 540]\n", 3, "must be text"},
    {"[[pictures]]\nhomes = 'house.sh3d'\nquality = 'nice'\n", 3, "nice"},
    {"[[pictures]]\nhomes = 'house.sh3d'\nsamples = -1\n", 3, "must be from 0"},
    {"[[pictures]]\nhomes = 'house.sh3d'\noutput = 'tiff'\n", 3, "must be one of"},
    {"[[pictures]]\nhomes = 'house.sh3d'\nsettings = 'none.json'\n", 3, "none.json: no such file"},
    {"[[pictures]]\nhomes = 'house.sh3d'\ncamerasPerTask = 2\n", 3, "needs cameras"},
    {"[[pictures]]\nhomes = 'house.sh3d'\ncameras = 'A'\ncamerasPerTask = 0\n", 4, "must be from 1"},
    {"[[optimise]]\nhomes = 'house.sh3d'\n", 1, "has no 'studies'"},
    {"[[optimise]]\nhomes = 'house.sh3d'\nstudies = 'gaols.toml'\n", 3, "gaols.toml: no such file"},
    {"[[optimise]]\nhomes = 'house.sh3d'\nstudies = []\n", 3, "must not be empty"},
    {"[[optimise]]\nhomes = 'house.sh3d'\nstudies = 'house.sh3d'\nparts = 0\n", 4, "must be from 1"},
    {"[[optimise]]\nhomes = 'house.sh3d'\nstudies = 'house.sh3d'\noptions = ['--part', '1/2']\n", 4,
     "leave --part out"},
    {"[[study]]\n", 1, "has no 'study'"},
    {"[[study]]\nstudy = 'house.sh3d'\n", 2, "house.sh3d: parse error"},
    {"[[study]]\nstudy = 'gone.json'\n", 2, "gone.json: no such file"},
    {"[[pictures]]\nhomes = 'house.sh3d'\noptions = ['-o', 'x.png']\n", 3, "leave -o out"},
    {"[[pictures]]\nhomes = 'house.sh3d'\noptions = ['--stats', 'x']\n", 3, "leave --stats out"},
    {"[[pictures]]\nhomes = 'house.sh3d'\nseconds = 0\n", 3, "must be from 0.001"},
    {"[[pictures]]\nhomes = 'house.sh3d'\nseconds = 'a minute'\n", 3, "must be a number"},
    {"[[pictures]]\nhomes = 'house.sh3d'\nshareLight = true\n", 3, "needs cameras"},
    {"[[references]]\nhomes = 'house.sh3d'\n", 1, "needs seeds"},
    {"[[references]]\nhomes = 'house.sh3d'\nseeds = 1\n", 1, "needs seeds, two or more"},
    {"[[references]]\nhomes = 'house.sh3d'\nseeds = 2\ntechniques = 'path'\n", 4, "unknown key"},
    {"[[layers]]\nhomes = 'house.sh3d'\ngroups = 'lamp'\n", 3, "must be one of"},
    {"[[layers]]\nhomes = 'house.sh3d'\noutput = 'png'\n", 3, "unknown key"},
    {"[[walks]]\nhomes = 'house.sh3d'\n", 1, "has no 'walk'"},
    {"[[walks]]\nhomes = 'house.sh3d'\nwalk = 'gone.json'\n", 3, "gone.json: no such file"},
    {"[[walks]]\nhomes = 'house.sh3d'\nwalk = 'house.sh3d'\n", 3, "has no 'seconds'"},
    {"[[walks]]\nhomes = 'house.sh3d'\nwalk = 'walk.json'\nframes = 0\n", 4, "must be from 1"},
    {"[[walks]]\nhomes = 'house.sh3d'\nwalk = 'walk.json'\nframesPerTask = 0\n", 4, "must be from 1"},
    {"[[walks]]\nhomes = 'house.sh3d'\nwalk = 'walk.json'\ncameras = 'A'\n", 4, "has its own camera"},
    {"[[measure]]\nhomes = 'house.sh3d'\nmeters = 'desk.json'\n", 3, "desk.json: no such file"},
    {"[[measure]]\nhomes = 'house.sh3d'\ncameras = 'A'\n", 3, "unknown key"},
    {"[[commands]]\n", 1, "has no 'arguments'"},
    {"[[commands]]\narguments = []\noutput = 'a.txt'\n", 2, "must not be empty"},
    {"[[commands]]\narguments = 'info house.sh3d'\noutput = 'a.txt'\n", 2, "must be a list"},
    {"[[commands]]\narguments = ['info', 'house.sh3d']\n", 1, "needs output"},
    {"[[commands]]\narguments = ['render', 'house.sh3d', '-o', '{output}']\n", 1, "needs output"},
    {"[[commands]]\narguments = ['info', '{home}']\noutput = 'a.txt'\n", 2, "neither {output}, {folder} nor a key"},
    {"[[commands]]\narguments = ['info', 'x']\noutput = '../a.txt'\n", 3, "without a folder"},
    {"[[commands]]\narguments = ['info', 'x']\noutput = 'a.txt'\neach = 3\n", 4, "must be a table of lists"},
    {"[[commands]]\narguments = ['info', 'x']\noutput = 'a.txt'\neach = {home = []}\n", 4, "must not be empty"},
    {"[[commands]]\narguments = ['info', 'x']\noutput = 'a.txt'\neach = {home = ['a']}\n", 4,
     "no argument holds {home}"},
    {"[[commands]]\narguments = ['info', '{output}']\noutput = 'a'\neach = {output = ['a']}\n", 4, "take another"},
    {"[[commands]]\narguments = ['batch', 'run', 'x']\noutput = 'a.txt'\n", 2, "cannot be a task"},
    {"[[pictures]]\nhomes = 'house.sh3d'\nseeds = 1000000\n"
     "cameras = ['0', '1', '2', '3', '4', '5', '6', '7', '8', '9', '10']\n"
     "lights = ['day', 'night', 'evening', 'none', 'file', 'auto', 'evening.json', 'day', 'night', 'file']\n",
     1, "more than 100000000 tasks"},
};

class BatchMistake : public SmallBatch {};

TEST_F(BatchMistake, EachIsOneLineWithItsPlace) {
  for (const char* file : {"house.sh3d", "evening.json"}) writeFile(files_ / file, "x");
  writeFile(files_ / "walk.json", "{\"seconds\": 2, \"framesPerSecond\": 10}");
  const auto file = files_ / "plan.toml";
  for (const Mistake& m : kMistakes) {
    writeFile(file, m.toml);
    const Result<Planned> done = planBatch(file, folder_.path(), "1", [](const auto&) { return Ok{}; });
    ASSERT_FALSE(done) << m.toml;
    const std::string place = fmt::format("{}:{}: ", file.string(), m.line);
    EXPECT_TRUE(done.error().starts_with(place)) << m.toml << "\n" << done.error();
    EXPECT_NE(done.error().find(m.what), std::string::npos) << m.toml << "\n" << done.error();
    EXPECT_EQ(done.error().find('\n'), std::string::npos) << done.error();
    EXPECT_FALSE(std::filesystem::exists(folder_.plan())) << m.toml;
  }
  EXPECT_GE(std::size(kMistakes), 50u);
}

}  // namespace
}  // namespace roomlight::batch
