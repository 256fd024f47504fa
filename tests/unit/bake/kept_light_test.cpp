// Light that an interrupted run leaves for the next.
#include "bake/kept_light.h"

#include <gtest/gtest.h>

#include <fstream>

#include "bake/meter_chunks.h"
#include "unit/temporary_folder.h"

namespace roomlight::bake {
namespace {

using roomlight::testing::TemporaryFolder;

TEST(KeptLight, isThereAsItWasUntilItIsForgotten) {
  const TemporaryFolder folder;
  const KeptLight kept(folder / "home.light");
  EXPECT_FALSE(kept.any());
  EXPECT_FALSE(kept.find("a", 2));
  const std::vector<float> numbers{1.5f, -0.0f};
  kept.keep("a", numbers);
  EXPECT_TRUE(kept.any());
  EXPECT_EQ(kept.find("a", 2), numbers);
  EXPECT_FALSE(kept.find("a", 3)) << "of another size";
  EXPECT_FALSE(kept.find("b", 2));
  kept.forget();
  EXPECT_FALSE(std::filesystem::exists(folder / "home.light"));
}

TEST(KeptLight, whatIsDamagedIsNotThere) {
  const TemporaryFolder folder;
  const KeptLight kept(folder / "home.light");
  kept.keep("a", std::vector<float>{1, 2});
  std::fstream file(folder / "home.light/a.light", std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(5).put('x');
  file.close();
  EXPECT_FALSE(kept.find("a", 2));
}

TEST(KeptLight, filesOfOthersStay) {
  const TemporaryFolder folder;
  const KeptLight kept(folder / "home.light");
  kept.keep("a", std::vector<float>{1});
  std::ofstream(folder / "home.light/mine.txt") << "mine";
  kept.forget();
  EXPECT_TRUE(std::filesystem::exists(folder / "home.light/mine.txt"));
  EXPECT_FALSE(std::filesystem::exists(folder / "home.light/a.light"));
}

TEST(KeptLight, withoutAFolderNothingIsKept) {
  const KeptLight none, nowhere("/dev/null/home.light");
  for (const KeptLight* kept : {&none, &nowhere}) {
    kept->keep("a", std::vector<float>{1});
    EXPECT_FALSE(kept->find("a", 1));
    EXPECT_FALSE(kept->any());
    kept->forget();
  }
}

// A reader that is stopped in its third chunk measures the rest when it is asked again.
TEST(MeterChunks, measureWhatIsNotKept) {
  const TemporaryFolder folder;
  const KeptLight kept(folder / "home.light");
  std::vector<SurfaceElement> places(70'000);
  for (size_t i = 0; i < places.size(); ++i) places[i].position.x = static_cast<float>(i);
  const MeterChunks chunks{places, 1, "inputs", kept, {}};
  std::atomic<bool> stop = false;
  size_t measured = 0, mostChunks = 2;
  const auto measure = [&](std::span<const SurfaceElement> chunk, const MeterSettings&, const Progress&) {
    stop = measured == mostChunks;
    ++measured;
    std::vector<float> out;
    for (const SurfaceElement& e : chunk) out.push_back(e.position.x);
    return out;
  };
  std::vector<float> taken;
  const auto take = [&](size_t first, std::span<const float> numbers) {
    EXPECT_EQ(first, taken.size());
    taken.insert(taken.end(), numbers.begin(), numbers.end());
  };
  EXPECT_FALSE(chunks.read(measure, take, {{}, &stop}));
  EXPECT_EQ(measured, 3u);
  EXPECT_EQ(taken.size() % 1024, 0u) << "what was stopped is not handed on";
  const size_t done = taken.size();
  stop = false, measured = 0, mostChunks = 100, taken.clear();
  float told = 0;
  EXPECT_TRUE(chunks.read(measure, take, {[&](float f) { told = f; }, &stop}));
  EXPECT_EQ(measured, 3u) << "of five chunks two are kept";
  ASSERT_EQ(taken.size(), places.size());
  EXPECT_GT(taken.size(), done);
  for (size_t i = 0; i < taken.size(); ++i) ASSERT_EQ(taken[i], static_cast<float>(i));
  const MeterChunks others{places, 1, "other inputs", kept, {}};
  measured = 0, taken.clear();
  EXPECT_TRUE(others.read(measure, take, {}));
  EXPECT_EQ(measured, 5u);
}

}  // namespace
}  // namespace roomlight::bake
