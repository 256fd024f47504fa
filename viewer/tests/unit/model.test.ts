import assert from "node:assert/strict";
import { test } from "node:test";
import { changed, edited, modelFrom, type Model } from "../../src/model.js";
import { Desk } from "../double/desk.js";
import { nearAll } from "./near.js";

const model = (): Model => modelFrom(new Desk().welcome("w"));
const nothing = { type: "state", revision: 2, undo: null, redo: null, by: null } as const;

test("a state changes what it names and leaves the rest as it was", () => {
  const before = model();
  const lamp = { ...before.lamps.get("lamp:1")!, dim: 0.25 };
  const after = changed(before, { ...nothing, lamps: [lamp], undo: "dim Floor lamp" });
  assert.equal(after.lamps.get("lamp:1")?.dim, 0.25);
  assert.equal(after.lamps.get("lamp:0"), before.lamps.get("lamp:0"));
  assert.equal(after.things, before.things);
  assert.equal(after.sun, before.sun);
  assert.equal(after.undo, "dim Floor lamp");
  assert.deepEqual([...after.lamps.keys()], [...before.lamps.keys()]);
});

test("a sun that is gone is not one that did not change", () => {
  assert.equal(changed(model(), { ...nothing, sun: null }).sun, null);
  assert.notEqual(changed(model(), nothing).sun, null);
});

test("a thing takes its box and its lamps along", () => {
  const before = model();
  const lamps = new Map(before.lamps);
  lamps.set("lamp:1", { ...lamps.get("lamp:1")!, object: "object:0" });
  const after = edited({ ...before, lamps }, "object:0", { move: [1, 0, -0.5] });
  nearAll(after.things.get("object:0")!.low, [3.2, 0, 1.4]);
  nearAll(after.lamps.get("lamp:1")!.position, [1.6, 1.5, 0.1]);
  nearAll(after.lamps.get("lamp:0")!.position, [3, 2.1, 2.5]);
  // Absolute, so that one sent twice does no harm.
  nearAll(edited(after, "object:0", { move: [1, 0, -0.5] }).things.get("object:0")!.low, [3.2, 0, 1.4]);
});

test("a lamp has a temperature or a colour, never both", () => {
  const red = edited(model(), "lamp:0", { color: [1, 0, 0] });
  assert.equal(red.lamps.get("lamp:0")?.temperatureK, null);
  const white = edited(red, "lamp:0", { temperatureK: 3000 });
  assert.equal(white.lamps.get("lamp:0")?.color, null);
  assert.equal(white.lamps.get("lamp:0")?.temperatureK, 3000);
});

test("a colour goes to the material that it names, or to all", () => {
  const before = model();
  const named = edited(before, "object:1", { color: [0, 1, 0], material: "Other" });
  assert.deepEqual(named.things.get("object:1")!.colors, before.things.get("object:1")!.colors);
  const all = edited(before, "object:1", { color: [0, 1, 0] });
  assert.deepEqual(all.things.get("object:1")!.colors[0]?.color, [0, 1, 0]);
});

test("a date or an hour switches daylight on, unless the edit says otherwise", () => {
  const before = model();
  const off = { ...before, sun: { ...before.sun!, on: false } };
  assert.equal(edited(off, "sun", { hour: 9 }).sun?.on, true);
  assert.equal(edited(off, "sun", { date: "2026-12-21" }).sun?.on, true);
  assert.deepEqual(edited(before, "sun", { on: false }).sun, { ...before.sun, on: false });
});

test("a flux that was set is not assumed", () => {
  const before = model();
  const lamps = new Map(before.lamps).set("lamp:0", { ...before.lamps.get("lamp:0")!, fluxAssumed: true });
  const dimmed = edited({ ...before, lamps }, "lamp:0", { dim: 0.5 });
  assert.equal(dimmed.lamps.get("lamp:0")?.fluxAssumed, true);
  assert.equal(edited(dimmed, "lamp:0", { fluxLm: 700 }).lamps.get("lamp:0")?.fluxAssumed, false);
});

test("an edit of what is not there changes nothing", () => {
  const before = model();
  assert.equal(edited(before, "object:99", { hidden: true }), before);
  assert.equal(edited({ ...before, sun: null }, "sun", { hour: 3 }).sun, null);
});
