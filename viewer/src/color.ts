// Colours for the controls: linear Rec.709 to and from what the browser shows, the colour of a black body, and the
// false-colour scale.
import { clamp, type Vec3 } from "./vector.js";

// Transfer function of IEC 61966-2-1, 0 to 1.
function encode(linear: number): number {
  const v = clamp(linear, 0, 1);
  return v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055;
}

function decode(encoded: number): number {
  return encoded <= 0.04045 ? encoded / 12.92 : ((encoded + 0.055) / 1.055) ** 2.4;
}

export function hexFromLinear(color: Vec3): string {
  return `#${color
    .map(v =>
      Math.round(255 * encode(v))
        .toString(16)
        .padStart(2, "0"),
    )
    .join("")}`;
}

export function linearFromHex(hex: string): Vec3 {
  const channel = (at: number) => decode(parseInt(hex.slice(at, at + 2), 16) / 255);
  return [channel(1), channel(3), channel(5)];
}

// As bright as the screen can show it, with the same hue: lamps' colours are relative.
export function brightest(color: Vec3): Vec3 {
  const top = Math.max(color[0], color[1], color[2]);
  return top > 0 ? [color[0] / top, color[1] / top, color[2] / top] : [0, 0, 0];
}

// Chromaticity of the Planckian locus from 1667 to 25000 K (cubic fit of Kim et al., 2002), as linear Rec.709,
// brightest channel 1.
export function blackBody(kelvin: number): Vec3 {
  const t = clamp(kelvin, 1667, 25000);
  const u = 1000 / t;
  const x =
    t <= 4000
      ? ((-0.2661239 * u - 0.234358) * u + 0.8776956) * u + 0.17991
      : ((-3.0258469 * u + 2.1070379) * u + 0.2226347) * u + 0.24039;
  const y =
    t <= 2222
      ? ((-1.1063814 * x - 1.3481102) * x + 2.18555832) * x - 0.20219683
      : t <= 4000
        ? ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867
        : ((3.081758 * x - 5.8733867) * x + 3.75112997) * x - 0.37001483;
  const X = x / y;
  const Z = (1 - x - y) / y;
  const linear: Vec3 = [
    3.2404542 * X - 1.5371385 - 0.4985314 * Z,
    -0.969266 * X + 1.8760108 + 0.041556 * Z,
    0.0556434 * X - 0.2040259 + 1.0572252 * Z,
  ];
  return brightest([Math.max(0, linear[0]), Math.max(0, linear[1]), Math.max(0, linear[2])]);
}

// Ticks at 1, 2 and 5 times powers of ten, and where they stand on a logarithmic scale: 0 at the low end, 1 at the high
// one.
export function scaleTicks(low: number, high: number): { value: number; at: number }[] {
  const ticks: { value: number; at: number }[] = [];
  const span = Math.log(high / low);
  if (!(low > 0) || !(span > 0)) return ticks;
  // Over four decades the tens alone are enough.
  const steps = span > Math.log(1e4) ? [1] : [1, 2, 5];
  for (let power = Math.floor(Math.log10(low)); power <= Math.ceil(Math.log10(high)); ++power) {
    for (const step of steps) {
      const value = Number(`${step}e${power}`);
      const at = Math.log(value / low) / span;
      if (at >= -1e-9 && at <= 1 + 1e-9) ticks.push({ value, at: clamp(at, 0, 1) });
    }
  }
  return ticks;
}
