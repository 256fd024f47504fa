#include "look/exposure.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace roomlight {
namespace {

constexpr double kMiddleGrey = 0.18;
constexpr double kAboveEv = 2.5, kBelowEv = 6.5;  // from the median on, light is that of windows and lamps, or of holes
constexpr double kVoidEv =
    0.4;  // more for a picture that is all void, as a camera gives it that meters all of its frame
constexpr float kEdge = 0.3f;  // weight of the edges of the picture
constexpr float kWide = 0.55f;  // of the middle, in shares of width and height

struct Place {
  float log2;
  float weight;
};

double median(std::vector<Place>& places) {
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.log2 < b.log2; });
  double all = 0, upTo = 0;
  for (const Place& p : places) all += static_cast<double>(p.weight);
  for (const Place& p : places) {
    upTo += static_cast<double>(p.weight);
    if (2 * upTo >= all) return static_cast<double>(p.log2);
  }
  return static_cast<double>(places.back().log2);
}

}  // namespace

float lookedAtEv100(const Image& image) {
  std::vector<Place> places;
  places.reserve(image.pixels.size());
  for (int y = 0; y < image.height; ++y) {
    const float v = ((static_cast<float>(y) + 0.5f) / static_cast<float>(image.height) - 0.5f) / kWide;
    for (int x = 0; x < image.width; ++x) {
      const float l = luminance(image.at(x, y));
      if (!(l > 0) || !std::isfinite(l)) continue;
      const float u = ((static_cast<float>(x) + 0.5f) / static_cast<float>(image.width) - 0.5f) / kWide;
      places.push_back({std::log2(l), kEdge + (1 - kEdge) * std::exp(-2 * (u * u + v * v))});
    }
  }
  if (places.empty()) return 0;
  const double middle = median(places);
  double sum = 0, weight = 0;
  for (const Place& p : places) {
    if (static_cast<double>(p.log2) > middle + kAboveEv || static_cast<double>(p.log2) < middle - kBelowEv) continue;
    sum += static_cast<double>(p.log2 * p.weight), weight += static_cast<double>(p.weight);
  }
  const double empty = 1 - static_cast<double>(places.size()) / static_cast<double>(image.pixels.size());
  return static_cast<float>(sum / weight - std::log2(kMiddleGrey * 1.2) - kVoidEv * empty);
}

Image pixelsWhere(const Image& image, const std::vector<bool>& mask, bool so) {
  Image out;
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    if (mask[i] == so) out.pixels.push_back(image.pixels[i]);
  }
  out.width = static_cast<int>(out.pixels.size()), out.height = 1;
  return out;
}

void holdGrounds(Image& image, const std::vector<bool>& rooms, float ev100) {
  constexpr float kMostEv = 2.0f / 3;
  Image grounds = pixelsWhere(image, rooms, false);
  std::erase_if(grounds.pixels, [](Vec3 p) { return !(luminance(p) > 0); });
  grounds.width = static_cast<int>(grounds.pixels.size());
  if (grounds.width == 0) return;
  const float over = lookedAtEv100(grounds) - ev100 - kMostEv;
  if (!(over > 0)) return;
  const float gain = std::exp2(-over);
  for (size_t i = 0; i < rooms.size(); ++i) {
    if (!rooms[i]) image.pixels[i] *= gain;
  }
}

}  // namespace roomlight
