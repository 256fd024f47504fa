#include "photometry/photometric_web.h"

#include <algorithm>

namespace roomlight {
namespace {

// Chooses among `count` shares whose upper ends begin at `upTo`; `u` becomes the place inside the chosen one, 0 to 1.
// Shares of zero are never chosen.
size_t choose(const float* upTo, size_t count, float& u) {
  const auto i = std::min(static_cast<size_t>(std::upper_bound(upTo, upTo + count, u) - upTo), count - 1);
  const float from = i > 0 ? upTo[i - 1] : 0, share = upTo[i] - from;
  u = share > 0 ? std::clamp((u - from) / share, 0.0f, 1.0f) : 0.5f;
  return i;
}

// Upper ends of the shares, the last and all empty ones after it exactly 1.
void accumulate(const std::vector<double>& parts, double total, float* upTo) {
  double sum = 0;
  size_t last = 0;
  for (size_t i = 0; i < parts.size(); ++i) {
    sum += parts[i];
    upTo[i] = static_cast<float>(total > 0 ? sum / total : 0);
    if (parts[i] > 0) last = i;
  }
  for (size_t i = last; i < parts.size(); ++i) upTo[i] = 1;
}

}  // namespace

WebSampler::WebSampler(const PhotometricWeb& web) : web_(web), planes_(web.cRad.size() - 1) {
  const size_t rows = web.gammas() - 1;
  rowUpTo_.resize(rows), upTo_.resize(rows * planes_), density_.resize(rows * planes_);
  std::vector<double> ofRow(rows), ofCell(planes_);
  for (size_t g = 0; g < rows; ++g) {
    for (size_t c = 0; c < planes_; ++c) ofRow[g] += ofCell[c] = cellFluxLm(web, c, g);
    accumulate(ofCell, ofRow[g], &upTo_[g * planes_]);
    const double height =
        std::cos(static_cast<double>(web.gammaRad[g])) - std::cos(static_cast<double>(web.gammaRad[g + 1]));
    for (size_t c = 0; c < planes_; ++c) {
      const double width = static_cast<double>(web.cRad[c + 1]) - static_cast<double>(web.cRad[c]);
      density_[g * planes_ + c] = static_cast<float>(ofCell[c] / (web.fluxLm * height * width));
    }
  }
  accumulate(ofRow, web.fluxLm, rowUpTo_.data());
}

Vec3 WebSampler::sample(Vec2 u, float& pdf) const {
  const size_t g = choose(rowUpTo_.data(), rowUpTo_.size(), u.x);
  const size_t c = choose(&upTo_[g * planes_], planes_, u.y);
  pdf = density(c, g);
  // 1 - cos of gamma, exact close to the nadir; its even places are even over the sphere.
  const auto oneMinusCos = [](float gamma) { return 2 * std::sin(gamma / 2) * std::sin(gamma / 2); };
  const float h = lerp(oneMinusCos(web_.gammaRad[g]), oneMinusCos(web_.gammaRad[g + 1]), u.x),
              phi = lerp(web_.cRad[c], web_.cRad[c + 1], u.y);
  const float across = std::sqrt(std::max(0.0f, h * (2 - h)));
  return {across * std::cos(phi), across * std::sin(phi), h - 1};
}

float WebSampler::pdf(Vec3 direction) const {
  const WebPlace at = placeInWeb(web_, direction);
  return at.dark ? 0 : density(at.plane, at.gamma);
}

}  // namespace roomlight
