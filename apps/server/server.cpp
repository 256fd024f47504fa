#include "server.h"

#include <fmt/format.h>

#include <boost/asio/awaitable.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ip/v6_only.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <deque>
#include <exception>
#include <map>

#include "admission.h"
#include "stranger.h"

namespace roomlight::server {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;
using boost::system::error_code;
using Request = http::request<http::empty_body>;

constexpr uint32_t kMostHeaderBytes = 16 << 10;
constexpr std::chrono::seconds kHandshakeTime{5}, kSilence{60}, kFileTime{600};
constexpr std::chrono::milliseconds kLookAgain{50}, kLastLook{10};
constexpr int kLastLooks = 50;
constexpr size_t kMostWaiting = 4096, kMostWaitingBytes = 64 << 20;  // a browser that takes nothing more is let go

// What may not be handled through exceptions ends here.
asio::redirect_error_t<asio::use_awaitable_t<>> into(error_code& code) {
  return asio::redirect_error(asio::use_awaitable, code);
}

struct Target {
  std::string path, query;
};
Target targetOf(const Request& request) {
  const std::string whole(request.target());
  const size_t question = whole.find('?');
  return {whole.substr(0, question), question == std::string::npos ? "" : whole.substr(question + 1)};
}

std::string text(boost::string_view v) { return {v.data(), v.size()}; }

template <class Body>
void addSafety(http::response<Body>& response, const std::string& host) {
  response.set(http::field::cache_control, "no-store");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("X-Frame-Options", "DENY");
  response.set("Referrer-Policy", "no-referrer");
  response.set("Cross-Origin-Opener-Policy", "same-origin");
  response.set("Cross-Origin-Resource-Policy", "same-origin");
  response.set("Content-Security-Policy",
               fmt::format("default-src 'none'; script-src 'self'; style-src 'self'; style-src-attr 'unsafe-inline'; "
                           "img-src 'self' blob: data:; font-src 'self'; "
                           "manifest-src 'self'; connect-src 'self' ws://{}; worker-src 'self' blob:; base-uri 'none'; "
                           "form-action 'none'; frame-ancestors 'none'",
                           host));
}

http::response<http::string_body> textResponse(const Request& request, http::status status, const std::string& body,
                                               const std::string& host) {
  http::response<http::string_body> response(status, request.version());
  response.set(http::field::content_type, "text/plain; charset=utf-8");
  addSafety(response, host);
  response.body() = body + "\n";
  response.keep_alive(request.keep_alive() && status == http::status::ok);
  response.prepare_payload();
  return response;
}

// A WebSocket and what waits to be sent over it. Lives as long as one of its two loops.
struct Peer {
  explicit Peer(tcp::socket socket) : stream(std::move(socket)), wake(stream.get_executor()) {}
  websocket::stream<beast::tcp_stream> stream;
  asio::steady_timer wake;  // cancelled when there is something to send
  struct Outgoing {
    std::string bytes;
    bool binary;
  };
  std::deque<Outgoing> waiting;
  size_t waitingBytes = 0;
  std::optional<websocket::close_reason> closing;
};

}  // namespace

struct Server::State {
  State(const Options& o, StaticFiles p, Handlers h)
      : options(o), page(std::move(p)), handlers(std::move(h)), acceptor(context) {}

  const Options options;
  const StaticFiles page;
  const Handlers handlers;
  Stranger::List strangers;  // outlive the context: who is served when that ends leaves them then
  size_t files = 0;          // under way
  asio::io_context context{1};
  tcp::acceptor acceptor;
  bool loopbackOnly = true;
  Connection nextPeer = 1;
  std::map<Connection, std::shared_ptr<Peer>> peers;

