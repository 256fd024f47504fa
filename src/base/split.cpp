#include "base/image_layers.h"

#include "base/parallel.h"

namespace roomlight {
namespace {

constexpr float kLeast = 0.1f;  // of a part stays

// What the parts have of all the picture.
std::vector<float> sharesOf(const std::vector<Image>& parts) {
  std::vector<float> shares;
  double all = 0;
  for (const Image& part : parts) {
    double sum = 0;
    for (const Vec3& p : part.pixels) sum += static_cast<double>(luminance(max(p, Vec3(0))));
    shares.push_back(static_cast<float>(sum));
    all += sum;
  }
  for (float& s : shares) s = all > 0 ? s / static_cast<float>(all) : 1 / static_cast<float>(parts.size());
  return shares;
}

}  // namespace

void splitLike(const Image& whole, std::vector<Image>& parts) {
  if (parts.empty()) return;
  const std::vector<float> shares = sharesOf(parts);
  parallelFor(whole.pixels.size(), 4096, [&](size_t i) {
    Vec3 sum, squares;
    for (Image& part : parts) {
      const Vec3 p = part.pixels[i] = max(part.pixels[i], Vec3(0));
      sum += p, squares += p * p;
    }
    const Vec3 all = whole.pixels[i], missing = all - sum;
    const float white = sum.x + sum.y + sum.z;
    Vec3 after;
    for (size_t k = 0; k < parts.size(); ++k) {
      Vec3& p = parts[k].pixels[i];
      const float share = white > 0 ? (p.x + p.y + p.z) / white : shares[k];
      for (int c = 0; c < 3; ++c)
        p[c] = squares[c] > 0 ? p[c] * std::max(kLeast, 1 + missing[c] * p[c] / squares[c]) : all[c] * share;
      after += p;
    }
    for (Image& part : parts) {
      for (int c = 0; c < 3; ++c) part.pixels[i][c] *= after[c] > 0 ? all[c] / after[c] : 0;
    }
  });
}

}  // namespace roomlight
