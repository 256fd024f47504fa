// Means of pictures that differ by their seed alone.
#include <fmt/format.h>

#include <cmath>

#include "batch/merge.h"

namespace roomlight::batch {
namespace {

namespace fs = std::filesystem;

// Mean and sum of squared differences from it, picture by picture (Welford 1962).
struct Sums {
  Image mean;
  std::vector<double> squares;  // of luminance
  size_t count = 0;

  void add(const Image& image) {
    if (count == 0) mean = Image(image.width, image.height), squares.assign(image.pixels.size(), 0);
    ++count;
    const float share = 1 / static_cast<float>(count);
    for (size_t i = 0; i < squares.size(); ++i) {
      const double before = luminance(image.pixels[i] - mean.pixels[i]);
      mean.pixels[i] = mean.pixels[i] + (image.pixels[i] - mean.pixels[i]) * share;
      squares[i] += before * luminance(image.pixels[i] - mean.pixels[i]);
    }
  }
  // Variance of the mean.
  double variance(size_t i) const { return squares[i] / static_cast<double>(count - 1) / static_cast<double>(count); }
};

}  // namespace

Result<SeedMean> meanOfSeeds(const std::string& group, const std::vector<fs::path>& pictures, const fs::path& mean,
                             const fs::path& error) {
  if (pictures.size() < 2) return Error{fmt::format("{}: a mean needs two seeds that are done", group)};
  Sums sums;
  for (const fs::path& picture : pictures) {
    const Result<Image> image = readImage(picture);
    if (!image) return Error{image.error()};
    if (sums.count > 0 && !(image.value().size() == sums.mean.size()))
      return Error{fmt::format("{}: is not as large as the other seeds of {}", picture.string(), group)};
    sums.add(image.value());
  }
  Image errors(sums.mean.width, sums.mean.height);
  double variance = 0, light = 0;
  for (size_t i = 0; i < errors.pixels.size(); ++i) {
    const auto e = static_cast<float>(std::sqrt(std::max(0.0, sums.variance(i))));
    errors.pixels[i] = {e, e, e};
    variance += sums.variance(i), light += luminance(sums.mean.pixels[i]);
  }
  const double pixels = static_cast<double>(std::max<size_t>(1, errors.pixels.size()));
  SeedMean out{group, mean.filename().string(), error.filename().string(), pictures.size(), 0};
  if (light > 0) out.standardError = std::sqrt(variance / pixels) / (light / pixels);
  Result<Metadata> metadata = readMetadata(pictures.front());
  Metadata about = metadata ? metadata.value() : Metadata();
  about.erase("roomlight.seed");
  about["roomlight.seeds"] = std::to_string(pictures.size());
  about["roomlight.standardError"] = fmt::format("{:.6g}", out.standardError);
  if (const Status s = writeExr(mean, sums.mean, about); !s) return Error{s.error()};
  if (const Status s = writeExr(error, errors, about); !s) return Error{s.error()};
  return out;
}

}  // namespace roomlight::batch
