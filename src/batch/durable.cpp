#include "batch/durable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <iterator>

#include "base/platform/files.h"
#include "base/platform/machine.h"
#include "base/platform/process.h"
#include "base/write_file.h"

namespace roomlight::batch {
namespace {

namespace fs = std::filesystem;

Status synced(const fs::path& path, bool isFolder) {
  const int reason = isFolder ? syncFolder(path) : syncFile(path);
  return reason == 0 ? Status(Ok{}) : cannotWrite(path, reason);
}

}  // namespace

std::string processToken() {
  static const std::string host = [] {
    std::string name = hostName();
    if (name.empty()) return std::string("host");
    name.resize(std::min(name.find('.'), name.size()));
    for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '-';
    return name;
  }();
  static const auto start = std::chrono::steady_clock::now().time_since_epoch().count() & 0xffffffff;
  return fmt::format("{}-{}-{:x}", host, processNumber(), start);  // a child by fork() has one of its own
}

Status writeDurably(const fs::path& file, std::string_view bytes) {
  const fs::path part = file.string() + "." + processToken() + ".part";
  const int reason = writeSynced(part, bytes);
  Status status = reason == 0 ? Status(Ok{}) : cannotWrite(part, reason);
  std::error_code code;
  if (status) {
    fs::rename(part, file, code);
    if (code) status = cannotWrite(file, code.value());
  }
  if (status) return synced(file.parent_path(), true);
  fs::remove(part, code);
  return status;
}

Status syncTree(const fs::path& folder) {
  std::error_code code;
  for (fs::recursive_directory_iterator it(folder, code), end; !code && it != end; it.increment(code)) {
    if (it->is_symlink()) continue;
    if (const Status s = synced(it->path(), it->is_directory()); !s) return s;
  }
  return code ? Status(cannotWrite(folder, code.value())) : synced(folder, true);
}

Status publishFolder(const fs::path& from, const fs::path& to) {
  bool taken = false;
  if (const int reason = renameFolder(from, to, taken); reason != 0) {
    if (!taken) return cannotWrite(to, reason);
    std::error_code code;
    fs::remove_all(from, code);
  }
  return synced(to.parent_path(), true);
}

std::string textOf(const fs::path& file) {
  std::error_code code;
  if (!fs::is_regular_file(file, code)) return {};
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

bool tellsOfFullDisk(std::string_view line) {
  const auto tells = [&](int error) { return line.find(std::strerror(error)) != std::string_view::npos; };
#ifdef EDQUOT
  if (tells(EDQUOT)) return true;
#endif
  return tells(ENOSPC);
}

}  // namespace roomlight::batch
