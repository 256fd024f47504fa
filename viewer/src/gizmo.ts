// The handles with which a lamp or a thing is moved: three arrows along the axes, a disc for the floor plane, a ring to
// turn. All in CSS pixels of the stage, projected by camera.ts; drags are found by rays.
import { pixelsPerTangent, project, type Pose, type Ray, type ScreenPoint, type Viewport } from "./camera.js";
import { add, dot, scale, subtract, type Vec3 } from "./vector.js";

export type Axis = "x" | "y" | "z";
export type Handle = Axis | "floor" | "turn";

export interface Arrow {
  readonly handle: Axis;
  readonly tip: ScreenPoint;
}

export interface Gizmo {
  readonly place: Vec3;
  readonly center: ScreenPoint;
  readonly arrows: readonly Arrow[];
  readonly ring: readonly ScreenPoint[]; // empty where nothing turns; else closed
  readonly radiusM: number; // of the ring
}

export const kAxes: Readonly<Record<Axis, Vec3>> = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };
const kArrowPx = 84; // length of an arrow seen square on
const kRingPx = 58;
const kRingPoints = 48;
export const kDiscPx = 9;
const kHiddenPx = 14; // an arrow that points at the eye is too short to take hold of

// Null where the place is behind the eye.
export function gizmoAt(pose: Pose, viewport: Viewport, place: Vec3, canTurn: boolean): Gizmo | null {
  const center = project(pose, viewport, place);
  if (!center) return null;
  const metresPerPixel = center.depthM / pixelsPerTangent(pose, viewport);
  const arrows: Arrow[] = [];
  for (const handle of ["x", "y", "z"] as const) {
    const tip = project(pose, viewport, add(place, scale(kAxes[handle], kArrowPx * metresPerPixel)));
    if (tip && Math.hypot(tip.x - center.x, tip.y - center.y) > kHiddenPx) arrows.push({ handle, tip });
  }
  const radiusM = kRingPx * metresPerPixel;
  const ring: ScreenPoint[] = [];
  for (let i = 0; canTurn && i <= kRingPoints; ++i) {
    const angle = (2 * Math.PI * i) / kRingPoints;
    const point = project(pose, viewport, add(place, [radiusM * Math.cos(angle), 0, -radiusM * Math.sin(angle)]));
    if (point) ring.push(point);
  }
  return { place, center, arrows, ring, radiusM };
}

function distanceToSegment(x: number, y: number, a: ScreenPoint, b: ScreenPoint): number {
  const dx = b.x - a.x;
  const dy = b.y - a.y;
  const size = dx * dx + dy * dy;
  const t = size > 0 ? Math.min(1, Math.max(0, ((x - a.x) * dx + (y - a.y) * dy) / size)) : 0;
  return Math.hypot(x - a.x - t * dx, y - a.y - t * dy);
}

// What the pointer would take hold of; the nearest wins, the disc before all others.
export function handleAt(gizmo: Gizmo, x: number, y: number, reachPx: number): Handle | null {
  if (Math.hypot(x - gizmo.center.x, y - gizmo.center.y) <= kDiscPx + reachPx / 2) return "floor";
  let best: Handle | null = null;
  let nearest = reachPx;
  for (const arrow of gizmo.arrows) {
    const distance = distanceToSegment(x, y, gizmo.center, arrow.tip);
    if (distance < nearest) {
      nearest = distance;
      best = arrow.handle;
    }
  }
  for (let i = 1; i < gizmo.ring.length; ++i) {
    const distance = distanceToSegment(x, y, gizmo.ring[i - 1]!, gizmo.ring[i]!);
    if (distance < nearest) {
      nearest = distance;
      best = "turn";
    }
  }
  return best;
}

// Metres along the axis through a place at which it comes nearest to the ray; null where the two are all but parallel.
export function alongAxis(ray: Ray, place: Vec3, axis: Axis): number | null {
  const direction = kAxes[axis];
  const offset = subtract(place, ray.origin);
  const slant = dot(direction, ray.direction);
  const square = 1 - slant * slant;
  if (square < 1e-4) return null;
  return (slant * dot(offset, ray.direction) - dot(offset, direction)) / square;
}

// Where the ray meets the level plane through a place; null where it does not, or more than 50 m away.
export function onLevel(ray: Ray, place: Vec3): Vec3 | null {
  const t = (place[1] - ray.origin[1]) / ray.direction[1];
  return Number.isFinite(t) && t > 0 && t < 50 ? add(ray.origin, scale(ray.direction, t)) : null;
}

// The angle of the place where the ray meets the ring's plane: counter-clockwise seen from above, 0 along +x.
export function angleAround(ray: Ray, place: Vec3): number | null {
  const point = onLevel(ray, place);
  return point && Math.atan2(-(point[2] - place[2]), point[0] - place[0]);
}

export interface Drag {
  readonly by: Vec3; // metres
  readonly turnRad: number;
}

// What pulling a handle from one ray to another does; null where the rays do not tell.
export function dragBy(handle: Handle, place: Vec3, from: Ray, to: Ray): Drag | null {
  if (handle === "turn") {
    const before = angleAround(from, place);
    const after = angleAround(to, place);
    return before === null || after === null ? null : { by: [0, 0, 0], turnRad: after - before };
  }
  if (handle === "floor") {
    const before = onLevel(from, place);
    const after = onLevel(to, place);
    return before && after && { by: subtract(after, before), turnRad: 0 };
  }
  const before = alongAxis(from, place, handle);
  const after = alongAxis(to, place, handle);
  return before === null || after === null ? null : { by: scale(kAxes[handle], after - before), turnRad: 0 };
}
