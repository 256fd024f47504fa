// Four browsers that do all sorts of things at once. Seconds here; for longer: ROOMLIGHT_SOAK_SECONDS=3600 test_server
// --gtest_filter='Soak*', also with sanitizers. Prints how memory grew with what they said.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <mutex>
#include <optional>
#include <random>

#include "served_home.h"
#include "support/techniques.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define ROOMLIGHT_SANITIZED
extern "C" size_t __sanitizer_get_current_allocated_bytes();  // of <sanitizer/allocator_interface.h>, which GCC lacks
#endif

namespace roomlight {
namespace {

using namespace roomlight::testing;
using nlohmann::json;

constexpr double kMiB = 1 << 20;

double allocatedMiB() {
#ifdef ROOMLIGHT_SANITIZED
  return static_cast<double>(__sanitizer_get_current_allocated_bytes()) / kMiB;
#else
  const struct mallinfo2 m = mallinfo2();
  return static_cast<double>(m.uordblks + m.hblkhd) / kMiB;
#endif
}

double residentMiB() {
  std::ifstream in("/proc/self/statm");
  double pages = 0, resident = 0;
  in >> pages >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / kMiB;
}

// The least memory of two halves of what was said after the warm-up: pictures and lights that come and go do not count.
struct Growth {
  double firstMiB = 0, lastMiB = 0;
  double kibEach = 0;  // a thing that was said
};

// None: too little was said after the warm-up.
constexpr size_t kFewestInHalf = 80;
std::optional<Growth> growthOf(const std::vector<double>& memoryMiB, size_t warmUp) {
  if (memoryMiB.size() < warmUp + 2 * kFewestInHalf) return {};
  const auto half = static_cast<std::ptrdiff_t>((memoryMiB.size() - warmUp) / 2);
  const auto middle = memoryMiB.end() - half;
  const double first = *std::min_element(middle - half, middle), last = *std::min_element(middle, memoryMiB.end());
  return Growth{first, last, 1024 * (last - first) / static_cast<double>(half)};
}

// Memory after each thing that any visitor said. From several threads.
class Memory {
 public:
  void see() {
    const std::lock_guard lock(mutex_);
    allocatedMiB_.push_back(allocatedMiB());
    residentMiB_.push_back(residentMiB());
  }
  bool hasEnough() {
    const std::lock_guard lock(mutex_);
    return growthOf(allocatedMiB_, kWarmUp).has_value();
  }
  // What is allocated settles soon; the allocator goes on taking pages for longer. Each half may differ by what was
  // lit at its quietest moment.
  void judge() const {
    const auto allocated = growthOf(allocatedMiB_, kWarmUp), resident = growthOf(residentMiB_, kWarmUpOfPages);
    ASSERT_TRUE(allocated);
    tell("allocated", *allocated);
    EXPECT_GT(allocated->firstMiB, 0);
    EXPECT_LT(allocated->lastMiB, allocated->firstMiB + 24);
    if (!resident) return;
    tell("resident", *resident);
    EXPECT_LT(resident->lastMiB, 1.2 * resident->firstMiB + 64);
  }

 private:
  static constexpr size_t kWarmUp = 60, kWarmUpOfPages = 1000;
  void tell(const char* what, const Growth& g) const {
    std::printf("%s after %zu things said: %.0f MiB, then %.0f MiB: %+.1f KiB each\n", what, allocatedMiB_.size(),
                g.firstMiB, g.lastMiB, g.kibEach);
  }

  std::mutex mutex_;
  std::vector<double> allocatedMiB_, residentMiB_;
};

// One wall is missing, so that the sun comes in.
view::ViewHome sunnyHome() {
  Scene scene = servedScene();
  scene.meshes.emplace_back();
  scene.instances[5].mesh = static_cast<int>(scene.meshes.size()) - 1;
  return underTheSun("test", std::move(scene));
}

struct Manners {
  int widest = 128, highest = 96;  // of its window
  int slowestMs = 0;  // on its line
  bool forgets = false;  // to acknowledge frames, now and then
};

class Visitor {
 public:
  Visitor(const ServedHome& home, uint32_t seed, Manners manners, Memory& memory)
      : home_(home), manners_(manners), name_(seed), random_(seed), memory_(memory) {}

  // Longer where too little was said until then.
  void visit(std::chrono::steady_clock::time_point until) {
    std::string window;
    const auto goesOn = [&] { return std::chrono::steady_clock::now() < until || !memory_.hasEnough(); };
    while (goesOn()) {
      Client client(home_.port(), home_.live(window));
      const json welcome = client.hear("welcome");
      window = welcome["window"];
      client.say(viewport());
      for (int i = whole(5, 60); i > 0 && goesOn(); --i) {
        client.acknowledges = !manners_.forgets || whole(0, 2) > 0;
        said_ = something(welcome);
        client.say(said_);
        memory_.see();
        if (manners_.slowestMs > 0)
          std::this_thread::sleep_for(std::chrono::milliseconds(whole(0, manners_.slowestMs)));
        if (whole(0, 3) == 0) ask(client);
      }
      ask(client);
      if (whole(0, 1)) window.clear();
    }
  }

