// Vectors of three numbers, as the protocol has them: right-handed axes, y up, metres.
export type Vec3 = readonly [number, number, number];

export const add = (a: Vec3, b: Vec3): Vec3 => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const subtract = (a: Vec3, b: Vec3): Vec3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (a: Vec3, s: number): Vec3 => [a[0] * s, a[1] * s, a[2] * s];
export const dot = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const length = (a: Vec3): number => Math.hypot(a[0], a[1], a[2]);
export const mix = (a: Vec3, b: Vec3, t: number): Vec3 => add(scale(a, 1 - t), scale(b, t));
export const cross = (a: Vec3, b: Vec3): Vec3 => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

// The unit vector, or the fallback for one without a length.
export function normalize(a: Vec3, fallback: Vec3 = [0, 0, -1]): Vec3 {
  const size = length(a);
  return size > 1e-9 ? scale(a, 1 / size) : fallback;
}

// Turned about an axis of unit length, counter-clockwise seen against it (Rodrigues' formula).
export function rotateAbout(v: Vec3, axis: Vec3, angleRad: number): Vec3 {
  const cos = Math.cos(angleRad);
  const sin = Math.sin(angleRad);
  return add(add(scale(v, cos), scale(cross(axis, v), sin)), scale(axis, dot(axis, v) * (1 - cos)));
}

export const clamp = (value: number, low: number, high: number): number => Math.min(high, Math.max(low, value));
export const kRadPerDegree = Math.PI / 180;