  asio::awaitable<void> acceptAll();
  asio::awaitable<void> serve(tcp::socket socket);
  asio::awaitable<bool> answer(beast::tcp_stream& stream, Stranger& stranger, const Request& request);
  asio::awaitable<bool> sendFile(beast::tcp_stream& stream, const Request& request, const Target& target,
                                 const std::string& host);
  http::response<http::string_body> answerOf(const Request& request, const Target& target,
                                             const std::string& host) const;
  http::response<http::string_body> liveAnswer(const Request& request, const std::string& host) const;
  asio::awaitable<void> talk(tcp::socket socket, Request request);
  asio::awaitable<void> readAll(Connection number, std::shared_ptr<Peer> peer);
  asio::awaitable<void> writeAll(std::shared_ptr<Peer> peer);
  asio::awaitable<void> endOnce(const std::atomic<bool>& stop);
  void enqueue(Connection to, std::string message, bool binary);
  std::string refusal(const Request& request, const Target& target) const;
};

asio::awaitable<void> Server::State::acceptAll() {
  while (acceptor.is_open()) {
    error_code code;
    tcp::socket socket = co_await acceptor.async_accept(into(code));
    if (code == asio::error::operation_aborted) co_return;
    if (code) {  // too many open files: wait for some to close
      if (code == asio::error::no_descriptors && !strangers.empty()) strangers.front()->close();
      asio::steady_timer pause(context, std::chrono::milliseconds(100));
      co_await pause.async_wait(into(code));
      continue;
    }
    asio::co_spawn(context, serve(std::move(socket)), asio::detached);
  }
}

// "": let in. WebSockets need an origin; other requests may come without.
std::string Server::State::refusal(const Request& request, const Target& target) const {
  const std::string host = text(request[http::field::host]);
  const bool live = target.path == "/live";
  if (!isOwnHost(host, acceptor.local_endpoint().port(), loopbackOnly)) return "wrong host";
  const bool hasOrigin = request.find(http::field::origin) != request.end();
  if ((websocket::is_upgrade(request) || hasOrigin) && !isOwnOrigin(text(request[http::field::origin]), host))
    return "wrong origin";
  const bool secret = live || target.path.starts_with("/files/");
  if (secret && !sameSecret(queryValue(target.query, "token"), options.token))
    return "wrong token; use the link that roomlight view printed";
  return {};
}

// Whoever comes is served, so that who has the token can show it; who has shown it is safe from those who come later.
asio::awaitable<void> Server::State::serve(tcp::socket socket) {
  beast::tcp_stream stream(std::move(socket));
  Stranger stranger(strangers, stream);
  while (strangers.size() > options.mostStrangers) strangers.front()->close();
  beast::flat_buffer buffer;
  error_code code;
  for (bool more = true; more;) {
    http::request_parser<http::empty_body> parser;
    parser.header_limit(kMostHeaderBytes);
    stream.expires_after(options.strangersTime);
    co_await http::async_read_header(stream, buffer, parser, into(code));
    if (code) break;
    stranger.speaks();
    const Target target = targetOf(parser.get());
    if (websocket::is_upgrade(parser.get()) && target.path == "/live" && refusal(parser.get(), target).empty() &&
        peers.size() < options.mostWindows) {
      stranger.leave();
      stream.expires_never();
      co_await talk(stream.release_socket(), parser.release());
      co_return;
    }
    if (!parser.is_done()) break;  // a body: nothing here takes one
    more = co_await answer(stream, stranger, parser.get());
  }
  stream.socket().shutdown(tcp::socket::shutdown_send, code);
}

// Whether the connection goes on.
asio::awaitable<bool> Server::State::answer(beast::tcp_stream& stream, Stranger& stranger, const Request& request) {
  const Target target = targetOf(request);
  const std::string host = text(request[http::field::host]);
  http::response<http::string_body> response;
  if (const std::string refused = refusal(request, target); !refused.empty()) {
    response = textResponse(request, http::status::forbidden, refused,
                            fmt::format("127.0.0.1:{}", acceptor.local_endpoint().port()));
  } else if (target.path.starts_with("/files/") && request.method() == http::verb::get) {
    stranger.leave();
    co_return co_await sendFile(stream, request, target, host);
  } else {
    response = answerOf(request, target, host);
  }
  if (request.method() == http::verb::head) response.body().clear();
  error_code code;
  co_await http::async_write(stream, response, into(code));
  co_return !code && response.keep_alive();
}

