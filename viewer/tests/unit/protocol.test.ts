import assert from "node:assert/strict";
import { test } from "node:test";
import { decodeMessage } from "../../src/protocol.js";
import { BadMessage } from "../../src/schema.js";
import { Desk } from "../double/desk.js";

const decode = (message: unknown) => decodeMessage(JSON.stringify(message));
const welcome = () => new Desk().welcome("5f1c09aa");

test("a welcome is read, with all that it holds", () => {
  const message = decode(welcome());
  assert.ok(message.type === "welcome");
  assert.equal(message.lamps.length, 3);
  assert.deepEqual(message.lamps[0]?.position, [3, 2.1, 2.5]);
  assert.equal(message.display.whiteBalance, "auto");
});

test("what is wrong is named by its place", () => {
  const broken = (change: object) => () => decode({ ...welcome(), ...change });
  assert.throws(broken({ revision: "12" }), /revision: .*Expected number but received "12"/);
  assert.throws(
    broken({ lamps: [{ ...welcome().lamps[0], dim: null }] }),
    /lamps\.0\.dim: .*Expected number but received null/,
  );
  assert.throws(
    broken({ rooms: [{ name: "A", low: [0, 0], high: [1, 1, 1], floor: [] }] }),
    /rooms\.0\.low\.2: .*Expected number/,
  );
  assert.throws(
    broken({ rooms: [{ name: "A", low: [0, 0, 0, 0], high: [1, 1, 1], floor: [] }] }),
    /rooms\.0\.low\.3: /,
  );
  assert.throws(broken({ revision: 1.5 }), /revision: .*integer/);
  assert.throws(broken({ limits: undefined }), /limits: .*received undefined/);
  assert.throws(broken({ rooms: null }), BadMessage);
  assert.throws(
    broken({ display: { ...welcome().display, falseColor: "red" } }),
    /display\.falseColor: .*Expected \("off" \| /,
  );
});

test("messages of no known type, and what is no message, are refused", () => {
  assert.throws(() => decode({ type: "hello" }), /type: .*Expected \("welcome" \| .*received "hello"/);
  assert.throws(() => decode({ type: "constructor" }), /type: .*received "constructor"/);
  assert.throws(() => decode([1, 2]), /type: .*received undefined/);
  assert.throws(() => decode("pong"), /message: .*Expected Object but received "pong"/);
  assert.throws(() => decodeMessage("{"), /not JSON/);
});

test("a state may leave out what did not change; null is another thing", () => {
  const state = decode({ type: "state", revision: 4, lamps: [], objects: [], undo: null, redo: "move Sofa", by: "a" });
  assert.ok(state.type === "state");
  assert.equal("sun" in state, false);
  const none = decode({
    type: "state",
    revision: 4,
    lamps: [],
    objects: [],
    sun: null,
    undo: null,
    redo: null,
    by: "a",
  });
  assert.ok(none.type === "state" && none.sun === null);
});

test("a number is finite", () => {
  assert.throws(() => decodeMessage('{"type":"progress","stage":"light","fraction":1e999}'), /fraction: .*Infinity/);
});

test("keys that this page does not know are passed over", () => {
  const message = decode({ type: "pong", id: 3, newer: true });
  assert.deepEqual(message, { type: "pong", id: 3 });
});

test("an exposure is a number or auto", () => {
  const display = (exposure: unknown) => decode({ ...welcome(), display: { ...welcome().display, exposure } });
  assert.doesNotThrow(() => display(7.5));
  assert.doesNotThrow(() => display("auto"));
  assert.throws(() => display("bright"), /display\.exposure/);
});
