// Colours for illuminance, as src/measure/false_colour.cpp has them: even steps of lightness from dark violet to light
// yellow, on a logarithmic scale.
import { clamp, type Vec3 } from "../../src/vector.js";

export interface Scale {
  readonly low: number; // lux
  readonly high: number;
}

const kRound = [1, 1.5, 2, 3, 5, 7.5];
const kMostChroma = 0.17;

function fromOklab(lightness: number, a: number, b: number): Vec3 {
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return [
    4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
    -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
    -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s,
  ];
}

// t from 0 to 1; encoded sRGB 0 to 1.
export function falseColour(t: number): Vec3 {
  const held = clamp(t, 0, 1);
  const lightness = 0.25 + (0.94 - 0.25) * held;
  const hue = ((295 + (105 - 295) * held) * Math.PI) / 180;
  const colour = (chroma: number) => fromOklab(lightness, chroma * Math.cos(hue), chroma * Math.sin(hue));
  let low = 0;
  let high = kMostChroma;
  for (let i = 0; i < 20; ++i) {
    const middle = (low + high) / 2;
    if (colour(middle).every(c => c >= 0 && c <= 1)) low = middle;
    else high = middle;
  }
  return colour(low).map(c => {
    const v = clamp(c, 0, 1);
    return v > 0.0031308 ? 1.055 * v ** (1 / 2.4) - 0.055 : 12.92 * v;
  }) as unknown as Vec3;
}

export const cssColour = (t: number): string =>
  `rgb(${falseColour(t)
    .map(c => Math.round(255 * c))
    .join(" ")})`;

export const placeOnScale = ({ low, high }: Scale, value: number): number =>
  clamp(Math.log(Math.max(value, 1e-30) / low) / Math.log(high / low), 0, 1);

// 1 - 1.5 - 2 - 3 - 5 - 7.5 - 10 and so on, from low to high.
export function roundSteps(low: number, high: number): number[] {
  const steps: number[] = [];
  for (let decade = Math.floor(Math.log10(low)); decade <= Math.ceil(Math.log10(high)); ++decade) {
    for (const step of kRound) {
      const value = step * 10 ** decade;
      if (value >= low * (1 - 1e-9) && value <= high * (1 + 1e-9)) steps.push(value);
    }
  }
  return steps;
}

// The 5th and 99th percentiles, rounded outwards, a factor 3 to 150 apart.
export function scaleOf(values: readonly number[]): Scale {
  const lit = values.filter(v => v > 0).sort((a, b) => a - b);
  if (lit.length === 0) return { low: 1, high: 1000 };
  const top = lit[lit.length - 1 - Math.floor(lit.length / 100)]!;
  const bottom = Math.max(lit[Math.floor(lit.length / 20)]!, top / 100);
  const high = roundSteps(top, 2 * top)[0]!;
  const low = roundSteps(bottom / 2, bottom).at(-1)!;
  return high < 3 * low ? { low: roundSteps(high / 6, high / 3).at(-1)!, high } : { low, high };
}
