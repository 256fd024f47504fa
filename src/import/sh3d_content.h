// Contents of a home, which are models with their companions, and pictures: what is unpacked of them, and whether it is
// what was saved.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "import/sh3d_archive.h"
#include "import/warnings.h"

namespace roomlight::importers {

// SHA-1 of the pieces one after another: what Sweet Home 3D writes of each content to notice damage. It guards against
// accidents, not against malice. Throws Failure.
using Sha1Digest = std::array<uint8_t, 20>;
Sha1Digest sha1(std::span<const std::span<const uint8_t>> pieces);

}  // namespace roomlight::importers

namespace roomlight::importers::sh3d {

// What the entry ContentDigests says of contents, by the name of their entry. Its text, as Sweet Home 3D writes it: a
// line "ContentDigests-Version: 1.0", then for each content "Name: <entry>" and "SHA-1-Digest: <base64>", with empty
// lines between.
class ContentDigests {
 public:
  ContentDigests() = default;
  // None where there is no such entry. A damaged one is a warning: nothing is checked then.
  ContentDigests(const Archive& archive, Warnings& warnings);
  std::optional<Sha1Digest> of(const std::string& entry) const;

 private:
  std::map<std::string, Sha1Digest> digests_;
};

// Entries that are read for one content; each is unpacked once. Not for several threads at a time.
class Content {
 public:
  explicit Content(const Archive& archive) : archive_(archive) {}

  // The entry's bytes, kept as long as this is; null where there is none. Throws Failure.
  const Bytes* read(const std::string& entry);

  // Whether `entry` and all else in its top folder, without licence texts, in the order of their names, have that
  // digest.
  bool has(const Sha1Digest& digest, const std::string& entry);

 private:
  const Archive& archive_;
  std::map<std::string, std::optional<Bytes>> read_;
};

}  // namespace roomlight::importers::sh3d
