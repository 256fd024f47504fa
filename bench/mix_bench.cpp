// A mix of 14 layers at 1920x1080, to bytes for a screen: the arguments are threads. Beside it what memory allows (the
// same bytes summed), and the sum alone of layers kept as 32-bit and as half floats. Needs no home.
#include <benchmark/benchmark.h>

#include <random>

#include "base/parallel.h"
#include "base/simd.h"
#include "mix/mixer.h"

namespace roomlight::bench {
namespace {

constexpr int kWidth = 1920, kHeight = 1080;
constexpr size_t kLayers = 14, kPixels = size_t{kWidth} * kHeight;

Image someLight(size_t seed) {
  std::mt19937 random(static_cast<uint32_t>(seed));
  std::exponential_distribution<float> light(0.1f);
  Image image(kWidth, kHeight);
  for (Vec3& p : image.pixels) p = {light(random), light(random), light(random)};
  return image;
}

const LayerStack& stack() {
  static const LayerStack filled = [] {
    LayerStack s = makeLayerStack(kWidth, kHeight, kLayers);
    for (size_t i = 0; i < kLayers; ++i) setLayer(s, i, someLight(i));
    return s;
  }();
  return filled;
}

std::vector<Vec3> gains() {
  std::vector<Vec3> g;
  for (size_t i = 0; i < kLayers; ++i) g.push_back(Vec3(0.9f, 1, 1.1f) * (0.1f * static_cast<float>(i + 1)));
  return g;
}

template <class Work>
void onThreads(benchmark::State& state, double bytes, Work&& work) {
  withThreads(static_cast<int>(state.range(0)), [&] {
    for (auto _ : state) work();
  });
  state.SetBytesProcessed(static_cast<int64_t>(bytes * static_cast<double>(state.iterations())));
}

void display(benchmark::State& state, ToneCurve tone) {
  const std::vector<Vec3> g = gains();
  const LayerStack& s = stack();
  onThreads(state, static_cast<double>(s.tiles.size() * sizeof(PackedTile)), [&] {
    ByteImage image = mixDisplay(s, g, {4, tone, {}});
    benchmark::DoNotOptimize(image.samples.data());
  });
}

void linear(benchmark::State& state) {
  const std::vector<Vec3> g = gains();
  const LayerStack& s = stack();
  onThreads(state, static_cast<double>(s.tiles.size() * sizeof(PackedTile)), [&] {
    Image image = mixLinear(s, g);
    benchmark::DoNotOptimize(image.pixels.data());
  });
}

// Reads the packed layers once and does next to nothing with them.
void memoryAlone(benchmark::State& state) {
  const LayerStack& s = stack();
  const auto* words = reinterpret_cast<const uint64_t*>(s.tiles.data());
  const size_t count = s.tiles.size() * sizeof(PackedTile) / sizeof(uint64_t);
  onThreads(state, static_cast<double>(count * sizeof(uint64_t)), [&] {
    parallelRanges(count, 1 << 17, [&](size_t begin, size_t end) {
      uint64_t sum = 0;
      for (size_t i = begin; i < end; ++i) sum += words[i];
      benchmark::DoNotOptimize(sum);
    });
  });
}

// The other ways to keep layers, in the same tiles; the sum stays in the cache.
template <class Stored, class Add>
void sumOf(benchmark::State& state, Add&& add) {
  constexpr size_t kTile = 3 * kTilePixels, kRuns = kPixels / kTilePixels;
  static const std::vector<Stored> kept(kRuns * kLayers * kTile);
  onThreads(state, static_cast<double>(kept.size() * sizeof(Stored)), [&] {
    parallelFor(kRuns, 8, [&](size_t run) {
      float sum[kTile] = {};
      for (size_t layer = 0; layer < kLayers; ++layer)
        add(sum, kept.data() + (run * kLayers + layer) * kTile, kTile, 0.1f * static_cast<float>(layer));
      benchmark::DoNotOptimize(sum);
    });
  });
}

void asFloats(benchmark::State& state) {
  sumOf<float>(state, [](float* sum, const float* light, size_t count, float gain) {
    for (size_t i = 0; i < count; ++i) sum[i] += gain * light[i];
  });
}

void asHalves(benchmark::State& state) {
  sumOf<uint16_t>(state, [](float* sum, const uint16_t* light, size_t count, float gain) {
    for (size_t i = 0; i < count; i += 8) {
      fma(Float8(gain), fromHalf8(light + i), Float8::load(sum + i)).store(sum + i);
    }
  });
}

void configure(benchmark::internal::Benchmark* b) {
  b->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
}
BENCHMARK_CAPTURE(display, neutral, ToneCurve::PbrNeutral)->Apply(configure);
BENCHMARK_CAPTURE(display, agx, ToneCurve::AgX)->Apply(configure);
BENCHMARK_CAPTURE(display, filmic, ToneCurve::Filmic)->Apply(configure);
BENCHMARK_CAPTURE(display, clip, ToneCurve::Clip)->Apply(configure);
BENCHMARK(linear)->Apply(configure);
BENCHMARK(memoryAlone)->Apply(configure);
BENCHMARK(asFloats)->Apply(configure);
BENCHMARK(asHalves)->Apply(configure);

}  // namespace
}  // namespace roomlight::bench

BENCHMARK_MAIN();
