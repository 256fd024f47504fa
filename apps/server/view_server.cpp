#include "view_server.h"

#include <optional>

#include "admission.h"
#include "base/result.h"
#include "view/session.h"

namespace roomlight::server {

Status serveHome(view::ViewHome home, const RenderSettings& settings, Options options, StaticFiles page,
                 const Served& tell, const std::atomic<bool>& stop) {
  if (options.token.empty()) options.token = randomToken();
  view::Session* session = nullptr;
  Handlers handlers;
  handlers.opened = [&](Connection c, const std::string& window) { session->open(c, window); };
  handlers.said = [&](Connection c, const std::string& text) { session->receive(c, text); };
  handlers.closed = [&](Connection c) { session->close(c); };
  handlers.findFile = [&](const std::string& id) -> std::optional<HeldFile> {
    const std::optional<view::FinishedFile> file = session->findFile(id);
    if (!file) return {};
    return HeldFile{file->path, file->name};
  };
  handlers.fileSent = [&](const std::string& id) { session->fileSent(id); };
  Result<std::unique_ptr<Server>> listening = Server::listen(options, std::move(page), std::move(handlers));
  if (!listening) return Error{listening.error()};
  Server& server = *listening.value();
  view::Outbox outbox;
  outbox.text = [&](Connection c, std::string text) { server.send(c, std::move(text), false); };
  outbox.frame = [&](Connection c, std::string bytes) { server.send(c, std::move(bytes), true); };
  outbox.failed = tell.failed;
  view::Session running(std::move(home), settings, std::move(outbox), tell.start);
  session = &running;
  if (const Status told = tell.listening(linksTo(options.address, server.port(), options.token)); !told)
    return Error{told.error()};
  server.run(stop);
  return Ok{};
}

}  // namespace roomlight::server
