// A session as one browser has it, without a network.
#pragma once

#include <condition_variable>
#include <cstring>
#include <deque>
#include <functional>
#include <mutex>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>

#include "support/served_scene.h"
#include "view/session.h"

namespace roomlight::testing {

// What a frame's header says (view/frame.h).
struct WindowFrame {
  uint32_t revision = 0, camera = 0, samples = 0;
  int flags = 0;
};

// A session with one window, without a network: frames are acknowledged as they come.
class OneWindow {
 public:
  explicit OneWindow(view::ViewHome home, const view::StartThread& start = view::systemThread)
      : session_(std::move(home), servedSettings(), outbox(), start) {}

  void open() { session_.open(1, ""); }
  void say(const nlohmann::json& message) { session_.receive(1, message.dump()); }
  // The next message of the type; earlier ones are taken.
  nlohmann::json hear(const std::string& type) {
    return next<nlohmann::json>(texts_, [&](const nlohmann::json& t) { return t["type"] == type; });
  }
  WindowFrame see(const std::function<bool(const WindowFrame&)>& wanted) { return next<WindowFrame>(frames_, wanted); }
  int failures() {
    const std::lock_guard lock(mutex_);
    return failures_;
  }

 private:
  view::Outbox outbox() {
    view::Outbox out;
    out.text = [this](view::Connection, const std::string& text) { add(texts_, nlohmann::json::parse(text)); };
    out.frame = [this](view::Connection, const std::string& bytes) {
      const auto at = [&](size_t from) {
        uint32_t value = 0;
        std::memcpy(&value, bytes.data() + from, sizeof value);
        return value;
      };
      say({{"type", "ack"}, {"frame", at(4)}});
      add(frames_, WindowFrame{at(20), at(16), at(24), static_cast<unsigned char>(bytes[13])});
    };
    out.failed = [this](const std::string&) {
      const std::lock_guard lock(mutex_);
      ++failures_;
    };
    return out;
  }
  template <class T>
  void add(std::deque<T>& all, T one) {
    const std::lock_guard lock(mutex_);
    all.push_back(std::move(one));
    came_.notify_all();
  }
  template <class T>
  T next(std::deque<T>& all, const std::function<bool(const T&)>& wanted) {
    std::unique_lock lock(mutex_);
    while (true) {
      if (!came_.wait_for(lock, std::chrono::seconds(30), [&] { return !all.empty(); }))
        throw std::runtime_error("nothing came in time");
      const T one = std::move(all.front());
      all.pop_front();
      if (wanted(one)) return one;
    }
  }

  std::mutex mutex_;
  std::condition_variable came_;
  std::deque<nlohmann::json> texts_;
  std::deque<WindowFrame> frames_;
  int failures_ = 0;
  view::Session session_;
};

}  // namespace roomlight::testing
