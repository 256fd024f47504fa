// Any bytes as files of weather and luminaires: no crash, no hang. An error is one short line.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "fuzz/fuzz_support.h"
#include "photometry/epw.h"
#include "photometry/photometric_web.h"
#include "photometry/web_files.h"

namespace roomlight::fuzz {
namespace {

bool isOneLine(const std::string& s) { return !s.empty() && s.size() < 1000 && s.find('\n') == std::string::npos; }

// What must hold of everything that a reader of photometric files returns.
void check(const Result<WebFile>& file) {
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

}  // namespace

// Any bytes as a weather file: no crash, no hang; an error is one short line, and what is accepted is in range.
void epw(const uint8_t* data, size_t size) {
  const Result<Epw> weather = parseEpw({reinterpret_cast<const char*>(data), size});
  if (!weather) {
    if (weather.error().empty() || weather.error().size() > 500 || weather.error().find('\n') != std::string::npos)
      std::abort();
    return;
  }
  for (const EpwHour& h : weather.value().hours) {
    for (const auto& v : {h.directNormalWm2, h.diffuseHorizontalWm2, h.directNormalLux, h.diffuseHorizontalLux}) {
      if (v && !(*v >= 0 && *v < 1e6)) std::abort();
    }
  }
  for (const int month : {1, 2, 12}) hourAt(weather.value(), {2024, month, 29, 23.5});
}

// Any bytes as an IES file, and as the file that its TILT= names: no crash, no hang. An error is one short line; what
// is accepted is a finite web that can be sampled.
void ies(const uint8_t* data, size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  check(parseIes(text, [&](const std::string&) { return Result<std::string>(text); }));
}

// Any bytes as an EULUMDAT file: no crash, no hang. An error is one short line; what is accepted is a finite web that
// can be sampled.
void eulumdat(const uint8_t* data, size_t size) { check(parseEulumdat({reinterpret_cast<const char*>(data), size})); }

}  // namespace roomlight::fuzz
