// A home served to browsers: a session behind a server.
#pragma once

#include "engine/settings.h"
#include "links.h"
#include "server.h"
#include "view/home.h"
#include "view/start_thread.h"

namespace roomlight::server {

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
