#include "filter/filter.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <span>

#include "base/parallel.h"
#include "filter/filter_kernel.h"
#include "filter/levels.h"
#include "filter/specks.h"

namespace roomlight {
namespace {

constexpr int kSpecularPasses = 3;
constexpr int kBand = 256;  // rows, at least
constexpr int kFar = 5;  // passes after which a lone bright line leaves copies of itself as far apart as the last pass
                         // looks; short passes after them take these away
constexpr int kBack = 3;
constexpr int kNoiseReach = 3, kSpeckReach = 1;  // pixels
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

// Filters a picture that has edges in bands of rows, one after the other, each with as many rows beside it as all
// passes reach: the whole picture at once would take far more memory than all else. A pass filters as many of these
// rows as those after it look at.
class BandFilter {
 public:
  BandFilter(const FilterInput& input, int passes, const Also& also)
      : input_(input),
        also_(also),
        passes_(passes),
        w_(input.width),
        h_(input.height),
        kinds_(kindsIn(input)),
        levels_(kinds_.rare || input.byLevels),
        steps_(stepsOf(passes)),
        around_(also.left ? (levels_ ? kNoiseReach : 0) : kSpeckReach),
        reach_(reachOf(steps_) + around_ + (levels_ ? poolReachOf(passes) + kCompanyReach : 0)),
        band_(h_ <= kBand + 2 * reach_ ? h_ : kBand),
        rows_(w_, std::min(h_, band_ + 2 * reach_), margin()) {}

  Image run() {
    Image out(w_, h_);
    if (also_.once) also_.once->resize(out.pixels.size());
    if (also_.irradiance) also_.irradiance->resize(out.pixels.size());
    if (also_.left) also_.left->variance.resize(out.pixels.size()), also_.left->luminance.resize(out.pixels.size());
    for (first_ = 0; first_ < h_; first_ += band_) {
      begin_ = std::max(0, first_ - reach_), end_ = std::min(h_, first_ + band_ + reach_),
      last_ = std::min(h_, first_ + band_);
      rows_.useRows(end_ - begin_);
      packBand();
      pass_ = {};
      pass_.levels = levels_;
      left_ = reach_;
      if (levels_) startLevels();
      for (int k = 0; k < static_cast<int>(steps_.size()); ++k) {
        passOver(k);
        if (k == 0 && also_.once) tellOnce();
      }
      if (levels_) forRows(around_, [&](int y) { addKept(rows_, pass_.place[0], y); });
      if (also_.left) {
        if (levels_) poolNoise();
      } else if (!steps_.empty()) {
        removeSpecks();
      }
      forRows(0, [&](int y) { tell(y, out); });
    }
    return out;
  }

 private:
  struct Kinds {
    bool sharp, rare;
  };
  // Of light, apart from diffuse and specular: whether there is any.
  static Kinds kindsIn(const FilterInput& input) {
    std::atomic<bool> sharp = false, rare = false;
    parallelFor(input.pixels.size(), 65536, [&](size_t i) {
      if (!isBlack(input.pixels[i].sharp)) sharp = true;
      if (!isBlack(input.pixels[i].rare)) rare = true;
    });
    return {sharp, rare};
  }

  int margin() const {
    const int farthest = 1 << std::max(0, passes_ - 1);
    return levels_ ? std::max({secondPool(farthest), around_, kCompanyReach}) : farthest;
  }

  size_t rowOf(int y) const { return static_cast<size_t>(begin_ + y) * static_cast<size_t>(w_); }

  std::span<const FilterPixel> pixelsOfRow(int y) const {
    const size_t row = rowOf(y);
    if (!also_.mean) return std::span(input_.pixels).subspan(row, static_cast<size_t>(w_));
    thread_local std::vector<FilterPixel> means;
    means.resize(static_cast<size_t>(w_));
    for (size_t x = 0; x < means.size(); ++x) means[x] = (*also_.mean)(row + x);
    return std::span<const FilterPixel>(means);
  }

  // Of the band, and so many rows beside it.
  template <class Body>
  void forRows(int beside, const Body& body) const {
    const int from = std::max(begin_, first_ - beside), to = std::min(end_, last_ + beside);
    parallelFor(static_cast<size_t>(to - from), 4, [&](size_t i) { body(from - begin_ + static_cast<int>(i)); });
  }

  void packBand() {
    forRows(reach_, [&](int y) {
      if (y >= cleared_) rows_.clearMargins(y);
      const std::span<const FilterPixel> pixels = pixelsOfRow(y);
      pack(pixels, input_.reflected.empty() ? nullptr : &input_.reflected[rowOf(y)], rows_, y);
      if (levels_) packNoise(pixels, rows_, y, rowOf(y), also_.round);
    });
    cleared_ = std::max(cleared_, end_ - begin_);
  }

  void startLevels() {
    forRows(around_, [&](int y) {
      for (int c = 0; c < 4; ++c) std::fill_n(rows_.line(FilterRows::kKept + c, y), w_, 0.0f);
    });
    left_ -= kCompanyReach;
    forRows(left_, [&](int y) { findCompany(rows_, y); });
    forRows(left_, [&](int y) { leaveLonely(rows_, y); });
  }

