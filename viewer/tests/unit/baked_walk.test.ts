import assert from "node:assert/strict";
import { test } from "node:test";
import { Bvh } from "../../baked/src/bvh.js";
import { frameOf, storeyAt } from "../../baked/src/floor_plan.js";
import { eyeOfCamera, Mover } from "../../baked/src/mover.js";
import { Pace } from "../../baked/src/pace.js";
import { insideOutline, middleOf, roomAt, roomInView } from "../../baked/src/rooms.js";
import { floorBelow, freePlace, hasHeadroom, walked, type Body } from "../../baked/src/walk.js";
import type { Vec3 } from "../../src/vector.js";
import { near, nearAll } from "./near.js";

type Quad = readonly [Vec3, Vec3, Vec3, Vec3];
function worldOf(quads: readonly Quad[]): Bvh {
  const index = quads.flatMap((_, i) => [0, 1, 2, 0, 2, 3].map(c => 4 * i + c));
  return new Bvh(Float32Array.from(quads.flat(2)), Uint32Array.from(index));
}
const level = (y: number, x0: number, x1: number, z0: number, z1: number): Quad => [
  [x0, y, z0],
  [x1, y, z0],
  [x1, y, z1],
  [x0, y, z1],
];
const wallX = (x: number, z0: number, z1: number, y0 = 0, y1 = 2.5): Quad => [
  [x, y0, z0],
  [x, y0, z1],
  [x, y1, z1],
  [x, y1, z0],
];
const at = (x: number, y: number, z: number): Body => ({ feet: [x, y, z], gapM: 0 });

test("a ray hits the nearest of many triangles, as a search of all finds it", () => {
  let seed = 1;
  const random = () => (seed = (seed * 16807) % 2147483647) / 2147483647;
  const quads = Array.from({ length: 300 }, (): Quad => {
    const [x, y, z, s] = [10 * random(), 10 * random(), 10 * random(), random()];
    return [
      [x, y, z],
      [x + s, y, z + random()],
      [x + s, y + s, z],
      [x, y + s, z + random()],
    ];
  });
  const world = worldOf(quads);
  const singles = quads.map(q => worldOf([q]));
  for (let i = 0; i < 50; ++i) {
    const origin: Vec3 = [10 * random(), 10 * random(), -1];
    const d = [random() - 0.5, random() - 0.5, 1];
    const size = Math.hypot(...d);
    const direction = d.map(c => c / size) as unknown as Vec3;
    const expected = Math.min(...singles.map(w => w.raycast(origin, direction)?.distance ?? Infinity));
    near(Math.min(1e9, world.raycast(origin, direction)?.distance ?? Infinity), Math.min(1e9, expected), 1e-5);
  }
});

test("the nearest point of a triangle is at its corners, edges or inside", () => {
  const world = new Bvh(Float32Array.from([0, 0, 0, 1, 0, 0, 0, 1, 0]), Uint32Array.from([0, 1, 2]));
  nearAll(world.nearestOn(0, [-1, -1, 0]), [0, 0, 0]);
  nearAll(world.nearestOn(0, [0.5, -1, 1]), [0.5, 0, 0]);
  nearAll(world.nearestOn(0, [0.2, 0.3, 2]), [0.2, 0.3, 0]);
  nearAll(world.nearestOn(0, [1, 1, 0]), [0.5, 0.5, 0]);
});

test("walls hold, and are slid along", () => {
  const world = worldOf([level(0, -5, 5, -5, 5), wallX(1, -5, 5)]);
  const straight = walked(world, at(0, 0, 0), 3, 0);
  near(straight.feet[0], 0.8, 0.01);
  const aslant = walked(world, at(0, 0, 0), 3, 2);
  near(aslant.feet[0], 0.8, 0.01);
  near(aslant.feet[2], 2, 0.02);
});

test("stairs are climbed, tables and drops are not", () => {
  const stairs = [0, 1, 2, 3, 4].flatMap((i): Quad[] => [
    level(0.18 * (i + 1), 1 + 0.28 * i, 6, -1, 1),
    wallX(1 + 0.28 * i, -1, 1, 0.18 * i, 0.18 * (i + 1)),
  ]);
  const world = worldOf([level(0, -5, 5, -5, 5), ...stairs]);
  const up = walked(world, at(0, 0, 0), 3, 0);
  near(up.feet[1], 0.9, 1e-5);
  const down = walked(world, up, -3, 0);
  near(down.feet[1], 0, 1e-5);
  const table = worldOf([level(0, -5, 5, -5, 5), level(0.75, 1, 2, -1, 1), wallX(1, -1, 1, 0.5, 0.75)]);
  near(walked(table, at(0, 0, 0), 3, 0).feet[0], 0.8, 0.02);
  const cliff = worldOf([level(0, -5, 1, -5, 5), level(-2.6, -5, 9, -5, 5)]);
  const stopped = walked(cliff, at(0, 0, 0), 3, 0);
  assert.ok(stopped.feet[0] < 2 && stopped.feet[1] === 0);
});

test("a threshold without a floor is crossed", () => {
  const world = worldOf([level(0, -5, 1, -5, 5), level(0, 1.3, 5, -5, 5)]);
  near(walked(world, at(0, 0, 0), 2, 0).feet[0], 2, 0.01);
});

