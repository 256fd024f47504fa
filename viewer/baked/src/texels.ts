// Texels of light: zlib streams of RGB9_E5 as what differs from a prediction (docs/reference/baked.md, light).
import { BadFile } from "./bad_file.js";
import type { Vec3 } from "../../src/vector.js";

// `what`: named if the stream is damaged.
export async function inflate(bytes: Uint8Array, expectedBytes: number, what: string): Promise<Uint8Array> {
  const stream = new Blob([bytes as Uint8Array<ArrayBuffer>]).stream().pipeThrough(new DecompressionStream("deflate"));
  const out = new Uint8Array(expectedBytes);
  const reader = stream.getReader();
  let filled = 0;
  try {
    for (;;) {
      const { done, value } = await reader.read();
      if (done) break;
      if (filled + value.length > expectedBytes) throw new BadFile("damaged", `${what}: too long`);
      out.set(value, filled);
      filled += value.length;
    }
  } catch (error) {
    if (error instanceof BadFile) throw error;
    throw new BadFile("damaged", `${what}: cannot be unpacked`);
  }
  if (filled !== expectedBytes) throw new BadFile("damaged", `${what}: too short`);
  return out;
}

const kMost = 511; // of a mantissa of 9 bits

// Texels of tiles of `width` x `height` from planes of bytes: differences of green, red, blue, and of the exponent with
// their highest bits. Behind them zeros up to `length`.
export function unpackTexels(
  planes: Uint8Array,
  width: number,
  height: number,
  length = planes.length / 4,
): Uint32Array<ArrayBuffer> {
  const count = planes.length / 4;
  const texels = new Uint32Array(length);
  const unfold = (n: number) => (n >>> 1) ^ -(n & 1);
  for (let i = 0; i < count; ++i) {
    const x = i % width;
    const y = Math.floor(i / width) % height;
    const last = planes[3 * count + i]!;
    const beside = x > 0 ? texels[i - 1]! : y > 0 ? texels[i - width]! : 0;
    const exponent = ((beside >>> 27) + unfold(last >>> 3)) & 31;
    // As it would be with this exponent.
    const greenOf = (texel: number) => {
      const green = (texel >>> 9) & 511;
      const up = (texel >>> 27) - exponent;
      return up >= 0 ? Math.min(green << Math.min(up, 9), kMost) : green >>> Math.min(-up, 9);
    };
    let predicted = greenOf(beside);
    if (x > 0 && y > 0) {
      const above = greenOf(texels[i - width]!);
      const sum = predicted + above - greenOf(texels[i - width - 1]!);
      predicted = Math.min(Math.max(sum, Math.min(predicted, above)), Math.max(predicted, above));
    }
    const green = (predicted + unfold(planes[i]! | ((last & 1) << 8))) & 511;
    const greenBeside = (beside >>> 9) & 511;
    const byRatio = (channel: number) =>
      greenBeside > 0 ? Math.min(Math.floor((green * channel + (greenBeside >> 1)) / greenBeside), kMost) : green;
    const red = (byRatio(beside & 511) + unfold(planes[count + i]! | ((last & 2) << 7))) & 511;
    const blue = (byRatio((beside >>> 18) & 511) + unfold(planes[2 * count + i]! | ((last & 4) << 6))) & 511;
    texels[i] = red | (green << 9) | (blue << 18) | (exponent << 27);
  }
  return texels;
}

// Shares of light in tiles, made light: each channel as a part of blue, times the luminance of `light` in the same
// place. Tiles where there is no light get none.
export function timesLuminance(
  shares: Uint32Array,
  tiles: readonly number[],
  light: Uint32Array,
  lightTiles: readonly number[],
  texels: number, // of a tile
): void {
  const placeOf = new Map(lightTiles.map((tile, place) => [tile, place * texels]));
  tiles.forEach((tile, place) => {
    const lit = placeOf.get(tile);
    for (let i = 0; i < texels; ++i) {
      const share = shares[place * texels + i]!;
      const of = (share >>> 18) & 511;
      const from = lit === undefined ? 0 : light[lit + i]!;
      const luminance = 0.2126 * (from & 511) + 0.7152 * ((from >>> 9) & 511) + 0.0722 * ((from >>> 18) & 511);
      const part = (channel: number) => Math.min(Math.round((luminance * channel) / of), kMost);
      shares[place * texels + i] =
        of === 0 || luminance === 0
          ? 0
          : (part(share & 511) | (part((share >>> 9) & 511) << 9) | (part(of) << 18) | ((from >>> 27) << 27)) >>> 0;
    }
  });
}

export function decodeTexel(texel: number): Vec3 {
  const unit = 2 ** ((texel >>> 27) - 24);
  return [(texel & 511) * unit, ((texel >>> 9) & 511) * unit, ((texel >>> 18) & 511) * unit];
}

// Nearest RGB9_E5 of values from 0 to 65408.
export function encodeTexel(rgb: Vec3): number {
  const held = rgb.map(c => Math.min(Math.max(c, 0), 65408));
  const top = Math.max(...held);
  if (!(top > 0)) return 0;
  let exponent = Math.max(0, Math.floor(Math.log2(top)) + 16);
  if (Math.round(top / 2 ** (exponent - 24)) > 511) ++exponent;
  const [r, g, b] = held.map(c => Math.round(c / 2 ** (exponent - 24)));
  return ((exponent << 27) | (b! << 18) | (g! << 9) | r!) >>> 0;
}
