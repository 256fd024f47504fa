// What must hold of everything that a reader of photometric files returns.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "fuzz/fuzz_support.h"
#include "photometry/ies.h"
#include "photometry/web_sampler.h"

namespace roomlight::fuzz {

inline bool isOneLine(const std::string& s) {
  return !s.empty() && s.size() < 1000 && s.find('\n') == std::string::npos;
}

inline void check(const Result<WebFile>& file) {
  if (!file) return require(isOneLine(file.error()));
  const PhotometricWeb& web = file.value().web;
  for (const std::string& w : file.value().warnings) require(isOneLine(w));
  require(web.cRad.size() >= 2 && web.gammas() >= 2 && web.candela.size() == web.cRad.size() * web.gammas());
  for (size_t i = 1; i < web.cRad.size(); ++i) require(web.cRad[i] > web.cRad[i - 1]);
  for (size_t i = 1; i < web.gammas(); ++i) require(web.gammaRad[i] > web.gammaRad[i - 1]);
  for (const float cd : web.candela) require(cd >= 0 && cd <= web.peakCd);
  require(std::isfinite(web.peakCd) && web.peakCd > 0 && std::isfinite(web.fluxLm) && web.fluxLm > 0);
  require(std::isfinite(web.sizeC0M) && std::isfinite(web.sizeC90M) && (web.sizeC0M > 0) == (web.sizeC90M > 0));
  const WebSampler sampler(web);
  for (const Vec2 u : {Vec2{0, 0}, Vec2{0.3f, 0.7f}, Vec2{0.999999f, 0.999999f}}) {
    float pdf = 0;
    const Vec3 d = sampler.sample(u, pdf);
    require(std::abs(length(d) - 1) < 1e-3f && pdf > 0 && std::isfinite(pdf));
    require(std::isfinite(intensityCd(web, d)));
  }
}

}  // namespace roomlight::fuzz
