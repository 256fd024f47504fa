// Sheets of small pictures, and films.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "base/tone_curves.h"
#include "batch/durable.h"
#include "batch/merge.h"
#include "look/display.h"

namespace roomlight::batch {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 240, kHeight = 160, kGap = 6, kColumns = 5, kRows = 12;  // pixels; of a sheet
constexpr size_t kOnSheet = size_t{kColumns} * kRows;

// No larger than a place of a sheet, by means over what falls on each pixel.
Image shrunk(const Image& image) {
  const float scale = std::min({1.0f, static_cast<float>(kWidth) / static_cast<float>(image.width),
                                static_cast<float>(kHeight) / static_cast<float>(image.height)});
  const int width = std::max(1, static_cast<int>(static_cast<float>(image.width) * scale)),
            height = std::max(1, static_cast<int>(static_cast<float>(image.height) * scale));
  Image out(width, height);
  for (int y = 0; y < height; ++y) {
    const int top = y * image.height / height, bottom = std::max(top + 1, (y + 1) * image.height / height);
    for (int x = 0; x < width; ++x) {
      const int left = x * image.width / width, right = std::max(left + 1, (x + 1) * image.width / width);
      Vec3 sum;
      for (int j = top; j < bottom; ++j) {
        for (int i = left; i < right; ++i) sum = sum + image.at(i, j);
      }
      out.at(x, y) = sum * (1 / static_cast<float>((bottom - top) * (right - left)));
    }
  }
  return out;
}

// Fit for a display.
Result<Image> smallPicture(const fs::path& file) {
  const Result<Image> image = readImage(file);
  if (!image) return image;
  Image small = shrunk(image.value());
  const Result<bool> isShown = isForDisplay(file);
  if (!isShown) return Error{isShown.error()};
  if (isShown.value()) {
    for (Vec3& p : small.pixels) p = {srgbEncode(p.x), srgbEncode(p.y), srgbEncode(p.z)};
    return small;
  }
  Display look = usualDisplay();
  look.localExposure = 0;
  return displayed(small, look, White(), ev100Of(look, small));
}

}  // namespace

Status SheetMaker::add(const fs::path& picture) {
  Result<Image> small = smallPicture(picture);
  if (!small) return Error{small.error()};
  small_.push_back(std::move(small.value()));
  return small_.size() == kOnSheet ? finish() : Status(Ok{});
}

Status SheetMaker::finish() {
  if (small_.empty()) return Ok{};
  const int count = static_cast<int>(small_.size()), columns = std::min(count, kColumns);
  const int rows = (count + columns - 1) / columns;
  Image sheet(columns * (kWidth + kGap) + kGap, rows * (kHeight + kGap) + kGap);
  std::fill(sheet.pixels.begin(), sheet.pixels.end(), Vec3{1, 1, 1});
  for (int i = 0; i < count; ++i) {
    const Image& small = small_[static_cast<size_t>(i)];
    const int left = kGap + (i % columns) * (kWidth + kGap) + (kWidth - small.width) / 2,
              top = kGap + (i / columns) * (kHeight + kGap) + (kHeight - small.height) / 2;
    for (int y = 0; y < small.height; ++y) {
      for (int x = 0; x < small.width; ++x) sheet.at(left + x, top + y) = small.at(x, y);
    }
  }
  const std::string file = fmt::format("{}_{}.jpg", name_, sheets_.size() + 1);
  sheets_.push_back({title_, file, small_.size()});
  small_.clear();
  return writeJpeg(folder_ / file, sheet, SIZE_MAX);
}

Film makeFilm(const std::string& group, const std::vector<fs::path>& frames, double framesPerSecond,
              const fs::path& folder, const std::string& name) {
  Film film{group, name + ".mp4", {}, frames.size()};
  std::string list;
  for (const fs::path& frame : frames) {
    std::string escaped;
    for (const char c : frame.lexically_relative(folder).string())
      escaped += c == '\'' ? std::string("'\\''") : std::string(1, c);
    list += fmt::format("file '{}'\nduration {:.6f}\n", escaped, 1 / framesPerSecond);
  }
  const fs::path listFile = folder / (name + ".txt");
  film.command = fmt::format(
      "ffmpeg -y -loglevel error -f concat -safe 0 -i {} -r {:g} -pix_fmt yuv420p -vf "
      "'pad=ceil(iw/2)*2:ceil(ih/2)*2' {}",
      quotedForShell(listFile.string()), framesPerSecond, quotedForShell((folder / film.file).string()));
  const bool written = static_cast<bool>(writeDurably(listFile, list));
  const std::string quietly = "command -v ffmpeg >/dev/null 2>&1 && " + film.command + " </dev/null >/dev/null 2>&1";
  if (!written || std::system(quietly.c_str()) != 0) film.file.clear();
  return film;
}

}  // namespace roomlight::batch
