#include "trace/sky_distribution.h"

#include <algorithm>
#include <numbers>

namespace roomlight {
namespace {

constexpr int kMaxTableWidth = 512, kConstantTableWidth = 64;
// What stands apart as a spot: a part of the sky's light this large, within this angle of the brightest cell, of cells
// at least so bright beside it.
constexpr double kSpotShare = 0.05, kSpotContrast = 0.02;
constexpr float kSpotRad = 0.06f;

Vec3 texel(const Image& image, int x, int y) {
  x = x < 0 ? x + image.width : x >= image.width ? x - image.width : x;
  y = std::clamp(y, 0, image.height - 1);
  return image.at(x, y);
}

// How many values of an increasing table of a few are not above v.
int countUpTo(const float* ends, int count, float v) {
  int n = 0;
  for (int i = 0; i < count; ++i) n += ends[i] <= v;
  return n;
}

// Where v lies between two values (0..1).
float placeWithin(float begin, float end, float v) {
  return end > begin ? std::clamp((v - begin) / (end - begin), 0.0f, 0.999999f) : 0.5f;
}

// Index of the cell of an increasing table in which v falls, and where in it (0..1).
int findCell(const float* cdf, int count, float v, float& within) {
  const float* it = std::upper_bound(cdf, cdf + count + 1, v);
  const int i = std::clamp(static_cast<int>(it - cdf) - 1, 0, count - 1);
  within = placeWithin(cdf[i], cdf[i + 1], v);
  return i;
}

}  // namespace

SkyDistribution::SkyDistribution(const Sky& sky, bool spotApart) : sky_(sky) {
  present_ = sky.present();
  mean_ = sky.luminanceCdM2;
  cosRotation_ = std::cos(sky.rotationRad);
  sinRotation_ = std::sin(sky.rotationRad);
  const Image& image = sky.image;
  if (image.width == 0) {
    if (present_) tabulateConstant();
    return;
  }
  // A whole number of cells in each block.
  width_ = std::max(kBlocksX, std::min(image.width, kMaxTableWidth) / kBlocksX * kBlocksX);
  height_ = std::max(kBlocksY, std::min(image.height, kMaxTableWidth / 2) / kBlocksY * kBlocksY);
  std::vector<double> weights(static_cast<size_t>(width_) * height_, 0.0);
  double total = 0;
  Vec3 sum;
  double area = 0;
  // Cells take every texel under them and its neighbours, because look-ups are bilinear: no radiance without density.
  // Images smaller than the table are walked in steps of its cells.
  const int rows = std::max(image.height, height_), columns = std::max(image.width, width_);
  for (int j = 0; j < rows; ++j) {
    const double s = std::sin(kPi * (j + 0.5) / rows);
    const int row = static_cast<int>(static_cast<int64_t>(j) * height_ / rows),
              y = static_cast<int>(static_cast<int64_t>(j) * image.height / rows);
    for (int i = 0; i < columns; ++i) {
      const int x = static_cast<int>(static_cast<int64_t>(i) * image.width / columns);
      const Vec3 c = texel(image, x, y);
      sum += c * static_cast<float>(s);
      area += s;
      float l = 2 * luminance(c);
      for (int k = 0; k < 9; ++k) l += luminance(texel(image, x + k % 3 - 1, y + k / 3 - 1)) / 9;
      const int column = static_cast<int>(static_cast<int64_t>(i) * width_ / columns);
      weights[static_cast<size_t>(row) * width_ + column] += l * s;
      total += l * s;
    }
  }
  mean_ = sum / static_cast<float>(area);
  if (!(total > 0)) {
    present_ = false;
    return;
  }
  if (spotApart) total -= takeSpot(weights);
  tabulate(weights, total);
}

// Takes cells around the brightest out of the table, where they hold a good part of the sky's light. Returns their
// weight.
double SkyDistribution::takeSpot(std::vector<double>& weights) {
  const auto density = [&](size_t i) {
    return weights[i] / std::sin(kPi * (static_cast<double>(i / static_cast<size_t>(width_)) + 0.5) / height_);
  };
  size_t brightest = 0;
  double total = 0;
  for (size_t i = 0; i < weights.size(); ++i) {
    total += weights[i];
    if (density(i) > density(brightest)) brightest = i;
  }
  const double least = kSpotContrast * density(brightest);
  const Vec3 middle = directionIn(static_cast<int>(brightest % static_cast<size_t>(width_)),
                                  static_cast<int>(brightest / static_cast<size_t>(width_)), 0.5f, 0.5f);
  double taken = 0;
  for (size_t i = 0; i < weights.size(); ++i) {
    const int row = static_cast<int>(i / static_cast<size_t>(width_)),
              column = static_cast<int>(i % static_cast<size_t>(width_));
    if (density(i) < least || dot(directionIn(column, row, 0.5f, 0.5f), middle) < std::cos(kSpotRad)) continue;
    spot_.push_back({static_cast<int64_t>(i), cellMean(column, row), 1, 0});
    taken += weights[i];
  }
  double flux = 0;
  const auto fluxOf = [&](const SpotCell& c) {
    return static_cast<double>(luminance(c.radiance)) / static_cast<double>(spotPdf(c));  // of share 1
  };
  for (const SpotCell& c : spot_) flux += fluxOf(c);
  if (taken < kSpotShare * total || !(flux > 0)) {
    spot_.clear();
    return 0;
  }
  float upTo = 0;
  for (SpotCell& c : spot_) {
    c.share = static_cast<float>(fluxOf(c) / flux);
    c.upTo = upTo += c.share;
    weights[static_cast<size_t>(c.cell)] = 0;
  }
  return taken;
}

// Of the texels under a cell of the table.
Vec3 SkyDistribution::cellMean(int column, int row) const {
  const Image& image = sky_.image;
  const int x0 = column * image.width / width_, x1 = std::max(x0 + 1, (column + 1) * image.width / width_);
  const int y0 = row * image.height / height_, y1 = std::max(y0 + 1, (row + 1) * image.height / height_);
  Vec3 sum;
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) sum += image.at(x, y);
  }
  return sum / static_cast<float>((x1 - x0) * (y1 - y0));
}

