import assert from "node:assert/strict";
import { test } from "node:test";
import { LightMeter } from "../../src/light_meter.js";
import type { FrameHeader } from "../../src/frame.js";

const turn = () => new Promise(resolve => setImmediate(resolve));
const frame = (camera: number, quick = false) => ({ camera, revision: 1, quick }) as FrameHeader;

function meter() {
  const asked: { at: [number, number]; answer: (hit: null | undefined) => void }[] = [];
  const light = new LightMeter(
    (x, y) => new Promise(resolve => asked.push({ at: [x, y], answer: resolve })),
    () => {},
  );
  light.turn(true);
  return { light, asked };
}

test("one question is under way, and the newest place is asked for next", async () => {
  const { light, asked } = meter();
  for (const x of [1, 2, 3]) light.hold(x, 0);
  assert.deepEqual(
    asked.map(({ at }) => at[0]),
    [1],
  );
  asked[0]!.answer(null);
  await turn();
  assert.deepEqual(
    asked.map(({ at }) => at[0]),
    [1, 3],
  );
  assert.deepEqual(light.reading, { at: [1, 0], hit: null });
});

test("it reads anew when the eye or the home has changed, from whole frames only", async () => {
  const { light, asked } = meter();
  light.hold(5, 5);
  asked[0]!.answer(null);
  await turn();
  light.shown(frame(2));
  assert.equal(asked.length, 2);
  asked[1]!.answer(null);
  await turn();
  light.shown(frame(2));
  light.shown(frame(3, true));
  assert.equal(asked.length, 2);
});

test("switched off it shows nothing, even if an answer comes late", async () => {
  const { light, asked } = meter();
  light.hold(1, 1);
  light.turn(false);
  asked[0]!.answer(null);
  await turn();
  assert.equal(light.reading, null);
  light.turn(true);
  light.hold(2, 2);
  assert.equal(asked.length, 2);
});

test("an answer that fails leaves it ready for the next", async () => {
  const { light, asked } = meter();
  light.hold(1, 1);
  asked[0]!.answer(undefined);
  await turn();
  assert.equal(light.reading, null);
  light.hold(2, 2);
  assert.equal(asked.length, 2);
});
