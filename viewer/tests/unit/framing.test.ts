import assert from "node:assert/strict";
import { test } from "node:test";
import { directionOf, project, type Pose } from "../../src/camera.js";
import { overFloor, poseForRoom, poseForThing, roomAround } from "../../src/framing.js";
import { dot, kRadPerDegree, normalize, subtract } from "../../src/vector.js";
import { near } from "./near.js";

const square = {
  name: "Square",
  low: [0, 0, 0],
  high: [4, 2.6, 4],
  floor: [
    [0, 0],
    [4, 0],
    [4, 4],
    [0, 4],
  ],
} as const;
const ell = {
  name: "L",
  low: [5, 0, 0],
  high: [11, 2.6, 6],
  floor: [
    [5, 0],
    [11, 0],
    [11, 2],
    [7, 2],
    [7, 6],
    [5, 6],
  ],
} as const;
const rooms = [square, ell];
const pose: Pose = { position: [1, 1.6, 1], yawRad: 0, pitchRad: 0, fovRad: 55 * kRadPerDegree };

test("a place is over the floor of its room alone", () => {
  assert.ok(overFloor(ell.floor, 6, 5));
  assert.ok(!overFloor(ell.floor, 9, 4));
  assert.equal(roomAround(rooms, [2, 1, 2])?.name, "Square");
  assert.equal(roomAround(rooms, [10, 1, 1])?.name, "L");
  assert.equal(roomAround(rooms, [2, 5, 2]), null);
});

test("a room is seen from inside it, its middle ahead", () => {
  for (const room of rooms) {
    const seen = poseForRoom(room, pose);
    assert.ok(overFloor(room.floor, seen.position[0], seen.position[2]), room.name);
    near(seen.position[1], 1.6);
    const toMiddle = normalize(
      subtract([(room.low[0] + room.high[0]) / 2, seen.position[1], (room.low[2] + room.high[2]) / 2], seen.position),
    );
    assert.ok(dot(toMiddle, directionOf(seen.yawRad, 0)) > 0.99, room.name);
  }
});

test("a thing at a good distance in the same room is looked at from where one stands", () => {
  const chair = { low: [2.5, 0, 2.5], high: [3, 0.9, 3] } as const;
  const seen = poseForThing(chair, rooms, pose);
  assert.deepEqual(seen.position, pose.position);
  const middle = project(seen, { width: 800, height: 600 }, [2.75, 0.45, 2.75])!;
  near(middle.x, 400, 1e-6);
  near(middle.y, 300, 1e-6);
});

test("a thing in another room is gone to, and seen from inside that room", () => {
  const lamp = { low: [5.9, 1.2, 4.9], high: [6.1, 1.4, 5.1] } as const;
  const seen = poseForThing(lamp, rooms, pose);
  assert.ok(overFloor(ell.floor, seen.position[0], seen.position[2]));
  const middle = project(seen, { width: 800, height: 600 }, [6, 1.3, 5])!;
  near(middle.x, 400, 1e-6);
});

test("without rooms one stands before the thing, on the side where one was", () => {
  const seen = poseForThing({ low: [20, 0, 0], high: [21, 1, 1] }, [], pose);
  assert.ok(seen.position[0] > 15 && seen.position[0] < 20);
});
