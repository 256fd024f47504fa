// The double's home: one room of boxes with three lamps, and the light in it by the inverse-square law. Enough to see a
// change, no more.
import { blackBody } from "../../src/color.js";
import { rayThrough, verticalFovRad, type Pose, type Ray, type Viewport } from "../../src/camera.js";
import type { Lamp, Sun, Thing } from "../../src/protocol.js";
import { add, dot, kRadPerDegree, length, normalize, scale, subtract, type Vec3 } from "../../src/vector.js";

export interface Home {
  lamps: Lamp[];
  objects: Thing[];
  sun: Sun;
}

export const kRoom = {
  name: "Living room",
  low: [0, 0, 0],
  high: [6, 2.6, 5],
  floor: [
    [0, 0],
    [6, 0],
    [6, 5],
    [0, 5],
  ],
} as const;

const thing = (id: number, name: string, low: Vec3, high: Vec3, color: Vec3): Thing => ({
  id: `object:${id}`,
  name,
  low,
  high,
  movable: true,
  move: [0, 0, 0],
  turn: 0,
  hidden: false,
  colors: [{ material: `${name} wood`, color, textured: false }],
  open: null,
});

const lamp = (id: number, name: string, kind: string, position: Vec3, fluxLm: number, temperatureK: number): Lamp => ({
  id: `lamp:${id}`,
  name,
  kind,
  object: null,
  position,
  direction: kind === "spot" ? [0, -1, 0] : null,
  fluxLm,
  fluxAssumed: false,
  dim: 1,
  on: true,
  temperatureK,
  color: null,
  movable: true,
});

export const firstHome = (): Home => ({
  lamps: [
    lamp(0, "Pendant", "point", [3, 2.1, 2.5], 800, 2700),
    lamp(1, "Floor lamp", "point", [0.6, 1.5, 0.6], 450, 2700),
    lamp(2, "Spot", "spot", [5, 2.5, 1], 300, 4000),
  ],
  objects: [
    thing(0, "Table", [2.2, 0, 1.9], [3.8, 0.75, 3.1], [0.45, 0.3, 0.18]),
    thing(1, "Armchair", [4.6, 0, 3.4], [5.5, 0.85, 4.3], [0.12, 0.25, 0.4]),
    thing(2, "Shelf", [0, 0, 3.2], [0.35, 1.9, 4.8], [0.6, 0.6, 0.58]),
  ],
  sun: {
    on: true,
    placeFrom: "home",
    date: "2026-06-21",
    hour: 12,
    utcOffset: 2,
    latitude: 48.1,
    longitude: 11.6,
    sky: "clear",
    altitude: 60,
    azimuth: 160,
  },
});

export interface Hit {
  point: Vec3;
  normal: Vec3;
  distanceM: number;
  color: Vec3;
  object: string | null;
}

function facing(axis: number, sign: number): Vec3 {
  return [axis === 0 ? sign : 0, axis === 1 ? sign : 0, axis === 2 ? sign : 0];
}

// Where a ray enters a box and where it leaves it, and through which faces.
function crossing(ray: Ray, low: Vec3, high: Vec3): { near: number; far: number; nearAxis: number; farAxis: number } {
  const result = { near: -Infinity, far: Infinity, nearAxis: 0, farAxis: 0 };
  for (let axis = 0; axis < 3; ++axis) {
    const a = (low[axis]! - ray.origin[axis]!) / ray.direction[axis]!;
    const b = (high[axis]! - ray.origin[axis]!) / ray.direction[axis]!;
    if (Math.min(a, b) > result.near) {
      result.near = Math.min(a, b);
      result.nearAxis = axis;
    }
    if (Math.max(a, b) < result.far) {
      result.far = Math.max(a, b);
      result.farAxis = axis;
    }
  }
  return result;
}

export function trace(home: Home, ray: Ray): Hit {
  const room = crossing(ray, kRoom.low, kRoom.high);
  let distanceM = room.far;
  let normal = facing(room.farAxis, -Math.sign(ray.direction[room.farAxis]!));
  let color: Vec3 = room.farAxis === 1 ? [0.5, 0.47, 0.43] : [0.75, 0.74, 0.7];
  let object: string | null = null;
  for (const box of home.objects) {
    if (box.hidden) continue;
    const { near, far, nearAxis } = crossing(ray, box.low, box.high);
    if (near > 0.01 && near < far && near < distanceM) {
      distanceM = near;
      normal = facing(nearAxis, -Math.sign(ray.direction[nearAxis]!));
      color = box.colors[0]!.color;
      object = box.id;
    }
  }
  return { point: add(ray.origin, scale(ray.direction, distanceM)), normal, distanceM, color, object };
}

// Illuminance in lx for each channel, shadows included.
export function light(home: Home, { point, normal }: Hit): Vec3 {
  let sum: Vec3 = [6, 6, 6.5];
  for (const { on, dim, fluxLm, position, temperatureK, color } of home.lamps) {
    if (!on || fluxLm === null) continue;
    const toLamp = subtract(position, point);
    const distance = length(toLamp);
    const direction = normalize(toLamp);
    const cosine = dot(direction, normal);
    if (cosine <= 0) continue;
    const start = add(point, scale(normal, 0.02));
    if (trace(home, { origin: start, direction }).distanceM < distance - 0.05) continue;
    const lux = (fluxLm * dim * cosine) / (4 * Math.PI * Math.max(0.05, distance * distance));
    sum = add(sum, scale(color ?? blackBody(temperatureK ?? 6500), lux));
  }
  return sum;
}

export const luminance = (c: Vec3): number => 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];

// Shows a fixed exposure; false colours are shades of green.
export function draw(
  home: Home,
  pose: Pose,
  width: number,
  height: number,
  falseColor: boolean,
  ev: number,
): Uint8Array {
  const rgb = new Uint8Array(3 * width * height);
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      const hit = trace(home, rayThrough(pose, { width, height }, x + 0.5, y + 0.5));
      const lux = light(home, hit);
      for (let i = 0; i < 3; ++i) {
        const cdM2 = (lux[i]! * hit.color[i]!) / Math.PI;
        const value = falseColor ? (i === 1 ? luminance(lux) / 300 : 0) : cdM2 / (1.2 * 2 ** ev);
        rgb[3 * (width * y + x) + i] = Math.round(255 * Math.min(1, value) ** (1 / 2.2));
      }
    }
  }
  return rgb;
}

// The pose whose vertical angle of view in this viewport is the camera's.
export function poseOf(camera: { position: Vec3; direction: Vec3; verticalFov: number }, viewport: Viewport): Pose {
  const [x, y, z] = normalize(camera.direction);
  const pose = { position: camera.position, yawRad: Math.atan2(-x, -z), pitchRad: Math.asin(y), fovRad: 1 };
  const tangent = Math.tan((camera.verticalFov * kRadPerDegree) / 2);
  const widened = Math.tan(verticalFovRad(pose, viewport) / 2) / Math.tan(pose.fovRad / 2);
  return { ...pose, fovRad: 2 * Math.atan(tangent / widened) };
}
