#include "view_server.h"

#include <fmt/format.h>

namespace roomlight::server {
namespace {

constexpr char kThisMachine[] = "127.0.0.1";

bool isV6(const std::string& address) { return address.find(':') != std::string::npos; }

std::string hostOf(const std::string& address) { return isV6(address) ? fmt::format("[{}]", address) : address; }

}  // namespace

std::vector<std::string> hostsOf(const std::string& address, const std::vector<InterfaceAddress>& machine) {
  if (!meansAllAddresses(address)) return {hostOf(address)};
  std::vector<std::string> hosts;
  for (const bool v6 : {false, true}) {  // the shorter ones first: they may have to be typed
    if (v6 && !isV6(address)) continue;
    for (const InterfaceAddress& a : machine) {
      if (a.v6 == v6 && !a.loopback) hosts.push_back(hostOf(a.address));
    }
  }
  if (hosts.empty()) hosts.emplace_back(kThisMachine);
  return hosts;
}

Links linksTo(const std::string& address, uint16_t port, const std::string& token) {
  const auto link = [&](const std::string& host) { return fmt::format("http://{}:{}/#{}", host, port, token); };
  Links links;
  const bool all = meansAllAddresses(address);
  for (const std::string& host : hostsOf(address, all ? interfaceAddresses() : std::vector<InterfaceAddress>()))
    links.all.push_back(link(host));
  links.here = link(all ? kThisMachine : hostOf(address));
  return links;
}

}  // namespace roomlight::server
