#include "study/references.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/image_io.h"
#include "compare/compare.h"

namespace roomlight {
namespace {

// One of the two, with what has gone into it.
struct Half {
  Image sum;  // the mean so far
  double samples = 0;
};

// The mean of what there was and a new picture, weighed by samples.
void add(Half& half, const Image& picture, double samples) {
  if (half.samples <= 0) {
    half.sum = picture;
  } else {
    const float share = static_cast<float>(samples / (half.samples + samples));
    for (size_t i = 0; i < picture.pixels.size(); ++i)
      half.sum.pixels[i] = half.sum.pixels[i] * (1 - share) + picture.pixels[i] * share;
  }
  half.samples += samples;
}

// Of two independent pictures the squared difference has the noise of both, their mean a quarter of that.
Result<double> noiseOfMean(const Image& a, const Image& b) {
  const Result<Report> r = compare(a, b);
  if (!r) return Error{r.error()};
  return r.value().mse / 4;
}

// Halves of every other round have files of their own, so that those of the last one are whole whenever the work ends.
std::filesystem::path fileOfHalf(const RunStore& store, const RunStore::Key& key, int round, size_t half) {
  return store.file(key, fmt::format("_{}{}.exr", half + 1, round % 2 ? "b" : "a"));
}

}  // namespace

Result<Reference> makeReference(const RunStore& store, const RunStore::Key& key, const StudyRender& view,
                                const ReferenceSettings& settings, const StudyTools& tools,
                                const StudyProgress& progress, const std::function<void(double)>& heard) {
  Half halves[2];
  int rounds = 0;
  double seconds = 0;
  Reference reference;
  if (const auto kept = store.find(key)) {
    const int last = kept->value("rounds", 0);
    for (size_t i = 0; i < 2; ++i) {
      Result<Image> read = readImage(fileOfHalf(store, key, last, i));
      if (!read || read.value().width != view.width || read.value().height != view.height) break;
      halves[i].sum = std::move(read.value());
      halves[i].samples = kept->value("samples", 0.0) / 2;
    }
    if (halves[1].samples > 0) {
      rounds = last, seconds = kept->value("seconds", 0.0);
      reference.noiseMse = kept->value("noiseMse", 1.0);
    } else {
      halves[0] = {};
    }
  }
  const auto enough = [&] {
    return rounds > 0 && (reference.noiseMse <= settings.noiseMse || seconds >= settings.mostS);
  };
  while (!enough() && !progress.stop()) {
    if (heard) heard(std::min(1.0, seconds / settings.mostS));
    Image pictures[2];
    double samples[2] = {};
    for (uint64_t i = 0; i < 2; ++i) {
      StudyRender ask = view;
      ask.technique = "path", ask.settings = "{}", ask.samples = 0, ask.timeLimitS = settings.roundS;
      ask.seed = 1000 + 2 * static_cast<uint64_t>(rounds) + i;
      ask.picture = store.file(key, "_round.exr");
      const Result<RenderCost> cost = tools.render(ask);
      if (!cost) return Error{cost.error()};
      Result<Image> read = readImage(ask.picture);
      if (!read) return Error{read.error()};
      pictures[i] = std::move(read.value());
      samples[i] = std::max(1.0, cost.value().samples);
      seconds += cost.value().seconds;
      std::error_code ignored;
      std::filesystem::remove(ask.picture, ignored);
    }
    // Both halves get the same weights, or one would be the noisier.
    const double each = (samples[0] + samples[1]) / 2;
    for (size_t i = 0; i < 2; ++i) add(halves[i], pictures[i], each);
    const Result<double> noise = noiseOfMean(halves[0].sum, halves[1].sum);
    if (!noise) return Error{fmt::format("reference: {}", noise.error())};
    reference.noiseMse = noise.value();
    ++rounds;
    for (size_t i = 0; i < 2; ++i) {
      if (const Status s = writeExr(fileOfHalf(store, key, rounds, i), halves[i].sum, {}); !s) return Error{s.error()};
    }
    const nlohmann::json kept = {{"rounds", rounds},
                                 {"seconds", seconds},
                                 {"samples", halves[0].samples + halves[1].samples},
                                 {"noiseMse", reference.noiseMse}};
    if (const Status s = store.keep(key, kept); !s) return Error{s.error()};
  }
  if (rounds == 0) return Error{"stopped before there was a reference"};
  reference.firstFile = fileOfHalf(store, key, rounds, 0), reference.secondFile = fileOfHalf(store, key, rounds, 1);
  reference.first = std::move(halves[0].sum), reference.second = std::move(halves[1].sum);
  reference.seconds = seconds;
  reference.samples = halves[0].samples + halves[1].samples;
  reference.converged = reference.noiseMse <= settings.noiseMse;
  return reference;
}

}  // namespace roomlight
