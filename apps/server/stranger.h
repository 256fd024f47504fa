// Who has not shown the token, and others that there is only so much room for.
#pragma once

#include <boost/beast/core/tcp_stream.hpp>
#include <cstddef>
#include <list>
#include <utility>

namespace roomlight::server {

// A connection that has not shown the token. They are in a list, those that were silent for longest first.
class Stranger {
 public:
  using List = std::list<Stranger*>;
  Stranger(List& all, boost::beast::tcp_stream& stream)
      : all_(all), stream_(stream), at_(all.insert(all.end(), this)) {}
  ~Stranger() { leave(); }
  Stranger(const Stranger&) = delete;
  Stranger& operator=(const Stranger&) = delete;

  void speaks() {
    if (at_ != all_.end()) all_.splice(all_.end(), all_, at_);
  }
  // It is none any longer.
  void leave() {
    if (at_ != all_.end()) all_.erase(std::exchange(at_, all_.end()));
  }
  void close() {
    leave();
    stream_.close();
  }

 private:
  List& all_;
  boost::beast::tcp_stream& stream_;
  List::iterator at_;
};

// One of a few places, for as long as it lives.
class Place {
 public:
  explicit Place(size_t& taken) : taken_(taken) { ++taken_; }
  ~Place() { --taken_; }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;

 private:
  size_t& taken_;
};

}  // namespace roomlight::server
