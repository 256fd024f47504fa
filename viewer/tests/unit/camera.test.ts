import assert from "node:assert/strict";
import { test } from "node:test";
import * as camera from "../../src/camera.js";
import { add, kRadPerDegree, length, scale, subtract, type Vec3 } from "../../src/vector.js";
import { near, nearAll } from "./near.js";

const wide: camera.Viewport = { width: 1600, height: 900 };
const pose: camera.Pose = { position: [1, 1.6, 2], yawRad: 0.7, pitchRad: -0.3, fovRad: 55 * kRadPerDegree };

test("yaw 0 looks along -z with x to the right, and grows counter-clockwise seen from above", () => {
  const ahead = camera.basisOf({ ...pose, yawRad: 0, pitchRad: 0 });
  nearAll(ahead.forward, [0, 0, -1]);
  nearAll(ahead.right, [1, 0, 0]);
  nearAll(ahead.up, [0, 1, 0]);
  nearAll(camera.directionOf(Math.PI / 2, 0), [-1, 0, 0]);
  nearAll(camera.directionOf(0, 0.5), [0, Math.sin(0.5), -Math.cos(0.5)]);
});

test("angles come back from a direction", () => {
  for (const [yaw, pitch] of [
    [0.3, 0.2],
    [-2.9, -1.2],
    [3.1, 1.4],
  ] as const) {
    const angles = camera.anglesOf(camera.directionOf(yaw, pitch));
    near(angles.yawRad, yaw, 1e-9);
    near(angles.pitchRad, pitch, 1e-9);
  }
  near(camera.anglesOf([0, 1, 0]).pitchRad, camera.kMaxPitchRad);
  near(camera.anglesOf([0, 0, 0]).yawRad, 0);
});

test("a point is seen where the ray through that place of the picture passes it", () => {
  for (const viewport of [wide, { width: 390, height: 700 }]) {
    for (const [x, y] of [
      [10, 20],
      [200, 350],
      [380, 690],
    ] as const) {
      const ray = camera.rayThrough(pose, viewport, x, y);
      near(length(ray.direction), 1);
      const seen = camera.project(pose, viewport, add(ray.origin, scale(ray.direction, 3.7)));
      assert.ok(seen);
      near(seen.x, x, 1e-6);
      near(seen.y, y, 1e-6);
    }
  }
});

test("the top of the picture is half the vertical angle of view above its middle", () => {
  const level = { ...pose, pitchRad: 0 };
  const top = camera.rayThrough(level, wide, wide.width / 2, 0);
  near(Math.asin(top.direction[1]), pose.fovRad / 2, 1e-9);
});

test("what is behind the eye is not seen, and segments are cut there", () => {
  const level = { ...pose, position: [0, 0, 0] as Vec3, yawRad: 0, pitchRad: 0 };
  assert.equal(camera.project(level, wide, [0, 0, 1]), null);
  assert.equal(camera.projectSegment(level, wide, [0, 0, 1], [1, 0, 2]), null);
  const cut = camera.projectSegment(level, wide, [0, 0, -2], [0, 0, 2]);
  assert.ok(cut);
  near(cut[0].depthM, 2);
  assert.ok(cut[1].depthM > 0 && cut[1].depthM < 0.05);
});

test("an upright picture sees as far to the sides as one of aspect 1.1", () => {
  near(camera.verticalFovRad(pose, wide), pose.fovRad);
  const upright = { width: 400, height: 500 };
  const sideways = Math.tan(camera.verticalFovRad(pose, upright) / 2) * 0.8;
  near(sideways, Math.tan(pose.fovRad / 2) * 1.1, 1e-9);
  assert.ok(camera.verticalFovRad(pose, { width: 100, height: 900 }) <= 110 * kRadPerDegree + 1e-9);
});

test("dragging takes hold of the picture: its middle follows the pointer", () => {
  const middle = camera.rayThrough(pose, wide, wide.width / 2, wide.height / 2);
  const point = add(middle.origin, scale(middle.direction, 4));
  const seen = camera.project(camera.look(pose, wide, 12, -7), wide, point);
  assert.ok(seen);
  assert.ok(Math.abs(seen.x - (wide.width / 2 + 12)) < 1.5, `x ${seen.x}`);
  assert.ok(Math.abs(seen.y - (wide.height / 2 - 7)) < 1.5, `y ${seen.y}`);
});

test("looking up and down ends before the zenith", () => {
  near(camera.look(pose, wide, 0, 1e6).pitchRad, camera.kMaxPitchRad);
  near(camera.look(pose, wide, 0, -1e6).pitchRad, -camera.kMaxPitchRad);
});

test("walking keeps the height of the eye, whatever it looks at", () => {
  const there = camera.walk({ ...pose, yawRad: 0, pitchRad: -1.2 }, 2, 0.5);
  nearAll(there.position, [1.5, 1.6, 0]);
  near(camera.walk(pose, 1, 1, 0.25).position[1], 1.85);
});

test("what is orbited stays where it is in the picture, at its distance", () => {
  const pivot: Vec3 = [0.2, 1.1, -1];
  const before = camera.project(pose, wide, pivot)!;
  const after = camera.orbit(pose, pivot, 0.4, 0.2);
  const seen = camera.project(after, wide, pivot)!;
  near(seen.x, before.x, 1e-6);
  near(seen.y, before.y, 1e-6);
  near(length(subtract(after.position, pivot)), length(subtract(pose.position, pivot)), 1e-9);
});

test("going nearer stops short of the pivot", () => {
  near(length(camera.dolly(pose, [1, 1.6, 0], 0.5).position.map((v, i) => v - [1, 1.6, 0][i]!) as unknown as Vec3), 1);
  near(camera.dolly(pose, [1, 1.6, 0], 1e-9).position[2], 0.2, 1e-9);
});

test("a move between two poses takes the shorter way round", () => {
  const half = camera.between({ ...pose, yawRad: 3 }, { ...pose, yawRad: -3 }, 0.5);
  near(Math.abs(half.yawRad), Math.PI, 1e-9);
  const end = camera.between(pose, { ...pose, position: [5, 1, 1], yawRad: 0.1, pitchRad: 0.1 }, 1);
  nearAll(end.position, [5, 1, 1]);
  near(end.yawRad, 0.1);
});

test("a home that is cut open stays so while the eye is above the cut, and on the way there and back", () => {
  const above = camera.poseFrom({ position: [0, 9, 9], direction: [0, -1, -1], verticalFov: 50, cutHeight: 2.5 });
  assert.equal(camera.cutHeightSeen(above), 2.5);
  assert.equal(camera.cutHeightSeen(camera.walk(above, 1, 0, 2)), 2.5);
  assert.equal(camera.cutHeightSeen(camera.walk(above, 0, 0, -7)), undefined);
  assert.equal(camera.cutHeightSeen(camera.between(pose, above, 0.9)), 2.5);
  assert.equal(camera.cutHeightSeen(camera.between(above, pose, 0.1)), 2.5);
  assert.equal(camera.between(above, pose, 1).cutHeightM, undefined);
  assert.equal(camera.poseFrom({ position: [0, 9, 9], direction: [0, -1, 0], verticalFov: 50 }).cutHeightM, undefined);
});
