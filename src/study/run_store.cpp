#include "study/run_store.h"

#include <fmt/format.h>

#include <cctype>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/hash.h"
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

std::string textHash(const std::string& text) {
  Hash hash;
  hash.bytes(text);
  return hash.text();
}

std::string contentHash(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return "-";
  Hash hash;
  char block[1 << 16];
  while (in.read(block, sizeof block), in.gcount() > 0) hash.bytes({block, static_cast<size_t>(in.gcount())});
  return hash.text();
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