http::response<http::string_body> Server::State::answerOf(const Request& request, const Target& target,
                                                          const std::string& host) const {
  if (request.method() != http::verb::get && request.method() != http::verb::head)
    return textResponse(request, http::status::method_not_allowed, "only GET", host);
  if (target.path == "/live") return liveAnswer(request, host);
  const auto file = page.find(target.path);
  if (file == page.end()) return textResponse(request, http::status::not_found, "no such page", host);
  http::response<http::string_body> response(http::status::ok, request.version());
  response.set(http::field::content_type, file->second.type);
  addSafety(response, host);
  response.keep_alive(request.keep_alive());
  response.body() = file->second.bytes;
  response.prepare_payload();
  return response;
}

// Why there is no window for who has the token. The page asks here without a WebSocket: browsers do not tell it why
// that was refused.
http::response<http::string_body> Server::State::liveAnswer(const Request& request, const std::string& host) const {
  if (peers.size() < options.mostWindows)
    return textResponse(request, http::status::upgrade_required, "this is for WebSockets", host);
  return textResponse(request, http::status::service_unavailable,
                      fmt::format("as many windows are open as there may be ({}); close one, or start roomlight view "
                                  "with more (--windows)",
                                  options.mostWindows),
                      host);
}

asio::awaitable<bool> Server::State::sendFile(beast::tcp_stream& stream, const Request& request, const Target& target,
                                              const std::string& host) {
  const std::string id = target.path.substr(std::string_view("/files/").size());
  const bool full = files >= options.mostFiles;
  const std::optional<HeldFile> file = handlers.findFile && !full ? handlers.findFile(id) : std::nullopt;
  error_code code;
  if (!file) {
    auto response =
        full ? textResponse(request, http::status::service_unavailable, "too many files are being fetched", host)
             : textResponse(request, http::status::not_found, "no such file, or it was fetched already", host);
    co_await http::async_write(stream, response, into(code));
    co_return false;
  }
  const Place place(files);
  http::response<http::file_body> response(http::status::ok, request.version());
  response.body().open(file->path.c_str(), beast::file_mode::scan, code);
  if (!code) {
    response.set(http::field::content_type, "application/octet-stream");
    response.set(http::field::content_disposition, fmt::format("attachment; filename=\"{}\"", file->name));
    addSafety(response, host);
    response.keep_alive(false);
    response.prepare_payload();
    stream.expires_after(kFileTime);
    co_await http::async_write(stream, response, into(code));
    if (!code) handlers.fileSent(id);  // else who asked may come again
  }
  co_return false;
}

asio::awaitable<void> Server::State::talk(tcp::socket socket, Request request) {
  const auto peer = std::make_shared<Peer>(std::move(socket));
  auto& stream = peer->stream;
  stream.set_option(websocket::stream_base::timeout{kHandshakeTime, kSilence, true});
  stream.read_message_max(options.mostMessageBytes);
  stream.auto_fragment(false);
  const Connection number = nextPeer++;
  peers[number] = peer;
  error_code code;
  co_await stream.async_accept(request, into(code));
  if (code) {
    peers.erase(number);
    co_return;
  }
  beast::get_lowest_layer(stream).socket().set_option(tcp::no_delay(true), code);
  try {
    handlers.opened(number, std::string(queryValue(targetOf(request).query, "window")));
    asio::co_spawn(context, writeAll(peer), asio::detached);
    co_await readAll(number, peer);
  } catch (const std::exception&) {  // of a handler: this window is lost, the others go on
    peer->closing = websocket::close_reason(websocket::close_code::internal_error, "roomlight has failed");
  }
  peers.erase(number);
  peer->wake.cancel();
  handlers.closed(number);
}

asio::awaitable<void> Server::State::readAll(Connection number, std::shared_ptr<Peer> peer) {
  RateLimit rate(options.messagesPerSecond, options.messagesAtOnce, std::chrono::steady_clock::now());
  beast::flat_buffer buffer;
  error_code code;
  while (true) {
    co_await peer->stream.async_read(buffer, into(code));
    if (code) co_return;
    const bool fast = !rate.allow(std::chrono::steady_clock::now());
    if (fast || !peer->stream.got_text()) {
      // The writer closes, once what it is sending is sent.
      peer->closing = fast ? websocket::close_reason(websocket::close_code::policy_error, "too many messages")
                           : websocket::close_reason(websocket::close_code::unknown_data, "text messages only");
      peer->wake.cancel();
      while (!code) {  // until the other side has closed too
        buffer.consume(buffer.size());
        co_await peer->stream.async_read(buffer, into(code));
      }
      co_return;
    }
    handlers.said(number, beast::buffers_to_string(buffer.data()));
    buffer.consume(buffer.size());
  }
}

