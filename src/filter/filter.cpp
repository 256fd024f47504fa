#include "filter/filter.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <span>

#include "base/parallel.h"
#include "filter/filter_kernel.h"
#include "filter/levels.h"

namespace roomlight {
namespace {

constexpr int kSpecularPasses = 3;
constexpr int kBand = 256;  // rows
constexpr int kFar = 5;  // passes after which a lone bright line leaves copies of itself as far apart as the last pass
                         // looks; short passes after them take these away
constexpr int kBack = 3;
constexpr int kNoiseReach = 3;  // pixels
// Of a pixel's light what its panes reflect, at least, where the surfaces seen in them tell what is filtered together:
// half of what glass reflects.
constexpr float kLeastShown = 0.02f;
constexpr int kFarthestPool =
    32;  // pixels: powers of levels are pooled over their step and twice that, but over no more

// What a pass reads is no longer independent: sums of squares of the passes' kernels taken one after the other over
// their product, where no weight stops.
float correlatedAfter(int passes) {
  constexpr std::array kRatio = {1.0f, 1.0f, 1.7f, 3.3f, 6.6f, 13.3f, 26.7f};
  return kRatio[static_cast<size_t>(std::min<int>(passes, kRatio.size() - 1))];
}

// How far each pass looks, in pixels.
std::vector<int> stepsOf(int passes) {
  std::vector<int> steps;
  for (int k = 0; k < passes; ++k) steps.push_back(1 << k);
  for (int k = passes > kFar ? kBack : 0; k-- > 0;) steps.push_back(1 << k);
  return steps;
}

// Powers of a level are pooled over its own step and then over this one.
int secondPool(int step) { return step < kFarthestPool ? 2 * step : step; }

// Pixels to each side that powers of any level are pooled over; where single pixels are bounded the noise is pooled
// before.
int poolReachOf(int passes) {
  int reach = 0;
  for (int k = 0; k < passes; ++k) reach = std::max(reach, (hasOutliers(k) ? 2 : 1) * ((1 << k) + secondPool(1 << k)));
  return reach;
}

// Pixels to each side that all passes together look.
int reachOf(const std::vector<int>& steps) {
  int reach = 0;
  for (const int step : steps) reach += step + 1;
  return reach;
}

// Kept from zero so that light can be divided by it.
Vec3 divisor(Vec3 albedo) { return max(albedo, Vec3(1e-3f)); }

void store(float* line, ptrdiff_t pitch, Vec3 v) { line[0] = v.x, line[pitch] = v.y, line[2 * pitch] = v.z; }
Vec3 fetch(const float* line, ptrdiff_t pitch) { return {line[0], line[pitch], line[2 * pitch]}; }

// Writes a row of pixels into its lines.
void pack(std::span<const FilterPixel> pixels, const ReflectedPlace* reflected, FilterRows& rows, int y) {
  const ptrdiff_t pitch = rows.pitch();
  float* at = rows.line(0, y);
  for (const FilterPixel& p : pixels) {
    store(at + FilterRows::kNormal * pitch, pitch, p.surface > 0 ? p.normal : Vec3());
    store(at + FilterRows::kPosition * pitch, pitch, p.position);
    const bool shows = reflected && reflected->weight > kLeastShown * p.weight && length(reflected->normal) > 0;
    store(at + FilterRows::kReflected * pitch, pitch,
          shows           ? normalize(reflected->normal)
          : p.surface > 0 ? p.normal
                          : Vec3());
    store(at + (FilterRows::kReflected + 3) * pitch, pitch,
          shows ? reflected->position / reflected->weight : p.position);
    if (reflected) ++reflected;
    at[FilterRows::kRoughness * pitch] = p.roughness;
    at[FilterRows::open(0) * pitch] = p.open;
    const Vec3 lights[kFilterLights] = {p.diffuse / divisor(p.albedo), p.sharp / divisor(p.albedo), p.specular,
                                        p.rare / divisor(p.albedo)};
    const float variances[kFilterLights] = {p.diffuseVariance, p.sharpVariance, p.specularVariance, 0};
    const float weights[kFilterLights] = {p.weight * p.diffuseShare, p.weight, p.weight * p.specularShare,
                                          p.weight * p.diffuseShare};
    for (int k = 0; k < kFilterLights; ++k) {
      float* light = at + FilterRows::light(k, 0) * pitch;
      store(light, pitch, lights[k]);
      light[FilterRows::kVariance * pitch] = variances[k];
      light[FilterRows::kWeight * pitch] = weights[k];
    }
    ++at;
  }
}

// A picture with columns of its other side beside each edge.
struct Round {
  size_t beside = 0, width = 0;  // columns, and those of the picture; 0: it has none beside it
  size_t columnOf(size_t x) const { return width == 0 ? x : (x + width * (1 + beside / width) - beside) % width; }
};

// Instead of the variance of a row's diffuse light, draws of its noise.
void packNoise(std::span<const FilterPixel> pixels, FilterRows& rows, int y, size_t firstPixel, const Round& round) {
  float* noise = rows.line(FilterRows::light(0, 0) + FilterRows::kVariance, y);
  for (size_t x = 0; x < pixels.size(); ++x)
    noise[x] = drawnNoise(pixels[x].diffuseVariance, firstPixel + round.columnOf(x));
}

// A row of the picture.
void compose(std::span<const FilterPixel> pixels, const FilterRows& rows, const FilterPass& pass, int y, Vec3* out) {
  const ptrdiff_t pitch = rows.pitch();
  const float* at = rows.line(0, y);
  for (const FilterPixel& p : pixels) {
    Vec3 lights[kFilterLights];
    for (int k = 0; k < kFilterLights; ++k) lights[k] = fetch(at + FilterRows::light(k, pass.place[k]) * pitch, pitch);
    // Where the albedo was raised to divide by it, light that no surface reflected is kept.
    *out++ = (p.surface > 0 ? (lights[0] + lights[1] + lights[3]) * divisor(p.albedo) : p.diffuse + p.rare + p.sharp) +
             lights[2] + p.rest;
    ++at;
  }
}

// What is told besides the picture, where given. `mean`, where given, makes pixels of sums.
struct Also {
  const std::function<FilterPixel(size_t)>* mean;
  std::vector<Vec3>*once, *irradiance;
  FilteredLuminance* left;
  Round round = {};
};

Image filteredFlat(const FilterInput& input, int passes, const Also& also) {
  const int w = input.width, h = input.height, farthest = 1 << std::max(0, passes - 1);
  const auto pixelsOfRow = [&](int y) {
    const size_t row = static_cast<size_t>(y) * static_cast<size_t>(w);
    if (!also.mean) return std::span(input.pixels).subspan(row, static_cast<size_t>(w));
    thread_local std::vector<FilterPixel> means;
    means.resize(static_cast<size_t>(w));
    for (size_t x = 0; x < means.size(); ++x) means[x] = (*also.mean)(row + x);
    return std::span<const FilterPixel>(means);
  };
  std::atomic<bool> sharp = false, rare = false;
  parallelFor(input.pixels.size(), 65536, [&](size_t i) {
    if (!isBlack(input.pixels[i].sharp)) sharp = true;
    if (!isBlack(input.pixels[i].rare)) rare = true;
  });
  // Bands of rows, one after the other, each with as many rows beside it as all passes reach: the whole picture at once
  // would take far more memory than all else. A pass filters as many of these rows as those after it look at.
  const std::vector<int> steps = stepsOf(passes);
  const bool levels = rare || input.byLevels;
  const int around = levels && also.left ? kNoiseReach : 0;  // rows whose noise tells that of a pixel
  const int pooled = levels ? poolReachOf(passes) + around : 0,
            reach = reachOf(steps) + pooled + (levels ? kCompanyReach : 0),
            margin = levels ? std::max({secondPool(farthest), around, kCompanyReach}) : farthest;
  Image out(w, h);
  if (also.once) also.once->resize(out.pixels.size());
  if (also.irradiance) also.irradiance->resize(out.pixels.size());
  if (also.left) also.left->variance.resize(out.pixels.size()), also.left->luminance.resize(out.pixels.size());
  FilterRows rows(w, std::min(h, kBand + 2 * reach), margin);
  int cleared = 0;  // rows whose margins are; passes leave them so
  for (int first = 0; first < h; first += kBand) {
    const int begin = std::max(0, first - reach), end = std::min(h, first + kBand + reach),
              last = std::min(h, first + kBand);
    rows.useRows(end - begin);
    const auto forRows = [&](int beside, auto&& body) {
      const int from = std::max(begin, first - beside), to = std::min(end, last + beside);
      parallelFor(static_cast<size_t>(to - from), 4, [&](size_t i) { body(from - begin + static_cast<int>(i)); });
    };
    forRows(reach, [&](int y) {
      if (y >= cleared) rows.clearMargins(y);
      const std::span<const FilterPixel> pixels = pixelsOfRow(begin + y);
      pack(
          pixels,
          input.reflected.empty() ? nullptr : &input.reflected[static_cast<size_t>(begin + y) * static_cast<size_t>(w)],
          rows, y);
      if (levels) packNoise(pixels, rows, y, static_cast<size_t>(begin + y) * static_cast<size_t>(w), also.round);
    });
    cleared = std::max(cleared, end - begin);
    FilterPass pass;
    pass.levels = levels;
    if (levels) {
      forRows(around, [&](int y) {
        for (int c = 0; c < 4; ++c) std::fill_n(rows.line(FilterRows::kKept + c, y), w, 0.0f);
      });
    }
    int left = reach;
    if (levels) {
      left -= kCompanyReach;
      forRows(left, [&](int y) { findCompany(rows, y); });
      forRows(left, [&](int y) { leaveLonely(rows, y); });
    }
    for (int k = 0; k < static_cast<int>(steps.size()); ++k) {
      pass.step = steps[static_cast<size_t>(k)], pass.correlated = also.left ? correlatedAfter(k) : 1;
      pass.filter[0] = !levels || k < passes, pass.filter[1] = sharp, pass.filter[2] = k < kSpecularPasses,
      pass.filter[3] = rare && !also.left;
      forRows(left - 1, [&](int y) { prepareRow(rows, pass, y); });
      left -= pass.step + 1;
      forRows(left, [&](int y) { filterRow(rows, pass, y); });
      if (levels && pass.filter[0]) {
        const int wide = secondPool(pass.step), pool = pass.step + wide;
        const auto poolTwice = [&](int beside) {
          forRows(beside + wide, [&](int y) { poolRow(rows, pass.step, 0, y); });
          forRows(beside, [&](int y) { poolRow(rows, wide, 1, y); });
        };
        forRows(around + (hasOutliers(k) ? 2 : 1) * pool, [&](int y) { takePower(rows, pass.place[0], y); });
        if (hasOutliers(k)) {
          poolTwice(around + pool);
          forRows(around + pool, [&](int y) { boundPower(rows, pass.place[0], y); });
        }
        poolTwice(around);
        forRows(around, [&](int y) { keepLevel(rows, k, pass.place[0], y); });
      }
      for (int l = 0; l < kFilterLights; ++l) pass.place[l] ^= pass.filter[l] ? 1 : 0;
      if (k > 0 || !also.once) continue;
      forRows(0, [&](int y) {
        const float* at = rows.line(FilterRows::light(0, pass.place[0]), y);
        for (int x = 0; x < w; ++x)
          (*also.once)[static_cast<size_t>(begin + y) * static_cast<size_t>(w) + static_cast<size_t>(x)] =
              fetch(at + x, rows.pitch());
      });
    }
    if (levels) forRows(around, [&](int y) { addKept(rows, pass.place[0], y); });
    if (around > 0) {
      forRows(around, [&](int y) { takeNoise(rows, pass.place[0], y); });
      forRows(2, [&](int y) { poolRow(rows, 1, 0, y); });
      forRows(0, [&](int y) { poolRow(rows, 2, 1, y); });
    }
    forRows(0, [&](int y) {
      const size_t row = static_cast<size_t>(begin + y) * static_cast<size_t>(w);
      const float *at = rows.line(FilterRows::light(0, pass.place[0]), y),
                  *spread = rows.line(FilterRows::light(3, pass.place[3]), y);
      const std::span<const FilterPixel> pixels = pixelsOfRow(begin + y);
      if (!also.left) compose(pixels, rows, pass, y, &out.at(0, begin + y));
      for (int x = 0; also.irradiance && x < w; ++x)
        (*also.irradiance)[row + static_cast<size_t>(x)] =
            fetch(at + x, rows.pitch()) + fetch(spread + x, rows.pitch());
      for (int x = 0; also.left && x < w; ++x) {
        const FilterPixel& p = pixels[static_cast<size_t>(x)];
        const size_t i = row + static_cast<size_t>(x);
        const auto of = [&](int k) {
          return rows.line(FilterRows::light(k, pass.place[k]) + FilterRows::kVariance, y)[x];
        };
        const auto light = [&](int k) {
          return fetch(rows.line(FilterRows::light(k, pass.place[k]), y) + x, rows.pitch());
        };
        const float albedo = luminance(divisor(p.albedo));
        also.left->luminance[i] = luminance(divisor(p.albedo) * (light(0) + light(1)) + light(2) + p.rest);
        const float diffuse = levels ? rows.line(FilterRows::pool(0), y)[x] : correlatedAfter(passes) * of(0);
        also.left->variance[i] = albedo * albedo * (diffuse + of(1)) + correlatedAfter(kSpecularPasses) * of(2);
      }
    });
  }
  return out;
}

// A picture with as many columns of its other side beside each edge as all passes reach.
class RoundPicture {
 public:
  RoundPicture(const FilterInput& input, int passes, const std::function<FilterPixel(size_t)>* mean)
      : w_(input.width),
        beside_(reachOf(stepsOf(passes)) + poolReachOf(passes) + kCompanyReach),
        padded_(w_ + 2 * beside_, input.height) {
    padded_.byLevels = input.byLevels;
    if (!input.reflected.empty()) padded_.reflected.resize(padded_.pixels.size());
    parallelFor(static_cast<size_t>(input.height), 4, [&](size_t y) {
      for (int x = 0; x < padded_.width; ++x) {
        const size_t i = y * static_cast<size_t>(w_) + static_cast<size_t>(((x - beside_) % w_ + w_) % w_);
        padded_.at(x, static_cast<int>(y)) = mean ? (*mean)(i) : input.pixels[i];
        if (!input.reflected.empty())
          padded_.reflected[y * static_cast<size_t>(padded_.width) + static_cast<size_t>(x)] = input.reflected[i];
      }
    });
  }
  const FilterInput& padded() const { return padded_; }
  Round round() const { return {static_cast<size_t>(beside_), static_cast<size_t>(w_)}; }
  // The picture's own columns of such rows.
  template <class T>
  std::vector<T> own(const std::vector<T>& all) const {
    std::vector<T> out;
    for (int y = 0; y < padded_.height; ++y) {
      const auto row = all.begin() + static_cast<ptrdiff_t>(y) * padded_.width + beside_;
      out.insert(out.end(), row, row + w_);
    }
    return out;
  }

