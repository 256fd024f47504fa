// Four browsers that do all sorts of things at once. Seconds here; for longer: ROOMLIGHT_SOAK_SECONDS=3600 test_server
// --gtest_filter='Soak.*', also with sanitizers. Prints how much memory there was at a fifth of the time and at the
// end.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <random>

#include "served_home.h"

namespace roomlight {
namespace {

using namespace roomlight::testing;
using nlohmann::json;

double residentMiB() {
  std::ifstream in("/proc/self/statm");
  double pages = 0, resident = 0;
  in >> pages >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

// One wall is missing, so that the sun comes in.
view::ViewHome sunnyHome() {
  Scene scene = servedScene();
  scene.meshes.emplace_back();
  scene.instances[5].mesh = static_cast<int>(scene.meshes.size()) - 1;
  return underTheSun("test", std::move(scene));
}

struct Manners {
  int widest = 128, highest = 96;  // of its window
  int slowestMs = 0;               // on its line
  bool forgets = false;            // to acknowledge frames, now and then
};

class Visitor {
 public:
  Visitor(const ServedHome& home, uint32_t seed, Manners manners)
      : home_(home), manners_(manners), name_(seed), random_(seed) {}

  void visit(std::chrono::steady_clock::time_point until) {
    std::string window;
    while (std::chrono::steady_clock::now() < until) {
      Client client(home_.port(), home_.live(window));
      const json welcome = client.hear("welcome");
      window = welcome["window"];
      client.say(viewport());
      for (int i = whole(5, 60); i > 0 && std::chrono::steady_clock::now() < until; --i) {
        client.acknowledges = !manners_.forgets || whole(0, 2) > 0;
        said_ = something(welcome);
        client.say(said_);
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
                {"technique", oneOf({"hybrid", "hybrid", "hybrid", "cone", "cone", "vxgi", "lpv", "photon", "path"})}};
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
  uint32_t id_ = 0;
  json said_;
};

TEST(Soak, fourVisitorsAtOnce) {
  const char* asked = std::getenv("ROOMLIGHT_SOAK_SECONDS");
  const double seconds = asked ? std::atof(asked) : 4;
  const ServedHome home(sunnyHome());
  constexpr Manners kManners[4] = {{}, {960, 540}, {128, 96, 200}, {128, 96, 20, true}};
  const auto begin = std::chrono::steady_clock::now();
  const auto until =
      begin + std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(seconds));
  std::vector<std::future<void>> visits;
  for (uint32_t i = 0; i < 4; ++i) {
    visits.push_back(std::async(std::launch::async,
                                [&home, &kManners, i, until] { Visitor(home, i + 1, kManners[i]).visit(until); }));
  }
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds / 5));
  const double early = residentMiB();
  for (auto& v : visits) EXPECT_NO_THROW(v.get());
  const double late = residentMiB();
  std::printf("resident: %.0f MiB early, %.0f MiB at the end\n", early, late);
  if (seconds >= 60) {
    EXPECT_LT(late, 1.2 * early + 64);
  }
  Client last(home.port(), home.live());
  EXPECT_EQ(last.hear("welcome")["home"], "test");
}

}  // namespace
}  // namespace roomlight
