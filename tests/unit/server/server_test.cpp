// Who is let in, and what is served.
#include <gtest/gtest.h>

#include <chrono>

#include "served_home.h"
#include "server/admission.h"

namespace roomlight {
namespace {

using namespace roomlight::testing;

view::ViewHome plainHome() { return view::ViewHome("test", servedScene()); }

// The reply to an attempt to open a WebSocket.
Reply tryToOpen(const ServedHome& home, const std::string& target, const Headers& more = {}) {
  Headers headers = {{"Upgrade", "websocket"},
                     {"Connection", "Upgrade"},
                     {"Sec-WebSocket-Version", "13"},
                     {"Sec-WebSocket-Key", "dGhlIHNhbXBsZSBub25jZQ=="}};
  headers.emplace_back("Origin", "http://127.0.0.1:" + std::to_string(home.port()));
  headers.insert(headers.end(), more.begin(), more.end());
  return get(home.port(), target, headers);
}

// Its status; 101 is let in.
int opened(const ServedHome& home, const std::string& target, const Headers& more = {}) {
  return tryToOpen(home, target, more).status;
}

// Nobody is closed for being silent.
server::Options patient() {
  server::Options options;
  options.strangersTime = std::chrono::hours(1);
  return options;
}

TEST(Admission, tokensAreNewAndLong) {
  const std::string a = server::randomToken(), b = server::randomToken();
  EXPECT_EQ(a.size(), 32u);
  EXPECT_NE(a, b);
  EXPECT_TRUE(server::sameSecret(a, a));
  EXPECT_FALSE(server::sameSecret(a, b));
  EXPECT_FALSE(server::sameSecret("", a));
  EXPECT_FALSE(server::sameSecret(a + "0", a));
}

TEST(Admission, hostsAreThisMachinesOwn) {
  using server::isOwnHost;
  EXPECT_TRUE(isOwnHost("127.0.0.1:80", 80, true));
  EXPECT_TRUE(isOwnHost("localhost:80", 80, true));
  EXPECT_TRUE(isOwnHost("[::1]:80", 80, true));
  for (const char* host :
       {"", "127.0.0.1", "127.0.0.1:81", "evil.example:80", "127.0.0.1.evil.example:80", "192.168.1.7:80"})
    EXPECT_FALSE(isOwnHost(host, 80, true)) << host;
  EXPECT_TRUE(isOwnHost("192.168.1.7:80", 80, false));
  EXPECT_TRUE(isOwnHost("[fe80::1]:80", 80, false));
  for (const char* host : {"evil.example:80", ":80", "[]:80", "192.168.1.7.nip.io:80"})
    EXPECT_FALSE(isOwnHost(host, 80, false)) << host;
}

TEST(Admission, queriesAreTakenApart) {
  EXPECT_EQ(server::queryValue("token=ab&window=cd", "token"), "ab");
  EXPECT_EQ(server::queryValue("token=ab&window=cd", "window"), "cd");
  EXPECT_EQ(server::queryValue("xtoken=ab", "token"), "");
  EXPECT_EQ(server::queryValue("&&=&token", "token"), "");
}

TEST(Server, aWrongTokenIsRefused) {
  const ServedHome home;
  EXPECT_EQ(opened(home, "/live?token=00000000000000000000000000000000"), 403);
  EXPECT_EQ(opened(home, "/live"), 403);
  EXPECT_EQ(get(home.port(), "/files/1").status, 403);
  EXPECT_EQ(get(home.port(), std::string("/files/1?token=") + ServedHome::kToken).status, 404);
  EXPECT_EQ(opened(home, home.live()), 101);
}

TEST(Server, otherSitesAreRefused) {
  const ServedHome home;
  const std::string port = std::to_string(home.port());
  EXPECT_EQ(opened(home, home.live(), {{"Origin", "http://evil.example"}}), 403);
  EXPECT_EQ(opened(home, home.live(), {{"Origin", "null"}}), 403);
  EXPECT_EQ(opened(home, home.live(), {{"Host", "evil.example:" + port}, {"Origin", "http://evil.example:" + port}}),
            403);
  EXPECT_EQ(get(home.port(), "/", {{"Host", "evil.example:" + port}}).status, 403);
  EXPECT_EQ(get(home.port(), "/", {{"Origin", "http://evil.example"}}).status, 403);
}

TEST(Server, onlyThePageIsServed) {
  const ServedHome home;
  const Reply page = get(home.port(), "/");
  EXPECT_EQ(page.status, 200);
  EXPECT_EQ(page.body, "<!doctype html>page");
  EXPECT_EQ(page.header("X-Content-Type-Options"), "nosniff");
  EXPECT_NE(page.header("Content-Security-Policy").find("default-src 'none'"), std::string::npos);
  for (const char* target : {"/../../etc/passwd", "/..%2f..%2fetc/passwd", "//etc/passwd", "/index.html/../../x",
                             "/secret.txt", "*", "/%00", "/index.html%00"})
    EXPECT_EQ(get(home.port(), target).status, 404) << target;
  EXPECT_EQ(get(home.port(), "/live").status, 403);
}

TEST(Server, thereIsRoomForEightWindows) {
  const ServedHome home;
  std::vector<std::unique_ptr<Client>> clients;
  for (int i = 0; i < 8; ++i) clients.push_back(std::make_unique<Client>(home.port(), home.live()));
  EXPECT_EQ(opened(home, home.live()), 503);
}

// The page asks without a WebSocket, since its browser does not tell why that was refused.
TEST(Server, aWindowTooManyIsToldApartFromAWrongToken) {
  server::Options options;
  options.mostWindows = 2;
  const ServedHome home(plainHome(), options);
  const std::string wrong = "/live?token=00000000000000000000000000000000";
  const Client one(home.port(), home.live());
  EXPECT_EQ(get(home.port(), home.live()).status, 426);
  const Client two(home.port(), home.live());
  for (const Reply& r : {tryToOpen(home, home.live()), get(home.port(), home.live())}) {
    EXPECT_EQ(r.status, 503);
    EXPECT_NE(r.body.find("there may be (2)"), std::string::npos) << r.body;
    EXPECT_NE(r.body.find("--windows"), std::string::npos) << r.body;
  }
  for (const Reply& r : {tryToOpen(home, wrong), get(home.port(), wrong)}) {
    EXPECT_EQ(r.status, 403);
    EXPECT_NE(r.body.find("wrong token"), std::string::npos) << r.body;
  }
}

TEST(Server, idleConnectionsKeepNobodyOut) {
  const ServedHome home(plainHome(), patient());
  Client before(home.port(), home.live());
  std::vector<Line> idle;
  for (int i = 0; i < 100; ++i) idle.emplace_back(home.port());
  EXPECT_EQ(get(home.port(), "/").status, 200);
  Client after(home.port(), home.live());
  after.hear("welcome");
  before.say({{"type", "ping"}, {"id", 3}});
  before.hear("pong", 3);
}

TEST(Server, ofConnectionsWithoutATokenThoseSilentForLongestMakeRoom) {
  server::Options options = patient();
  options.mostStrangers = 3;
  const ServedHome home(plainHome(), options);
  Line first(home.port()), second(home.port()), third(home.port());
  for (Line* line : {&first, &second, &third, &first}) EXPECT_EQ(line->get("/").status, 200);
  Line fourth(home.port());
  EXPECT_EQ(fourth.get("/").status, 200);
  EXPECT_TRUE(second.isClosed());
  EXPECT_EQ(first.get("/").status, 200);
  EXPECT_EQ(third.get("/").status, 200);
}

TEST(Server, silentConnectionsAreClosed) {
  server::Options options;
  options.strangersTime = std::chrono::milliseconds(1);
  const ServedHome home(plainHome(), options);
  Line idle(home.port());
  EXPECT_TRUE(idle.isClosed());
}

TEST(Server, onlySoManyFilesAreSentAtOnce) {
  server::Options options;
  options.mostFiles = 0;
  const ServedHome home(plainHome(), options);
  const std::string file = "/files/1";
  EXPECT_EQ(get(home.port(), file + "?token=" + ServedHome::kToken).status, 503);
  EXPECT_EQ(get(home.port(), file).status, 403);
}

TEST(Server, aMessageThatIsTooLongCloses) {
  const ServedHome home;
  Client client(home.port(), home.live());
  client.sayText(std::string((64 << 10) + 1, ' '));
  EXPECT_EQ(client.closeCode(), 1009);
}

TEST(Server, binaryMessagesClose) {
  const ServedHome home;
  Client client(home.port(), home.live());
  client.sayText("abc", true);
  EXPECT_EQ(client.closeCode(), 1003);
}

TEST(Server, aFloodCloses) {
  const ServedHome home;
  Client client(home.port(), home.live());
  for (int i = 0; i < 2000; ++i) client.sayText("{\"type\": \"ping\", \"id\": 1}");
  EXPECT_EQ(client.closeCode(), 1008);
  EXPECT_EQ(opened(home, home.live()), 101);
}

}  // namespace
}  // namespace roomlight
