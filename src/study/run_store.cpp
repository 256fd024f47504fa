#include "study/run_store.h"

#include <fmt/format.h>

#include <cctype>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/write_file.h"

namespace roomlight {

std::string fileNameOf(const std::string& name) {
  std::string out;
  for (const char c : name) {
    const auto u = static_cast<unsigned char>(c);
    if (std::isalnum(u) && u < 0x80)
      out += static_cast<char>(std::tolower(u));
    else if (c == '-' || out.empty() || out.back() != '_')
      out += c == '-' ? '-' : '_';
  }
  return out;
}

namespace {

constexpr uint64_t kFnvStart = 0xcbf29ce484222325ull;

uint64_t fnv(uint64_t hash, std::string_view bytes) {
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  return hash;
}

}  // namespace

std::string textHash(const std::string& text) { return fmt::format("{:016x}", fnv(kFnvStart, text)); }

std::string contentHash(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return "-";
  uint64_t hash = kFnvStart;
  char block[1 << 16];
  while (in.read(block, sizeof block), in.gcount() > 0) hash = fnv(hash, {block, static_cast<size_t>(in.gcount())});
  return fmt::format("{:016x}", hash);
}

Result<RunStore> RunStore::open(const std::filesystem::path& folder) {
  Result<HeldFolder> held = holdFolder(folder);
  if (!held) return Error{held.error()};
  if (!held.value()) return Error{fmt::format("{}: is in use by another study", folder.string())};
  return RunStore(folder, std::move(held.value()));
}

std::filesystem::path RunStore::file(const Key& key, const std::string& extension) const {
  std::string readable, all;
  for (const std::string& name : key.names) readable += (readable.empty() ? "" : " ") + name, all += name + '\0';
  return folder_ / (fileNameOf(readable) + "-" + textHash(all + key.circumstances).substr(0, 10) + extension);
}

std::optional<nlohmann::json> RunStore::find(const Key& key) const {
  std::ifstream in(file(key, ".json"));
  if (!in) return std::nullopt;
  const nlohmann::json read = nlohmann::json::parse(in, nullptr, false);
  if (!read.is_object() || !read.contains("circumstances") || read["circumstances"] != key.circumstances ||
      !read.contains("result") || !read["result"].is_object())
    return std::nullopt;
  return read["result"];
}

Status RunStore::keep(const Key& key, const nlohmann::json& result) const {
  return writeWhole(file(key, ".json"), nlohmann::json{{"circumstances", key.circumstances}, {"result", result}}.dump(
                                            1, ' ', false, nlohmann::json::error_handler_t::replace) +
                                            "\n");
}

void RunStore::forget(const Key& key) const {
  std::error_code ignored;
  std::filesystem::remove(file(key, ".json"), ignored);
}

}  // namespace roomlight
