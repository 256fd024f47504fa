#include "baselines/photon_map.h"

#include <gtest/gtest.h>

#include <set>

#include "base/parallel.h"
#include "base/random.h"
#include "base/sampling.h"

namespace roomlight {
namespace {

std::vector<Photon> randomPhotons(size_t count, uint64_t seed) {
  std::vector<Photon> photons;
  Rng rng(seed, 0, 0);
  for (size_t i = 0; i < count; ++i) {
    Photon photon;
    const Vec2 u = rng.uniform2();
    photon.p = {4 * u.x, 3 * u.y, i % 3 == 0 ? 1.0f : 5 * rng.uniform()};
    photon.n = sampleSphere(rng.uniform2()), photon.wi = sampleSphere(rng.uniform2());
    photon.fluxLm = Vec3(rng.uniform(), rng.uniform(), rng.uniform()) * std::exp2(20 * rng.uniform() - 10);
    photons.push_back(photon);
  }
  return photons;
}

class PhotonMapOf : public testing::TestWithParam<size_t> {};

TEST_P(PhotonMapOf, FindsTheNearestAsASearchOfAllDoes) {
  const std::vector<Photon> photons = randomPhotons(GetParam(), 7);
  const PhotonMap map(photons);
  ASSERT_EQ(map.size(), photons.size());
  Rng rng(1, 2, 3);
  std::vector<NearPhoton> near;
  for (int k = 0; k < 60; ++k) {
    PhotonQuery query;
    const Vec2 u = rng.uniform2();
    query.p = {5 * u.x - 0.5f, 4 * u.y - 0.5f, 5 * rng.uniform()};
    query.n = sampleSphere(rng.uniform2());
    query.cosNormal = k % 2 == 0 ? -1.0f : 0.3f;
    query.flatness = k % 3 == 0 ? 1.0f : 4.0f;
    query.radiusM = k % 5 == 0 ? 0.5f : kInfinity;
    const size_t wanted = k % 7 == 0 ? 1 : 20;
    map.nearest(query, wanted, near);
    std::vector<float> expected;
    for (size_t i = 0; i < map.size(); ++i) {
      if (dot(map.normal(i), query.n) < query.cosNormal) continue;
      const Vec3 d = map.place(i) - query.p;
      const float along = dot(d, query.n),
                  d2 = lengthSquared(d) + (query.flatness * query.flatness - 1) * along * along;
      if (d2 <= query.radiusM * query.radiusM) expected.push_back(d2);
    }
    std::sort(expected.begin(), expected.end());
    expected.resize(std::min(expected.size(), wanted));
    std::vector<float> found;
    std::set<uint32_t> numbers;
    for (const NearPhoton photon : near) found.push_back(photon.distance2), numbers.insert(photon.index);
    std::sort(found.begin(), found.end());
    EXPECT_EQ(numbers.size(), near.size());
    ASSERT_EQ(found.size(), expected.size());
    for (size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-5f * (1 + expected[i]));
  }
}
INSTANTIATE_TEST_SUITE_P(Counts, PhotonMapOf, testing::Values(0, 1, 2, 15, 16, 17, 31, 33, 100, 1000, 20011));

TEST(PhotonMap, KeepsPowersDirectionsAndOrderOfPhotons) {
  const std::vector<Photon> photons = randomPhotons(5000, 3);
  std::vector<uint32_t> order;
  const PhotonMap map(photons, &order);
  ASSERT_EQ(order.size(), photons.size());
  Vec3 kept, sum;
  for (size_t i = 0; i < map.size(); ++i) {
    const Photon& photon = photons[order[i]];
    EXPECT_EQ(map.place(i), photon.p);
    EXPECT_GT(dot(map.normal(i), photon.n), 0.9997f);
    EXPECT_GT(dot(map.direction(i), photon.wi), 0.9997f);
    const Vec3 off = abs(map.fluxLm(i) - photon.fluxLm);
    EXPECT_LE(maxComponent(off), maxComponent(photon.fluxLm) / 250);
    kept += map.fluxLm(i), sum += photon.fluxLm;
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(kept[c], sum[c], 5e-4f * sum[c]);
}

TEST(PhotonMap, IsTheSameForAnyNumberOfThreads) {
  std::vector<Photon> photons = randomPhotons(20000, 5);
  for (size_t i = 1; i < photons.size(); i += 4) photons[i].p = photons[i - 1].p;  // ties
  std::vector<uint32_t> one, four;
  withThreads(1, [&] { PhotonMap(photons, &one); });
  withThreads(4, [&] { PhotonMap(photons, &four); });
  EXPECT_EQ(one, four);
}

TEST(PhotonMap, TakesTwentyBytesAPhoton) {
  const PhotonMap map(randomPhotons(100000, 1));
  EXPECT_LE(map.bytes(), 24u * 100000u);
}

}  // namespace
}  // namespace roomlight
