// Where the eye is and looks: pure functions on a pose. Yaw 0 looks along -z and grows counter-clockwise seen from
// above; pitch grows upwards.
import {
  add,
  clamp,
  cross,
  dot,
  kRadPerDegree,
  length,
  mix,
  normalize,
  rotateAbout,
  scale,
  subtract,
  type Vec3,
} from "./vector.js";

export interface Pose {
  readonly position: Vec3;
  readonly yawRad: number;
  readonly pitchRad: number;
  readonly fovRad: number; // of the height of a picture that is not upright; see verticalFovRad
  readonly cutHeightM?: number; // an eye above it sees nothing of the home that is higher
}

export interface Viewport {
  readonly width: number; // CSS pixels
  readonly height: number;
}

export interface Basis {
  readonly right: Vec3;
  readonly up: Vec3;
  readonly forward: Vec3;
}

export interface Ray {
  readonly origin: Vec3;
  readonly direction: Vec3;
}

export interface ScreenPoint {
  readonly x: number; // CSS pixels from the top left corner
  readonly y: number;
  readonly depthM: number; // along the direction of view
}

const kUp: Vec3 = [0, 1, 0];
export const kMaxPitchRad = 85 * kRadPerDegree;
const kNearM = 0.02;
const kNarrowestAspect = 1.1; // upright pictures see as far to the sides as one of this aspect
const kMaxFovRad = 110 * kRadPerDegree;

export function directionOf(yawRad: number, pitchRad: number): Vec3 {
  return [-Math.sin(yawRad) * Math.cos(pitchRad), Math.sin(pitchRad), -Math.cos(yawRad) * Math.cos(pitchRad)];
}

export function anglesOf(direction: Vec3): { yawRad: number; pitchRad: number } {
  const d = normalize(direction);
  // Straight up or down has no yaw of its own.
  const level = Math.hypot(d[0], d[2]);
  return {
    yawRad: level > 1e-6 ? Math.atan2(-d[0], -d[2]) : 0,
    pitchRad: clamp(Math.asin(clamp(d[1], -1, 1)), -kMaxPitchRad, kMaxPitchRad),
  };
}

export function poseFrom(camera: {
  position: Vec3;
  direction: Vec3;
  verticalFov: number;
  cutHeight?: number | null | undefined;
}): Pose {
  return {
    position: camera.position,
    ...anglesOf(camera.direction),
    fovRad: clamp(camera.verticalFov, 15, 110) * kRadPerDegree,
    ...cutAt(camera.cutHeight),
  };
}

function cutAt(heightM: number | null | undefined): { cutHeightM?: number } {
  return heightM === null || heightM === undefined ? {} : { cutHeightM: heightM };
}

// Where the eye is below the cut it sees ceilings, as anybody in the home does.
export function cutHeightSeen(pose: Pose): number | undefined {
  return pose.cutHeightM !== undefined && pose.position[1] > pose.cutHeightM ? pose.cutHeightM : undefined;
}

export function basisOf(pose: Pose): Basis {
  const forward = directionOf(pose.yawRad, pose.pitchRad);
  const right: Vec3 = [Math.cos(pose.yawRad), 0, -Math.sin(pose.yawRad)];
  return { right, up: cross(right, forward), forward };
}

// The vertical angle of view in this viewport: on an upright screen it grows, so that the sides of the room stay in the
// picture.
export function verticalFovRad(pose: Pose, viewport: Viewport): number {
  const aspect = viewport.width / viewport.height;
  if (aspect >= kNarrowestAspect) return pose.fovRad;
  return Math.min(kMaxFovRad, 2 * Math.atan((Math.tan(pose.fovRad / 2) * kNarrowestAspect) / aspect));
}

// CSS pixels that one metre at a depth of one metre takes.
export function pixelsPerTangent(pose: Pose, viewport: Viewport): number {
  return viewport.height / (2 * Math.tan(verticalFovRad(pose, viewport) / 2));
}

// Null for a point behind the eye.
export function project(pose: Pose, viewport: Viewport, point: Vec3): ScreenPoint | null {
  const { right, up, forward } = basisOf(pose);
  const offset = subtract(point, pose.position);
  const depthM = dot(offset, forward);
  if (depthM < kNearM) return null;
  const pixels = pixelsPerTangent(pose, viewport) / depthM;
  return {
    x: viewport.width / 2 + dot(offset, right) * pixels,
    y: viewport.height / 2 - dot(offset, up) * pixels,
    depthM,
  };
}

