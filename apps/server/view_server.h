// A home served to browsers: a session behind a server.
#pragma once

#include "engine/settings.h"
#include "server.h"
#include "view/home.h"

namespace roomlight::server {

struct Served {
  // The link to open, once somebody listens; and what goes wrong later.
  std::function<void(const std::string& link)> listening;
  std::function<void(const std::string& line)> failed;
};

// Until `stop` becomes true. Errors: nobody can listen there.
Status serveHome(view::ViewHome home, const RenderSettings& settings, Options options, StaticFiles page,
                 const Served& tell, const std::atomic<bool>& stop);

}  // namespace roomlight::server
