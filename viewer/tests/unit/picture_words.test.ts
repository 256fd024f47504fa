import assert from "node:assert/strict";
import { test } from "node:test";
import type { FrameHeader } from "../../src/frame.js";
import { pictureWords, type PictureState } from "../../src/picture_words.js";

const frame = (change: Partial<FrameHeader> = {}): FrameHeader => ({
  number: 1,
  width: 960,
  height: 540,
  side: "whole",
  quick: false,
  settled: false,
  lightBehind: false,
  falseColor: false,
  refining: false,
  camera: 1,
  revision: 1,
  samples: 0,
  samplesInAll: null,
  relativeError: null,
  ev100: null,
  scale: null,
  latencyMs: null,
  pictureMs: null,
  whiteK: null,
  ...change,
});

function words(frames: FrameHeader[], change: Partial<PictureState> = {}): string {
  const state: PictureState = {
    frames,
    moving: false,
    framesPerSecond: null,
    awaited: false,
    progress: null,
    rendering: false,
    ...change,
  };
  return pictureWords(state).join(" · ").replaceAll("\u202f", " ");
}

test("refining: samples so far, and the error that is left", () => {
  assert.equal(words([frame({ samples: 8, samplesInAll: 24 })]), "refining 8 of 24");
  assert.equal(words([frame({ samples: 8 })]), "refining 8");
  assert.equal(
    words([frame({ samples: 90, refining: true, relativeError: 0.0312 })]),
    "refining, 90 paths a pixel, 3.1 % error left",
  );
  assert.equal(words([frame()]), "refining");
});

test("finished, and paused for a final picture", () => {
  assert.equal(words([frame({ settled: true, samples: 64 })]), "finished");
  assert.equal(words([frame({ settled: true, refining: true, relativeError: 0.0018 })]), "finished, 0.2 % error left");
  assert.equal(words([frame({ samples: 24, samplesInAll: 24 })], { rendering: true }), "paused for the final picture");
});

test("moving: frames a second where they are known, and never none", () => {
  assert.equal(words([frame()], { moving: true, framesPerSecond: 23.7 }), "moving, 24 frames/s");
  assert.equal(words([frame()], { moving: true, framesPerSecond: 1.2 }), "moving, 1 frame/s");
  assert.equal(words([frame()], { moving: true, framesPerSecond: 0.3 }), "moving");
  assert.equal(words([frame()], { moving: true }), "moving");
  assert.equal(words([frame()], { framesPerSecond: 20 }), "refining", "frames of light that comes are no move");
});

test("what is behind is said", () => {
  assert.equal(words([frame({ lightBehind: true })]), "light follows");
  assert.equal(
    words([frame({ lightBehind: true })], { moving: true, framesPerSecond: 12 }),
    "moving, 12 frames/s · light follows",
  );
  assert.equal(words([frame({ settled: true })], { awaited: true }), "waiting for the next picture");
  assert.equal(words([]), "waiting for the first picture");
  const progress = { type: "progress", stage: "links", fraction: 0.4 } as const;
  assert.equal(words([], { progress }), "finding the light, 40 %");
  assert.equal(words([frame({ settled: true })], { progress }), "finding the light, 40 %");
});

test("of two sides the one that has farther to go is told of", () => {
  const left = frame({ side: "left", settled: true });
  const right = frame({ side: "right", samples: 12, samplesInAll: 24 });
  assert.equal(words([left, right]), "refining 12 of 24");
  assert.equal(words([right, left]), "refining 12 of 24");
  assert.equal(words([left, { ...left, side: "right" }]), "finished");
});
