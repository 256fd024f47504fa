// From luminance in cd/m² to what displays are given, as src/base/tone_curves.h does it: once for the GPU, once for
// tests.
import type { Vec3 } from "../../src/vector.js";
import type { ToneName } from "./document.js";

export const kToneNumbers: Readonly<Record<ToneName, number>> = { neutral: 0, agx: 1, filmic: 2, clip: 3 };

// Saturation-based (ISO 12232): 1.2 * 2^EV100 becomes 1.
export const exposureFromEv100 = (ev100: number): number => 1 / (1.2 * 2 ** ev100);

// Hides the steps of a coarse format: interleaved gradient noise (Jimenez 2014).
export const kDitherGlsl = `
  float dither(vec2 p) { return fract(52.9829189 * fract(dot(floor(p), vec2(0.06711056, 0.00583715)))); }`;

export const kToneGlsl = `
  vec3 toneNeutral(vec3 color) {
    const float start = 0.8 - 0.04, desaturation = 0.15;
    float x = min(color.r, min(color.g, color.b));
    vec3 c = color - (x < 0.08 ? x - 6.25 * x * x : 0.04);
    float peak = max(max(c.r, max(c.g, c.b)), start);
    float d = 1.0 - start;
    float newPeak = 1.0 - d * d / (peak + d - start);
    float g = 1.0 - 1.0 / (desaturation * (peak - newPeak) + 1.0);
    return c * ((1.0 - g) * newPeak / peak) + newPeak * g;
  }
  vec3 toneAgx(vec3 color) {
    const float low = -12.47393, high = 4.026069;
    const mat3 inset = mat3(
      0.842479062253094, 0.0423282422610123, 0.0423756549057051,
      0.0784335999999992, 0.878468636469772, 0.0784336,
      0.0792237451477643, 0.0791661274605434, 0.879142973793104);
    const mat3 outset = mat3(
      1.19687900512017, -0.0528968517574562, -0.0529716355144438,
      -0.0980208811401368, 1.15190312990417, -0.0980434501171241,
      -0.0990297440797205, -0.0989611768448433, 1.15107367264116);
    vec3 x = (clamp(log2(max(inset * color, 1e-10)), low, high) - low) / (high - low);
    x = x * (x * (x * (x * (x * (15.5 * x - 40.14) + 31.96) - 6.868) + 0.4298) + 0.1191) - 0.00232;
    x = outset * x;
    return mix(vec3(0.0), pow(max(x, 1e-6), vec3(2.2)), greaterThan(x, vec3(1e-6)));
  }
  vec3 toneFilmic(vec3 color) {
    const float shoulder = 0.7;
    float x = max(max(color.r, max(color.g, color.b)), 1e-6);
    float peak = min(1.0, x * (x * 2.51 + 0.03) / (x * (x * 2.43 + 0.59) + 0.14));
    float beyond = peak > shoulder ? (peak - shoulder) / (1.0 - shoulder) : 0.0, white = beyond * beyond;
    return color * ((1.0 - white) * peak / x) + white * peak;
  }
  // x: contrast about middle grey, y: saturation.
  vec3 graded(vec3 color, vec2 grade) {
    float y = dot(color, vec3(0.2126, 0.7152, 0.0722)), gain = pow(max(y / 0.18, 1e-6), grade.x - 1.0);
    return max(mix(vec3(y), color, grade.y) * gain, 0.0);
  }
  vec3 toneCurve(vec3 exposed, int curve, vec2 grade) {
    vec3 v = graded(max(exposed, 0.0), grade);
    return curve == 0 ? toneNeutral(v) : curve == 1 ? toneAgx(v) : curve == 2 ? toneFilmic(v) : v;
  }
  vec3 srgbEncode(vec3 linear) {
    vec3 v = clamp(linear, 0.0, 1.0);
    return mix(12.92 * v, 1.055 * pow(max(v, 1e-6), vec3(1.0 / 2.4)) - 0.055, greaterThan(v, vec3(0.0031308)));
  }`;

function neutral(color: Vec3): Vec3 {
  const start = 0.8 - 0.04;
  const x = Math.min(...color);
  const lift = x < 0.08 ? x - 6.25 * x * x : 0.04;
  const c = color.map(v => v - lift);
  const peak = Math.max(...c, start);
  const d = 1 - start;
  const newPeak = 1 - (d * d) / (peak + d - start);
  const g = 1 - 1 / (0.15 * (peak - newPeak) + 1);
  return c.map(v => (v * (1 - g) * newPeak) / peak + newPeak * g) as unknown as Vec3;
}

const kInset = [
  [0.842479062253094, 0.0784335999999992, 0.0792237451477643],
  [0.0423282422610123, 0.878468636469772, 0.0791661274605434],
  [0.0423756549057051, 0.0784336, 0.879142973793104],
] as const;
const kOutset = [
  [1.19687900512017, -0.0980208811401368, -0.0990297440797205],
  [-0.0528968517574562, 1.15190312990417, -0.0989611768448433],
  [-0.0529716355144438, -0.0980434501171241, 1.15107367264116],
] as const;

function agx(color: Vec3): Vec3 {
  const low = -12.47393;
  const high = 4.026069;
  const times = (rows: typeof kInset | typeof kOutset, v: Vec3) =>
    rows.map(row => row[0] * v[0] + row[1] * v[1] + row[2] * v[2]) as unknown as Vec3;
  const curved = times(kInset, color).map(v => {
    const x = (Math.min(high, Math.max(low, Math.log2(Math.max(v, 1e-10)))) - low) / (high - low);
    return x * (x * (x * (x * (x * (15.5 * x - 40.14) + 31.96) - 6.868) + 0.4298) + 0.1191) - 0.00232;
  }) as unknown as Vec3;
  return times(kOutset, curved).map(e => (e > 1e-6 ? e ** 2.2 : 0)) as unknown as Vec3;
}

function filmic(color: Vec3): Vec3 {
  const x = Math.max(...color, 1e-6);
  const peak = Math.min(1, (x * (x * 2.51 + 0.03)) / (x * (x * 2.43 + 0.59) + 0.14));
  const white = (Math.max(0, peak - 0.7) / 0.3) ** 2;
  return color.map(v => (v * (1 - white) * peak) / x + white * peak) as unknown as Vec3;
}

export interface Grade {
  readonly contrast: number; // exponent of luminance about middle grey
  readonly saturation: number;
}

function graded(color: Vec3, { contrast, saturation }: Grade): Vec3 {
  const y = 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2];
  const gain = Math.max(y / 0.18, 1e-6) ** (contrast - 1);
  return color.map(c => Math.max(0, gain * (y + saturation * (c - y)))) as unknown as Vec3;
}

// Display values 0 to 1 of exposed light.
export function toned(exposed: Vec3, tone: ToneName, grade: Grade = { contrast: 1, saturation: 1 }): Vec3 {
  const curve = { neutral, agx, filmic, clip: (c: Vec3) => c }[tone];
  return curve(graded(exposed.map(c => Math.max(0, c)) as unknown as Vec3, grade)).map(c => {
    const v = Math.min(1, Math.max(0, c));
    return v > 0.0031308 ? 1.055 * v ** (1 / 2.4) - 0.055 : 12.92 * v;
  }) as unknown as Vec3;
}
