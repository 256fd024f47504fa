import assert from "node:assert/strict";
import { test } from "node:test";
import { followed, gainsFor, luminance, meanLight } from "../../baked/src/white_balance.js";
import type { Vec3 } from "../../src/vector.js";
import { nearAll } from "./near.js";

const unit = (rgb: Vec3): Vec3 => rgb.map(c => c / luminance(rgb)) as unknown as Vec3;
const warm = unit([1.6, 0.9, 0.35]);
const cool = unit([1, 1, 1.02]);
const whites = [
  { light: warm, shown: unit([1.1, 0.98, 0.85]) },
  { light: cool, shown: unit([1, 1, 1]) },
];
const times = (a: Vec3, b: Vec3): Vec3 => [a[0] * b[0], a[1] * b[1], a[2] * b[2]];

test("light of a white is shown as that white is, however bright", () => {
  for (const { light, shown } of whites)
    for (const bright of [0.01, 1, 5000])
      nearAll(times(gainsFor(whites, light.map(c => c * bright) as unknown as Vec3)!, light), shown, 1e-6);
});

test("light that no one calls white keeps its colour, and none tells nothing", () => {
  nearAll(gainsFor(whites, [0.1, 0.2, 3])!, [1, 1, 1], 1e-9);
  assert.equal(gainsFor(whites, [0, 0, 0]), null);
  assert.equal(gainsFor([], warm), null);
});

test("the mean of light counts a patch of sun as much as four times the mean", () => {
  const shareOf = ([r, g, b]: Vec3) => [r / (r + g + b), g / (r + g + b)] as const;
  const lamp = shareOf(warm);
  nearAll(unit(meanLight([lamp, lamp, [0, 0]], [3, 5, 0])), warm, 1e-6);
  // Nine places of 1 and one of 991: the mean is 100, so that the patch counts 400.
  const amounts = [...Array<number>(9).fill(1), 991];
  const mean = meanLight([...Array<readonly [number, number]>(9).fill(lamp), shareOf(cool)], amounts);
  nearAll(mean, [0, 1, 2].map(c => 9 * warm[c]! + 400 * cool[c]!) as unknown as Vec3, 1e-6);
});

test("gains are followed in time, and reached", () => {
  let gains: Vec3 = [1, 1, 1];
  const wanted: Vec3 = [0.7, 1, 2];
  const first = followed(gains, wanted, 0.1);
  assert.ok(first[0] < 1 && first[0] > 0.9 && first[2] > 1 && first[2] < 1.2);
  for (let i = 0; i < 100; ++i) gains = followed(gains, wanted, 0.1);
  assert.equal(gains, wanted);
});
