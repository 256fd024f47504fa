// The sun, splits, plans, final pictures, saved lighting.
#include <gtest/gtest.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "seen.h"
#include "support/techniques.h"
#include "view/frame.h"

namespace roomlight {
namespace {

using namespace roomlight::testing;
using nlohmann::json;

// A yard.
view::ViewHome yard() {
  Scene scene;
  const int stone = test::addMaterial(scene, test::lambertian(0.3f));
  test::addRectangle(scene, {-5, 0, 5}, {10, 0, 0}, {0, 0, -10}, stone);
  test::addBox(scene, {-0.5f, 0, -3}, {0.5f, 1, -2}, stone);
  Camera camera;
  camera.worldFromCamera = looking({0, 1.6f, 3}, {0, -0.4f, -1});
  scene.cameras.push_back(camera);
  return underTheSun("yard", std::move(scene));
}

TEST(Session, theSunFollowsTheHour) {
  const ServedHome home(yard());
  Client client(home.port(), home.live());
  const json sun = client.hear("welcome")["sun"];
  EXPECT_EQ(sun["date"], "2026-06-21");
  EXPECT_NEAR(sun["hour"].get<double>(), 13, 1e-6);
  EXPECT_NEAR(sun["altitude"].get<double>(), 65, 2);
  client.say(kViewport);
  client.see(isWhole);
  const double noon = lux(client, 1);
  EXPECT_GT(noon, 50'000);
  client.say({{"type", "edit"}, {"id", 2}, {"target", "sun"}, {"hour", 20}});
  const uint32_t revision = client.hear("state")["revision"];
  client.see([&](const ReceivedFrame& f) { return f.revision == revision && !(f.flags & 4); });
  const double evening = lux(client, 3);
  EXPECT_LT(evening, 0.5 * noon);
  EXPECT_GT(evening, 1000);
  client.say({{"type", "undo"}, {"id", 4}});
  EXPECT_NEAR(client.hear("state")["sun"]["hour"].get<double>(), 13, 1e-6);
  client.see([&](const ReceivedFrame& f) { return f.revision == revision + 1 && !(f.flags & 4); });
  EXPECT_NEAR(lux(client, 5), noon, 0.02 * noon);
}

TEST(Session, splitsShowTwoPlans) {
  const ServedHome home;
  Client client(home.port(), home.live());
  const std::string lamp = named(client.hear("welcome")["lamps"], "Pendant")["id"];
  client.say(kViewport);
  client.say({{"type", "edit"}, {"id", 1}, {"target", lamp}, {"dim", 0.1}});
  client.say({{"type", "plan"}, {"id", 2}, {"do", "keep"}, {"name", "Dim"}});
  client.hear("ok", 2);
  EXPECT_EQ(client.hear("state")["plans"], json({"Dim", "start"}));
  client.say({{"type", "split"},
              {"id", 3},
              {"split", {{"left", {{"plan", "start"}}}, {"right", {{"plan", "Dim"}, {"technique", "cone"}}}}}});
  client.hear("ok", 3);
  client.say({{"type", "display"}, {"exposure", 7}});
  const ReceivedFrame left = client.see([](const ReceivedFrame& f) { return f.side == 1 && f.samples >= 4; });
  const ReceivedFrame right = client.see([](const ReceivedFrame& f) { return f.side == 2 && f.samples >= 4; });
  EXPECT_TRUE(isWhole(left) && isWhole(right));
  const double bright = lux(client, 4);  // of the left side
  client.say({{"type", "split"}, {"id", 5}, {"split", nullptr}});
  client.hear("ok", 5);
  client.see([](const ReceivedFrame& f) { return f.side == 0; });
  const double dimmed = lux(client, 6);
  EXPECT_LT(dimmed, 0.5 * bright);
  EXPECT_GT(dimmed, 0);
  client.say({{"type", "plan"}, {"id", 7}, {"do", "apply"}, {"name", "start"}});
  client.hear("ok", 7);
  EXPECT_NEAR(lux(client, 8), bright, 0.03 * bright);
  client.say({{"type", "split"}, {"id", 9}, {"split", {{"left", {{"plan", "none"}}}, {"right", json::object()}}}});
  EXPECT_EQ(client.hear("error", 9)["field"], "split.left.plan");
  client.say({{"type", "technique"}, {"id", 10}, {"technique", "magic"}});
  EXPECT_EQ(client.hear("error", 10)["field"], "technique");
}

// Light that always has a next change to follow is never that of the newest state. The reader hears of an edit before
// each thing that it asks for, and after the last, so that the other window has not given up meanwhile.
void readWhileAnotherWindowEdits(const char* technique) {
  const ServedHome home;
  Client editor(home.port(), home.live()), reader(home.port(), home.live());
  const json welcome = editor.hear("welcome");
  const std::string lamp = named(welcome["lamps"], "Pendant")["id"];
  uint32_t revision = welcome["revision"];
  reader.say({{"type", "technique"}, {"id", 100}, {"technique", technique}});
  reader.hear("ok", 100);
  reader.say(kViewport);
  reader.see(isWhole);
  const std::jthread edits([&](const std::stop_token& enough) {
    for (uint32_t id = 1; !enough.stop_requested(); ++id) {
      editor.say({{"type", "edit"}, {"id", id}, {"target", lamp}, {"position", {1.5 + 0.001 * (id % 1000), 2.2, 2.5}}});
      std::this_thread::sleep_for(std::chrono::milliseconds(6));
    }
  });
  const auto expectAnotherEdit = [&] {
    const uint32_t next = reader.hear("state")["revision"];
    EXPECT_GT(next, std::exchange(revision, next));
  };
  for (uint32_t id = 1; id <= 3; ++id) {
    expectAnotherEdit();
    EXPECT_GT(lux(reader, id), 1);
  }
  uint32_t last = 0;
  for (int i = 0; i < 3; ++i) {
    expectAnotherEdit();
    last = reader.see([&](const ReceivedFrame& f) { return f.number > last; }).number;
  }
  expectAnotherEdit();
}

TEST(Session, aMeterIsAnsweredWhileAnotherWindowEdits) { readWhileAnotherWindowEdits("hybrid"); }
TEST(Session, techniquesWithoutAFrontAreShownWhileAnotherWindowEdits) { readWhileAnotherWindowEdits("lpv"); }

TEST(Session, splitsOfTechniquesAllFollow) {
  const ServedHome home;
  Client client(home.port(), home.live());
  const std::string lamp = named(client.hear("welcome")["lamps"], "Pendant")["id"];
  client.say(kViewport);
  for (const std::string& name : test::allTechniques()) {
    if (name == technique::kHybrid) continue;
    client.say({{"type", "split"},
                {"id", 1},
                {"split", {{"left", {{"technique", name}}}, {"right", {{"technique", technique::kHybrid}}}}}});
    client.hear("ok", 1);
    client.see([](const ReceivedFrame& f) { return f.side == 1 && f.samples >= 4; });
    const double before = lux(client, 2);
    client.say({{"type", "edit"}, {"id", 3}, {"target", lamp}, {"dim", 0.25}});
    client.hear("ok", 3);
    const uint32_t revision = client.hear("state")["revision"];
    for (const int side : {1, 2})
      client.see([&](const ReceivedFrame& f) {
        return f.side == side && f.revision >= revision && !(f.flags & view::kLightIsBehind);
      });
    const double dimmed = lux(client, 4);
    EXPECT_LT(dimmed, 0.6 * before) << name;
    EXPECT_GT(dimmed, 0) << name;
    client.say({{"type", "undo"}, {"id", 5}});
    client.hear("ok", 5);
    EXPECT_NEAR(lux(client, 6), before, 0.05 * before) << name;
  }
}

TEST(Session, finalPicturesAreFetchedOnce) {
  const ServedHome home;
  Client client(home.port(), home.live());
  client.say(kViewport);
  client.say({{"type", "render"}, {"id", 1}, {"kind", "picture"}, {"width", 48}, {"height", 27}, {"quality", "draft"}});
  const std::string job = client.hear("ok", 1)["job"];
  json news;
  do {
    news = client.hear("job");
    EXPECT_EQ(news["job"], job);
  } while (news["state"] == "running");
  ASSERT_EQ(news["state"], "done");
  EXPECT_EQ(news["file"]["name"], "test-picture.png");
  const std::string target = news["file"]["path"].get<std::string>() + "?token=" + ServedHome::kToken;
  EXPECT_EQ(get(home.port(), news["file"]["path"]).status, 403);
  const Reply reply = get(home.port(), target);
  EXPECT_EQ(reply.status, 200);
  EXPECT_EQ(reply.body.substr(1, 3), "PNG");
  EXPECT_EQ(reply.body.size(), news["file"]["bytes"].get<size_t>());
  EXPECT_EQ(reply.header("Content-Disposition"), "attachment; filename=\"test-picture.png\"");
  EXPECT_EQ(get(home.port(), target).status, 404);
}

TEST(Session, picturesOfRestWaitWhileAFinalPictureIsMade) {
  const ServedHome home;
  Client client(home.port(), home.live());
  client.say(kViewport);
  client.see(isWhole);
  client.say({{"type", "render"},
              {"id", 1},
              {"kind", "picture"},
              {"width", 640},
              {"height", 480},
              {"technique", "path"},
              {"seconds", 600}});
  const std::string job = client.hear("ok", 1)["job"];
  EXPECT_EQ(client.hear("job")["state"], "running");
  // The picture before may have come to rest already.
  client.say({{"type", "camera"}, {"number", 9}, {"position", {2, 1.5, 4}}, {"target", {2, 1, 0}}});
  uint32_t most = client.see([](const ReceivedFrame& f) { return f.camera == 9; }).samples;
  const auto noneEnds = [&](const ReceivedFrame& f) {
    most = std::max(most, f.samples);
    return false;
  };
  expectNothingInTime([&] { client.see(noneEnds, 2); });
  EXPECT_LE(most, 2u);
  Client another(home.port(), home.live());
  another.say({{"type", "cancel"}, {"id", 2}, {"job", job}});
  another.hear("ok", 2);  // it was still being made
  another.say(kViewport);
  another.see([](const ReceivedFrame& f) { return f.samples > 20; });
}

TEST(Session, picturesThatNobodyFetchedAreToldOfAgain) {
  const ServedHome home;
  std::string window, job;
  {
    Client client(home.port(), home.live());
    window = client.hear("welcome")["window"];
    client.say(
        {{"type", "render"}, {"id", 1}, {"kind", "picture"}, {"width", 48}, {"height", 27}, {"quality", "draft"}});
    job = client.hear("ok", 1)["job"];
    while (client.hear("job")["state"] == "running") {}
    client.drop();
  }
  Client again(home.port(), home.live(window));
  EXPECT_EQ(again.hear("welcome")["window"], window);
  const json news = again.hear("job");
  EXPECT_EQ(news["job"], job);
  EXPECT_EQ(news["state"], "done");
  EXPECT_EQ(get(home.port(), news["file"]["path"].get<std::string>() + "?token=" + ServedHome::kToken).status, 200);
}

TEST(Session, rendersCanBeCancelled) {
  const ServedHome home;
  Client client(home.port(), home.live());
  client.say({{"type", "render"},
              {"id", 1},
              {"kind", "panorama"},
              {"technique", "path"},
              {"width", 256},
              {"height", 128},
              {"seconds", 600},
              {"format", "exr"}});
  const std::string job = client.hear("ok", 1)["job"];
  client.hear("job");
  client.say({{"type", "cancel"}, {"id", 2}, {"job", job}});
  client.hear("ok", 2);
  json news;
  do {
    news = client.hear("job");
  } while (news["state"] == "running");
  EXPECT_EQ(news["state"], "cancelled");
  client.say({{"type", "cancel"}, {"id", 3}, {"job", job}});
  EXPECT_EQ(client.hear("error", 3)["code"], "unknownThing");
}

TEST(Session, falseColoursTellTheirScale) {
  const ServedHome home;
  Client client(home.port(), home.live());
  client.say(kViewport);
  client.say({{"type", "display"}, {"falseColor", "illuminance"}, {"low", 10}, {"high", 1000}});
  const ReceivedFrame frame = client.see([](const ReceivedFrame& f) { return (f.flags & 8) != 0; });
  EXPECT_EQ(frame.scaleLow, 10);
  EXPECT_EQ(frame.scaleHigh, 1000);
}

TEST(Session, lightingIsSaved) {
  const ServedHome home;
  Client client(home.port(), home.live());
  const std::string lamp = named(client.hear("welcome")["lamps"], "Pendant")["id"];
  client.say({{"type", "edit"}, {"id", 1}, {"target", lamp}, {"dim", 0.5}, {"temperatureK", 2700}});
  client.say({{"type", "save"}, {"id", 2}});
  const json saved = client.hear("saved", 2);
  EXPECT_EQ(saved["name"], "test-lighting.json");
  const json file = json::parse(saved["text"].get<std::string>());
  EXPECT_EQ(file["own"][0], json({{"name", "Pendant"}, {"dimming", 0.5}, {"temperature", "2700 K"}}));
}

}  // namespace
}  // namespace roomlight