SkyDistribution::Sample SkyDistribution::sampleSpot(Vec2 u) const {
  const auto it =
      std::upper_bound(spot_.begin(), spot_.end(), u.x, [](float v, const SpotCell& c) { return v < c.upTo; });
  const SpotCell& c = it == spot_.end() ? spot_.back() : *it;
  const float within = std::clamp((u.x - (c.upTo - c.share)) / c.share, 0.0f, 0.999999f);
  return {
      directionIn(static_cast<int>(c.cell % width_), static_cast<int>(c.cell / width_), within, u.y), spotPdf(c), {}};
}

Bounds3 SkyDistribution::spotDirections() const {
  Bounds3 out;
  for (const SpotCell& c : spot_) {
    for (int corner = 0; corner < 4; ++corner) {
      out.add(directionIn(static_cast<int>(c.cell % width_), static_cast<int>(c.cell / width_),
                          static_cast<float>(corner & 1), static_cast<float>(corner >> 1)));
    }
  }
  const Vec3 bulge(0.01f);  // of the sphere within a cell
  return {out.lo - bulge, out.hi + bulge};
}

const SkyDistribution::SpotCell* SkyDistribution::spotAt(Vec2 uv) const {
  if (spot_.empty()) return nullptr;
  const int64_t cell = cellAt(uv);
  const auto it =
      std::lower_bound(spot_.begin(), spot_.end(), cell, [](const SpotCell& c, int64_t v) { return c.cell < v; });
  return it == spot_.end() || it->cell != cell ? nullptr : &*it;
}

Vec3 SkyDistribution::spotRadiance(Vec3 d, float& pdf) const {
  const SpotCell* c = spot_.empty() ? nullptr : spotAt(toUv(d));
  pdf = c ? spotPdf(*c) : 0;
  return c ? c->radiance : Vec3(0);
}

float SkyDistribution::spotPdf(const SpotCell& c) const {
  return c.share /
         solidAngleAt(std::sin(kPi * (static_cast<float>(c.cell / width_) + 0.5f) / static_cast<float>(height_)));
}

