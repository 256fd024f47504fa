import assert from "node:assert/strict";
import { test } from "node:test";
import { ConnectionLost, EditQueue, type Edit } from "../../src/edits.js";
import { modelFrom } from "../../src/model.js";
import { Desk } from "../double/desk.js";

interface Sent {
  edit: Edit;
  succeed(): void;
  fail(error: unknown): void;
}

function queue() {
  const sent: Sent[] = [];
  const done: { edit: Edit; failure: unknown }[] = [];
  const edits = new EditQueue(
    edit => new Promise((resolve, reject) => sent.push({ edit, succeed: () => resolve(null), fail: reject })),
    (edit, failure) => done.push({ edit, failure }),
  );
  return { edits, sent, done };
}

const turn = () => new Promise(resolve => setImmediate(resolve));
const dim = (value: number, gesture = "a"): Edit => ({ target: "lamp:0", gesture, fields: { dim: value } });

test("one is under way at a time, and the newest values of a gesture win", async () => {
  const { edits, sent } = queue();
  for (const value of [0.1, 0.2, 0.3, 0.4]) edits.push(dim(value));
  assert.deepEqual(
    sent.map(({ edit }) => edit.fields.dim),
    [0.1],
  );
  sent[0]!.succeed();
  await turn();
  assert.deepEqual(
    sent.map(({ edit }) => edit.fields.dim),
    [0.1, 0.4],
  );
});

test("two gestures stay two steps of undo, two materials two messages", async () => {
  const { edits, sent } = queue();
  edits.push(dim(0.1, "a"));
  edits.push(dim(0.2, "b"));
  edits.push(dim(0.3, "c"));
  edits.push({ target: "object:0", gesture: "d", fields: { color: [1, 0, 0], material: "Oak" } });
  edits.push({ target: "object:0", gesture: "d", fields: { color: [0, 1, 0], material: "Steel" } });
  for (let i = 0; i < 5; ++i) {
    sent[i]!.succeed();
    await turn();
  }
  assert.equal(sent.length, 5);
});

test("a thing moves alone as the last move of the gesture says", async () => {
  const { edits, sent } = queue();
  edits.push(dim(1));
  edits.push({ target: "object:0", gesture: "x", fields: { move: [1, 0, 0], alone: true } });
  edits.push({ target: "object:0", gesture: "x", fields: { move: [2, 0, 0] } });
  sent[0]!.succeed();
  await turn();
  assert.deepEqual(sent[1]!.edit.fields, { move: [2, 0, 0] });
});

test("a temperature and a colour of one gesture are not sent together", async () => {
  const { edits, sent } = queue();
  edits.push(dim(1));
  edits.push({ target: "lamp:1", gesture: "x", fields: { temperatureK: 3000 } });
  edits.push({ target: "lamp:1", gesture: "x", fields: { color: [1, 0, 0] } });
  sent[0]!.succeed();
  await turn();
  assert.deepEqual(sent[1]!.edit.fields, { color: [1, 0, 0] });
});

test("what waits is shown on top of what the server said", async () => {
  const { edits, sent } = queue();
  const model = modelFrom(new Desk().welcome("w"));
  edits.push(dim(0.5));
  edits.push(dim(0.7));
  assert.equal(edits.overlay(model).lamps.get("lamp:0")?.dim, 0.7);
  sent[0]!.succeed();
  await turn();
  sent[1]!.succeed();
  await turn();
  assert.equal(edits.overlay(model), model);
});

test("a refusal is told and the next one goes on", async () => {
  const { edits, sent, done } = queue();
  edits.push(dim(2));
  edits.push(dim(0.5, "b"));
  const failure = new Error("dim: at most 1");
  sent[0]!.fail(failure);
  await turn();
  assert.equal(done[0]!.failure, failure);
  assert.equal(sent.length, 2);
});

test("what was under way when the line was lost is sent once more", async () => {
  const { edits, sent, done } = queue();
  edits.push(dim(0.5));
  sent[0]!.fail(new ConnectionLost());
  await turn();
  assert.equal(done.length, 0);
  edits.resume();
  assert.equal(sent.length, 2);
  let empty = false;
  void edits.empty().then(() => (empty = true));
  await turn();
  assert.equal(empty, false);
  sent[1]!.succeed();
  await turn();
  assert.equal(empty, true);
  assert.equal(done[0]!.failure, null);
});
