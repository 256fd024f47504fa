import assert from "node:assert/strict";
import { test } from "node:test";
import { changed, modelFrom, type Model } from "../../src/model.js";
import { overlapBoxes, overlapWords } from "../../src/overlaps.js";
import { Desk } from "../double/desk.js";

const nothing = { type: "state", revision: 2, undo: null, redo: null, by: null } as const;
const after = (overlaps: { object: string; into: string }[], model = modelFrom(new Desk().welcome("w"))): Model =>
  changed(model, { ...nothing, overlaps });

test("things that run into each other are named, some of many", () => {
  assert.equal(overlapWords(after([])), null);
  const pair = { object: "object:0", into: "object:1" };
  assert.equal(overlapWords(after([pair])), "Table runs into Armchair");
  assert.equal(overlapWords(changed(after([pair]), nothing)), "Table runs into Armchair", "until the server says so");
  const three = [pair, { object: "object:2", into: "object:0" }, { object: "object:1", into: "object:2" }];
  assert.equal(overlapWords(after(three)), "Table runs into Armchair, Shelf runs into Table, and 1 more");
  assert.equal(overlapWords(after([{ object: "object:0", into: "object:77" }])), null);
});

test("of a wall only the part in the thing is drawn", () => {
  const desk = new Desk();
  const wall = { ...desk.home.objects[0]!, id: "object:9", movable: false };
  desk.home.objects.push({ ...wall, low: [3.7, 0, 0], high: [3.9, 2.6, 5] });
  const [table, part] = overlapBoxes(after([{ object: "object:0", into: "object:9" }], modelFrom(desk.welcome("w"))));
  assert.deepEqual(table!.low, [2.2, 0, 1.9]);
  assert.deepEqual(part, { low: [3.7, 0, 1.9], high: [3.8, 0.75, 3.1] });
});
