// Ranges and ticks of axes, and how numbers stand on them.

export type Range = readonly [number, number];

// Without digits that only rounding made.
export const number = (value: number, digits = 6): string => String(Number(value.toPrecision(digits)));

// A twentieth more on both sides; of one value, or none, some room about it.
export function linearRange(values: readonly number[]): Range {
  const finite = values.filter(Number.isFinite);
  if (finite.length === 0) return [0, 1];
  const least = finite.reduce((a, b) => Math.min(a, b));
  const most = finite.reduce((a, b) => Math.max(a, b));
  const margin = (most - least || 1) / 20;
  return [least - margin, most + margin];
}

// From thirds of a decade to thirds of a decade, no shorter than half of one. Values are above 0.
export function logarithmicRange(least: number, most: number): Range {
  let low = Math.floor(Math.log10(least) * 3) / 3;
  let high = Math.ceil(Math.log10(most) * 3) / 3;
  if (high - low < 0.5) [low, high] = [low - 0.25, high + 0.25];
  return [10 ** low, 10 ** high];
}

// 1, 2 and 5 times powers of ten; powers alone where the range is long.
export function decadeTicks(least: number, most: number): number[] {
  const low = Math.log10(least);
  const high = Math.log10(most);
  const ticks: number[] = [];
  for (let power = Math.floor(low); power <= Math.ceil(high); ++power) {
    for (const digit of high - low > 2.5 ? [1] : [1, 2, 5]) {
      const tick = Number(`${digit}e${power}`);
      if (Math.log10(tick) >= low - 1e-9 && Math.log10(tick) <= high + 1e-9) ticks.push(tick);
    }
  }
  return ticks;
}

// The range by so much longer, with the value `at` where it was.
export function zoomed(range: Range, factor: number, at = (range[0] + range[1]) / 2): Range {
  return [at + (range[0] - at) * factor, at + (range[1] - at) * factor];
}
