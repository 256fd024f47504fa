// A browser as tests need one: plain requests, and a WebSocket that is read message by message.
#pragma once

#include <nlohmann/json.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace roomlight::testing {

struct Reply {
  int status = 0;
  std::string body;
  std::vector<std::pair<std::string, std::string>> headers;
  std::string header(const std::string& name) const;
};

using Headers = std::vector<std::pair<std::string, std::string>>;

// A connection on which nothing is said unless it is asked to.
class Line {
 public:
  explicit Line(uint16_t port);
  Line(Line&&) noexcept;
  ~Line();
  // A GET of the very target, whatever it holds. Host and Origin are those of `headers`, else this machine's, and none.
  // Throws where it is closed.
  Reply get(const std::string& target, const Headers& headers = {});
  // Waits until the server closes it; false: it did not.
  bool isClosed(double seconds = 20);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// The same on a line of its own.
Reply get(uint16_t port, const std::string& target, const Headers& headers = {});

struct ReceivedFrame {
  uint32_t number = 0, camera = 0, revision = 0, samples = 0;
  int width = 0, height = 0, side = 0, flags = 0;
  float ev100 = 0, scaleLow = 0, scaleHigh = 0, latencyMs = 0;
  std::string jpeg;
};

class Client {
 public:
  // Throws where the server does not let it in.
  Client(uint16_t port, const std::string& target, const Headers& headers = {});
  ~Client();

  void say(const nlohmann::json& message) { sayText(message.dump()); }
  void sayText(const std::string& text, bool binary = false);
  // The next text message of the type, with `id` where given; everything before it is taken and frames are
  // acknowledged. Throws after `seconds`, or when the connection is closed.
  nlohmann::json hear(const std::string& type, std::optional<uint32_t> id = {}, double seconds = 20);
  // The next frame that is as `wanted` says; acknowledged.
  ReceivedFrame see(const std::function<bool(const ReceivedFrame&)>& wanted, double seconds = 20);
  // Reads on until the server closes; the code it gives.
  int closeCode(double seconds = 20);
  void drop();  // the line breaks
  bool acknowledges = true;

 private:
  struct State;
  bool read(double seconds);
  std::unique_ptr<State> state_;
};

}  // namespace roomlight::testing
