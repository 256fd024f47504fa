#include "import/file_access.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>

#include "import/failure.h"

namespace roomlight::importers {
namespace {

constexpr uintmax_t kMaxFileBytes = uintmax_t{4} << 30;

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  const int lower = std::tolower(static_cast<unsigned char>(c));
  return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

// Of both alphabets, that of files and that of addresses.
int base64Digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' || c == '-' ? 62 : c == '/' || c == '_' ? 63 : -1;
}

Bytes base64Decode(std::string_view given, const std::string& place) {
  std::string text(given);
  std::erase_if(text, [](unsigned char c) { return std::isspace(c) != 0; });
  size_t padding = 0;
  while (padding < 2 && !text.empty() && text.back() == '=') text.pop_back(), ++padding;
  if (text.size() % 4 == 1 || (padding > 0 && (text.size() + padding) % 4 != 0))
    fail(place, "the base64 data are cut short");
  Bytes out;
  out.reserve(text.size() / 4 * 3 + 3);
  uint32_t bits = 0;
  int held = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    const int digit = base64Digit(text[i]);
    if (digit < 0) fail(place, fmt::format("character {} of the base64 data is not base64", i));
    bits = (bits << 6) | static_cast<uint32_t>(digit);
    held += 6;
    if (held >= 8) {
      held -= 8;
      out.push_back(static_cast<uint8_t>(bits >> held));
    }
  }
  return out;
}

std::string lowerCase(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

// Letters before a colon. One letter is a drive, which must not be followed either.
bool hasScheme(std::string_view uri) {
  const size_t colon = uri.find(':');
  if (colon == std::string_view::npos || colon == 0) return false;
  for (const char c : uri.substr(0, colon)) {
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '+' && c != '-' && c != '.') return false;
  }
  return true;
}

}  // namespace

Bytes readWholeFile(const std::filesystem::path& file, const std::string& place) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(file, code)) fail(place, "there is no such file");
  const uintmax_t size = std::filesystem::file_size(file, code);
  if (code) fail(place, "the file cannot be read");
  if (size > kMaxFileBytes) fail(place, "the file is larger than 4 GiB");
  Bytes bytes(static_cast<size_t>(size));
  std::ifstream in(file, std::ios::binary);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!in && size > 0) fail(place, "the file cannot be read");
  return bytes;
}

std::string percentDecode(std::string_view uri) {
  std::string out;
  for (size_t i = 0; i < uri.size(); ++i) {
    const int high = uri[i] == '%' && i + 2 < uri.size() ? hexDigit(uri[i + 1]) : -1;
    const int low = high >= 0 ? hexDigit(uri[i + 2]) : -1;
    if (low < 0) {
      out += uri[i];
      continue;
    }
    out += static_cast<char>(high * 16 + low);
    i += 2;
  }
  return out;
}

std::filesystem::path pathInside(const std::filesystem::path& folder, std::string_view reference,
                                 const std::string& place) {
  const auto refuse = [&](const char* why) {
    fail(place, fmt::format("'{}' {}; only files beside the scene are read", printable(reference), why));
  };
  if (reference.empty()) refuse("names no file");
  if (reference.find('\0') != std::string_view::npos) refuse("holds a NUL character");
  if (hasScheme(reference)) refuse("is an address elsewhere");
  if (reference.front() == '/' || reference.front() == '\\') refuse("is an absolute path");
  const std::filesystem::path relative(reference);
  for (const auto& part : relative) {
    if (part.string().size() > 255) refuse("is too long");
    if (part == "..") refuse("leaves the scene's folder");
  }
  if (reference.size() > 2048) refuse("is too long");
  if (reference.find("..\\") != std::string_view::npos) refuse("leaves the scene's folder");

  // Symbolic links are followed first, then the real place is compared.
  std::error_code code;
  const auto home = std::filesystem::weakly_canonical(folder.empty() ? std::filesystem::path(".") : folder, code);
  if (code) refuse("cannot be resolved");
  const auto target = std::filesystem::weakly_canonical(home / relative, code);
  if (code) refuse("cannot be resolved");
  const auto fromHome = target.lexically_relative(home);
  if (fromHome.empty() || *fromHome.begin() == "..") refuse("leaves the scene's folder through a link");
  return target;
}

std::optional<std::filesystem::path> findInside(const std::filesystem::path& folder, std::string_view reference,
                                                const std::string& place) {
  std::string relative(reference);
  std::replace(relative.begin(), relative.end(), '\\', '/');
  std::filesystem::path file = pathInside(folder, relative, place);
  std::error_code code;
  if (std::filesystem::is_regular_file(file, code)) return file;
  // Part by part, the first name in the alphabet that differs by case alone.
  std::filesystem::path found;
  for (const auto& part : std::filesystem::path(relative)) {
    if (part.empty() || part == ".") continue;
    const std::string wanted = lowerCase(part.string());
    std::string best;
    for (std::filesystem::directory_iterator entry((folder.empty() ? "." : folder) / found, code), end;
         !code && entry != end; entry.increment(code)) {
      const std::string name = entry->path().filename().string();
      if (lowerCase(name) == wanted && (best.empty() || name < best)) best = name;
    }
    if (best.empty()) return std::nullopt;
    found /= best;
  }
  file = pathInside(folder, found.string(), place);
  if (!std::filesystem::is_regular_file(file, code)) return std::nullopt;
  return file;
}

ReadCompanion companionsIn(const std::filesystem::path& folder) {
  return [folder](std::string_view reference, const std::string& place) -> std::optional<Bytes> {
    const auto file = findInside(folder, reference, place);
    if (!file) return std::nullopt;
    return readWholeFile(*file, place);
  };
}

std::optional<Bytes> dataUri(std::string_view uri, const std::string& place) {
  if (!uri.starts_with("data:")) return std::nullopt;
  const size_t comma = uri.find(',');
  if (comma == std::string_view::npos) fail(place, "the data URI holds no data");
  if (!uri.substr(0, comma).ends_with(";base64")) fail(place, "the data URI is not base64");
  return base64Decode(uri.substr(comma + 1), place);
}

std::optional<std::filesystem::path> fileOfUri(const std::filesystem::path& folder, std::string_view uri,
                                               const std::string& place) {
  const std::string decoded = percentDecode(uri);
  if (auto file = findInside(folder, decoded, place)) return file;
  return decoded == uri ? std::nullopt : findInside(folder, uri, place);
}

Bytes readUri(const std::filesystem::path& folder, std::string_view uri, const std::string& place) {
  if (auto embedded = dataUri(uri, place)) return std::move(*embedded);
  const std::string named = fmt::format("{} '{}'", place, printable(uri));
  const auto file = fileOfUri(folder, uri, place);
  if (!file) fail(named, "there is no such file");
  return readWholeFile(*file, named);
}

}  // namespace roomlight::importers
