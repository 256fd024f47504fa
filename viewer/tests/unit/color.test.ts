import assert from "node:assert/strict";
import { test } from "node:test";
import { blackBody, hexFromLinear, linearFromHex, scaleTicks } from "../../src/color.js";
import { clock, duration, roundTo, threeDigits } from "../../src/numbers.js";
import { near } from "./near.js";

test("colours come back from what the browser shows", () => {
  for (const hex of ["#000000", "#ffffff", "#1b7fe3", "#0a0b0c"]) assert.equal(hexFromLinear(linearFromHex(hex)), hex);
  near(linearFromHex("#808080")[0], 0.2158605, 1e-6);
  assert.equal(hexFromLinear([2, -1, 0.5]), "#ff00bc");
});

test("lamps get bluer with their temperature; 6500 K is all but white", () => {
  const kelvins = [1800, 2700, 4000, 6500, 10000];
  const blueness = kelvins.map(k => blackBody(k)[2] / blackBody(k)[0]);
  for (let i = 1; i < blueness.length; ++i) assert.ok(blueness[i]! > blueness[i - 1]!);
  const white = blackBody(6500);
  white.forEach(channel => assert.ok(channel > 0.93, String(white)));
  // CIE tables: 2700 K at x 0.4599, y 0.4106, in linear Rec.709 with red 1.
  const [, green, blue] = blackBody(2700);
  near(green, 0.4234, 0.02);
  near(blue, 0.0946, 0.02);
});

test("a scale has ticks at 1, 2 and 5, in their places", () => {
  const ticks = scaleTicks(10, 1000);
  assert.deepEqual(
    ticks.map(({ value }) => value),
    [10, 20, 50, 100, 200, 500, 1000],
  );
  near(ticks[3]!.at, 0.5);
  assert.deepEqual(
    scaleTicks(1, 1e6).map(({ value }) => value),
    [1, 10, 100, 1000, 10000, 100000, 1000000],
  );
  assert.deepEqual(scaleTicks(0, 10), []);
  assert.deepEqual(scaleTicks(10, 10), []);
});

test("numbers are told to three digits", () => {
  assert.deepEqual([0, 0.00123, 0.123456, 12.345, 212.4, 12345].map(threeDigits), [
    "0",
    "0.0012",
    "0.123",
    "12.3",
    "212",
    "12345",
  ]);
  assert.equal(clock(17.5), "17:30");
  assert.equal(clock(9.999), "10:00");
  assert.equal(duration(0.2), "1\u202fs");
  assert.equal(duration(200), "3\u202fmin");
  assert.equal(roundTo(0.1 + 0.2, 0.01), 0.3);
});
