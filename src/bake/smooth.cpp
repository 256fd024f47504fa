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
constexpr float kMostOff = 0.1f;  // that the light of one side of an edge may be off the mean, of the sum of these

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
      if (j == kNoElement || square[square.size() - 1 - k] == kNoElement) continue;
      const float facing = dot(atlas.elements[i].normal, atlas.elements[j].normal);
      const float apart = luminance(layer.lux[i]) - luminance(layer.lux[j]);
      const float noise = layer.errorLux[i] * layer.errorLux[i] + layer.errorLux[j] * layer.errorLux[j];
      const float near = static_cast<float>(alongX(k) * alongX(k) + alongY(k) * alongY(k)) / (2 * kSpread * kSpread);
      const float same = apart * apart / std::max(kDeviations * kDeviations * 2 * noise, 1e-12f);
      const float w = std::exp(-near - same) * std::max(facing, 0.0f);
      sum += layer.lux[j] * w, weights += w, squares += w * w * layer.errorLux[j] * layer.errorLux[j];
    }
    if (weights > 0) smooth[i] = sum / weights, errors[i] = std::sqrt(squares) / weights;
  });
  layer.lux = std::move(smooth), layer.errorLux = std::move(errors);
}

// Both sides of an edge get the mean of both, unless that is so far off that something must part them.
void weld(const Smoothing::Others<float>& welds, BakedLayer& layer) {
  std::vector<Vec3> welded = layer.lux;
  parallelFor(welded.size(), 512, [&](size_t i) {
    Vec3 sum = layer.lux[i];
    float weights = 1;
    for (size_t k = welds.first[i]; k < welds.first[i + 1]; ++k)
      sum += layer.lux[welds.of[k].first] * welds.of[k].second, weights += welds.of[k].second;
    const float own = luminance(layer.lux[i]), mean = luminance(sum) / weights;
    if (std::abs(mean - own) <= kMostOff * (mean + own)) welded[i] = sum / weights;
  });
  layer.lux = std::move(welded);
}

}  // namespace

Smoothing::Smoothing(const Atlas& atlas, const RayScene& rays) {
  const std::vector<uint32_t> elementAt = elementsByTexel(atlas);
  const Seams seams(atlas, elementAt, rays, static_cast<float>(kReach * kSteps.back()));
  const size_t count = atlas.elements.size();
  for (const int step : kSteps) {
    std::vector<std::vector<std::pair<uint32_t, uint8_t>>> beyond(count);
    std::vector<std::vector<std::pair<uint32_t, float>>> welds(step == 1 ? count : 0);
    parallelFor(count, 256, [&](size_t i) {
      if (!seams.any(i)) return;
      const Square square = squareAround(atlas, elementAt, i, step);
      for (size_t k = 0; k < square.size(); ++k) {
        if (square[k] != kNoElement) continue;
        const Vec2 texels{static_cast<float>(alongX(k) * step), static_cast<float>(alongY(k) * step)};
        const uint32_t j = seams.beyond(i, texels);
        if (j != kNoElement) beyond[i].emplace_back(j, static_cast<uint8_t>(k));
      }
      if (step == 1 && !beyond[i].empty()) welds[i] = seams.at(i);
    });
    passes_.push_back({step, {}});
    for (const auto& of : beyond) passes_.back().beyond.add(of);
    for (const auto& of : welds) welds_.add(of);
  }
}

void Smoothing::smooth(const Atlas& atlas, std::vector<BakedLayer>& layers) const {
  const std::vector<uint32_t> elementAt = elementsByTexel(atlas);
  for (BakedLayer& layer : layers) {
    for (const Pass& pass : passes_) smoothOnce(atlas, elementAt, pass, layer);
    weld(welds_, layer);
  }
}

}  // namespace roomlight::bake
