#include "bake/meter_chunks.h"

#include <fmt/format.h>

#include "base/hash.h"

namespace roomlight::bake {
namespace {

constexpr size_t kPlaces = 16384;  // a chunk: some seconds of work

}  // namespace

bool MeterChunks::read(const Measure& measure, const Take& take, const Progress& progress) const {
  for (size_t first = 0; first < places.size(); first += kPlaces) {
    const std::span<const SurfaceElement> chunk = places.subspan(first, std::min(kPlaces, places.size() - first));
    MeterSettings settings = meters;
    settings.seed = meters.seed + first / kPlaces;
    Hash hash;
    hash.bytes(inputs);
    hash.word(settings.seed);
    hash.bytes({reinterpret_cast<const char*>(chunk.data()), chunk.size_bytes()});
    const std::string name = hash.text();
    if (const auto known = kept.find(name, chunk.size() * numbersAPlace)) {
      take(first, *known);
      continue;
    }
    Progress ofChunk = progress;
    ofChunk.report = [&](float f) {
      progress.at((static_cast<float>(first) + f * static_cast<float>(chunk.size())) /
                  static_cast<float>(places.size()));
    };
    const std::vector<float> numbers = measure(chunk, settings, ofChunk);
    if (progress.stop()) return false;
    kept.keep(name, numbers);
    take(first, numbers);
  }
  return !progress.stop();
}

}  // namespace roomlight::bake
