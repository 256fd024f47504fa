#include "client.h"

#include <fmt/format.h>

#include <bit>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <stdexcept>

namespace roomlight::testing {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;

tcp::endpoint at(uint16_t port) { return {asio::ip::address_v4::loopback(), port}; }
std::string hostOf(uint16_t port) { return fmt::format("127.0.0.1:{}", port); }

uint32_t number(const std::string& bytes, size_t at, int count) {
  uint32_t v = 0;
  for (int k = 0; k < count; ++k)
    v |= static_cast<uint32_t>(static_cast<unsigned char>(bytes[at + static_cast<size_t>(k)])) << (8 * k);
  return v;
}

ReceivedFrame frameOf(const std::string& b) {
  if (b.size() < 64 || number(b, 0, 1) != 1 || number(b, 2, 2) != 64) throw std::runtime_error("no frame");
  ReceivedFrame f;
  f.number = number(b, 4, 4);
  f.width = static_cast<int>(number(b, 8, 2)), f.height = static_cast<int>(number(b, 10, 2));
  f.side = static_cast<int>(number(b, 12, 1)), f.flags = static_cast<int>(number(b, 13, 1));
  f.camera = number(b, 16, 4), f.revision = number(b, 20, 4), f.samples = number(b, 24, 4);
  f.ev100 = std::bit_cast<float>(number(b, 32, 4)), f.scaleLow = std::bit_cast<float>(number(b, 36, 4)),
  f.scaleHigh = std::bit_cast<float>(number(b, 40, 4)), f.latencyMs = std::bit_cast<float>(number(b, 44, 4));
  f.jpeg = b.substr(64);
  return f;
}

}  // namespace

std::string Reply::header(const std::string& name) const {
  for (const auto& [n, value] : headers) {
    if (beast::iequals(n, name)) return value;
  }
  return {};
}

struct Line::State {
  uint16_t port = 0;
  asio::io_context context;
  tcp::socket socket{context};
  beast::flat_buffer buffer;
};

Line::Line(uint16_t port) : state_(std::make_unique<State>()) {
  state_->port = port;
  state_->socket.connect(at(port));
}
Line::Line(Line&&) noexcept = default;
Line::~Line() = default;

Reply Line::get(const std::string& target, const Headers& headers) {
  http::request<http::empty_body> request(http::verb::get, target, 11);
  request.set(http::field::host, hostOf(state_->port));
  for (const auto& [name, value] : headers) request.set(name, value);
  http::write(state_->socket, request);
  http::response_parser<http::string_body> parser;
  parser.body_limit(256 << 20);
  http::read(state_->socket, state_->buffer, parser);
  Reply reply;
  reply.status = static_cast<int>(parser.get().result_int());
  reply.body = parser.get().body();
  for (const auto& field : parser.get())
    reply.headers.emplace_back(std::string(field.name_string()), std::string(field.value()));
  return reply;
}

bool Line::isClosed(double seconds) {
  char byte = 0;
  bool closed = false;
  state_->socket.async_read_some(asio::buffer(&byte, 1), [&](beast::error_code code, size_t) {
    closed = code && code != asio::error::operation_aborted;
  });
  state_->context.restart();
  state_->context.run_for(
      std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::duration<double>(seconds)));
  if (closed) return true;
  state_->socket.close();
  state_->context.run();
  return false;
}

Reply get(uint16_t port, const std::string& target, const Headers& headers) { return Line(port).get(target, headers); }

struct Client::State {
  asio::io_context context;
  websocket::stream<beast::tcp_stream> stream{context};
  beast::flat_buffer buffer;
  std::string message;
  bool binary = false, closed = false;
};

Client::Client(uint16_t port, const std::string& target, const Headers& headers) : state_(std::make_unique<State>()) {
  beast::get_lowest_layer(state_->stream).connect(at(port));
  state_->stream.set_option(websocket::stream_base::decorator([&](websocket::request_type& request) {
    request.set(http::field::origin, "http://" + hostOf(port));
    for (const auto& [name, value] : headers) request.set(name, value);
  }));
  state_->stream.read_message_max(64 << 20);
  state_->stream.handshake(hostOf(port), target);
}

Client::~Client() { drop(); }

void Client::drop() {
  beast::error_code ignored;
  beast::get_lowest_layer(state_->stream).socket().close(ignored);
}

void Client::sayText(const std::string& text, bool binary) {
  state_->stream.binary(binary);
  beast::error_code code;
  state_->stream.write(asio::buffer(text), code);
}

// One message; false when the connection is closed.
bool Client::read(double seconds) {
  if (state_->closed) return false;
  beast::error_code code;
  bool done = false;
  state_->stream.async_read(state_->buffer, [&](beast::error_code c, size_t) { code = c, done = true; });
  state_->context.restart();
  state_->context.run_for(
      std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::duration<double>(seconds)));
  if (!done) {
    drop();
    state_->context.run();
    throw std::runtime_error("nothing came in time");
  }
  state_->closed = static_cast<bool>(code);
  if (code) return false;
  state_->binary = state_->stream.got_binary();
  state_->message = beast::buffers_to_string(state_->buffer.data());
  state_->buffer.consume(state_->buffer.size());
  if (state_->binary && acknowledges) say({{"type", "ack"}, {"frame", number(state_->message, 4, 4)}});
  return true;
}

nlohmann::json Client::hear(const std::string& type, std::optional<uint32_t> id, double seconds) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (true) {
    const double left = std::chrono::duration<double>(until - std::chrono::steady_clock::now()).count();
    if (left <= 0) throw std::runtime_error("no '" + type + "' came in time");
    if (!read(left)) throw std::runtime_error("closed before '" + type + "' came");
    if (state_->binary) continue;
    const auto json = nlohmann::json::parse(state_->message);
    if (json["type"] == type && (!id || json["id"] == *id)) return json;
  }
}

ReceivedFrame Client::see(const std::function<bool(const ReceivedFrame&)>& wanted, double seconds) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (true) {
    const double left = std::chrono::duration<double>(until - std::chrono::steady_clock::now()).count();
    if (left <= 0) throw std::runtime_error("no such frame came in time");
    if (!read(left)) throw std::runtime_error("closed before the frame came");
    if (!state_->binary) continue;
    const ReceivedFrame frame = frameOf(state_->message);
    if (wanted(frame)) return frame;
  }
}

int Client::closeCode(double seconds) {
  while (read(seconds)) {}
  return state_->stream.reason().code;
}

}  // namespace roomlight::testing