test("floors below and head room above", () => {
  const world = worldOf([level(0, -5, 5, -5, 5), level(1.2, 1, 2, 1, 2)]);
  near(floorBelow(world, 0, 1.6, 0, 0, 5)!, 0, 1e-6);
  assert.equal(floorBelow(world, 0, 1.6, 0, 0, 1), null);
  assert.ok(hasHeadroom(world, [0, 0, 0]));
  assert.ok(!hasHeadroom(world, [1.5, 0, 1.5]));
});

test("a place to stand is looked for beside the furniture", () => {
  const table = [level(0.75, -0.6, 0.6, -0.4, 0.4), wallX(-0.6, -0.4, 0.4, 0, 0.75), wallX(0.6, -0.4, 0.4, 0, 0.75)];
  const world = worldOf([level(0, -5, 5, -5, 5), ...table]);
  const place = freePlace(world, [0, 0, 0], x => x > 0);
  assert.ok(place[0] > 0 && Math.abs(place[1]) < 1e-6 && hasHeadroom(world, place), String(place));
  assert.deepEqual(
    freePlace(world, [3, 0, 3], () => true),
    [3, 0, 3],
  );
});

test("the eye stands as the camera did, and walks where it looks", () => {
  const mover = new Mover(() => true);
  mover.stand(eyeOfCamera({ name: "", position: [0, 1.4, 0], forward: [1, 0, 0], yFovDeg: 50 }));
  mover.useWorld(worldOf([level(0, -50, 50, -50, 50)]));
  assert.deepEqual([mover.eye.position, mover.eye.fovDeg], [[0, 1.4, 0], 50]);
  near(mover.eye.yawDeg, -90);
  const still = { forward: 0, right: 0, turnDeg: 0, tiltDeg: 0, fast: false };
  assert.equal(mover.update(0.016, still), true);
  assert.equal(mover.update(0.016, still), false);
  for (let i = 0; i < 60; ++i) mover.update(1 / 60, { ...still, forward: 1 });
  nearAll(mover.eye.position, [1.5, 1.6, 0], 0.01);
  for (let i = 0; i < 60; ++i) mover.update(1 / 60, { ...still, right: 1 });
  nearAll(mover.eye.position, [1.5, 1.6, 1.5], 0.01);
});

test("rooms are found by place, and have a middle that is inside", () => {
  const floor = [
    [0, 0],
    [4, 0],
    [4, 1],
    [1, 1],
    [1, 4],
    [0, 4],
  ] as const;
  assert.ok(insideOutline(floor, 0.5, 3) && !insideOutline(floor, 2, 2));
  const rooms = [
    { name: "a", floor, elevationM: 0, heightM: 2.5 },
    { name: "b", floor, elevationM: 2.8, heightM: 2.5 },
  ];
  assert.deepEqual(
    [roomAt(rooms, [0.5, 1.6, 3]), roomAt(rooms, [0.5, 4.4, 3]), roomAt(rooms, [3, 1, 3])],
    [0, 1, null],
  );
  assert.ok(insideOutline(floor, ...middleOf(rooms[0]!)));
  assert.equal(storeyAt(rooms, 4.4), 2.8);
  assert.equal(storeyAt(rooms, 1.6), 0);
  near(frameOf(rooms, 100, 100).scale, 20);
});

test("an eye before an open side is in the room that it looks into, not in one behind a wall", () => {
  const floor = [
    [0, 0],
    [4, 0],
    [4, 4],
    [0, 4],
  ] as const;
  const rooms = [{ name: "a", floor, elevationM: 0, heightM: 2.5 }];
  const open = worldOf([level(0, 0, 4, 0, 4), wallX(4, 0, 4)]);
  const shut = worldOf([level(0, 0, 4, 0, 4), wallX(4, 0, 4), wallX(0, 0, 4)]);
  const eye: Vec3 = [-2, 1.5, 2];
  assert.equal(roomInView(rooms, open, eye, [1, 0, 0]), 0);
  assert.equal(roomInView(rooms, open, eye, [-1, 0, 0]), null);
  assert.equal(roomInView(rooms, shut, eye, [1, 0, 0]), null);
  assert.equal(roomInView(rooms, open, [2, 6, 2], [0, -1, 0]), 0);
  assert.equal(roomInView(rooms, open, [2, 1.5, 2], [-1, 0, 0]), 0);
  assert.equal(roomInView(rooms, null, eye, [1, 0, 0]), null);
});

test("slow frames get fewer pixels, unless that does not help", () => {
  const run = (pace: Pace, ms: (share: number) => number, frames: number) => {
    for (let i = 0; i < frames; ++i) pace.took(ms(pace.share));
    return pace.share;
  };
  assert.ok(run(new Pace(), share => 40 * share ** 2, 400) < 0.85);
  assert.equal(
    run(new Pace(), () => 33, 400),
    1,
  );
  assert.equal(
    run(new Pace(), () => 16, 400),
    1,
  );
  const pace = new Pace();
  run(pace, share => 60 * share ** 2, 200);
  assert.ok(run(pace, share => 10 * share ** 2, 400) > 0.99);
});
