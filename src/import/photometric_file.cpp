#include "import/photometric_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "import/failure.h"
#include "import/file_access.h"
#include "photometry/web_files.h"

namespace roomlight::importers {
namespace {

constexpr uintmax_t kMostBytes = uintmax_t{16} << 20;
constexpr float kSmallestOpeningM = 0.01f;

std::string lowerExtension(const std::filesystem::path& file) {
  std::string e = file.extension().string();
  std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return e;
}

// Throws Failure.
std::string textOf(const std::filesystem::path& file) {
  std::error_code code;
  if (std::filesystem::is_regular_file(file, code) && std::filesystem::file_size(file, code) > kMostBytes)
    fail("", "the file is larger than 16 MiB");
  const Bytes bytes = readWholeFile(file, "");
  return {bytes.begin(), bytes.end()};
}

}  // namespace

bool isPhotometric(const std::filesystem::path& file) {
  const std::string e = lowerExtension(file);
  return e == ".ies" || e == ".ldt";
}

Result<PhotometricFiles::Web> PhotometricFiles::read(const std::filesystem::path& file) {
  if (const auto known = known_.find(file); known != known_.end()) return known->second;
  if (!isPhotometric(file)) return Error{"unknown kind of photometric file; use .ies or .ldt"};
  try {
    const std::string text = textOf(file);
    const TiltFile tilt = [&](const std::string& name) -> Result<std::string> {
      try {
        return textOf(pathInside(file.parent_path(), name, ""));
      } catch (const Failure& f) {
        return Error{f.what()};
      }
    };
    Result<WebFile> parsed = lowerExtension(file) == ".ies" ? parseIes(text, tilt) : parseEulumdat(text);
    if (!parsed) return Error{parsed.error()};
    for (const std::string& w : parsed.value().warnings)
      warnings_.push_back(fmt::format("{}: {}", file.filename().string(), printable(w, 300)));
    return known_[file] = std::make_shared<const PhotometricWeb>(std::move(parsed.value().web));
  } catch (const Failure& f) {
    return Error{f.what()};
  }
}

Vec3 perpendicular(Vec3 wish, Vec3 direction) {
  const Vec3 v = wish - direction * dot(wish, direction);
  return length(v) < 1e-3f * length(wish) ? Vec3(0) : normalize(v);
}

void setWeb(Lamp& lamp, const PhotometricFiles::Web& web, LampSize size, Vec3 colour, double fluxLm, double factor) {
  lamp.kind = LampKind::Point;
  lamp.web = web;
  lamp.wattsW = static_cast<float>(web->watts);
  const bool large = web->hasOpening() && std::max(web->sizeC0M, web->sizeC90M) >= kSmallestOpeningM;
  lamp.extended = size == LampSize::Area || (size == LampSize::AsStated && large);
  const float tilt = std::acos(std::clamp(-lamp.direction.y, -1.0f, 1.0f));
  const double part = (fluxLm >= 0 ? fluxLm / web->fluxLm : 1) * factor * static_cast<double>(tiltFactor(*web, tilt));
  lamp.intensityCd = colour * static_cast<float>(static_cast<double>(web->peakCd) * part);
}

}  // namespace roomlight::importers
