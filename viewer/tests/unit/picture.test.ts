import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import type { FrameHeader } from "../../src/frame.js";
import { Picture } from "../../src/picture.js";

interface Bitmap {
  readonly name: string;
  closed: boolean;
  close(): void;
}

let decoding: { done: (bitmap: Bitmap) => void; fail: () => void }[] = [];
let frames: (() => void)[] = [];
let drawn: string[] = [];
let acknowledged: number[] = [];
let broken = 0;

const context = {
  save: () => {},
  restore: () => {},
  beginPath: () => {},
  rect: () => {},
  clip: () => {},
  drawImage: (bitmap: Bitmap) => void drawn.push(bitmap.name),
};
const canvas = { width: 100, height: 50, getContext: () => context } as unknown as HTMLCanvasElement;

beforeEach(() => {
  decoding = [];
  frames = [];
  drawn = [];
  acknowledged = [];
  broken = 0;
  Object.assign(globalThis, {
    createImageBitmap: () =>
      new Promise((done, fail) => decoding.push({ done, fail: () => fail(new Error("no picture")) })),
    requestAnimationFrame: (run: () => void) => frames.push(run),
  });
});

const picture = () =>
  new Picture(
    canvas,
    frame => acknowledged.push(frame),
    () => {},
    () => ++broken,
  );
const header = (number: number, side: FrameHeader["side"] = "whole") => ({ number, side }) as FrameHeader;
const bytes = new Uint8Array(1);
const bitmap = (name: string): Bitmap => ({
  name,
  closed: false,
  close() {
    this.closed = true;
  },
});

// Lets decoded frames arrive, then the browser draw.
async function paint(): Promise<void> {
  await new Promise(resolve => setImmediate(resolve));
  frames.splice(0).forEach(run => run());
}

test("a frame that is decoded late is neither shown nor acknowledged after a newer one", async () => {
  const shown = picture();
  void shown.accept(header(1), bytes);
  void shown.accept(header(2), bytes);
  decoding[1]!.done(bitmap("second"));
  await paint();
  const late = bitmap("first");
  decoding[0]!.done(late);
  await paint();
  assert.deepEqual(acknowledged, [2]);
  assert.ok(late.closed);
  assert.ok(!drawn.includes("first"));
});

test("a split shows the newest of both sides, and a whole picture after it alone", async () => {
  const shown = picture();
  void shown.accept(header(1, "left"), bytes);
  void shown.accept(header(2, "right"), bytes);
  decoding[0]!.done(bitmap("left"));
  decoding[1]!.done(bitmap("right"));
  await paint();
  assert.deepEqual(drawn, ["left", "right"]);
  drawn = [];
  void shown.accept(header(3), bytes);
  decoding[2]!.done(bitmap("whole"));
  await paint();
  assert.deepEqual(drawn, ["whole"]);
  assert.deepEqual(acknowledged, [2, 3]);
});

test("a frame that cannot be decoded is told and acknowledged, so that others follow", async () => {
  const shown = picture();
  void shown.accept(header(4), bytes);
  decoding[0]!.fail();
  await paint();
  assert.equal(broken, 1);
  assert.deepEqual(acknowledged, [4]);
});

test("a new connection may count from 1 again; frames of the old one are not acknowledged to it", async () => {
  const shown = picture();
  void shown.accept(header(90), bytes);
  decoding[0]!.done(bitmap("old"));
  await paint();
  void shown.accept(header(91), bytes);
  shown.forget();
  decoding[1]!.done(bitmap("between"));
  void shown.accept(header(1), bytes);
  decoding[2]!.done(bitmap("new"));
  await paint();
  assert.deepEqual(acknowledged, [90, 1]);
  assert.equal(drawn.at(-1), "new");
  assert.ok(!drawn.includes("between"));
});
