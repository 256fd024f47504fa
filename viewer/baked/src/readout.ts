// Amounts of light as three bytes that every GPU can hand back: logarithms from 2^-24 to 2^24 in 24 bits.
export const kReadoutGlsl = `
  vec4 readout(float amount) {
    float share = clamp((log2(max(amount, 6e-8)) + 24.0) / 48.0, 0.0, 0.9999);
    float high = floor(share * 256.0), rest = share * 256.0 - high, middle = floor(rest * 256.0);
    return vec4(high / 255.0, middle / 255.0, rest * 256.0 - middle, 1.0);
  }`;

// Zero where there is nothing.
export function readoutAt(bytes: ArrayLike<number>, pixel: number): number {
  const at = 4 * pixel;
  const share = (bytes[at]! + (bytes[at + 1]! + bytes[at + 2]! / 255) / 256) / 256;
  const amount = 2 ** (48 * share - 24);
  return amount < 1e-7 ? 0 : amount;
}
