// A home served to browsers: a session behind a server, and the links that open it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/platform/network.h"
#include "engine/settings.h"
#include "server.h"
#include "view/home.h"
#include "view/executor.h"

namespace roomlight::server {

// Hosts of links to who listens at `address`: itself, or, where that is all there are (0.0.0.0 or ::), each of the
// machine's that others can reach; its loopback where there is no other. IPv6 in brackets.
std::vector<std::string> hostsOf(const std::string& address, const std::vector<InterfaceAddress>& machine);

// Links that open the page: on this machine, and on others that can reach one of its addresses.
struct Links {
  std::vector<std::string> all;  // at least one
  std::string here;              // the best on this machine
};
Links linksTo(const std::string& address, uint16_t port, const std::string& token);

struct Served {
  // The links to open, once somebody listens. An error ends it.
  std::function<Status(const Links& links)> listening;
  std::function<void(const std::string& line)> failed;  // what goes wrong later
  view::StartThread start = view::systemThread;
};

// Until `stop` becomes true. Errors: nobody can listen there; that of `listening`. Throws ResourceError where there is
// no thread.
Status serveHome(view::ViewHome home, const RenderSettings& settings, Options options, StaticFiles page,
                 const Served& tell, const std::atomic<bool>& stop);

}  // namespace roomlight::server
