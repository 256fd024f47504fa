// Messages between this page and `roomlight view`, as docs/reference/view-protocol.md states them. Whatever comes from
// the server passes a check here.
import * as v from "valibot";
import { BadMessage, check, pair, real, triple, whole, type Checked } from "./schema.js";

const box = v.object({ low: triple, high: triple });
export type Box = Checked<typeof box>;

const room = v.object({ name: v.string(), low: triple, high: triple, floor: v.array(pair) });
export type Room = Checked<typeof room>;

const cutHeight = v.optional(v.nullable(real));

const namedCamera = v.object({
  name: v.string(),
  position: triple,
  direction: triple,
  verticalFov: real,
  cutHeight,
});

const windowCamera = v.object({
  position: triple,
  direction: triple,
  up: triple,
  verticalFov: real,
  cutHeight,
});

const described = v.object({ name: v.string(), about: v.string() });

const lamp = v.object({
  id: v.string(),
  name: v.string(),
  kind: v.string(),
  object: v.nullable(v.string()),
  position: triple,
  direction: v.nullable(triple),
  fluxLm: v.nullable(real),
  fluxAssumed: v.boolean(),
  dim: real,
  on: v.boolean(),
  temperatureK: v.nullable(real),
  color: v.nullable(triple),
  movable: v.boolean(),
});
export type Lamp = Checked<typeof lamp>;

const paint = v.object({ material: v.string(), label: v.optional(v.string()), color: triple, textured: v.boolean() });
export type Paint = Checked<typeof paint>;

const thing = v.object({
  id: v.string(),
  name: v.string(),
  low: triple,
  high: triple,
  movable: v.boolean(),
  move: triple,
  turn: real,
  hidden: v.boolean(),
  colors: v.array(paint),
  open: v.nullable(real),
});
export type Thing = Checked<typeof thing>;

const sun = v.object({
  on: v.boolean(),
  placeFrom: v.picklist(["lighting", "home", "assumed"]),
  date: v.string(),
  hour: real,
  utcOffset: real,
  latitude: real,
  longitude: real,
  sky: v.string(),
  altitude: real,
  azimuth: real,
});
export type Sun = Checked<typeof sun>;

// The first was moved.
const overlap = v.object({ object: v.string(), into: v.string() });
export type Overlap = Checked<typeof overlap>;

const display = v.object({
  exposure: v.union([real, v.literal("auto")]),
  compensation: real,
  curve: v.string(),
  whiteBalance: v.union([real, v.picklist(["auto", "none"])]),
  falseColor: v.picklist(["off", "illuminance", "luminance"]),
  low: v.nullable(real),
  high: v.nullable(real),
});
export type Display = Checked<typeof display>;

const side = v.object({ technique: v.optional(v.string()), plan: v.optional(v.string()) });
export type Side = Checked<typeof side>;
const split = v.object({ left: side, right: side });
export type Split = Checked<typeof split>;

const limits = v.object({
  frameWidth: whole,
  frameHeight: whole,
  renderWidth: whole,
  renderHeight: whole,
  messageBytes: whole,
  messagesPerSecond: real,
});

const welcome = v.object({
  type: v.literal("welcome"),
  protocol: whole,
  version: v.string(),
  home: v.string(),
  window: v.string(),
  bounds: v.array(triple),
  rooms: v.array(room),
  cameras: v.array(namedCamera),
  camera: windowCamera,
  techniques: v.array(described),
  technique: v.string(),
  plans: v.array(v.string()),
  qualities: v.array(described),
  curves: v.array(v.string()),
  display,
  split: v.nullable(split),
  legend: v.array(v.string()),
  limits,
  revision: whole,
  lamps: v.array(lamp),
  objects: v.array(thing),
  overlaps: v.optional(v.array(overlap)),
  sun: v.nullable(sun),
  undo: v.nullable(v.string()),
  redo: v.nullable(v.string()),
});
export type Welcome = Checked<typeof welcome>;

const stateChange = v.object({
  type: v.literal("state"),
  revision: whole,
  lamps: v.optional(v.array(lamp)),
  objects: v.optional(v.array(thing)),
  overlaps: v.optional(v.array(overlap)),
  sun: v.optional(v.nullable(sun)),
  plans: v.optional(v.array(v.string())),
  undo: v.nullable(v.string()),
  redo: v.nullable(v.string()),
  by: v.nullable(v.string()),
});
export type StateChange = Checked<typeof stateChange>;

