import assert from "node:assert/strict";
import { test } from "node:test";
import { project, rayThrough, type Pose, type ScreenPoint, type Viewport } from "../../src/camera.js";
import { dragBy, gizmoAt, handleAt } from "../../src/gizmo.js";
import { add, kRadPerDegree, type Vec3 } from "../../src/vector.js";
import { near, nearAll } from "./near.js";

const viewport: Viewport = { width: 960, height: 540 };
const pose: Pose = { position: [0, 1.6, 3], yawRad: 0.15, pitchRad: -0.35, fovRad: 55 * kRadPerDegree };
const place: Vec3 = [0.1, 0.6, 0];

const rayAt = (point: ScreenPoint) => rayThrough(pose, viewport, point.x, point.y);
const seen = (point: Vec3) => project(pose, viewport, point)!;

test("handles are as large near the eye as far from it", () => {
  const lengthOf = (z: number) => {
    const gizmo = gizmoAt({ ...pose, yawRad: 0, pitchRad: 0 }, viewport, [0, 1.6, z], false)!;
    const up = gizmo.arrows.find(({ handle }) => handle === "y")!;
    return Math.hypot(up.tip.x - gizmo.center.x, up.tip.y - gizmo.center.y);
  };
  near(lengthOf(1), lengthOf(-8), 1e-6);
});

test("an arrow that points at the eye is left out, and nothing is drawn behind it", () => {
  const level = { ...pose, yawRad: 0, pitchRad: 0 };
  const gizmo = gizmoAt(level, viewport, [0, 1.6, 0], false)!;
  assert.deepEqual(
    gizmo.arrows.map(({ handle }) => handle),
    ["x", "y"],
  );
  assert.equal(gizmo.ring.length, 0);
  assert.equal(gizmoAt(level, viewport, [0, 1.6, 5], true), null);
});

test("the pointer finds the handle that it is on", () => {
  const gizmo = gizmoAt(pose, viewport, place, true)!;
  for (const { handle, tip } of gizmo.arrows) assert.equal(handleAt(gizmo, tip.x, tip.y, 8), handle);
  assert.equal(handleAt(gizmo, gizmo.center.x + 3, gizmo.center.y, 8), "floor");
  const aside = gizmo.ring[30]!;
  assert.equal(handleAt(gizmo, aside.x, aside.y, 4), "turn");
  assert.equal(handleAt(gizmo, 5, 5, 20), null);
});

test("pulling an arrow moves along its axis, as far as the pointer goes", () => {
  for (const [handle, by] of [
    ["x", [0.5, 0, 0]],
    ["y", [0, 0.3, 0]],
    ["z", [0, 0, -0.7]],
  ] as const) {
    const drag = dragBy(handle, place, rayAt(seen(place)), rayAt(seen(add(place, by))));
    assert.ok(drag);
    nearAll(drag.by, by, 1e-6);
    near(drag.turnRad, 0);
  }
});

test("pulling the disc moves on the level, under the pointer", () => {
  const by: Vec3 = [0.4, 0, 0.6];
  const drag = dragBy("floor", place, rayAt(seen(place)), rayAt(seen(add(place, by))));
  nearAll(drag!.by, by, 1e-6);
});

test("pulling the ring turns counter-clockwise seen from above", () => {
  const east = seen(add(place, [0.3, 0, 0]));
  const north = seen(add(place, [0, 0, -0.3]));
  near(dragBy("turn", place, rayAt(east), rayAt(north))!.turnRad, Math.PI / 2, 1e-6);
});

test("rays that never meet the level tell nothing", () => {
  const up = { origin: pose.position, direction: [0, 1, 0] as Vec3 };
  assert.equal(dragBy("floor", place, up, up), null);
  assert.equal(dragBy("y", place, up, up), null);
});
