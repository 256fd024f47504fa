#include "server.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

namespace roomlight::server {
namespace {

constexpr uintmax_t kMostBytes = 64 << 20;

const char* typeOf(const std::filesystem::path& file) {
  static const std::map<std::string, const char*> types = {{".html", "text/html; charset=utf-8"},
                                                           {".js", "text/javascript; charset=utf-8"},
                                                           {".css", "text/css; charset=utf-8"},
                                                           {".svg", "image/svg+xml"},
                                                           {".png", "image/png"},
                                                           {".jpg", "image/jpeg"},
                                                           {".webp", "image/webp"},
                                                           {".ico", "image/x-icon"},
                                                           {".woff2", "font/woff2"},
                                                           {".json", "application/json"},
                                                           {".webmanifest", "application/manifest+json"}};
  const auto type = types.find(file.extension().string());
  return type == types.end() ? nullptr : type->second;
}

}  // namespace

Result<StaticFiles> readStaticFiles(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  StaticFiles files;
  uintmax_t bytes = 0;
  std::error_code code;
  for (fs::recursive_directory_iterator i(folder, code), end; !code && i != end; i.increment(code)) {
    const char* type = typeOf(i->path());
    if (!type || i->is_symlink() || !i->is_regular_file()) continue;
    std::ifstream in(i->path(), std::ios::binary);
    StaticFile file{{std::istreambuf_iterator<char>(in), {}}, type};
    if (!in.good() && !in.eof()) return Error{fmt::format("{}: cannot be read", i->path().string())};
    if ((bytes += file.bytes.size()) > kMostBytes)
      return Error{
          fmt::format("{}: holds more than {} MiB; is this the page's folder?", folder.string(), kMostBytes >> 20)};
    files[fmt::format("/{}", i->path().lexically_relative(folder).generic_string())] = std::move(file);
  }
  const auto index = files.find("/index.html");
  if (index == files.end())
    return Error{fmt::format(
        "{}: has no index.html; build the page with scripts/build, or name its folder with --viewer", folder.string())};
  files["/"] = index->second;
  return files;
}

}  // namespace roomlight::server