void SkyDistribution::tabulateConstant() {
  width_ = kConstantTableWidth, height_ = kConstantTableWidth / 2;
  std::vector<double> weights(static_cast<size_t>(width_) * height_);
  double total = 0;
  for (int y = 0; y < height_; ++y) {
    const double step = std::numbers::pi / height_, solidAngle = std::cos(step * y) - std::cos(step * (y + 1));
    for (int x = 0; x < width_; ++x) total += weights[static_cast<size_t>(y) * width_ + x] = solidAngle;
  }
  tabulate(weights, total);
}

void SkyDistribution::tabulate(const std::vector<double>& weights, double total) {
  cells_.resize(weights.size());
  rowCdf_.assign(static_cast<size_t>(height_) + 1, 0);
  columnCdf_.assign(static_cast<size_t>(height_) * (width_ + 1), 0);
  double rows = 0;
  for (int y = 0; y < height_; ++y) {
    double rowSum = 0;
    for (int x = 0; x < width_; ++x) rowSum += weights[static_cast<size_t>(y) * width_ + x];
    double running = 0;
    for (int x = 0; x < width_; ++x) {
      const double w = weights[static_cast<size_t>(y) * width_ + x];
      cells_[static_cast<size_t>(y) * width_ + x] = static_cast<float>(w / total);
      running += w;
      columnCdf_[static_cast<size_t>(y) * (width_ + 1) + x + 1] =
          rowSum > 0 ? static_cast<float>(running / rowSum) : static_cast<float>(x + 1) / static_cast<float>(width_);
    }
    rows += rowSum;
    rowCdf_[static_cast<size_t>(y) + 1] = static_cast<float>(rows / total);
  }
  blockShare_.assign(kBlocks, 0);
  blockRows_.assign(static_cast<size_t>(kBlocksX) * static_cast<size_t>(height_), 0);
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      const float share = cells_[static_cast<size_t>(y) * width_ + x];
      const int high = height_ / kBlocksY, block = y / high * kBlocksX + x * kBlocksX / width_;
      blockShare_[static_cast<size_t>(block)] += share;
      blockRows_[static_cast<size_t>(block * high + y % high)] += share;
    }
  }
  const auto high = static_cast<size_t>(height_ / kBlocksY);
  for (size_t block = 0; block < static_cast<size_t>(kBlocks); ++block) {
    float* rowEnds = &blockRows_[block * high];
    for (size_t y = 1; y < high; ++y) rowEnds[y] += rowEnds[y - 1];
    const float whole = rowEnds[high - 1];
    for (size_t y = 0; y < high; ++y)
      rowEnds[y] = whole > 0 ? rowEnds[y] / whole : static_cast<float>(y + 1) / static_cast<float>(high);
  }
}

Vec2 SkyDistribution::toUv(Vec3 d) const {
  const float x = cosRotation_ * d.x - sinRotation_ * d.z;  // rotation by -angle about +y
  const float z = sinRotation_ * d.x + cosRotation_ * d.z;
  return {0.5f + std::atan2(x, -z) / (2 * kPi), std::acos(std::clamp(d.y, -1.0f, 1.0f)) / kPi};
}

int64_t SkyDistribution::cellAt(Vec2 uv) const {
  const int column = std::clamp(static_cast<int>(uv.x * static_cast<float>(width_)), 0, width_ - 1);
  const int row = std::clamp(static_cast<int>(uv.y * static_cast<float>(height_)), 0, height_ - 1);
  return static_cast<int64_t>(row) * width_ + column;
}

float SkyDistribution::solidAngleAt(float sinTheta) const {
  return (2 * kPi / static_cast<float>(width_)) * (kPi / static_cast<float>(height_)) * std::max(sinTheta, 1e-6f);
}

