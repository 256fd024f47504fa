// Photometric webs for tests, made from functions of C and gamma.
#pragma once

#include <functional>
#include <memory>

#include "photometry/photometric_web.h"
#include "scene/scene.h"

namespace roomlight::test {

// Candela at every degree of gamma up to `lastGammaDeg` and every `stepDeg` of C. Sizes in metres; 0: a point.
inline std::shared_ptr<const PhotometricWeb> makeWeb(const std::function<float(float cRad, float gammaRad)>& candela,
                                                     int lastGammaDeg = 90, int stepDeg = 90, float sizeC0M = 0,
                                                     float sizeC90M = 0, bool round = false) {
  auto web = std::make_shared<PhotometricWeb>();
  for (int g = 0; g <= lastGammaDeg; ++g) web->gammaRad.push_back(static_cast<float>(g) * kPi / 180);
  for (int c = 0; c <= 360; c += stepDeg) {
    web->cRad.push_back(static_cast<float>(c) * kPi / 180);
    for (const float gamma : web->gammaRad)
      web->candela.push_back(std::max(0.0f, candela(static_cast<float>(c % 360) * kPi / 180, gamma)));
  }
  web->sizeC0M = sizeC0M, web->sizeC90M = sizeC90M, web->round = round;
  sumUp(*web);
  return web;
}

// Straight down, C0 along +x; as large as the web's opening where it has one.
inline Lamp webLamp(Vec3 position, std::shared_ptr<const PhotometricWeb> web) {
  Lamp lamp;
  lamp.position = position;
  lamp.intensityCd = Vec3(web->peakCd);
  lamp.extended = web->hasOpening();
  lamp.web = std::move(web);
  return lamp;
}

inline std::shared_ptr<const PhotometricWeb> lambertianWeb(float peakCd, float sizeC0M = 0, float sizeC90M = 0,
                                                           bool round = false) {
  return makeWeb([=](float, float g) { return peakCd * std::cos(g); }, 90, 90, sizeC0M, sizeC90M, round);
}

}  // namespace roomlight::test