 private:
  int whole(int low, int high) { return std::uniform_int_distribution(low, high)(random_); }
  double real(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  json place() { return {real(0.3, 3.7), real(0.3, 2.3), real(0.3, 4.7)}; }
  std::string oneOf(std::vector<std::string> words) {
    return words[static_cast<size_t>(whole(0, static_cast<int>(words.size()) - 1))];
  }
  json idOfOne(const json& list) {
    return list[static_cast<size_t>(whole(0, static_cast<int>(list.size()) - 1))]["id"];
  }

  json viewport() {
    return {{"type", "viewport"}, {"width", whole(16, manners_.widest)}, {"height", whole(16, manners_.highest)}};
  }

  // Everything said so far has been taken.
  void ask(Client& client) {
    constexpr double kPatienceS = 120;
    client.say({{"type", "meter"}, {"id", ++id_}, {"x", real(0, 1)}, {"y", real(0, 1)}});
    try {
      client.hear("metered", id_, kPatienceS);
    } catch (const std::exception& e) {
      throw std::runtime_error(fmt::format("visitor {}: no meter's answer to {} within {} s; it said {}", name_, id_,
                                           kPatienceS, said_.dump()));
    }
  }

  json something(const json& home) {
    const json edit = {{"type", "edit"}, {"id", ++id_}};
    json m = edit;
    switch (whole(0, 19)) {
      case 0: m["target"] = idOfOne(home["lamps"]), m["dim"] = real(0, 1); return m;
      case 1:
        m["target"] = idOfOne(home["lamps"]), m["temperatureK"] = real(2000, 6000), m["on"] = whole(0, 1) == 1;
        return m;
      case 2: m["target"] = idOfOne(home["lamps"]), m["position"] = place(); return m;
      case 3:
        m["target"] = idOfOne(home["objects"]), m["move"] = {real(-1, 1), 0, real(-1, 1)}, m["turn"] = real(-180, 180);
        return m;
      case 4: m["target"] = idOfOne(home["objects"]), m["hidden"] = whole(0, 3) == 0; return m;
      case 5: m["target"] = idOfOne(home["objects"]), m["color"] = {real(0, 1), real(0, 1), real(0, 1)}; return m;
      case 6: return {{"type", whole(0, 1) ? "undo" : "redo"}, {"id", id_}};
      case 7:
        return {{"type", "display"},
                {"falseColor", oneOf({"luminance", "illuminance", "off"})},
                {"compensation", real(-2, 2)}};
      case 8:
        return {{"type", "technique"},
                {"id", id_},
                {"technique", whole(0, 3) ? oneOf(test::allTechniques()) : technique::kHybrid}};
      case 9:
        return whole(0, 1) ? json{{"type", "split"}, {"id", id_}, {"split", nullptr}}
                           : json{{"type", "split"},
                                  {"id", id_},
                                  {"split", {{"left", {{"plan", "start"}}}, {"right", json::object()}}}};
      case 10:
        return {
            {"type", "plan"}, {"id", id_}, {"do", whole(0, 1) ? "keep" : "apply"}, {"name", whole(0, 1) ? "a" : "b"}};
      case 11: return {{"type", "pick"}, {"id", id_}, {"x", real(0, 1)}, {"y", real(0, 1)}};
      case 12:
        return {{"type", "render"}, {"id", id_},    {"kind", whole(0, 1) ? "picture" : "panorama"},
                {"width", 32},      {"height", 18}, {"quality", "draft"}};
      case 13: return {{"type", "save"}, {"id", id_}};
      case 14: m["target"] = "sun", m["hour"] = real(0, 24); return m;
      case 15: m["target"] = "sun", m["date"] = oneOf({"2026-12-21", "2026-06-21"}); return m;
      case 16: return viewport();
      default:
        return {{"type", "camera"},
                {"number", id_},
                {"position", place()},
                {"direction", {real(-1, 1), real(-0.5, 0.5), real(-1, 1)}}};
    }
  }

  const ServedHome& home_;
  const Manners manners_;
  const uint32_t name_;
  std::mt19937 random_;
  Memory& memory_;
  uint32_t id_ = 0;
  json said_;
};

TEST(SoakMemory, whatComesAndGoesIsNoGrowth) {
  constexpr size_t kWarmUp = 40;
  std::vector<double> steady, leaking;
  for (size_t i = 0; i < kWarmUp + 2 * kFewestInHalf; ++i) {
    EXPECT_FALSE(growthOf(steady, kWarmUp));
    const double now = (i < kWarmUp ? static_cast<double>(i) : 100) + static_cast<double>(i % 8) * 30;
    steady.push_back(now);
    leaking.push_back(now + static_cast<double>(i));
  }
  ASSERT_TRUE(growthOf(steady, kWarmUp));
  EXPECT_EQ(growthOf(steady, kWarmUp)->kibEach, 0);
  EXPECT_EQ(growthOf(leaking, kWarmUp)->kibEach, 1024);
}

TEST(Soak, fourVisitorsAtOnce) {
  const char* asked = std::getenv("ROOMLIGHT_SOAK_SECONDS");
  const double seconds = asked ? std::atof(asked) : 4;
  const ServedHome home(sunnyHome());
  constexpr Manners kManners[4] = {{}, {960, 540}, {128, 96, 200}, {128, 96, 20, true}};
  const auto begin = std::chrono::steady_clock::now();
  const auto until =
      begin + std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(seconds));
  Memory memory;
  std::vector<std::future<void>> visits;
  for (uint32_t i = 0; i < 4; ++i) {
    visits.push_back(
        std::async(std::launch::async, [&, i] { Visitor(home, i + 1, kManners[i], memory).visit(until); }));
  }
  for (auto& v : visits) EXPECT_NO_THROW(v.get());
  memory.judge();
  Client last(home.port(), home.live());
  EXPECT_EQ(last.hear("welcome")["home"], "test");
}

}  // namespace
}  // namespace roomlight