 private:
  const int w_, beside_;
  FilterInput padded_;
};

Image filteredRound(const FilterInput& input, int passes, std::vector<Vec3>* irradiance) {
  const RoundPicture round(input, passes, nullptr);
  const Image all = filteredFlat(round.padded(), passes, {nullptr, nullptr, irradiance, nullptr, round.round()});
  if (irradiance) *irradiance = round.own(*irradiance);
  Image out(input.width, input.height);
  out.pixels = round.own(all.pixels);
  return out;
}

}  // namespace

Image composed(const FilterInput& input) {
  Image out(input.width, input.height);
  for (size_t i = 0; i < out.pixels.size(); ++i)
    out.pixels[i] = input.pixels[i].diffuse + input.pixels[i].rare + input.pixels[i].sharp + input.pixels[i].specular +
                    input.pixels[i].rest;
  return out;
}

Image filtered(const FilterInput& input, int passes, std::vector<Vec3>* once, std::vector<Vec3>* irradiance) {
  if (input.wraps) return filteredRound(input, passes, irradiance);
  return filteredFlat(input, passes, {nullptr, once, irradiance, nullptr});
}

FilteredLuminance filteredLuminance(const FilterInput& sums, int passes,
                                    const std::function<FilterPixel(size_t i)>& mean) {
  FilteredLuminance out;
  if (!sums.wraps) {
    filteredFlat(sums, passes, {&mean, nullptr, nullptr, &out});
    return out;
  }
  const RoundPicture round(sums, passes, &mean);
  filteredFlat(round.padded(), passes, {nullptr, nullptr, nullptr, &out, round.round()});
  return {round.own(out.luminance), round.own(out.variance)};
}

}  // namespace roomlight
