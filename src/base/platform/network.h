// This machine's addresses.
#pragma once

#include <string>
#include <vector>

namespace roomlight {

struct InterfaceAddress {
  std::string address;  // numeric
  bool v6 = false, loopback = false;
};

// Of the interfaces that run. Without link-local addresses of IPv6, which need a zone that browsers do not take.
std::vector<InterfaceAddress> interfaceAddresses();

// 0.0.0.0 or ::, however it is written.
bool meansAllAddresses(const std::string& address);

}  // namespace roomlight