asio::awaitable<void> Server::State::writeAll(std::shared_ptr<Peer> peer) {
  error_code code;
  while (peer->stream.is_open()) {
    if (peer->closing) {
      co_await peer->stream.async_close(*peer->closing, into(code));
      co_return;
    }
    if (peer->waiting.empty()) {
      peer->wake.expires_at(asio::steady_timer::time_point::max());
      co_await peer->wake.async_wait(into(code));
      continue;
    }
    const Peer::Outgoing next = std::move(peer->waiting.front());
    peer->waiting.pop_front();
    peer->waitingBytes -= next.bytes.size();
    peer->stream.binary(next.binary);
    co_await peer->stream.async_write(asio::buffer(next.bytes), into(code));
    if (code) co_return;
  }
}

// Waits for `stop`, then until all have closed; those that do not answer are not waited for.
asio::awaitable<void> Server::State::endOnce(const std::atomic<bool>& stop) {
  asio::steady_timer pause(context);
  error_code code;
  while (!stop) {
    pause.expires_after(kLookAgain);
    co_await pause.async_wait(into(code));
  }
  acceptor.close(code);
  for (auto& [number, peer] : peers) {
    peer->closing = websocket::close_reason(websocket::close_code::going_away, "roomlight has ended");
    peer->wake.cancel();
  }
  for (int i = 0; i < kLastLooks && !peers.empty(); ++i) {
    pause.expires_after(kLastLook);
    co_await pause.async_wait(into(code));
  }
  context.stop();
}

void Server::State::enqueue(Connection to, std::string message, bool binary) {
  const auto peer = peers.find(to);
  if (peer == peers.end()) return;
  Peer& p = *peer->second;
  if (p.waiting.size() >= kMostWaiting || p.waitingBytes > kMostWaitingBytes) {
    beast::get_lowest_layer(p.stream).close();
    return;
  }
  p.waitingBytes += message.size();
  p.waiting.push_back({std::move(message), binary});
  p.wake.cancel();
}

Server::Server(std::unique_ptr<State> state) : state_(std::move(state)) {}
Server::~Server() = default;

Result<std::unique_ptr<Server>> Server::listen(const Options& options, StaticFiles page, Handlers handlers) {
  auto state = std::make_unique<State>(options, std::move(page), std::move(handlers));
  error_code code;
  const auto address = asio::ip::make_address(options.address, code);
  if (code) return Error{fmt::format("{}: is no numeric address; write one such as 127.0.0.1", options.address)};
  state->loopbackOnly = address.is_loopback();
  const tcp::endpoint endpoint(address, options.port);
  state->acceptor.open(endpoint.protocol(), code);
  if (!code) state->acceptor.set_option(asio::socket_base::reuse_address(true), code);
  if (!code && address.is_v6() && address.is_unspecified())  // all there are, also IPv4's
    state->acceptor.set_option(asio::ip::v6_only(false), code);
  if (!code) state->acceptor.bind(endpoint, code);
  if (!code) state->acceptor.listen(asio::socket_base::max_listen_connections, code);
  if (code) return Error{fmt::format("{} port {}: {}", options.address, options.port, code.message())};
  return std::unique_ptr<Server>(new Server(std::move(state)));
}

uint16_t Server::port() const { return state_->acceptor.local_endpoint().port(); }

void Server::run(const std::atomic<bool>& stop) {
  asio::co_spawn(state_->context, state_->acceptAll(), asio::detached);
  asio::co_spawn(state_->context, state_->endOnce(stop), asio::detached);
  state_->context.run();
}

void Server::send(Connection to, std::string message, bool binary) {
  asio::post(state_->context, [this, to, message = std::move(message), binary]() mutable {
    state_->enqueue(to, std::move(message), binary);
  });
}

}  // namespace roomlight::server
