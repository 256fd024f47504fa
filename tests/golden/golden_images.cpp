// Renders the golden pictures anew: golden_images SAMPLES. Once for every change that is meant to change them. With a
// number of seeds after it, writes nothing and prints how far pictures of the test's samples lie from the golden ones.
// With the name of a scene after that, of it alone.
#include <fmt/format.h>

#include <cstdlib>

#include "golden/blocks.h"
#include "golden/scenes.h"

using namespace roomlight;
using namespace roomlight::test;

int main(int argc, char** argv) {
  const int samples = argc > 1 ? std::atoi(argv[1]) : 0, seeds = argc > 2 ? std::atoi(argv[2]) : 0;
  if (samples < 2) {
    fmt::print(stderr, "usage: golden_images SAMPLES [SEEDS [SCENE]]\n");
    return 2;
  }
  for (const GoldenScene& g : goldenScenes()) {
    if (argc > 3 && g.name != argv[3]) continue;
    for (int seed = 0; seed < seeds; ++seed) {
      const PathResult r = pathOf(g.scene, g.camera, samples, static_cast<uint64_t>(1000 + seed));
      const Deviation d = largestDeviation(readGolden(g.name).value(), blocksOf(r.image, &r.variance));
      fmt::print("{} seed {}: {:.2f} at {}\n", g.name, seed, d.z, d.where);
    }
    if (seeds > 0) continue;
    const PathResult r = pathOf(g.scene, g.camera, samples, 1);
    const Status written = writeGolden(g.name, blocksOf(r.image, &r.variance), samples);
    if (!written) {
      fmt::print(stderr, "{}\n", written.error());
      return 1;
    }
    fmt::print("{}: {} rays, noise a pixel {:.4f}\n", g.name, r.rays, r.noise);
  }
}
