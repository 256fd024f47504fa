#include "view_server.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>

#include <memory>
#include <optional>

namespace roomlight::server {
namespace {

constexpr char kThisMachine[] = "127.0.0.1";

bool isV6(const std::string& address) { return address.find(':') != std::string::npos; }

// 0.0.0.0 or ::, however it is written.
bool meansAll(const std::string& address) {
  in_addr v4{};
  in6_addr v6{};
  if (inet_pton(AF_INET, address.c_str(), &v4) == 1) return v4.s_addr == INADDR_ANY;
  return inet_pton(AF_INET6, address.c_str(), &v6) == 1 && IN6_IS_ADDR_UNSPECIFIED(&v6);
}

std::string hostOf(const std::string& address) { return isV6(address) ? fmt::format("[{}]", address) : address; }

std::optional<InterfaceAddress> readAddress(const ifaddrs& i) {
  const bool runs = (i.ifa_flags & IFF_UP) && (i.ifa_flags & IFF_RUNNING);
  if (!runs || !i.ifa_addr) return {};
  const int family = i.ifa_addr->sa_family;
  const void* bytes = nullptr;
  if (family == AF_INET) {
    bytes = &reinterpret_cast<const sockaddr_in*>(i.ifa_addr)->sin_addr;
  } else if (family == AF_INET6) {
    const in6_addr& v6 = reinterpret_cast<const sockaddr_in6*>(i.ifa_addr)->sin6_addr;
    if (!IN6_IS_ADDR_LINKLOCAL(&v6)) bytes = &v6;
  }
  char text[INET6_ADDRSTRLEN];
  if (!bytes || !inet_ntop(family, bytes, text, sizeof text)) return {};
  return InterfaceAddress{text, family == AF_INET6, (i.ifa_flags & IFF_LOOPBACK) != 0};
}

}  // namespace

std::vector<InterfaceAddress> interfaceAddresses() {
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return {};
  const std::unique_ptr<ifaddrs, void (*)(ifaddrs*)> all(first, freeifaddrs);
  std::vector<InterfaceAddress> out;
  for (const ifaddrs* i = first; i; i = i->ifa_next) {
    if (std::optional<InterfaceAddress> a = readAddress(*i)) out.push_back(std::move(*a));
  }
  return out;
}

std::vector<std::string> hostsOf(const std::string& address, const std::vector<InterfaceAddress>& machine) {
  if (!meansAll(address)) return {hostOf(address)};
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
  const bool all = meansAll(address);
  for (const std::string& host : hostsOf(address, all ? interfaceAddresses() : std::vector<InterfaceAddress>()))
    links.all.push_back(link(host));
  links.here = link(all ? kThisMachine : hostOf(address));
  return links;
}

}  // namespace roomlight::server
