// What the page knows of the home: the server's state, and on top of it the edits of this window that are not yet
// answered, so that controls follow the hand at once. Pure functions from one model to the next.
import type { EditFields, Lamp, Overlap, StateChange, Sun, Target, Thing, Welcome } from "./protocol.js";
import { add, subtract } from "./vector.js";

export interface Model {
  readonly welcome: Welcome;
  readonly revision: number;
  readonly lamps: ReadonlyMap<string, Lamp>;
  readonly things: ReadonlyMap<string, Thing>;
  readonly overlaps: readonly Overlap[]; // things that run into others
  readonly sun: Sun | null;
  readonly plans: readonly string[];
  readonly undo: string | null;
  readonly redo: string | null;
}

function byId<T extends { readonly id: string }>(items: readonly T[]): Map<string, T> {
  return new Map(items.map(item => [item.id, item]));
}

export function modelFrom(welcome: Welcome): Model {
  return {
    welcome,
    revision: welcome.revision,
    lamps: byId(welcome.lamps),
    things: byId(welcome.objects),
    overlaps: welcome.overlaps ?? [],
    sun: welcome.sun,
    plans: welcome.plans,
    undo: welcome.undo,
    redo: welcome.redo,
  };
}

export function changed(model: Model, change: StateChange): Model {
  return {
    ...model,
    revision: Math.max(model.revision, change.revision),
    lamps: change.lamps?.length ? new Map([...model.lamps, ...byId(change.lamps)]) : model.lamps,
    things: change.objects?.length ? new Map([...model.things, ...byId(change.objects)]) : model.things,
    overlaps: change.overlaps ?? model.overlaps,
    sun: change.sun === undefined ? model.sun : change.sun,
    plans: change.plans ?? model.plans,
    undo: change.undo,
    redo: change.redo,
  };
}

function editedLamp(lamp: Lamp, fields: EditFields): Lamp {
  const next = { ...lamp };
  if (fields.position) next.position = fields.position;
  if (fields.direction) next.direction = fields.direction;
  if (fields.dim !== undefined) next.dim = fields.dim;
  if (fields.on !== undefined) next.on = fields.on;
  if (fields.fluxLm !== undefined) {
    next.fluxLm = fields.fluxLm;
    next.fluxAssumed = false;
  }
  if (fields.temperatureK !== undefined) {
    next.temperatureK = fields.temperatureK;
    next.color = null;
  } else if (fields.color) {
    next.color = fields.color;
    next.temperatureK = null;
  }
  return next;
}

function editedThing(thing: Thing, fields: EditFields): Thing {
  const next = { ...thing };
  if (fields.move) {
    const by = subtract(fields.move, thing.move);
    next.move = fields.move;
    next.low = add(thing.low, by);
    next.high = add(thing.high, by);
  }
  if (fields.turn !== undefined) next.turn = fields.turn;
  if (fields.hidden !== undefined) next.hidden = fields.hidden;
  if (fields.open !== undefined) next.open = fields.open;
  const { color, material } = fields;
  if (color)
    next.colors = thing.colors.map(paint =>
      material === undefined || paint.material === material ? { ...paint, color } : paint,
    );
  return next;
}

// The model as it will be once the server has done the edit.
export function edited(model: Model, target: Target, fields: EditFields): Model {
  if (target === "sun") {
    if (!model.sun) return model;
    const { date = model.sun.date, hour = model.sun.hour, on = true } = fields;
    return { ...model, sun: { ...model.sun, date, hour, on } };
  }
  const lamp = model.lamps.get(target);
  if (lamp) return { ...model, lamps: new Map([...model.lamps, [target, editedLamp(lamp, fields)]]) };
  const thing = model.things.get(target);
  if (!thing) return model;
  let lamps = model.lamps;
  if (fields.move) {
    // Lamps move with the thing that they belong to.
    const by = subtract(fields.move, thing.move);
    lamps = new Map(
      [...lamps].map(([id, l]) => [id, l.object === target ? { ...l, position: add(l.position, by) } : l]),
    );
  }
  return { ...model, lamps, things: new Map([...model.things, [target, editedThing(thing, fields)]]) };
}
