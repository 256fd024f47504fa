// Messages between this page and `roomlight view`, as docs/reference/view-protocol.md states them. Whatever comes from
// the server passes a check here.
import * as c from "./schema.js";

const box = c.shape({ low: c.triple, high: c.triple });
export type Box = c.Checked<typeof box>;

const room = c.shape({ name: c.text, low: c.triple, high: c.triple, floor: c.listOf(c.pair) });
export type Room = c.Checked<typeof room>;

const cutHeight = c.optional(c.nullable(c.real));

const namedCamera = c.shape({
  name: c.text,
  position: c.triple,
  direction: c.triple,
  verticalFov: c.real,
  cutHeight,
});

const windowCamera = c.shape({
  position: c.triple,
  direction: c.triple,
  up: c.triple,
  verticalFov: c.real,
  cutHeight,
});

const described = c.shape({ name: c.text, about: c.text });

const lamp = c.shape({
  id: c.text,
  name: c.text,
  kind: c.text,
  object: c.nullable(c.text),
  position: c.triple,
  direction: c.nullable(c.triple),
  fluxLm: c.nullable(c.real),
  fluxAssumed: c.flag,
  dim: c.real,
  on: c.flag,
  temperatureK: c.nullable(c.real),
  color: c.nullable(c.triple),
  movable: c.flag,
});
export type Lamp = c.Checked<typeof lamp>;

const paint = c.shape({ material: c.text, label: c.optional(c.text), color: c.triple, textured: c.flag });
export type Paint = c.Checked<typeof paint>;

const thing = c.shape({
  id: c.text,
  name: c.text,
  low: c.triple,
  high: c.triple,
  movable: c.flag,
  move: c.triple,
  turn: c.real,
  hidden: c.flag,
  colors: c.listOf(paint),
  open: c.nullable(c.real),
});
export type Thing = c.Checked<typeof thing>;

const sun = c.shape({
  on: c.flag,
  placeFrom: c.literal("lighting", "home", "assumed"),
  date: c.text,
  hour: c.real,
  utcOffset: c.real,
  latitude: c.real,
  longitude: c.real,
  sky: c.text,
  altitude: c.real,
  azimuth: c.real,
});
export type Sun = c.Checked<typeof sun>;

// The first was moved.
const overlap = c.shape({ object: c.text, into: c.text });
export type Overlap = c.Checked<typeof overlap>;

const display = c.shape({
  exposure: c.either(c.real, c.literal("auto")),
  compensation: c.real,
  curve: c.text,
  whiteBalance: c.either(c.real, c.literal("auto", "none")),
  falseColor: c.literal("off", "illuminance", "luminance"),
  low: c.nullable(c.real),
  high: c.nullable(c.real),
});
export type Display = c.Checked<typeof display>;

const side = c.shape({ technique: c.optional(c.text), plan: c.optional(c.text) });
export type Side = c.Checked<typeof side>;
const split = c.shape({ left: side, right: side });
export type Split = c.Checked<typeof split>;

const limits = c.shape({
  frameWidth: c.whole,
  frameHeight: c.whole,
  renderWidth: c.whole,
  renderHeight: c.whole,
  messageBytes: c.whole,
  messagesPerSecond: c.real,
});

const welcome = c.shape({
  type: c.literal("welcome"),
  protocol: c.whole,
  version: c.text,
  home: c.text,
  window: c.text,
  bounds: c.listOf(c.triple),
  rooms: c.listOf(room),
  cameras: c.listOf(namedCamera),
  camera: windowCamera,
  techniques: c.listOf(described),
  technique: c.text,
  plans: c.listOf(c.text),
  qualities: c.listOf(described),
  curves: c.listOf(c.text),
  display,
  split: c.nullable(split),
  legend: c.listOf(c.text),
  limits,
  revision: c.whole,
  lamps: c.listOf(lamp),
  objects: c.listOf(thing),
  overlaps: c.optional(c.listOf(overlap)),
  sun: c.nullable(sun),
  undo: c.nullable(c.text),
  redo: c.nullable(c.text),
});
export type Welcome = c.Checked<typeof welcome>;

const stateChange = c.shape({
  type: c.literal("state"),
  revision: c.whole,
  lamps: c.optional(c.listOf(lamp)),
  objects: c.optional(c.listOf(thing)),
  overlaps: c.optional(c.listOf(overlap)),
  sun: c.optional(c.nullable(sun)),
  plans: c.optional(c.listOf(c.text)),
  undo: c.nullable(c.text),
  redo: c.nullable(c.text),
  by: c.nullable(c.text),
});
export type StateChange = c.Checked<typeof stateChange>;

const pickHit = c.shape({
  point: c.triple,
  normal: c.triple,
  distanceM: c.real,
  object: c.nullable(c.text),
  lamp: c.nullable(c.text),
  material: c.nullable(c.text),
});
export type PickHit = c.Checked<typeof pickHit>;

const meterHit = c.shape({
  point: c.triple,
  normal: c.triple,
  object: c.nullable(c.text),
  illuminanceLux: c.real,
  standardErrorLux: c.nullable(c.real),
  luminanceCdM2: c.real,
  incidentEv100: c.nullable(c.real),
  reflectedEv100: c.nullable(c.real),
});
export type MeterHit = c.Checked<typeof meterHit>;

const job = c.shape({
  type: c.literal("job"),
  job: c.either(c.text, c.whole),
  stage: c.text,
  fraction: c.real,
  secondsLeft: c.nullable(c.real),
  estimatedError: c.nullable(c.real),
  state: c.literal("running", "done", "cancelled", "failed"),
  file: c.optional(c.nullable(c.shape({ path: c.text, name: c.text, bytes: c.real }))),
  message: c.optional(c.nullable(c.text)),
});
export type Job = c.Checked<typeof job>;

const progress = c.shape({ type: c.literal("progress"), stage: c.text, fraction: c.real });
export type Progress = c.Checked<typeof progress>;

const messages = {
  welcome,
  state: stateChange,
  ok: c.shape({ type: c.literal("ok"), id: c.whole, job: c.optional(c.either(c.text, c.whole)) }),
  error: c.shape({
    type: c.literal("error"),
    id: c.nullable(c.whole),
    code: c.text,
    field: c.nullable(c.text),
    message: c.text,
  }),
  progress,
  picked: c.shape({ type: c.literal("picked"), id: c.whole, hit: c.nullable(pickHit) }),
  metered: c.shape({ type: c.literal("metered"), id: c.whole, hit: c.nullable(meterHit) }),
  job,
  saved: c.shape({ type: c.literal("saved"), id: c.whole, name: c.text, text: c.text }),
  pong: c.shape({ type: c.literal("pong"), id: c.whole }),
};
type Messages = typeof messages;
export type ServerMessage = { [K in keyof Messages]: c.Checked<Messages[K]> }[keyof Messages];
export type ServerError = c.Checked<Messages["error"]>;

const kindOf = c.shape({ type: c.text });

// A message as it came over the line; throws BadMessage where it is not one of the protocol's.
export function decodeMessage(source: string): ServerMessage {
  let value: unknown;
  try {
    value = JSON.parse(source);
  } catch {
    throw new c.BadMessage("message: not JSON");
  }
  const { type } = kindOf(value, "");
  const check = Object.hasOwn(messages, type) ? (messages as Record<string, c.Check<unknown>>)[type] : undefined;
  if (!check) throw new c.BadMessage(`type: unknown message "${type}"`);
  return check(value, "") as ServerMessage;
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
