import assert from "node:assert/strict";
import { test } from "node:test";
import * as THREE from "three";
import { PaneOrder } from "../../baked/src/pane_order.js";

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
