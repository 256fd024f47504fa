// A small home behind a server, for as long as a test lasts.
#pragma once

#include <future>
#include <stdexcept>
#include <thread>

#include "client.h"
#include "server/view_server.h"
#include "support/served_scene.h"

namespace roomlight::testing {

class ServedHome {
 public:
  static constexpr const char* kToken = "0123456789abcdef0123456789abcdef";

  explicit ServedHome(view::ViewHome home = view::ViewHome("test", servedScene()), server::Options options = {}) {
    options.token = kToken;
    server::StaticFiles page = {{"/", {"<!doctype html>page", "text/html"}},
                                {"/index.html", {"<!doctype html>page", "text/html"}}};
    std::promise<server::Links> listening;
    server::Served tell;
    tell.listening = [&](const server::Links& links) {
      listening.set_value(links);
      return Status(Ok{});
    };
    thread_ = std::thread([this, home = std::move(home), options, page = std::move(page), tell, &listening]() mutable {
      const Status s = server::serveHome(std::move(home), servedSettings(), options, std::move(page), tell, stop_);
      if (!s) listening.set_exception(std::make_exception_ptr(std::runtime_error(s.error())));
    });
    try {
      links_ = listening.get_future().get();
    } catch (const std::exception&) {
      thread_.join();
      throw;
    }
  }
  ~ServedHome() {
    stop_ = true;
    thread_.join();
  }
  const server::Links& links() const { return links_; }
  uint16_t port() const { return static_cast<uint16_t>(std::stoi(links_.here.substr(links_.here.rfind(':') + 1))); }
  std::string live(const std::string& window = "") const {
    return std::string("/live?token=") + kToken + (window.empty() ? "" : "&window=" + window);
  }

 private:
  server::Links links_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace roomlight::testing
