#include "study/run_store.h"

#include <fmt/format.h>

#include <cctype>
#include <fstream>
#include <nlohmann/json.hpp>

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

std::string contentHash(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return "-";
  uint64_t hash = 0xcbf29ce484222325ull;
  char block[1 << 16];
  while (in.read(block, sizeof block), in.gcount() > 0) {
    for (std::streamsize i = 0; i < in.gcount(); ++i) hash = (hash ^ static_cast<unsigned char>(block[i])) * 0x100000001b3ull;
  }
  return fmt::format("{:016x}", hash);
}

Result<RunStore> RunStore::open(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return Error{fmt::format("{}: cannot be made: {}", folder.string(), error.message())};
  return RunStore(folder);
}

std::filesystem::path RunStore::file(const std::string& name, const std::string& extension) const { return folder_ / (fileNameOf(name) + extension); }

std::optional<nlohmann::json> RunStore::find(const std::string& name, const std::string& circumstances) const {
  std::ifstream in(file(name, ".json"));
  if (!in) return std::nullopt;
  const nlohmann::json read = nlohmann::json::parse(in, nullptr, false);
  if (!read.is_object() || read.value("circumstances", "") != circumstances || !read.contains("result")) return std::nullopt;
  return read["result"];
}

Status RunStore::keep(const std::string& name, const std::string& circumstances, const nlohmann::json& result) const {
  const std::filesystem::path to = file(name, ".json"), half = file(name, ".json.part");
  std::ofstream(half) << nlohmann::json{{"circumstances", circumstances}, {"result", result}}.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
  std::error_code error;
  std::filesystem::rename(half, to, error);
  if (error) return Error{fmt::format("{}: cannot be written: {}", to.string(), error.message())};
  return Ok{};
}

}  // namespace roomlight