Vec3 SkyDistribution::radianceAt(Vec2 uv) const {
  const Image& image = sky_.image;
  if (image.width == 0) return sky_.luminanceCdM2;
  if (spotAt(uv)) return {};
  const float x = uv.x * static_cast<float>(image.width) - 0.5f, y = uv.y * static_cast<float>(image.height) - 0.5f;
  const float fx = std::floor(x), fy = std::floor(y);
  const int ix = static_cast<int>(fx);
  int iy = static_cast<int>(fy), below = iy + 1;
  if (sky_.horizonEdge && below == image.height / 2) {
    if (uv.y < 0.5f) {
      below = iy;
    } else {
      iy = below;
    }
  }
  const Vec3 top = lerp(texel(image, ix, iy), texel(image, ix + 1, iy), x - fx);
  const Vec3 bottom = lerp(texel(image, ix, below), texel(image, ix + 1, below), x - fx);
  return lerp(top, bottom, y - fy);
}

void SkyDistribution::prefetch(Vec2 uv) const {
  const Image& image = sky_.image;
  if (image.width == 0) return;
  const int x = std::clamp(static_cast<int>(uv.x * static_cast<float>(image.width) - 0.5f), 0, image.width - 1);
  const int y = std::clamp(static_cast<int>(uv.y * static_cast<float>(image.height) - 0.5f), 0, image.height - 1);
  __builtin_prefetch(&image.at(x, y)), __builtin_prefetch(&image.at(x, std::min(y + 1, image.height - 1)));
}

SkyDistribution::Sample SkyDistribution::sample(Vec2 u) const {
  float dy, dx;
  const int row = findCell(rowCdf_.data(), height_, u.y, dy);
  const int column = findCell(&columnCdf_[static_cast<size_t>(row) * (width_ + 1)], width_, u.x, dx);
  return inCell(column, row, dx, dy);
}

Vec3 SkyDistribution::directionIn(int column, int row, float dx, float dy) const {
  const float theta = kPi * (static_cast<float>(row) + dy) / static_cast<float>(height_);
  const float phi = 2 * kPi * ((static_cast<float>(column) + dx) / static_cast<float>(width_) - 0.5f);
  const float s = std::sin(theta), x = s * std::sin(phi), z = -s * std::cos(phi);
  return {cosRotation_ * x + sinRotation_ * z, std::cos(theta), -sinRotation_ * x + cosRotation_ * z};
}

SkyDistribution::Sample SkyDistribution::inCell(int column, int row, float dx, float dy) const {
  const Vec2 uv{(static_cast<float>(column) + dx) / static_cast<float>(width_),
                (static_cast<float>(row) + dy) / static_cast<float>(height_)};
  const Vec3 d = directionIn(column, row, dx, dy);
  return {d, cells_[static_cast<size_t>(row) * width_ + column] / solidAngleAt(std::sqrt(d.x * d.x + d.z * d.z)), uv};
}

SkyDistribution::Sample SkyDistribution::sampleBlock(int block, Vec2 u) const {
  const int rows = height_ / kBlocksY, columns = width_ / kBlocksX;
  const float* rowEnds = &blockRows_[static_cast<size_t>(block) * static_cast<size_t>(rows)];
  const int y = countUpTo(rowEnds, rows - 1, u.y), row = block / kBlocksX * rows + y;
  const float dy = placeWithin(y > 0 ? rowEnds[y - 1] : 0, rowEnds[y], u.y);
  const int x0 = block % kBlocksX * columns;
  const float* ends = &columnCdf_[static_cast<size_t>(row) * (width_ + 1) + x0];
  const float v = ends[0] + u.x * (ends[columns] - ends[0]);
  const int x = countUpTo(ends + 1, columns - 1, v);
  return inCell(x0 + x, row, placeWithin(ends[x], ends[x + 1], v), dy);
}

int SkyDistribution::blockAt(Vec2 uv) const {
  return std::clamp(static_cast<int>(uv.y * kBlocksY), 0, kBlocksY - 1) * kBlocksX +
         std::clamp(static_cast<int>(uv.x * kBlocksX), 0, kBlocksX - 1);
}

float SkyDistribution::pdfAt(Vec2 uv) const {
  return cells_.empty() ? 0 : cells_[static_cast<size_t>(cellAt(uv))] / solidAngleAt(std::sin(kPi * uv.y));
}

}  // namespace roomlight
