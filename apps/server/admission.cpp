#include "admission.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/platform/machine.h"

namespace roomlight::server {

std::string randomToken() {
  std::array<unsigned char, 16> bytes;
  fillWithRandomBytes(bytes);
  std::string text;
  for (const unsigned char b : bytes) text += fmt::format("{:02x}", b);
  return text;
}

bool sameSecret(std::string_view a, std::string_view b) {
  unsigned differs = a.size() == b.size() ? 0 : 1;
  for (size_t i = 0; i < b.size(); ++i)
    differs |= static_cast<unsigned char>(i < a.size() ? a[i] : 0) ^ static_cast<unsigned char>(b[i]);
  return differs == 0;
}

bool isOwnHost(std::string_view host, uint16_t port, bool loopbackOnly) {
  const std::string tail = fmt::format(":{}", port);
  if (!host.ends_with(tail)) return false;
  host.remove_suffix(tail.size());
  if (host == "localhost" || host == "127.0.0.1" || host == "[::1]") return true;
  if (loopbackOnly || host.empty()) return false;
  const auto only = [](std::string_view text, std::string_view allowed) {
    return !text.empty() && text.find_first_not_of(allowed) == std::string_view::npos;
  };
  if (host.front() == '[')
    return host.back() == ']' && only(host.substr(1, host.size() - 2), "0123456789abcdefABCDEF:.");
  return only(host, "0123456789.");
}

bool isOwnOrigin(std::string_view origin, std::string_view host) {
  return origin.starts_with("http://") && origin.substr(7) == host;
}

std::string_view queryValue(std::string_view query, std::string_view key) {
  while (!query.empty()) {
    const size_t end = std::min(query.find('&'), query.size());
    const std::string_view pair = query.substr(0, end);
    const size_t equals = pair.find('=');
    if (equals != std::string_view::npos && pair.substr(0, equals) == key) return pair.substr(equals + 1);
    query.remove_prefix(std::min(end + 1, query.size()));
  }
  return {};
}

bool RateLimit::allow(TimePoint now) {
  left_ = std::min(atOnce_, left_ + perSecond_ * std::chrono::duration<double>(now - last_).count());
  last_ = now;
  if (left_ < 1) return false;
  left_ -= 1;
  return true;
}

}  // namespace roomlight::server
