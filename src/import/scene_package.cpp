#include "import/scene_package.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <fstream>

#include "base/platform/files.h"
#include "import/failure.h"
#include "import/file_access.h"
#include "import/guarded.h"
#include "import/scene_kind.h"
#include "import/sh3d_archive.h"

namespace roomlight::importers {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMostFiles = 20'000, kMostNamed = 5;
constexpr int kDeepest = 5;
constexpr uintmax_t kClearlyLarger = 4;
constexpr ArchiveLimits kLimits{.entries = kMostFiles, .totalBytes = size_t{2} << 30};

struct Candidate {
  const PackedFile* file = nullptr;
  SceneKind kind = SceneKind::Gltf;
  size_t depth = 0;
  std::string stem;
};

std::string stemOf(const fs::path& name) {
  std::string out = name.stem().string();
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

std::vector<Candidate> candidatesIn(const std::vector<PackedFile>& files) {
  std::vector<Candidate> out;
  for (const PackedFile& f : files) {
    const auto kind = kindByExtension(f.name);
    if (!kind || *kind == SceneKind::Zip) continue;
    out.push_back({&f, *kind, static_cast<size_t>(std::count(f.name.begin(), f.name.end(), '/')), stemOf(f.name)});
  }
  std::sort(out.begin(), out.end(), [](const Candidate& a, const Candidate& b) {
    return std::tuple(a.kind, a.depth, b.file->bytes, a.file->name) <
           std::tuple(b.kind, b.depth, a.file->bytes, b.file->name);
  });
  return out;
}

std::string without(const std::vector<PackedFile>& files) {
  for (const PackedFile& f : files) {
    if (const std::string advice = adviceFor(f.name); !advice.empty())
      return fmt::format("holds no scene that can be read; '{}' {}", printable(f.name), advice);
  }
  return "holds no scene; use one with " + supportedFiles();
}

// One line whose paths are those that the user knows.
std::string renamed(std::string error, const std::string& from, const std::string& to) {
  for (size_t at = error.find(from); at != std::string::npos; at = error.find(from, at + to.size()))
    error.replace(at, from.size(), to);
  return error;
}

Result<Imported> importPicked(const fs::path& root, const std::vector<PackedFile>& files, ImportOptions options) {
  const std::string name = pickScene(files);
  options.companionRoot = root;
  Result<Imported> imported = importFile(root / name, options);
  if (imported && candidatesIn(files).size() > 1) {
    imported.value().warnings.insert(imported.value().warnings.begin(),
                                     fmt::format("'{}' is shown; other scenes beside it are not", printable(name)));
  }
  return imported;
}

// A folder of our own that goes away with all in it.
class UnpackFolder {
 public:
  UnpackFolder() {
    path_ = makeTemporaryFolder("roomlight");
    if (path_.empty()) fail("", "cannot be unpacked: there is no folder for temporary files");
  }
  ~UnpackFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  UnpackFolder(const UnpackFolder&) = delete;
  UnpackFolder& operator=(const UnpackFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// Scenes and what they name; not programs, films and papers beside them.
bool isOfScenes(const std::string& name) {
  constexpr std::array kCompanions = {".mtl", ".bin",  ".png", ".jpg", ".jpeg", ".webp", ".bmp",
                                      ".tga", ".ktx2", ".ies", ".ldt", ".hdr",  ".exr",  ".json"};
  const auto kind = kindByExtension(name);
  if (kind) return *kind != SceneKind::Zip;
  std::string extension = fs::path(name).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(kCompanions.begin(), kCompanions.end(), extension) != kCompanions.end();
}

// Names are those that the archive found to stay inside it.
void unpack(const Archive& archive, const std::string& name, const fs::path& root) {
  const std::optional<Bytes> bytes = archive.read(name);
  if (!bytes) return;
  const fs::path file = root / name;
  std::error_code code;
  fs::create_directories(file.parent_path(), code);
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes->data()), static_cast<std::streamsize>(bytes->size()));
  if (!out.flush())
    fail(fmt::format("entry '{}'", printable(name)), "cannot be unpacked into the folder for temporary files");
}

}  // namespace

std::string pickScene(const std::vector<PackedFile>& files) {
  const std::vector<Candidate> all = candidatesIn(files);
  if (all.empty()) fail("", without(files));
  // Of the best kind, nearest to the top: one of each name.
  std::vector<const Candidate*> best;
  for (const Candidate& c : all) {
    if (c.kind != all[0].kind || c.depth != all[0].depth) break;
    if (std::none_of(best.begin(), best.end(), [&](const Candidate* b) { return b->stem == c.stem; }))
      best.push_back(&c);
  }
  if (best.size() == 1 || best[0]->file->bytes / kClearlyLarger >= best[1]->file->bytes) return best[0]->file->name;
  std::string names;
  for (size_t i = 0; i < best.size() && i < kMostNamed; ++i)
    names += fmt::format("{}'{}'", i ? ", " : "", printable(best[i]->file->name));
  fail("", fmt::format("holds {} scenes, name the one to open: {}{}", best.size(), names,
                       best.size() > kMostNamed ? ", ..." : ""));
}

Result<Imported> importFolder(const fs::path& folder, const ImportOptions& options) {
  try {
    const auto names = filesBelow(folder, kMostFiles, kDeepest);
    if (!names)
      fail("", fmt::format("is a folder of more than {} files; name the scene's own folder or its file", kMostFiles));
    std::vector<PackedFile> files;
    for (const std::string& name : *names) {
      std::error_code code;
      const uintmax_t bytes = fs::file_size(folder / name, code);
      files.push_back({name, code ? 0 : bytes});
    }
    return importPicked(folder, files, options);
  } catch (const std::exception& e) {
    return Error{fmt::format("{}: {}", folder.string(), printable(e.what(), 600))};
  }
}

Result<Imported> importZip(const fs::path& file, const ImportOptions& options) {
  try {
    const Bytes bytes = readWholeFile(file, "");
    const Archive archive(bytes, "", kLimits);
    std::vector<std::string> names;
    std::copy_if(archive.names().begin(), archive.names().end(), std::back_inserter(names), isOfScenes);
    std::vector<PackedFile> files;
    for (const std::string& name : archive.names()) files.push_back({name, archive.sizeOf(name)});
    pickScene(files);  // before anything is unpacked
    const UnpackFolder folder;
    for (const std::string& name : names) unpack(archive, name, folder.path());
    Result<Imported> imported = importPicked(folder.path(), files, options);
    if (!imported) return Error{renamed(imported.error(), folder.path().string() + "/", file.string() + ": ")};
    return imported;
  } catch (const std::exception& e) {
    return Error{fmt::format("{}: {}", file.string(), printable(e.what(), 600))};
  }
}

}  // namespace roomlight::importers
