#include "view_server.h"

#include <fmt/format.h>

#include <thread>

#include "admission.h"
#include "view/session.h"

namespace roomlight::server {
namespace {

constexpr std::chrono::milliseconds kLookAgain{50};

std::string linkTo(const Options& o, uint16_t port) {
  const bool v6 = o.address.find(':') != std::string::npos;
  const bool any = o.address == "0.0.0.0" || o.address == "::";
  return fmt::format("http://{}:{}/#{}",
                     any  ? "127.0.0.1"
                     : v6 ? fmt::format("[{}]", o.address)
                          : o.address,
                     port, o.token);
}

}  // namespace

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
  view::Session running(std::move(home), settings, std::move(outbox));
  session = &running;
  tell.listening(linkTo(options, server.port()));
  // Ends with this function, also where that throws.
  const std::jthread watch([&](const std::stop_token& ended) {
    while (!stop && !ended.stop_requested()) std::this_thread::sleep_for(kLookAgain);
    server.stop();
  });
  server.run();
  return Ok{};
}

}  // namespace roomlight::server
