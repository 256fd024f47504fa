// Removes what noise a few samples leave: an edge-avoiding a-trous filter of reflected light, guided by what is seen
// and by the noise itself (Dammertz et al. 2010; variance guidance after Schied et al. 2017, section 4.4; comparison of
// small patches after Rousselle et al. 2012). About 0.14 s of one core for 960x540.
#pragma once

#include <functional>
#include <vector>

#include "base/image.h"

namespace roomlight {

constexpr float kMirrorRoughness =
    0.08f;  // reflections of smoother surfaces are pictures, not light: they are left alone

// Means over a pixel's samples.
struct FilterPixel {
  Vec3 diffuse, sharp, albedo, specular,
      rest;  // the picture is diffuse + rare + sharp + specular + rest; albedo is of the first three
  Vec3 rare;  // diffuse light that single samples found far beyond what all should find: noise for the most part,
  // spread as widely as surfaces allow
  float diffuseVariance = 0, sharpVariance = 0;  // of the luminance of diffuse / albedo and sharp / albedo, as means
  float specularVariance = 0;
  Vec3 normal, position;
  float roughness = 0;
  float open = 1;  // 0..1: how open it is to what lies near, a mean always; equal everywhere: not known
  float surface = 0;  // 0..1: share of samples that saw a surface
  float weight = 1;  // samples that the pixel stands for among its neighbours,
  float diffuseShare = 1,
        specularShare = 1;  // and how many times as many of these lights; 0: none, its neighbours tell
};

// What a pixel shows of other things in panes: what these reflect is filtered as surfaces themselves are.
struct ReflectedPlace {  // sums of unit normals and places, and of what they weigh
  Vec3 normal, position;
  float weight = 0;
  void scale(float by) { normal *= by, position *= by, weight *= by; }
  void add(const ReflectedPlace& other, float by) {
    normal += other.normal * by, position += other.position * by, weight += other.weight * by;
  }
};

struct FilterInput {
  int width = 0, height = 0;
  bool wraps = false;  // the picture goes on at its other side, as panoramas do
  bool byLevels = false;  // no outliers are in the variance of diffuse light (as where rare light is apart): it is
  // filtered by levels
  std::vector<FilterPixel> pixels;
  std::vector<ReflectedPlace> reflected;  // of each pixel; may be empty
  FilterInput(int w, int h) : width(w), height(h), pixels(static_cast<size_t>(w) * static_cast<size_t>(h)) {}
  FilterPixel& at(int x, int y) {
    return pixels[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
  }
};

Image composed(const FilterInput& input);  // without filtering
// Pass k looks 2^k pixels far. Diffuse light is filtered as irradiance, so textures stay sharp; mirrors are left alone.
// `once`, where given and unless it wraps: diffuse light over albedo after the first pass.
// `irradiance`, where given: diffuse light over albedo after all passes.
Image filtered(const FilterInput& input, int passes, std::vector<Vec3>* once = nullptr,
               std::vector<Vec3>* irradiance = nullptr);
// Pixels on edges are means of two surfaces that no pass filters as either: of a filtered image they are kept within
// what the eight pixels around show, unless most of their light is `rest` or they are far brighter.
void boundEdges(const FilterInput& means, Image& image);
// What is left after so many passes, a pixel each: its luminance without rare light, and the variance of that.
struct FilteredLuminance {
  std::vector<float> luminance, variance;
};
// `mean` makes pixel i's means of what `sums` has there.
FilteredLuminance filteredLuminance(const FilterInput& sums, int passes,
                                    const std::function<FilterPixel(size_t i)>& mean);

}  // namespace roomlight
