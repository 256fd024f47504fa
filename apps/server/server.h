// HTTP and WebSockets for the page of `roomlight view` (docs/reference/view-protocol.md): who may connect, what is
// served, how fast anybody may talk. Knows nothing of homes.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "base/result.h"

namespace roomlight::server {

// The page's files, read once into memory: what is not among them is not served.
struct StaticFile {
  std::string bytes;
  std::string type;  // media type
};

// By path from the root, "/index.html"; "/" is the same page.
using StaticFiles = std::map<std::string, StaticFile>;

// All regular files below the folder of kinds that a page has; links are not followed. Errors: there is no index.html,
// or more than 64 MiB.
Result<StaticFiles> readStaticFiles(const std::filesystem::path& folder);

using Connection = uint64_t;

struct Options {
  std::string address = "127.0.0.1";
  uint16_t port = 0;  // 0: any that is free
  std::string token;  // asked of WebSockets and of finished files
  size_t mostWindows = 8;
  size_t mostFiles = 32;  // that are fetched at once
  // Connections that have not shown the token, as those that fetch the page; beyond it the one that was silent for
  // longest is closed. And for how long each may be silent.
  size_t mostStrangers = 32;
  std::chrono::milliseconds strangersTime{5000};
  size_t mostMessageBytes = 64 << 10;
  double messagesPerSecond = 240, messagesAtOnce = 480;
};

// A finished file, which stays until it was sent.
struct HeldFile {
  std::filesystem::path path;
  std::string name;  // under which the browser saves it
};

// Called from the thread that runs the server.
struct Handlers {
  std::function<void(Connection, const std::string& window)> opened;
  std::function<void(Connection, const std::string& text)> said;
  std::function<void(Connection)> closed;
  std::function<std::optional<HeldFile>(const std::string& id)> findFile;
  std::function<void(const std::string& id)> fileSent;  // the whole of it: it may go
};

class Server {
 public:
  // Listens from now on. Errors: the address is none, or the port is taken.
  static Result<std::unique_ptr<Server>> listen(const Options& options, StaticFiles page, Handlers handlers);
  ~Server();

  uint16_t port() const;
  // Until `stop` becomes true; all connections are closed then.
  void run(const std::atomic<bool>& stop);
  // From any thread.
  void send(Connection to, std::string message, bool binary);

 private:
  struct State;
  explicit Server(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace roomlight::server
