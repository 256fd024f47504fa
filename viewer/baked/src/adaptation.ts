// Automatic exposure as pictures have it (src/look/exposure.cpp): a mean of logarithms in which the middle of the
// picture counts most, and windows, lamps and holes do not; and how eyes follow it over time.
const kMiddleGrey = 0.18;
const kAboveEv = 2.5; // from the median
const kBelowEv = 6.5;
const kVoidEv = 0.4;
const kEdge = 0.3; // weight of the edges
const kWide = 0.55;
const kSecondsUp = 0.35; // to brighter light
const kSecondsDown = 0.9;

// `luminances` in cd/m², rows of `width`; null if nothing is seen.
export function lookedAtEv100(luminances: readonly number[], width: number): number | null {
  const height = luminances.length / width;
  const places = luminances.flatMap((luminance, i) => {
    if (!(luminance > 0)) return [];
    const u = (((i % width) + 0.5) / width - 0.5) / kWide;
    const v = ((Math.floor(i / width) + 0.5) / height - 0.5) / kWide;
    return [{ log2: Math.log2(luminance), weight: kEdge + (1 - kEdge) * Math.exp(-2 * (u * u + v * v)) }];
  });
  if (places.length === 0) return null;
  places.sort((a, b) => a.log2 - b.log2);
  const all = places.reduce((sum, p) => sum + p.weight, 0);
  let upTo = 0;
  const middle = places.find(p => 2 * (upTo += p.weight) >= all)!.log2;
  const counted = places.filter(p => p.log2 <= middle + kAboveEv && p.log2 >= middle - kBelowEv);
  const weight = counted.reduce((sum, p) => sum + p.weight, 0);
  const mean = counted.reduce((sum, p) => sum + p.log2 * p.weight, 0) / weight;
  return mean - Math.log2(kMiddleGrey * 1.2) - kVoidEv * (1 - places.length / luminances.length);
}

// One step of `seconds` towards the exposure that is wanted.
export function adapted(ev100: number, wanted: number, seconds: number): number {
  const gap = wanted - ev100;
  if (Math.abs(gap) < 0.01) return wanted;
  return wanted - gap * Math.exp(-seconds / (gap > 0 ? kSecondsUp : kSecondsDown));
}
