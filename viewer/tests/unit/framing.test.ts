import assert from "node:assert/strict";
import { test } from "node:test";
import { directionOf, project, type Pose } from "../../src/camera.js";
import {
  lampBox,
  overFloor,
  poseForLamp,
  poseForRoom,
  poseForThing,
  roomAround,
  type Surroundings,
} from "../../src/framing.js";
import type { Box, Lamp, Thing } from "../../src/protocol.js";
import { dot, kRadPerDegree, length, normalize, subtract, type Vec3 } from "../../src/vector.js";
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
const around: Surroundings = { rooms, bounds: { low: [0, 0, 0], high: [11, 2.6, 6] }, things: [] };
const nothing: Surroundings = { rooms: [], bounds: null, things: [] };
const viewport = { width: 800, height: 600 };
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
  const seen = poseForThing(chair, around, pose);
  assert.deepEqual(seen.position, pose.position);
  const middle = project(seen, { width: 800, height: 600 }, [2.75, 0.45, 2.75])!;
  near(middle.x, 400, 1e-6);
  near(middle.y, 300, 1e-6);
});

test("a thing in another room is gone to, and seen from inside that room", () => {
  const lamp = { low: [5.9, 1.2, 4.9], high: [6.1, 1.4, 5.1] } as const;
  const seen = poseForThing(lamp, around, pose);
  assert.ok(overFloor(ell.floor, seen.position[0], seen.position[2]));
  const middle = project(seen, { width: 800, height: 600 }, [6, 1.3, 5])!;
  near(middle.x, 400, 1e-6);
});

test("without rooms one stands before the thing, on the side where one was", () => {
  const seen = poseForThing({ low: [20, 0, 0], high: [21, 1, 1] }, nothing, pose);
  assert.ok(seen.position[0] > 15 && seen.position[0] < 20);
});

// A box of this half width, and half a metre high.
const boxAround = ([x, y, z]: Vec3, half: number): Box => ({
  low: [x - half, y - 0.25, z - half],
  high: [x + half, y + 0.25, z + half],
});

function seenWhole(seen: Pose, box: Box): boolean {
  return [0, 1, 2, 3, 4, 5, 6, 7].every(i => {
    const corner: Vec3 = [
      (i & 1 ? box.high : box.low)[0],
      (i & 2 ? box.high : box.low)[1],
      (i & 4 ? box.high : box.low)[2],
    ];
    const at = project(seen, viewport, corner);
    return at !== null && at.x > 0 && at.x < viewport.width && at.y > 0 && at.y < viewport.height;
  });
}

test("a hanging lamp is seen whole, from eye height, from outside of its shade", () => {
  const box = boxAround([2, 2.1, 2], 0.35);
  const starts: Vec3[] = [
    [1, 1.6, 1],
    [2, 2.1, 2],
    [2, 1.6, 2.1],
    [9, 1.6, 1],
  ];
  for (const position of starts) {
    const seen = poseForLamp(box, around, { ...pose, position }, viewport);
    const away = length(subtract(seen.position, [2, 2.1, 2]));
    assert.ok(away > 1.4 && away < 2.6, `${position}: ${away} m`);
    near(seen.position[1], 1.6);
    assert.ok(overFloor(square.floor, seen.position[0], seen.position[2]), `${position}: outside of the room`);
    assert.ok(seenWhole(seen, box), `${position}: not seen whole`);
  }
});

test("a lamp is seen from where nothing stands before it", () => {
  const box = boxAround([2, 1, 3.2], 0.15);
  const turned = poseForLamp(box, around, pose, viewport);
  assert.deepEqual(turned.position, pose.position, "seen well from where one stands");
  const wall = { low: [0, 0, 2.4], high: [4, 2.3, 2.8] } as const;
  const seen = poseForLamp(box, { ...around, things: [wall] }, pose, viewport);
  assert.ok(seen.position[2] > 2.8, JSON.stringify(seen));
});

test("a lamp in a small room is seen from inside that room", () => {
  const cell = {
    name: "Cell",
    low: [20, 0, 20],
    high: [21.4, 2.6, 21.4],
    floor: [
      [20, 20],
      [21.4, 20],
      [21.4, 21.4],
      [20, 21.4],
    ],
  } as const;
  const box = boxAround([20.7, 2.2, 20.7], 0.15);
  const { position } = poseForLamp(box, { ...around, rooms: [cell] }, pose, viewport);
  assert.ok(overFloor(cell.floor, position[0], position[2]), position.join(", "));
  assert.ok(Math.hypot(position[0] - 20.7, position[2] - 20.7) > 0.35, "not under the lamp");
});

test("a lamp in the wall is seen from the room before it, not from around its corner", () => {
  const { position } = poseForLamp(
    boxAround([6, 1.8, 6.1], 0.1),
    around,
    { ...pose, position: [10, 1.6, 1] },
    viewport,
  );
  assert.ok(overFloor(ell.floor, position[0], position[2]) && position[2] > 2 && position[0] < 7, position.join(", "));
});

test("without rooms a lamp is seen from within the bounds of the home, at about its height", () => {
  const outside: Pose = { ...pose, position: [-3, 9, 2] };
  const { position } = poseForLamp(boxAround([0.5, 2, 2], 0.15), { ...around, rooms: [] }, outside, viewport);
  assert.ok(position[0] > 0 && Math.abs(position[1] - 2) < 1.3, position.join(", "));
});

test("the box of a lamp is that of its body, or of the shade around it", () => {
  const lamp = { object: null, position: [2, 2, 2] } as unknown as Lamp;
  const thing = (id: string, half: number, more: object = {}) =>
    ({ id, movable: true, hidden: false, ...boxAround([2, 2, 2], half), ...more }) as unknown as Thing;
  const room = thing("room", 4, { movable: false });
  const hall = thing("hall", 3);
  const shade = thing("shade", 0.3);
  assert.equal(lampBox(lamp, [room, hall, shade]), shade);
  assert.equal(lampBox({ ...lamp, object: "hall" }, [room, shade, hall]), hall);
  const bare = lampBox(lamp, [room, hall, thing("gone", 0.2, { hidden: true })]);
  near(bare.high[0] - bare.low[0], 0.3);
});
