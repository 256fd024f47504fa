// Which room a place is in, and the box around a room.
import type { Vec3 } from "../../src/vector.js";
import type { Bvh } from "./bvh.js";
import type { Room } from "./document.js";

const kBeforeSurfaceM = 0.05;

export interface Box {
  readonly low: Vec3;
  readonly high: Vec3;
}

type Point = readonly [number, number];

export function insideOutline(outline: readonly Point[], x: number, z: number): boolean {
  let inside = false;
  outline.forEach(([ax, az], i) => {
    const [bx, bz] = outline[(i + 1) % outline.length]!;
    if (az > z !== bz > z && x < ax + ((bx - ax) * (z - az)) / (bz - az)) inside = !inside;
  });
  return inside;
}

export function roomAt(rooms: readonly Room[], [x, y, z]: Vec3): number | null {
  const found = rooms.findIndex(
    room => y >= room.elevationM - 0.1 && y <= room.elevationM + room.heightM && insideOutline(room.floor, x, z),
  );
  return found < 0 ? null : found;
}

// The room that an eye is in. Before an open side or above a missing ceiling it is that of what the eye looks at.
export function roomInView(rooms: readonly Room[], world: Bvh | null, eye: Vec3, ahead: Vec3): number | null {
  const around = roomAt(rooms, eye);
  const hit = around === null ? world?.raycast(eye, ahead) : null;
  if (!hit) return around;
  const [x, y, z] = ahead.map((d, axis) => eye[axis]! + d * (hit.distance - kBeforeSurfaceM));
  return roomAt(rooms, [x!, y!, z!]);
}

export function boxOf({ floor, elevationM, heightM }: Room): Box {
  const xs = floor.map(p => p[0]);
  const zs = floor.map(p => p[1]);
  return {
    low: [Math.min(...xs), elevationM, Math.min(...zs)],
    high: [Math.max(...xs), elevationM + heightM, Math.max(...zs)],
  };
}

export function boxAround(positions: Float32Array): Box {
  const low: [number, number, number] = [Infinity, Infinity, Infinity];
  const high: [number, number, number] = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < positions.length; ++i) {
    const axis = i % 3;
    low[axis] = Math.min(low[axis]!, positions[i]!);
    high[axis] = Math.max(high[axis]!, positions[i]!);
  }
  return { low, high };
}

// A place inside: the middle of the outline, or if that is outside of it the middle of a triangle of its corners.
export function middleOf(room: Room): Point {
  const mean = (points: readonly Point[]): Point => [
    points.reduce((s, p) => s + p[0], 0) / points.length,
    points.reduce((s, p) => s + p[1], 0) / points.length,
  ];
  const { floor } = room;
  const { low, high } = boxOf(room);
  const candidates = [
    [(low[0] + high[0]) / 2, (low[2] + high[2]) / 2] as const,
    mean(floor),
    ...floor.map((p, i) => mean([p, floor[(i + 1) % floor.length]!, floor[(i + 2) % floor.length]!])),
  ];
  return candidates.find(([x, z]) => insideOutline(floor, x, z)) ?? candidates[0]!;
}

// Storeys by the height of their floors.
export const storeysOf = (rooms: readonly Room[]): number[] =>
  [...new Set(rooms.map(r => Math.round(r.elevationM * 100) / 100))].sort((a, b) => a - b);
