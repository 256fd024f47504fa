// Links that open the page: on this machine, and on others that can reach one of its addresses.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace roomlight::server {

struct InterfaceAddress {
  std::string address;  // numeric
  bool v6 = false, loopback = false;
};

// Of the interfaces that run. Without link-local addresses of IPv6, which need a zone that browsers do not take.
std::vector<InterfaceAddress> interfaceAddresses();

// Hosts of links to who listens at `address`: itself, or, where that is all there are (0.0.0.0 or ::), each of the
// machine's that others can reach; its loopback where there is no other. IPv6 in brackets.
std::vector<std::string> hostsOf(const std::string& address, const std::vector<InterfaceAddress>& machine);

struct Links {
  std::vector<std::string> all;  // at least one
  std::string here;              // the best on this machine
};
Links linksTo(const std::string& address, uint16_t port, const std::string& token);

}  // namespace roomlight::server
