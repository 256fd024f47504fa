#include "study/references.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/image_io.h"
#include "compare/compare.h"
#include "engine/settings.h"

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

// What has been rendered so far.
struct Rounds {
  Half halves[2];
  int count = 0;
  double seconds = 0;   // that it took
  double noiseMse = 0;  // of the halves' mean
};

// What an earlier run left; nothing where a half is missing or has another size.
Rounds roundsIn(const RunStore& store, const ReferenceWish& wish) {
  const auto kept = store.find(wish.key);
  if (!kept) return {};
  Rounds rounds;
  rounds.count = kept->value("rounds", 0);
  for (size_t i = 0; i < 2; ++i) {
    Result<Image> read = readImage(fileOfHalf(store, wish.key, rounds.count, i));
    if (!read || read.value().width != wish.view.width || read.value().height != wish.view.height) return {};
    rounds.halves[i].sum = std::move(read.value());
    rounds.halves[i].samples = kept->value("samples", 0.0) / 2;
  }
  if (!(rounds.halves[1].samples > 0)) return {};
  rounds.seconds = kept->value("seconds", 0.0);
  rounds.noiseMse = kept->value("noiseMse", 1.0);
  return rounds;
}

Status keepRounds(const Rounds& rounds, const RunStore& store, const RunStore::Key& key) {
  for (size_t i = 0; i < 2; ++i) {
    if (const Status s = writeExr(fileOfHalf(store, key, rounds.count, i), rounds.halves[i].sum, {}); !s) return s;
  }
  return store.keep(key, {{"rounds", rounds.count},
                          {"seconds", rounds.seconds},
                          {"samples", rounds.halves[0].samples + rounds.halves[1].samples},
                          {"noiseMse", rounds.noiseMse}});
}

// One picture of a round.
struct RoundPicture {
  Image image;
  double samples = 0, seconds = 0;
};

Result<RoundPicture> renderRound(const ReferenceWish& wish, uint64_t seed, const RunStore& store,
                                 const StudyTools& tools) {
  StudyRender ask = wish.view;
  ask.technique = technique::kPath, ask.settings = "{}", ask.samples = 0, ask.timeLimitS = wish.settings.roundS;
  ask.seed = seed;
  ask.picture = store.file(wish.key, "_round.exr");
  const Result<RenderCost> cost = tools.render(ask);
  if (!cost) return Error{cost.error()};
  Result<Image> read = readImage(ask.picture);
  if (!read) return Error{read.error()};
  std::error_code ignored;
  std::filesystem::remove(ask.picture, ignored);
  return RoundPicture{std::move(read.value()), std::max(1.0, cost.value().samples), cost.value().seconds};
}

Status addRound(Rounds& rounds, const ReferenceWish& wish, const RunStore& store, const StudyTools& tools) {
  RoundPicture pictures[2];
  for (uint64_t i = 0; i < 2; ++i) {
    Result<RoundPicture> made = renderRound(wish, 1000 + 2 * static_cast<uint64_t>(rounds.count) + i, store, tools);
    if (!made) return Error{made.error()};
    pictures[i] = std::move(made.value());
    rounds.seconds += pictures[i].seconds;
  }
  // Both halves get the same weights, or one would be the noisier.
  const double each = (pictures[0].samples + pictures[1].samples) / 2;
  for (size_t i = 0; i < 2; ++i) add(rounds.halves[i], pictures[i].image, each);
  const Result<double> noise = noiseOfMean(rounds.halves[0].sum, rounds.halves[1].sum);
  if (!noise) return Error{fmt::format("reference: {}", noise.error())};
  rounds.noiseMse = noise.value();
  ++rounds.count;
  return keepRounds(rounds, store, wish.key);
}

}  // namespace

Result<Reference> makeReference(const ReferenceWish& wish, const RunStore& store, const StudyTools& tools,
                                const StudyProgress& progress, const std::function<void(double)>& heard) {
  const ReferenceSettings& settings = wish.settings;
  Rounds rounds = roundsIn(store, wish);
  const auto enough = [&] {
    return rounds.count > 0 && (rounds.noiseMse <= settings.noiseMse || rounds.seconds >= settings.mostS);
  };
  while (!enough() && !progress.stop()) {
    if (heard) heard(std::min(1.0, rounds.seconds / settings.mostS));
    if (const Status s = addRound(rounds, wish, store, tools); !s) return Error{s.error()};
  }
  if (rounds.count == 0) return Error{"stopped before there was a reference"};
  Reference reference;
  reference.firstFile = fileOfHalf(store, wish.key, rounds.count, 0);
  reference.secondFile = fileOfHalf(store, wish.key, rounds.count, 1);
  reference.first = std::move(rounds.halves[0].sum), reference.second = std::move(rounds.halves[1].sum);
  reference.noiseMse = rounds.noiseMse;
  reference.seconds = rounds.seconds;
  reference.samples = rounds.halves[0].samples + rounds.halves[1].samples;
  reference.converged = reference.noiseMse <= settings.noiseMse;
  return reference;
}

}  // namespace roomlight
