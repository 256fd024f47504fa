// Which links are told, and that they lead to the page.
#include "server/view_server.h"

#include <gtest/gtest.h>

#include "served_home.h"

namespace roomlight::server {
namespace {

using Hosts = std::vector<std::string>;

const std::vector<InterfaceAddress> kMachine = {{"127.0.0.1", false, true},
                                                {"192.168.1.7", false, false},
                                                {"::1", true, true},
                                                {"2001:db8::7", true, false},
                                                {"10.0.0.3", false, false}};

TEST(Links, oneAddressIsItsOwnHost) {
  EXPECT_EQ(hostsOf("127.0.0.1", kMachine), Hosts({"127.0.0.1"}));
  EXPECT_EQ(hostsOf("::1", kMachine), Hosts({"[::1]"}));
  EXPECT_EQ(hostsOf("192.168.1.7", kMachine), Hosts({"192.168.1.7"}));
}

TEST(Links, allAddressesAreTheMachinesOwn) {
  EXPECT_EQ(hostsOf("0.0.0.0", kMachine), Hosts({"192.168.1.7", "10.0.0.3"}));
  EXPECT_EQ(hostsOf("::", kMachine), Hosts({"192.168.1.7", "10.0.0.3", "[2001:db8::7]"}));
  EXPECT_EQ(hostsOf("0:0::0", kMachine), hostsOf("::", kMachine));
}

TEST(Links, aMachineWithoutANetworkHasItsLoopback) {
  EXPECT_EQ(hostsOf("0.0.0.0", {kMachine[0], kMachine[2], kMachine[3]}), Hosts({"127.0.0.1"}));
  EXPECT_EQ(hostsOf("::", {kMachine[0], kMachine[2]}), Hosts({"127.0.0.1"}));
  EXPECT_EQ(hostsOf("::", {}), Hosts({"127.0.0.1"}));
}

TEST(Links, haveTheToken) {
  const Links links = linksTo("::1", 80, "abc");
  EXPECT_EQ(links.all, Hosts({"http://[::1]:80/#abc"}));
  EXPECT_EQ(links.here, links.all[0]);
  EXPECT_EQ(linksTo("0.0.0.0", 80, "abc").here, "http://127.0.0.1:80/#abc");
}

TEST(Links, leadToThePage) {
  Options options;
  options.address = "0.0.0.0";
  const testing::ServedHome home(view::ViewHome("test", testing::servedScene()), options);
  ASSERT_FALSE(home.links().all.empty());
  for (const std::string& link : home.links().all) {
    const size_t from = std::string("http://").size(), to = link.find("/#");
    ASSERT_NE(to, std::string::npos) << link;
    EXPECT_EQ(link.substr(to + 2), testing::ServedHome::kToken);
    EXPECT_EQ(testing::get(home.port(), "/", {{"Host", link.substr(from, to - from)}}).status, 200) << link;
  }
}

}  // namespace
}  // namespace roomlight::server