  void passOver(int k) {
    pass_.step = steps_[static_cast<size_t>(k)], pass_.correlated = also_.left ? correlatedAfter(k) : 1;
    pass_.filter[0] = !levels_ || k < passes_, pass_.filter[1] = kinds_.sharp, pass_.filter[2] = k < kSpecularPasses,
    pass_.filter[3] = kinds_.rare && !also_.left;
    forRows(left_ - 1, [&](int y) { prepareRow(rows_, pass_, y); });
    left_ -= pass_.step + 1;
    forRows(left_, [&](int y) { filterRow(rows_, pass_, y); });
    if (levels_ && pass_.filter[0]) takeLevel(k);
    for (int l = 0; l < kFilterLights; ++l) pass_.place[l] ^= pass_.filter[l] ? 1 : 0;
  }

  void takeLevel(int k) {
    const int wide = secondPool(pass_.step), pool = pass_.step + wide;
    const auto poolTwice = [&](int beside) {
      forRows(beside + wide, [&](int y) { poolRow(rows_, pass_.step, 0, y); });
      forRows(beside, [&](int y) { poolRow(rows_, wide, 1, y); });
    };
    forRows(around_ + (hasOutliers(k) ? 2 : 1) * pool, [&](int y) { takePower(rows_, pass_.place[0], y); });
    if (hasOutliers(k)) {
      poolTwice(around_ + pool);
      forRows(around_ + pool, [&](int y) { boundPower(rows_, pass_.place[0], y); });
    }
    poolTwice(around_);
    forRows(around_, [&](int y) { keepLevel(rows_, k, pass_.place[0], y); });
  }

  void poolNoise() {
    forRows(around_, [&](int y) { takeNoise(rows_, pass_.place[0], y); });
    forRows(2, [&](int y) { poolRow(rows_, 1, 0, y); });
    forRows(0, [&](int y) { poolRow(rows_, 2, 1, y); });
  }

  void removeSpecks() {
    forRows(0, [&](int y) { boundSpecks(rows_, pass_, y); });
    for (int k = 0; k < kFilterLights; ++k) pass_.place[k] ^= hasSpecks(k) ? 1 : 0;
  }

  void tellOnce() {
    forRows(0, [&](int y) {
      const float* at = rows_.line(FilterRows::light(0, pass_.place[0]), y);
      for (int x = 0; x < w_; ++x) (*also_.once)[rowOf(y) + static_cast<size_t>(x)] = fetch(at + x, rows_.pitch());
    });
  }

  void tell(int y, Image& out) const {
    const size_t row = rowOf(y);
    const float *at = rows_.line(FilterRows::light(0, pass_.place[0]), y),
                *spread = rows_.line(FilterRows::light(3, pass_.place[3]), y);
    const std::span<const FilterPixel> pixels = pixelsOfRow(y);
    if (!also_.left) compose(pixels, rows_, pass_, y, &out.at(0, begin_ + y));
    for (int x = 0; also_.irradiance && x < w_; ++x)
      (*also_.irradiance)[row + static_cast<size_t>(x)] =
          fetch(at + x, rows_.pitch()) + fetch(spread + x, rows_.pitch());
    for (int x = 0; also_.left && x < w_; ++x) {
      const FilterPixel& p = pixels[static_cast<size_t>(x)];
      const size_t i = row + static_cast<size_t>(x);
      const auto of = [&](int k) {
        return rows_.line(FilterRows::light(k, pass_.place[k]) + FilterRows::kVariance, y)[x];
      };
      const auto light = [&](int k) {
        return fetch(rows_.line(FilterRows::light(k, pass_.place[k]), y) + x, rows_.pitch());
      };
      const float albedo = luminance(divisor(p.albedo));
      also_.left->luminance[i] = luminance(divisor(p.albedo) * (light(0) + light(1)) + light(2) + p.rest);
      const float diffuse = levels_ ? rows_.line(FilterRows::pool(0), y)[x] : correlatedAfter(passes_) * of(0);
      also_.left->variance[i] = albedo * albedo * (diffuse + of(1)) + correlatedAfter(kSpecularPasses) * of(2);
    }
  }

  const FilterInput& input_;
  const Also& also_;
  const int passes_, w_, h_;
  const Kinds kinds_;
  const bool levels_;  // diffuse light is filtered by levels
  const std::vector<int> steps_;
  const int around_;  // rows that a pixel is judged by, after all passes
  const int reach_;
  const int band_;  // rows: all, where a band and those beside it are as many
  FilterRows rows_;
  int cleared_ = 0;  // rows whose margins are; passes leave them so
  int begin_ = 0, end_ = 0, first_ = 0, last_ = 0;  // rows in memory, and those of the band among them
  int left_ = 0;  // rows beside the band that passes still look at
  FilterPass pass_;
};

Image filteredFlat(const FilterInput& input, int passes, const Also& also) {
  return BandFilter(input, passes, also).run();
}

// A picture with as many columns of its other side beside each edge as all passes reach.
class RoundPicture {
 public:
  RoundPicture(const FilterInput& input, int passes, const std::function<FilterPixel(size_t)>* mean)
      : w_(input.width),
        beside_(reachOf(stepsOf(passes)) + poolReachOf(passes) + kCompanyReach + kSpeckReach),
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
