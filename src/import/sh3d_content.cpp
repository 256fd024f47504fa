#include "import/sh3d_content.h"

#include <algorithm>
#include <bit>
#include <cctype>

#include "import/failure.h"

namespace roomlight::importers {

// FIPS 180-4, 6.1.2: the schedule of 80 words is kept as a ring of 16.
void Sha1::block(const uint8_t* bytes) {
  std::array<uint32_t, 16> w;
  for (size_t i = 0; i < 16; ++i) {
    w[i] = static_cast<uint32_t>(bytes[4 * i]) << 24 | static_cast<uint32_t>(bytes[4 * i + 1]) << 16 |
           static_cast<uint32_t>(bytes[4 * i + 2]) << 8 | bytes[4 * i + 3];
  }
  auto [a, b, c, d, e] = state_;
  const auto rounds = [&](size_t from, uint32_t constant, auto&& mix) {
    for (size_t t = from; t < from + 20; ++t) {
      uint32_t& word = w[t % 16];
      if (t >= 16) word = std::rotl(w[(t + 13) % 16] ^ w[(t + 8) % 16] ^ w[(t + 2) % 16] ^ word, 1);
      const uint32_t next = std::rotl(a, 5) + mix(b, c, d) + e + constant + word;
      e = d, d = c, c = std::rotl(b, 30), b = a, a = next;
    }
  };
  rounds(0, 0x5a827999, [](uint32_t x, uint32_t y, uint32_t z) { return (x & y) | (~x & z); });
  rounds(20, 0x6ed9eba1, [](uint32_t x, uint32_t y, uint32_t z) { return x ^ y ^ z; });
  rounds(40, 0x8f1bbcdc, [](uint32_t x, uint32_t y, uint32_t z) { return (x & y) | (x & z) | (y & z); });
  rounds(60, 0xca62c1d6, [](uint32_t x, uint32_t y, uint32_t z) { return x ^ y ^ z; });
  state_[0] += a, state_[1] += b, state_[2] += c, state_[3] += d, state_[4] += e;
}

void Sha1::add(std::span<const uint8_t> bytes) {
  allBytes_ += bytes.size();
  if (waitingBytes_ > 0) {
    const size_t taken = std::min(bytes.size(), waiting_.size() - waitingBytes_);
    std::copy_n(bytes.begin(), taken, waiting_.begin() + static_cast<ptrdiff_t>(waitingBytes_));
    waitingBytes_ += taken, bytes = bytes.subspan(taken);
    if (waitingBytes_ < waiting_.size()) return;
    block(waiting_.data()), waitingBytes_ = 0;
  }
  for (; bytes.size() >= waiting_.size(); bytes = bytes.subspan(waiting_.size())) block(bytes.data());
  std::copy(bytes.begin(), bytes.end(), waiting_.begin());
  waitingBytes_ = bytes.size();
}

Sha1Digest Sha1::finish() {
  const uint64_t bits = allBytes_ * 8;
  const uint8_t one = 0x80, zero = 0;
  add({&one, 1});
  while (waitingBytes_ != 56) add({&zero, 1});
  std::array<uint8_t, 8> length;
  for (size_t i = 0; i < 8; ++i) length[i] = static_cast<uint8_t>(bits >> (56 - 8 * i));
  add(length);
  Sha1Digest digest;
  for (size_t i = 0; i < digest.size(); ++i) digest[i] = static_cast<uint8_t>(state_[i / 4] >> (24 - 8 * (i % 4)));
  return digest;
}

}  // namespace roomlight::importers

namespace roomlight::importers::sh3d {
namespace {

constexpr std::string_view kName = "Name: ", kDigest = "SHA-1-Digest: ";

bool isLicence(std::string_view entry) {
  const size_t slash = entry.rfind('/');
  std::string name(slash == std::string_view::npos ? entry : entry.substr(slash + 1));
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return name == "LICENSE.TXT";
}

}  // namespace

ContentDigests::ContentDigests(const Archive& archive, Warnings& warnings) {
  try {
    const auto bytes = archive.read("ContentDigests");
    if (!bytes) return;
    std::string_view rest(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    std::string name;
    while (!rest.empty()) {
      const size_t end = std::min(rest.find_first_of("\r\n"), rest.size());
      const std::string_view line = rest.substr(0, end);
      rest.remove_prefix(std::min(end + 1, rest.size()));
      if (line.starts_with(kName)) name = line.substr(kName.size());
      if (!line.starts_with(kDigest)) continue;
      const auto decoded = dataUri("data:;base64," + std::string(line.substr(kDigest.size())), "ContentDigests");
      Sha1Digest digest;
      if (!decoded || decoded->size() != digest.size()) fail("", "a digest is not as long as those of SHA-1");
      std::copy(decoded->begin(), decoded->end(), digest.begin());
      const auto entry = normalisedEntryName(name);
      if (entry) digests_.emplace(*entry, digest);
    }
  } catch (const Failure&) {
    digests_.clear();
    warnings.add("the list of digests (ContentDigests) is damaged: models and pictures are taken as they are");
  }
}

std::optional<Sha1Digest> ContentDigests::of(const std::string& entry) const {
  const auto it = digests_.find(entry);
  return it == digests_.end() ? std::nullopt : std::optional<Sha1Digest>(it->second);
}

const Bytes* Content::read(const std::string& entry) {
  const auto [it, isNew] = read_.try_emplace(entry);
  if (isNew) it->second = archive_.read(entry);
  return it->second ? &*it->second : nullptr;
}

bool Content::has(const Sha1Digest& digest, const std::string& entry) {
  const size_t slash = entry.find('/');
  std::vector<std::string> names;
  if (slash == std::string::npos) {
    names.push_back(entry);
  } else {
    for (const std::string& name : archive_.namesIn(entry.substr(0, slash + 1))) {
      if (!isLicence(name)) names.push_back(name);
    }
  }
  Sha1 sha1;
  try {
    for (const std::string& name : names) {
      if (const Bytes* bytes = read(name)) sha1.add(*bytes);
    }
  } catch (const Failure&) {
    return false;  // a companion that nobody needed cannot be unpacked
  }
  return sha1.finish() == digest;
}

}  // namespace roomlight::importers::sh3d
