#include "base/platform/network.h"

#if defined(__unix__) || defined(__APPLE__)

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <memory>
#include <optional>

namespace roomlight {
namespace {

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

bool meansAllAddresses(const std::string& address) {
  in_addr v4{};
  in6_addr v6{};
  if (inet_pton(AF_INET, address.c_str(), &v4) == 1) return v4.s_addr == INADDR_ANY;
  return inet_pton(AF_INET6, address.c_str(), &v6) == 1 && IN6_IS_ADDR_UNSPECIFIED(&v6);
}

}  // namespace roomlight

#endif
