// Who is let in: tokens, names of hosts, origins, and how fast anybody may talk. No network in it.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace roomlight::server {

// 128 bits of the system's random numbers as 32 hexadecimal digits.
std::string randomToken();

// In a time that does not depend on where they differ.
bool sameSecret(std::string_view a, std::string_view b);

// Whether a request's Host is this server's: a numeric address or localhost with its port, so that no name of another
// site leads here (DNS rebinding). `loopbackOnly`: only those of this machine.
bool isOwnHost(std::string_view host, uint16_t port, bool loopbackOnly);
// Whether a page of that origin came from the host that is asked.
bool isOwnOrigin(std::string_view origin, std::string_view host);

// "token=ab&window=cd" -> the value of a key; empty: none. Values are not percent-decoded: ours need none.
std::string_view queryValue(std::string_view query, std::string_view key);

// Lets so many a second through on average, and so many at once.
class RateLimit {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;
  RateLimit(double perSecond, double atOnce, TimePoint now)
      : perSecond_(perSecond), atOnce_(atOnce), left_(atOnce), last_(now) {}
  bool allow(TimePoint now);

 private:
  double perSecond_, atOnce_, left_;
  TimePoint last_;
};

}  // namespace roomlight::server
