#include "bake/lean.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace roomlight::bake {
namespace {

constexpr int kBlock = 5;  // texels
constexpr size_t kTurns = 4;
constexpr float kSine = 0.5f, kCosine = 0.8660254f;  // of the angle that places are turned by
constexpr float kMostLean = 0.95f;  // of illuminance: light that comes more flatly counts as if it came so
constexpr float kLeastLux = 0.01f;  // below which nothing is told
constexpr float kLeastRelief = 0.05f;  // 3°: less changes light by less than 5 %, where it comes from 45°
constexpr float kSpread = 0.5f;    // standard deviation of weights, in blocks

// Root mean square of the slopes of a normal map.
float reliefOf(const Texture& map, float scale) {
  double sum = 0;
  const size_t count = map.rgba.size() / 4;
  for (size_t i = 0; i < count; ++i) {
    const auto part = [&](size_t c) { return static_cast<float>(map.rgba[4 * i + c]) / 127.5f - 1; };
    const float x = part(0) * scale, y = part(1) * scale, z = std::max(part(2), 0.1f);
    sum += (x * x + y * y) / (z * z);
  }
  return static_cast<float>(std::sqrt(sum / static_cast<double>(std::max<size_t>(count, 1))));
}

// By material: whether its normal map turns light noticeably.
std::vector<uint8_t> withRelief(const Scene& scene) {
  std::vector<uint8_t> out;
  for (const Material& m : scene.materials) {
    const int map = m.normalTexture.texture;
    out.push_back(map >= 0 && reliefOf(scene.textures[static_cast<size_t>(map)], m.normalScale) >= kLeastRelief);
  }
  return out;
}

size_t materialOf(const Scene& scene, const Chart& chart) {
  const int mesh = scene.instances[chart.instance].mesh;
  return static_cast<size_t>(scene.meshes[static_cast<size_t>(mesh)].material);
}

Vec2 texelOf(const Atlas& atlas, size_t element) {
  const auto width = static_cast<uint32_t>(atlas.width);
  return {static_cast<float>(atlas.texels[element] % width), static_cast<float>(atlas.texels[element] / width)};
}

// Blocks of the atlas by x and y, of one chart.
using Block = std::pair<int, int>;
Block blockOf(Vec2 texel) { return {static_cast<int>(texel.x) / kBlock, static_cast<int>(texel.y) / kBlock}; }

float distance2(Vec2 a, Vec2 b) {
  const Vec2 d = a - b;
  return d.x * d.x + d.y * d.y;
}

// Of each block the element nearest to its middle that has a place of its own.
std::map<Block, uint32_t> tellersOf(const Atlas& atlas, const LitPlaces& lit, size_t first, size_t end) {
  std::map<Block, std::pair<float, uint32_t>> nearest;
  for (size_t i = first; i < end; ++i) {
    if (lit.buried[i]) continue;
    const Vec2 at = texelOf(atlas, i);
    const Block block = blockOf(at);
    const Vec2 middle{static_cast<float>(block.first * kBlock) + 0.5f * (kBlock - 1),
                      static_cast<float>(block.second * kBlock) + 0.5f * (kBlock - 1)};
    const std::pair<float, uint32_t> own{distance2(at, middle), static_cast<uint32_t>(i)};
    const auto [known, added] = nearest.emplace(block, own);
    if (!added) known->second = std::min(known->second, own);
  }
  std::map<Block, uint32_t> out;
  for (const auto& [block, found] : nearest) out.emplace(block, found.second);
  return out;
}

void addTurned(const SurfaceElement& place, const Chart& chart, std::vector<SurfaceElement>& turned) {
  for (const Vec3 axis : {chart.alongU, chart.alongV}) {
    const Vec3 along = axis - place.normal * dot(axis, place.normal);
    const Vec3 unit = length(along) > 0.1f ? normalize(along) : Frame(place.normal).t;
    for (const float sine : {kSine, -kSine}) {
      turned.push_back(place);
      turned.back().turned = place.normal * kCosine + unit * sine;
    }
  }
}

// Of an element: of the tellers of its block and of those around it. `numbers`: of them among all.
LeanShares sharesOf(const Atlas& atlas, size_t element, const std::map<Block, uint32_t>& tellers,
                    const std::map<uint32_t, uint32_t>& numbers) {
  LeanShares out;
  const Vec2 at = texelOf(atlas, element);
  const Block own = blockOf(at);
  size_t count = 0;
  for (int y = own.second - 1; y <= own.second + 1; ++y) {
    for (int x = own.first - 1; x <= own.first + 1; ++x) {
      const auto teller = tellers.find({x, y});
      if (teller == tellers.end()) continue;
      const float facing = dot(atlas.elements[element].normal, atlas.elements[teller->second].normal);
      const float apart = distance2(at, texelOf(atlas, teller->second)) / (2 * kSpread * kSpread * kBlock * kBlock);
      if (facing <= 0) continue;
      out.teller[count] = numbers.at(teller->second), out.weight[count++] = facing * std::exp(-apart);
    }
  }
  return out;
}

}  // namespace

