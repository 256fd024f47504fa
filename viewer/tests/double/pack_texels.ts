// Planes of what differs from predictions, as the program writes them (docs/reference/baked.md, light).
const part = (texel: number, shift: number) => (texel >>> shift) & 511;

export function packTexels(texels: Uint32Array, width: number, height: number): Uint8Array {
  const count = texels.length;
  const planes = new Uint8Array(4 * count);
  texels.forEach((texel, i) => {
    const x = i % width;
    const y = Math.floor(i / width) % height;
    const left = x > 0 ? texels[i - 1]! : 0;
    const above = y > 0 ? texels[i - width]! : 0;
    const beside = x > 0 ? left : above;
    const exponent = texel >>> 27;
    const green = (of: number) => {
      const scaled = Math.floor(part(of, 9) * 2 ** ((of >>> 27) - exponent));
      return Math.min(scaled, 511);
    };
    const [w, n] = [green(left), green(above)];
    let predicted = green(beside);
    if (x > 0 && y > 0) {
      const corner = green(texels[i - width - 1]!);
      predicted =
        corner >= Math.max(w, n) ? Math.min(w, n) : corner <= Math.min(w, n) ? Math.max(w, n) : w + n - corner;
    }
    const own = part(texel, 9);
    const other = (shift: number) => {
      const p = part(beside, 9)
        ? Math.min(Math.floor((own * part(beside, shift) + Math.floor(part(beside, 9) / 2)) / part(beside, 9)), 511)
        : own;
      return part(texel, shift) - p;
    };
    const folded = (difference: number, range: number) => {
      const d = ((((difference + range / 2) % range) + range) % range) - range / 2;
      return d < 0 ? -2 * d - 1 : 2 * d;
    };
    const [g, r, b] = [own - predicted, other(0), other(18)].map(d => folded(d, 512)) as [number, number, number];
    const e = folded(exponent - (beside >>> 27), 32);
    [g, r, b].forEach((value, plane) => (planes[plane * count + i] = value & 255));
    planes[3 * count + i] = (g >> 8) | ((r >> 8) << 1) | ((b >> 8) << 2) | (e << 3);
  });
  return planes;
}
