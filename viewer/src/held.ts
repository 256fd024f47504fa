// What the handles take hold of: a lamp that can be moved, or the thing that is selected or to which the selected lamp
// belongs.
import type { Drag } from "./gizmo.js";
import { middle } from "./framing.js";
import type { Model } from "./model.js";
import type { EditFields, Lamp, Target, Thing } from "./protocol.js";
import type { Selection } from "./session.js";
import { add, kRadPerDegree, type Vec3 } from "./vector.js";

export interface Held {
  readonly target: Target;
  readonly place: Vec3;
  readonly canTurn: boolean;
  dragged(drag: Drag, alone: boolean): EditFields; // alone: without what stands on it
}

const tidy = (v: Vec3): Vec3 => [Number(v[0].toFixed(4)), Number(v[1].toFixed(4)), Number(v[2].toFixed(4))];

function heldThing(thing: Thing): Held | null {
  if (!thing.movable || thing.hidden) return null;
  const { move, turn } = thing;
  return {
    target: thing.id,
    place: middle(thing),
    canTurn: true,
    dragged: ({ by, turnRad }, alone) => ({
      ...(turnRad !== 0
        ? { turn: Number((turn + turnRad / kRadPerDegree).toFixed(2)) }
        : { move: tidy(add(move, by)) }),
      ...(alone && { alone }),
    }),
  };
}

function heldLamp(lamp: Lamp): Held {
  const { position } = lamp;
  return {
    target: lamp.id,
    place: position,
    canTurn: false,
    dragged: ({ by }) => ({ position: tidy(add(position, by)) }),
  };
}

export function heldBy(model: Model, selection: Selection | null): Held | null {
  if (selection?.kind === "object") {
    const thing = model.things.get(selection.id);
    return thing ? heldThing(thing) : null;
  }
  const lamp = selection?.kind === "lamp" ? model.lamps.get(selection.id) : undefined;
  if (!lamp) return null;
  if (lamp.movable) return heldLamp(lamp);
  const body = lamp.object === null ? undefined : model.things.get(lamp.object);
  return body ? heldThing(body) : null;
}
