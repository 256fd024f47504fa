#include "import/file_access.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <memory>

#include "base/utf8.h"
#include "import/failure.h"

namespace roomlight::importers {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMostFiles = 20'000;
constexpr int kDeepest = 6;
constexpr std::array kPictures = {"png", "jpg", "jpeg", "webp", "tga", "bmp"};

std::string lower(std::string_view text) {
  std::string out = asUtf8(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return c < 0x80 ? static_cast<char>(std::tolower(c)) : static_cast<char>(c); });
  return out;
}

// "C:\tex\..\Oak%20.PNG" to {"c:", "oak .png"}.
std::vector<std::string> parts(std::string_view path) {
  std::string text = lower(path);
  std::replace(text.begin(), text.end(), '\\', '/');
  if (text.starts_with("file://")) text.erase(0, 7);
  std::vector<std::string> out;
  for (size_t at = 0; at <= text.size();) {
    const size_t end = std::min(text.find('/', at), text.size());
    std::string part = text.substr(at, end - at);
    if (part == ".." && !out.empty() && out.back() != "..") {
      out.pop_back();
    } else if (!part.empty() && part != ".") {
      out.push_back(std::move(part));
    }
    at = end + 1;
  }
  return out;
}

std::string stem(const std::string& name) { return name.substr(0, name.rfind('.')); }

bool isPicture(const std::string& name) {
  const size_t dot = name.rfind('.');
  return dot != std::string::npos &&
         std::find(kPictures.begin(), kPictures.end(), name.substr(dot + 1)) != kPictures.end();
}

size_t sharedFromEnd(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  size_t n = 1;  // the last parts agree
  while (n < a.size() && n < b.size() && a[a.size() - 1 - n] == b[b.size() - 1 - n]) ++n;
  return n;
}

// The best of the names whose last part `agrees`.
template <class Agrees>
const std::string* best(const std::vector<std::string>& names, const std::vector<std::string>& wanted,
                        Agrees&& agrees) {
  const std::string* found = nullptr;
  size_t foundShared = 0, foundDepth = 0;
  for (const std::string& name : names) {
    const std::vector<std::string> own = parts(name);
    if (own.empty() || !agrees(own.back())) continue;
    const size_t shared = sharedFromEnd(own, wanted);
    const bool better =
        !found || shared > foundShared ||
        (shared == foundShared && (own.size() < foundDepth || (own.size() == foundDepth && name < *found)));
    if (better) found = &name, foundShared = shared, foundDepth = own.size();
  }
  return found;
}

class Around {
 public:
  Around(fs::path root, std::string folder) : root_(std::move(root)), folder_(std::move(folder)) {}

  std::optional<Bytes> read(std::string_view reference, const std::string& place) {
    if (reference.empty() || reference.size() > 2048 || reference.find('\0') != std::string_view::npos) return {};
    if (auto bytes = readInside(folder_ + slashed(reference), place)) return bytes;
    if (!files_) files_ = filesBelow(root_, kMostFiles, kDeepest).value_or(std::vector<std::string>());
    for (const std::string& spelling : {std::string(reference), percentDecode(reference)}) {
      if (const auto name = meantName(*files_, folder_, spelling)) return readInside(*name, place);
    }
    return {};
  }

 private:
  static std::string slashed(std::string_view text) {
    std::string out(text);
    std::replace(out.begin(), out.end(), '\\', '/');
    return out;
  }

  // None where the name leads out of the root, also through links, or to nothing.
  std::optional<Bytes> readInside(const std::string& name, const std::string& place) const {
    fs::path file;
    try {
      file = pathInside(root_, name, place);
    } catch (const Failure&) {
      return {};
    }
    std::error_code code;
    if (!fs::is_regular_file(file, code)) return {};
    return readWholeFile(file, place);
  }

  fs::path root_;
  std::string folder_;
  std::optional<std::vector<std::string>> files_;
};

}  // namespace

std::optional<std::string> meantName(const std::vector<std::string>& names, std::string_view folder,
                                     std::string_view reference) {
  const std::vector<std::string> wanted = parts(reference), place = parts(std::string(folder) + std::string(reference));
  if (wanted.empty()) return {};
  for (const std::string& name : names) {
    if (parts(name) == place) return name;
  }
  const std::string& last = wanted.back();
  const std::string* found = best(names, wanted, [&](const std::string& own) { return own == last; });
  if (!found && last.find('.') != std::string::npos && last.find('.') > 0) {
    found = best(names, wanted, [&](const std::string& own) { return isPicture(own) && stem(own) == stem(last); });
  }
  return found ? std::optional(*found) : std::nullopt;
}

std::optional<std::vector<std::string>> filesBelow(const fs::path& folder, size_t most, int deepest) {
  std::vector<std::string> out;
  std::error_code code;
  fs::recursive_directory_iterator it(folder.empty() ? fs::path(".") : folder,
                                      fs::directory_options::skip_permission_denied, code),
      end;
  for (size_t seen = 0; !code && it != end; it.increment(code)) {
    if (++seen > most) return {};
    const std::string name = it->path().filename().string();
    std::error_code ignored;
    const bool isFolder = it->is_directory(ignored);
    if (isFolder && (name.starts_with('.') || name == "__MACOSX" || it.depth() >= deepest))
      it.disable_recursion_pending();
    if (!isFolder && !name.starts_with('.') && it->is_regular_file(ignored))
      out.push_back(it->path().lexically_relative(folder.empty() ? fs::path(".") : folder).generic_string());
  }
  std::sort(out.begin(), out.end());
  return out;
}

ReadCompanion companionsAround(const fs::path& sceneFile, const fs::path& root) {
  const fs::path folder = sceneFile.parent_path();
  std::string inside;
  if (!root.empty() && folder != root) inside = folder.lexically_relative(root).generic_string() + "/";
  const auto around = std::make_shared<Around>(root.empty() ? folder : root, inside);
  return [around](std::string_view reference, const std::string& place) { return around->read(reference, place); };
}

}  // namespace roomlight::importers
