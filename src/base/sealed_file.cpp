#include "base/sealed_file.h"

#include <fmt/format.h>

#include <fstream>

#include "base/hash.h"
#include "base/write_file.h"

namespace roomlight {
namespace {

constexpr size_t kSealSize = 16;  // of hashOf() all that is before it, at the end of a file

}  // namespace

std::optional<std::string> contentOf(const std::filesystem::path& file) {
  std::error_code code;
  std::ifstream in(file, std::ios::binary);
  if (!in || !std::filesystem::is_regular_file(file, code)) return std::nullopt;
  // At once: light of a home takes hundreds of megabytes. What grows or shrinks meanwhile is told by its seal.
  const uintmax_t size = std::filesystem::file_size(file, code);
  std::string bytes(code ? 0 : size, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<size_t>(in.gcount()));
  return bytes;
}

void seal(std::string& bytes) { bytes += hashOf(bytes); }

Status saveSealed(const std::filesystem::path& file, std::string bytes) {
  seal(bytes);
  return writeWhole(file, bytes);
}

Result<std::optional<std::string>> loadSealed(const std::filesystem::path& file) {
  std::optional<std::string> bytes = contentOf(file);
  if (!bytes) return bytes;
  const size_t size = bytes->size() < kSealSize ? 0 : bytes->size() - kSealSize;
  if (hashOf(std::string_view(*bytes).substr(0, size)) != std::string_view(*bytes).substr(size))
    return Error{fmt::format("{}: is damaged or of another version; what it held is found anew", file.string())};
  bytes->resize(size);
  return bytes;
}

}  // namespace roomlight