TurnedPlaces turnedPlaces(const Scene& scene, const Atlas& atlas, const LitPlaces& lit) {
  TurnedPlaces out;
  const std::vector<uint8_t> relief = withRelief(scene);
  for (size_t first = 0, end = 0; first < atlas.elements.size(); first = end) {
    while (end < atlas.elements.size() && atlas.chartOf[end] == atlas.chartOf[first]) ++end;
    const Chart& chart = atlas.charts[atlas.chartOf[first]].chart;
    if (chart.byVertices || !relief[materialOf(scene, chart)]) continue;
    const std::map<Block, uint32_t> tellers = tellersOf(atlas, lit, first, end);
    std::map<uint32_t, uint32_t> numbers;
    for (const auto& [block, element] : tellers) {
      const uint32_t place = lit.ofElement[element].place[0];
      numbers.emplace(element, static_cast<uint32_t>(out.of.size()));
      out.of.push_back(place);
      addTurned(lit.places[place], chart, out.turned);
    }
    for (size_t i = first; i < end; ++i)
      out.elements.push_back(static_cast<uint32_t>(i)), out.shares.push_back(sharesOf(atlas, i, tellers, numbers));
  }
  return out;
}

void takeLean(const TurnedPlaces& turned, const LitPlaces& lit, BakedLayer& layer) {
  // What light has along both axes, and illuminance.
  std::vector<Vec3> told(turned.of.size());
  for (size_t k = 0; k < told.size(); ++k) {
    const Vec3* lux = &layer.lux[lit.places.size() + kTurns * k];
    // What light along an axis adds to illuminance, were the place turned by 90° without horizon.
    const auto along = [&](size_t turn) { return (luminance(lux[turn]) - luminance(lux[turn + 1])) / (2 * kSine); };
    told[k] = {along(0), along(2), luminance(layer.lux[turned.of[k]])};
  }
  if (!told.empty()) layer.lean.assign(lit.ofElement.size(), Vec3(0));
  for (size_t i = 0; i < turned.elements.size(); ++i) {
    const LeanShares& shares = turned.shares[i];
    Vec3 sum;
    float weights = 0;
    for (size_t k = 0; k < kMostTellers && shares.weight[k] > 0; ++k)
      sum += told[shares.teller[k]] * shares.weight[k], weights += shares.weight[k];
    if (sum.z <= kLeastLux * weights) continue;
    const auto share = [&](float along) {
      return 0.5f + 0.5f * std::clamp(along / (2 * sum.z), -kMostLean, kMostLean);
    };
    layer.lean[turned.elements[i]] = Vec3(share(sum.x), share(sum.y), 1) * kLeanOfOne;
  }
  layer.lux.resize(lit.places.size()), layer.errorLux.resize(lit.places.size());
}

}  // namespace roomlight::bake
