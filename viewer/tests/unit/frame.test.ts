import assert from "node:assert/strict";
import { test } from "node:test";
import { decodeFrame } from "../../src/frame.js";

function frame(change: (view: DataView) => void = () => {}, bytes = 70): ArrayBuffer {
  const data = new ArrayBuffer(bytes);
  const view = new DataView(data);
  view.setUint8(0, 1);
  view.setUint8(1, 1);
  view.setUint16(2, 64, true);
  view.setUint32(4, 77, true);
  view.setUint16(8, 960, true);
  view.setUint16(10, 540, true);
  view.setUint32(16, 5, true);
  for (const at of [28, 32, 36, 40, 44, 48, 52]) view.setFloat32(at, NaN, true);
  if (bytes > 64) view.setUint8(64, 0xff);
  change(view);
  return data;
}

test("a header is read field by field", () => {
  const { header, picture } = decodeFrame(
    frame(view => {
      view.setUint8(12, 2);
      view.setUint8(13, 1 + 8);
      view.setUint32(20, 9, true);
      view.setUint32(24, 16, true);
      view.setFloat32(28, 0.25, true);
      view.setFloat32(36, 1, true);
      view.setFloat32(40, 500, true);
      view.setUint32(56, 24, true);
    }),
  );
  assert.deepEqual(
    { ...header },
    {
      number: 77,
      width: 960,
      height: 540,
      side: "right",
      quick: true,
      settled: false,
      lightBehind: false,
      falseColor: true,
      refining: false,
      camera: 5,
      revision: 9,
      samples: 16,
      samplesInAll: 24,
      relativeError: 0.25,
      ev100: null,
      scale: [1, 500],
      latencyMs: null,
      pictureMs: null,
      whiteK: null,
    },
  );
  assert.equal(picture.length, 6);
  assert.equal(picture[0], 0xff);
});

test("a longer header of a later server is passed over", () => {
  const { picture } = decodeFrame(frame(view => view.setUint16(2, 68, true)));
  assert.equal(picture.length, 2);
});

test("what is no frame is refused", () => {
  assert.throws(() => decodeFrame(frame(undefined, 64)), /too few/);
  assert.throws(() => decodeFrame(frame(view => view.setUint8(0, 2))), /unknown kind 2/);
  assert.throws(() => decodeFrame(frame(view => view.setUint8(1, 9))), /version 9/);
  assert.throws(() => decodeFrame(frame(view => view.setUint16(2, 12, true))), /header of 12 bytes/);
  assert.throws(() => decodeFrame(frame(view => view.setUint16(2, 70, true))), /header of 70 bytes/);
  assert.throws(() => decodeFrame(frame(view => view.setUint8(12, 3))), /side 3/);
  assert.throws(() => decodeFrame(frame(view => view.setUint16(8, 0, true))), /empty/);
});

test("a scale without order is none", () => {
  const { header } = decodeFrame(
    frame(view => {
      view.setFloat32(36, 10, true);
      view.setFloat32(40, 1, true);
    }),
  );
  assert.equal(header.scale, null);
});
