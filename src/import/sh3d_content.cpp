#include "import/sh3d_content.h"

#include <openssl/evp.h>

#include <algorithm>
#include <cctype>
#include <memory>

#include "import/failure.h"

namespace roomlight::importers {

Sha1Digest sha1(std::span<const std::span<const uint8_t>> pieces) {
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(), &EVP_MD_CTX_free);
  bool done = context && EVP_DigestInit_ex(context.get(), EVP_sha1(), nullptr) == 1;
  for (const auto piece : pieces) done = done && EVP_DigestUpdate(context.get(), piece.data(), piece.size()) == 1;
  Sha1Digest digest;
  if (!done || EVP_DigestFinal_ex(context.get(), digest.data(), nullptr) != 1)
    fail("", "libcrypto cannot compute SHA-1");
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
  std::vector<std::span<const uint8_t>> pieces;
  try {
    for (const std::string& name : names) {
      if (const Bytes* bytes = read(name)) pieces.emplace_back(*bytes);
    }
  } catch (const Failure&) {
    return false;  // a companion that nobody needed cannot be unpacked
  }
  return sha1(pieces) == digest;
}

}  // namespace roomlight::importers::sh3d
