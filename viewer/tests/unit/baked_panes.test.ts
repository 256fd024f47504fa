import assert from "node:assert/strict";
import { test } from "node:test";
import * as THREE from "three";
import { PaneOrder } from "../../baked/src/pane_order.js";
import { sheetsOf } from "../../baked/src/sheets.js";

// Triangles that lie in planes of these heights.
function sheets(...heights: number[]): { index: Uint32Array; positions: Float32Array } {
  const positions = heights.flatMap(y => [0, y, 0, 1, y, 0, 0, y, 1]);
  return {
    index: Uint32Array.from({ length: 3 * heights.length }, (_, i) => i),
    positions: Float32Array.from(positions),
  };
}

test("the furthest triangle is drawn first, from wherever it is seen", () => {
  const { index, positions } = sheets(0.7, 0.9, 0.8);
  const drawn = new THREE.BufferAttribute(index.slice(), 1);
  const order = new PaneOrder(index, positions, drawn);
  const first = () => [0, 1, 2].map(k => drawn.array[3 * k]! / 3);
  order.sort(new THREE.Vector3(0.3, 2, 0.3));
  assert.deepEqual(first(), [0, 2, 1]);
  order.sort(new THREE.Vector3(0.3, -1, 0.3));
  assert.deepEqual(first(), [1, 2, 0]);
  assert.deepEqual(
    [...drawn.array].sort((a, b) => a - b),
    [...index],
  );
});

test("a step of a few millimetres sorts nothing anew", () => {
  const { index, positions } = sheets(0.7, 0.9);
  const drawn = new THREE.BufferAttribute(index.slice(), 1);
  const order = new PaneOrder(index, positions, drawn);
  order.sort(new THREE.Vector3(0, 2, 0));
  const { version } = drawn;
  order.sort(new THREE.Vector3(0.003, 2, 0));
  assert.equal(drawn.version, version);
});

test("a table top of four triangles is drawn over its underside of two", () => {
  const corners = (y: number) => [0, y, 0, 0.7, y, 0, 0.7, y, 1, 0, y, 1];
  const positions = Float32Array.from([...corners(0.75), 0.35, 0.75, 0.5, ...corners(0.742), ...corners(0.742)]);
  // The last four vertices stand where four others do.
  const index = Uint32Array.from([0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 5, 6, 7, 9, 11, 12]);
  const drawn = new THREE.BufferAttribute(index.slice(), 1);
  const order = new PaneOrder(index, positions, drawn);
  for (const eye of [
    [-2, 1.5, 1.2],
    [0.5, 1.2, 0.9],
    [3, 1.6, -2],
  ]) {
    order.sort(new THREE.Vector3(...eye));
    const heights = [0, 1, 2, 3, 4, 5].map(t => positions[3 * drawn.array[3 * t]! + 1]! > 0.745);
    assert.deepEqual(heights, [false, false, true, true, true, true]);
  }
});

test("sides of a tumbler are sheets of their own, the far ones first", () => {
  const sides = 12;
  const corner = (k: number, y: number) => [
    Math.cos((2 * Math.PI * k) / sides),
    y,
    Math.sin((2 * Math.PI * k) / sides),
  ];
  const positions = Float32Array.from(
    Array.from({ length: sides }, (_, k) => [
      ...corner(k, 0),
      ...corner(k + 1, 0),
      ...corner(k + 1, 1),
      ...corner(k, 1),
    ]).flat(),
  );
  const index = Uint32Array.from(
    Array.from({ length: sides }, (_, k) => [0, 1, 2, 0, 2, 3].map(i => 4 * k + i)).flat(),
  );
  const sheets = sheetsOf(index, positions, 2 * sides);
  assert.equal(sheets.length, sides);
  assert.ok(sheets.every(sheet => sheet.triangles.length === 2));
  const drawn = new THREE.BufferAttribute(index.slice(), 1);
  new PaneOrder(index, positions, drawn).sort(new THREE.Vector3(5, 0.5, 0));
  const xOf = (t: number) => positions[3 * drawn.array[3 * t]!]!;
  assert.ok(xOf(0) < -0.8 && xOf(2 * sides - 1) > 0.8);
});