// Both ends of a segment on the screen, cut where it passes behind the eye; null if none of it is before the eye.
export function projectSegment(
  pose: Pose,
  viewport: Viewport,
  from: Vec3,
  to: Vec3,
): readonly [ScreenPoint, ScreenPoint] | null {
  const { forward } = basisOf(pose);
  const a = dot(subtract(from, pose.position), forward);
  const b = dot(subtract(to, pose.position), forward);
  if (a < kNearM && b < kNearM) return null;
  const near = kNearM * 1.01;
  const start = a < kNearM ? mix(from, to, (near - a) / (b - a)) : from;
  const end = b < kNearM ? mix(to, from, (near - b) / (a - b)) : to;
  const p = project(pose, viewport, start);
  const q = project(pose, viewport, end);
  return p && q ? [p, q] : null;
}

export function rayThrough(pose: Pose, viewport: Viewport, x: number, y: number): Ray {
  const { right, up, forward } = basisOf(pose);
  const pixels = pixelsPerTangent(pose, viewport);
  const aside = scale(right, (x - viewport.width / 2) / pixels);
  const above = scale(up, (viewport.height / 2 - y) / pixels);
  return { origin: pose.position, direction: normalize(add(forward, add(aside, above))) };
}

// As if the picture were taken hold of: what is under the pointer moves with it.
export function look(pose: Pose, viewport: Viewport, dxPx: number, dyPx: number): Pose {
  const radPerPixel = 1 / pixelsPerTangent(pose, viewport);
  return turned(pose, dxPx * radPerPixel, dyPx * radPerPixel);
}

export function turned(pose: Pose, yawRad: number, pitchRad: number): Pose {
  return {
    ...pose,
    yawRad: pose.yawRad + yawRad,
    pitchRad: clamp(pose.pitchRad + pitchRad, -kMaxPitchRad, kMaxPitchRad),
  };
}

// On the level, whatever the eye looks at: the height of the eye changes by upM alone.
export function walk(pose: Pose, forwardM: number, rightM: number, upM = 0): Pose {
  const ahead = directionOf(pose.yawRad, 0);
  const { right } = basisOf(pose);
  return {
    ...pose,
    position: add(add(pose.position, scale(ahead, forwardM)), add(scale(right, rightM), scale(kUp, upM))),
  };
}

// About a pivot, which stays where it is in the picture.
export function orbit(pose: Pose, pivot: Vec3, yawRad: number, pitchRad: number): Pose {
  const pitch = clamp(pose.pitchRad + pitchRad, -kMaxPitchRad, kMaxPitchRad) - pose.pitchRad;
  const offset = subtract(pose.position, pivot);
  const raised = rotateAbout(offset, basisOf(pose).right, pitch);
  const swung = rotateAbout(raised, kUp, yawRad);
  return { ...pose, position: add(pivot, swung), yawRad: pose.yawRad + yawRad, pitchRad: pose.pitchRad + pitch };
}

// Nearer to a pivot or farther from it, by a factor of the distance; never nearer than 0.2 m.
export function dolly(pose: Pose, pivot: Vec3, factor: number): Pose {
  const offset = subtract(pose.position, pivot);
  const distance = length(offset);
  if (distance < 1e-6) return pose;
  return { ...pose, position: add(pivot, scale(offset, Math.max(0.2, distance * factor) / distance)) };
}

export function lookAt(pose: Pose, target: Vec3): Pose {
  return { ...pose, ...anglesOf(subtract(target, pose.position)) };
}

// Between two poses, the shorter way round; t 0 to 1.
export function between(a: Pose, b: Pose, t: number): Pose {
  const turn = Math.atan2(Math.sin(b.yawRad - a.yawRad), Math.cos(b.yawRad - a.yawRad));
  return {
    position: mix(a.position, b.position, t),
    yawRad: a.yawRad + turn * t,
    pitchRad: a.pitchRad + (b.pitchRad - a.pitchRad) * t,
    fovRad: a.fovRad + (b.fovRad - a.fovRad) * t,
    ...cutAt(b.cutHeightM ?? (t < 1 ? a.cutHeightM : undefined)), // the home stays open on the way down into it
  };
}
