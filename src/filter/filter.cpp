#include "filter/filter.h"

#include <algorithm>
#include <atomic>
#include <span>

#include "base/parallel.h"
#include "filter/filter_kernel.h"

namespace roomlight {
namespace {

constexpr int kSpecularPasses = 3;
constexpr int kBand = 96;  // rows

// Pixels to each side that all passes together look.
int reachOf(int passes) { return 2 * (1 << std::max(0, passes - 1)) - 1 + passes; }

// Kept from zero so that light can be divided by it.
Vec3 divisor(Vec3 albedo) { return max(albedo, Vec3(1e-3f)); }

void store(float* line, ptrdiff_t pitch, Vec3 v) { line[0] = v.x, line[pitch] = v.y, line[2 * pitch] = v.z; }
Vec3 fetch(const float* line, ptrdiff_t pitch) { return {line[0], line[pitch], line[2 * pitch]}; }

// Writes a row of pixels into its lines.
void pack(std::span<const FilterPixel> pixels, FilterRows& rows, int y) {
  const ptrdiff_t pitch = rows.pitch();
  float* at = rows.line(0, y);
  for (const FilterPixel& p : pixels) {
    store(at + FilterRows::kNormal * pitch, pitch, p.surface > 0 ? p.normal : Vec3());
    store(at + FilterRows::kPosition * pitch, pitch, p.position);
    at[FilterRows::kRoughness * pitch] = p.roughness;
    const Vec3 lights[kFilterLights] = {p.diffuse / divisor(p.albedo), p.sharp / divisor(p.albedo), p.specular};
    const float variances[kFilterLights] = {p.diffuseVariance, p.sharpVariance, p.specularVariance};
    const float weights[kFilterLights] = {p.weight * p.diffuseShare, p.weight, p.weight * p.specularShare};
    for (int k = 0; k < kFilterLights; ++k) {
      float* light = at + FilterRows::light(k, 0) * pitch;
      store(light, pitch, lights[k]);
      light[FilterRows::kVariance * pitch] = variances[k];
      light[FilterRows::kWeight * pitch] = weights[k];
    }
    ++at;
  }
}

// A row of the picture.
void compose(std::span<const FilterPixel> pixels, const FilterRows& rows, const FilterPass& pass, int y, Vec3* out) {
  const ptrdiff_t pitch = rows.pitch();
  const float* at = rows.line(0, y);
  for (const FilterPixel& p : pixels) {
    Vec3 lights[kFilterLights];
    for (int k = 0; k < kFilterLights; ++k) lights[k] = fetch(at + FilterRows::light(k, pass.place[k]) * pitch, pitch);
    // Where the albedo was raised to divide by it, light that no surface reflected is kept.
    *out++ = (p.surface > 0 ? (lights[0] + lights[1]) * divisor(p.albedo) : p.diffuse + p.sharp) + lights[2] + p.rest;
    ++at;
  }
}

// With as many columns of the other side beside each edge as all passes reach.
Image filteredRound(const FilterInput& input, int passes) {
  const int w = input.width, h = input.height, beside = reachOf(passes), wide = w + 2 * beside;
  FilterInput padded(wide, h);
  parallelFor(static_cast<size_t>(h), 4, [&](size_t y) {
    const size_t row = y * static_cast<size_t>(w);
    for (int x = 0; x < wide; ++x) padded.at(x, static_cast<int>(y)) = input.pixels[row + static_cast<size_t>(((x - beside) % w + w) % w)];
  });
  const Image all = filtered(padded, passes);
  Image out(w, h);
  for (int y = 0; y < h; ++y) std::copy_n(&all.at(beside, y), w, &out.at(0, y));
  return out;
}

}  // namespace

Image composed(const FilterInput& input) {
  Image out(input.width, input.height);
  for (size_t i = 0; i < out.pixels.size(); ++i) out.pixels[i] = input.pixels[i].diffuse + input.pixels[i].sharp + input.pixels[i].specular + input.pixels[i].rest;
  return out;
}

Image filtered(const FilterInput& input, int passes, bool wrap, std::vector<Vec3>* once, std::vector<Vec3>* irradiance) {
  if (wrap) return filteredRound(input, passes);
  const int w = input.width, h = input.height, farthest = 1 << std::max(0, passes - 1);
  const auto pixelsOfRow = [&](int y) { return std::span(input.pixels).subspan(static_cast<size_t>(y) * static_cast<size_t>(w), static_cast<size_t>(w)); };
  std::atomic<bool> sharp = false;
  parallelFor(input.pixels.size(), 65536, [&](size_t i) {
    if (!isBlack(input.pixels[i].sharp)) sharp = true;
  });
  // Bands of rows, one after the other, each with as many rows beside it as all passes reach: the whole picture at once would
  // take far more memory than all else.
  const int reach = reachOf(passes);
  Image out(w, h);
  if (once) once->resize(out.pixels.size());
  if (irradiance) irradiance->resize(out.pixels.size());
  for (int first = 0; first < h; first += kBand) {
    const int begin = std::max(0, first - reach), end = std::min(h, first + kBand + reach), last = std::min(h, first + kBand);
    const auto rowCount = static_cast<size_t>(end - begin);
    FilterRows rows(w, end - begin, farthest);
    parallelFor(rowCount, 4, [&](size_t y) {
      rows.clearMargins(static_cast<int>(y));
      pack(pixelsOfRow(begin + static_cast<int>(y)), rows, static_cast<int>(y));
    });
    FilterPass pass;
    for (int k = 0; k < passes; ++k) {
      pass.step = 1 << k;
      pass.filter[0] = true, pass.filter[1] = sharp, pass.filter[2] = k < kSpecularPasses;
      parallelFor(rowCount, 4, [&](size_t y) { prepareRow(rows, pass, static_cast<int>(y)); });
      parallelFor(rowCount, 4, [&](size_t y) { filterRow(rows, pass, static_cast<int>(y)); });
      for (int l = 0; l < kFilterLights; ++l) pass.place[l] ^= pass.filter[l] ? 1 : 0;
      if (k > 0 || !once) continue;
      parallelFor(static_cast<size_t>(last - first), 4, [&](size_t i) {
        const int y = first + static_cast<int>(i);
        const float* at = rows.line(FilterRows::light(0, pass.place[0]), y - begin);
        for (int x = 0; x < w; ++x) (*once)[static_cast<size_t>(y) * static_cast<size_t>(w) + static_cast<size_t>(x)] = fetch(at + x, rows.pitch());
      });
    }
    parallelFor(static_cast<size_t>(last - first), 4, [&](size_t i) {
      const int y = first + static_cast<int>(i);
      compose(pixelsOfRow(y), rows, pass, y - begin, &out.at(0, y));
      if (!irradiance) return;
      const float* at = rows.line(FilterRows::light(0, pass.place[0]), y - begin);
      for (int x = 0; x < w; ++x) (*irradiance)[static_cast<size_t>(y) * static_cast<size_t>(w) + static_cast<size_t>(x)] = fetch(at + x, rows.pitch());
    });
  }
  return out;
}

}  // namespace roomlight
