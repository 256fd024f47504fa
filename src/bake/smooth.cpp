#include "bake/smooth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "bake/seams.h"
#include "base/parallel.h"

namespace roomlight::bake {
namespace {

constexpr int kReach = 3, kAcross = 2 * kReach + 1;  // neighbours, each way and in all
constexpr std::array kSteps{1, 2};                   // texels between neighbours, by pass
constexpr float kSpread = 1.8f;                      // standard deviation of weights, in neighbours
constexpr float kDeviations = 1.6f;  // of the noise of two texels, up to which they count as the same
constexpr float kOneSided = 0.1f;    // what a neighbour counts that has none on the opposite side
constexpr float kMostStep = 0.2f;    // between the light of both sides of an edge, of the sum of both

using Square = std::array<uint32_t, static_cast<size_t>(kAcross* kAcross)>;  // elements, in rows

int alongX(size_t k) { return static_cast<int>(k) % kAcross - kReach; }
int alongY(size_t k) { return static_cast<int>(k) / kAcross - kReach; }

// The neighbours of an element in its own chart.
Square squareAround(const Atlas& atlas, std::span<const uint32_t> elementAt, size_t element, int step) {
  Square out;
  out.fill(kNoElement);
  const int x = static_cast<int>(atlas.texels[element]) % atlas.width,
            y = static_cast<int>(atlas.texels[element]) / atlas.width;
  for (size_t k = 0; k < out.size(); ++k) {
    const int nx = x + alongX(k) * step, ny = y + alongY(k) * step;
    if (nx < 0 || ny < 0 || nx >= atlas.width || ny >= atlas.height) continue;
    const uint32_t j = elementAt[static_cast<size_t>(ny) * static_cast<size_t>(atlas.width) + static_cast<size_t>(nx)];
    if (j != kNoElement && atlas.chartOf[j] == atlas.chartOf[element]) out[k] = j;
  }
  return out;
}

void smoothOnce(const Atlas& atlas, std::span<const uint32_t> elementAt, const Smoothing::Pass& pass,
                BakedLayer& layer) {
  std::vector<Vec3> smooth = layer.lux;
  std::vector<float> errors = layer.errorLux;
  parallelFor(smooth.size(), 512, [&](size_t i) {
    if (atlas.charts[atlas.chartOf[i]].chart.byVertices) return;
    Square square = squareAround(atlas, elementAt, i, pass.step);
    for (size_t k = pass.beyond.first[i]; k < pass.beyond.first[i + 1]; ++k)
      square[pass.beyond.of[k].second] = pass.beyond.of[k].first;
    Vec3 sum;
    float weights = 0, squares = 0;
    for (size_t k = 0; k < square.size(); ++k) {
      const uint32_t j = square[k];
      if (j == kNoElement) continue;
      const float facing = dot(atlas.elements[i].normal, atlas.elements[j].normal);
      const float apart = luminance(layer.lux[i]) - luminance(layer.lux[j]);
      const float noise = layer.errorLux[i] * layer.errorLux[i] + layer.errorLux[j] * layer.errorLux[j];
      const float near = static_cast<float>(alongX(k) * alongX(k) + alongY(k) * alongY(k)) / (2 * kSpread * kSpread);
      const float same = apart * apart / std::max(kDeviations * kDeviations * 2 * noise, 1e-12f);
      const float paired = square[square.size() - 1 - k] == kNoElement ? kOneSided : 1;
      const float w = std::exp(-near - same) * std::max(facing, 0.0f) * paired;
      sum += layer.lux[j] * w, weights += w, squares += w * w * layer.errorLux[j] * layer.errorLux[j];
    }
    if (weights > 0) smooth[i] = sum / weights, errors[i] = std::sqrt(squares) / weights;
  });
  layer.lux = std::move(smooth), layer.errorLux = std::move(errors);
}

// Both sides of an edge get the mean of both.
void weld(const Smoothing::Others<float>& welds, BakedLayer& layer) {
  std::vector<Vec3> welded = layer.lux;
  parallelFor(welded.size(), 512, [&](size_t i) {
    if (welds.first[i] == welds.first[i + 1]) return;
    Vec3 other;
    for (size_t k = welds.first[i]; k < welds.first[i + 1]; ++k)
      other += layer.lux[welds.of[k].first] * welds.of[k].second;
    const float here = luminance(layer.lux[i]), there = luminance(other);
    if (std::abs(here - there) <= kMostStep * (here + there)) welded[i] = (layer.lux[i] + other) * 0.5f;
  });
  layer.lux = std::move(welded);
}

// Of all others at one place the mean.
std::vector<std::pair<uint32_t, float>> meanOf(const std::vector<std::vector<std::pair<uint32_t, float>>>& charts) {
  std::vector<std::pair<uint32_t, float>> out;
  for (const auto& chart : charts) {
    for (const auto& [element, weight] : chart) out.emplace_back(element, weight / static_cast<float>(charts.size()));
  }
  return out;
}

}  // namespace

Smoothing::Smoothing(const Atlas& atlas, std::span<const uint8_t> buried, const RayScene& rays) {
  const std::vector<uint32_t> elementAt = elementsByTexel(atlas);
  const Seams seams(atlas, elementAt, buried, rays);
  const size_t count = atlas.elements.size();
  for (const int step : kSteps) {
    std::vector<std::vector<std::pair<uint32_t, uint8_t>>> beyond(count);
    parallelFor(count, 256, [&](size_t i) {
      if (!seams.any(i)) return;
      const Square square = squareAround(atlas, elementAt, i, step);
      for (size_t k = 0; k < square.size(); ++k) {
        if (square[k] != kNoElement) continue;
        const Vec2 texels{static_cast<float>(alongX(k) * step), static_cast<float>(alongY(k) * step)};
        const uint32_t j = seams.beyond(i, texels);
        if (j != kNoElement) beyond[i].emplace_back(j, static_cast<uint8_t>(k));
      }
    });
    passes_.push_back({step, {}});
    for (const auto& of : beyond) passes_.back().beyond.add(of);
  }
  std::vector<std::vector<std::pair<uint32_t, float>>> welds(count);
  parallelFor(count, 256, [&](size_t i) {
    if (seams.any(i)) welds[i] = meanOf(seams.at(i));
  });
  for (const auto& of : welds) welds_.add(of);
}

void Smoothing::smooth(const Atlas& atlas, std::vector<BakedLayer>& layers) const {
  const std::vector<uint32_t> elementAt = elementsByTexel(atlas);
  for (BakedLayer& layer : layers) {
    for (const Pass& pass : passes_) smoothOnce(atlas, elementAt, pass, layer);
    weld(welds_, layer);
  }
}

}  // namespace roomlight::bake
