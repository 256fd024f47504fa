// Texels of light: zlib streams of RGB9_E5 in four planes of bytes, lowest first (docs/reference/baked.md, light).
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

// Planes of bytes to texels; behind them zeros up to `length`.
export function joinPlanes(planes: Uint8Array, length = planes.length / 4): Uint32Array<ArrayBuffer> {
  const count = planes.length / 4;
  const texels = new Uint32Array(length);
  const low = planes.subarray(0, count);
  const second = planes.subarray(count, 2 * count);
  const third = planes.subarray(2 * count, 3 * count);
  const high = planes.subarray(3 * count);
  for (let i = 0; i < count; ++i) texels[i] = low[i]! | (second[i]! << 8) | (third[i]! << 16) | (high[i]! << 24);
  return texels;
}

export function splitPlanes(texels: Uint32Array): Uint8Array {
  const planes = new Uint8Array(4 * texels.length);
  texels.forEach((texel, i) => {
    for (let plane = 0; plane < 4; ++plane) planes[plane * texels.length + i] = texel >>> (8 * plane);
  });
  return planes;
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