const pickHit = v.object({
  point: triple,
  normal: triple,
  distanceM: real,
  object: v.nullable(v.string()),
  lamp: v.nullable(v.string()),
  material: v.nullable(v.string()),
});
export type PickHit = Checked<typeof pickHit>;

const meterHit = v.object({
  point: triple,
  normal: triple,
  object: v.nullable(v.string()),
  illuminanceLux: real,
  standardErrorLux: v.nullable(real),
  luminanceCdM2: real,
  incidentEv100: v.nullable(real),
  reflectedEv100: v.nullable(real),
});
export type MeterHit = Checked<typeof meterHit>;

const job = v.object({
  type: v.literal("job"),
  job: v.union([v.string(), whole]),
  stage: v.string(),
  fraction: real,
  secondsLeft: v.nullable(real),
  estimatedError: v.nullable(real),
  state: v.picklist(["running", "done", "cancelled", "failed"]),
  file: v.optional(v.nullable(v.object({ path: v.string(), name: v.string(), bytes: real }))),
  message: v.optional(v.nullable(v.string())),
});
export type Job = Checked<typeof job>;

const progress = v.object({ type: v.literal("progress"), stage: v.string(), fraction: real });
export type Progress = Checked<typeof progress>;

const serverError = v.object({
  type: v.literal("error"),
  id: v.nullable(whole),
  code: v.string(),
  field: v.nullable(v.string()),
  message: v.string(),
});
export type ServerError = Checked<typeof serverError>;

const serverMessage = v.variant("type", [
  welcome,
  stateChange,
  v.object({ type: v.literal("ok"), id: whole, job: v.optional(v.union([v.string(), whole])) }),
  serverError,
  progress,
  v.object({ type: v.literal("picked"), id: whole, hit: v.nullable(pickHit) }),
  v.object({ type: v.literal("metered"), id: whole, hit: v.nullable(meterHit) }),
  job,
  v.object({ type: v.literal("saved"), id: whole, name: v.string(), text: v.string() }),
  v.object({ type: v.literal("pong"), id: whole }),
]);
export type ServerMessage = Checked<typeof serverMessage>;

// A message as it came over the line; throws BadMessage where it is not one of the protocol's.
export function decodeMessage(source: string): ServerMessage {
  let value: unknown;
  try {
    value = JSON.parse(source);
  } catch {
    throw new BadMessage("message: not JSON");
  }
  return check(serverMessage, value);
}

export type Target = string; // id of a lamp or thing, or "sun"

// Fields that an edit sets; absolute values, so that one sent twice does no harm.
export interface EditFields {
  position?: readonly [number, number, number];
  direction?: readonly [number, number, number];
  dim?: number;
  on?: boolean;
  temperatureK?: number;
  color?: readonly [number, number, number];
  fluxLm?: number;
  move?: readonly [number, number, number];
  turn?: number;
  alone?: boolean; // of a move or turn: what stands on the thing stays
  hidden?: boolean;
  material?: string;
  open?: number;
  date?: string;
  hour?: number;
}

export interface RenderRequest {
  kind: "picture" | "panorama";
  width?: number;
  height?: number;
  technique?: string;
  quality?: string;
  seconds?: number;
  format?: "png" | "jpg" | "exr";
}

// What needs no answer.
export type Notice =
  | { type: "viewport"; width: number; height: number; pixelRatio: number }
  | {
      type: "camera";
      number: number;
      position: readonly [number, number, number];
      direction: readonly [number, number, number];
      verticalFov: number;
      cutHeight?: number;
    }
  | ({ type: "display" } & Partial<Display>)
  | { type: "ack"; frame: number };

// What is answered; the connection adds the id.
export type Request =
  | { type: "technique"; technique: string }
  | { type: "split"; split: Split | null }
  | ({ type: "edit"; target: Target; gesture?: string } & EditFields)
  | { type: "undo" }
  | { type: "redo" }
  | { type: "plan"; do: "keep" | "apply" | "drop"; name: string }
  | { type: "pick"; x: number; y: number }
  | { type: "meter"; x: number; y: number }
  | ({ type: "render" } & RenderRequest)
  | { type: "cancel"; job: string | number }
  | { type: "save" }
  | { type: "ping" };
