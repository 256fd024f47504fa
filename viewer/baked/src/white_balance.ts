// What the light in a picture shall look like, as pictures have it (src/look/display.cpp): light near to some white is
// shown as that white is, between its own warmth and daylight; light that no one would call white keeps its colour.
import type { Vec3 } from "../../src/vector.js";
import type { Home } from "./document.js";

type Whites = Home["display"]["whites"];

// Distance from the nearest white in CIE 1960 u, v: up to the first in full, from the second on not at all.
const kFull = 0.015;
const kNone = 0.05;
const kLeastLight = 0.02; // of a channel: what is not there cannot be brought back
const kBrightest = 4; // times the mean luminance: what is brighter counts as much as this

export const luminance = ([r, g, b]: Vec3): number => 0.2126 * r + 0.7152 * g + 0.0722 * b;
const each = (of: (c: 0 | 1 | 2) => number): Vec3 => [of(0), of(1), of(2)];

// CIE 1960 u, v of linear Rec.709.
function chromaticity([r, g, b]: Vec3): readonly [number, number] {
  const x = 0.4124564 * r + 0.3575761 * g + 0.1804375 * b;
  const y = 0.2126729 * r + 0.7151522 * g + 0.072175 * b;
  const z = 0.0193339 * r + 0.119192 * g + 0.9503041 * b;
  const sum = x + 15 * y + 3 * z;
  return [(4 * x) / sum, (6 * y) / sum];
}

// Gains of linear Rec.709 for light of a colour; null: there is none, or the home does not say.
export function gainsFor(whites: Whites, light: Vec3): Vec3 | null {
  if (whites.length < 2 || !(luminance(light) > 0)) return null;
  const [u, v] = chromaticity(light);
  let nearest = { apart: Infinity, shown: [1, 1, 1] as Vec3 };
  for (let i = 1; i < whites.length; ++i) {
    const [from, to] = [whites[i - 1]!, whites[i]!];
    const [u0, v0] = chromaticity(from.light);
    const [u1, v1] = chromaticity(to.light);
    const along = ((u - u0) * (u1 - u0) + (v - v0) * (v1 - v0)) / ((u1 - u0) ** 2 + (v1 - v0) ** 2);
    const t = Math.min(1, Math.max(0, along || 0));
    const apart = Math.hypot(u0 + (u1 - u0) * t - u, v0 + (v1 - v0) * t - v);
    if (apart < nearest.apart) nearest = { apart, shown: each(c => from.shown[c] * (1 - t) + to.shown[c] * t) };
  }
  const share = Math.min(1, Math.max(0, (kNone - nearest.apart) / (kNone - kFull)));
  return each(c => (nearest.shown[c] / Math.max(light[c] / luminance(light), kLeastLight)) ** share);
}

// Mean colour of light at places of a picture; black where there is none. `shares`: red and green of each, blue being
// the rest of one.
export function meanLight(shares: readonly (readonly [number, number])[], amounts: readonly number[]): Vec3 {
  const count = amounts.filter(a => a > 0).length;
  const most = (kBrightest * amounts.reduce((sum, a) => sum + a, 0)) / Math.max(1, count);
  let sum: Vec3 = [0, 0, 0];
  amounts.forEach((amount, i) => {
    const [r, g] = shares[i]!;
    const colour: Vec3 = [r, g, Math.max(0, 1 - r - g)];
    const times = amount > 0 ? Math.min(amount, most) / luminance(colour) : 0;
    sum = each(c => sum[c] + times * colour[c]);
  });
  return sum;
}

const kSeconds = 0.9; // that eyes take
const kSame = 0.01; // of gains: what nobody sees
const kReached = 0.005;
const apart = (a: Vec3, b: Vec3): number => Math.max(...each(c => Math.abs(Math.log(a[c] / b[c]))));

export const differ = (a: Vec3, b: Vec3): boolean => apart(a, b) > kSame;

// One step of `seconds` towards the gains that are wanted.
export function followed(gains: Vec3, wanted: Vec3, seconds: number): Vec3 {
  if (apart(gains, wanted) < kReached) return wanted;
  const left = Math.exp(-seconds / kSeconds);
  return each(c => wanted[c] * (gains[c] / wanted[c]) ** left);
}
