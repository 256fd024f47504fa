// What stands on the switches, and what each layer is multiplied by.
import { blackBody } from "../../src/color.js";
import { clamp, type Vec3 } from "../../src/vector.js";
import type { Home, Layer } from "./document.js";
import { luminance } from "./white_balance.js";

export interface Dial {
  readonly on: boolean;
  readonly level: number; // 1: as in the file
  readonly kelvin: number | null; // null: its own
}

export interface LightState {
  readonly dials: readonly Dial[]; // one a layer; those of sun and sky are not looked at
  readonly sun: Dial;
  readonly sky: Dial;
  readonly hour: number;
}

export const kMostLevel = 1.5;
export const kLeastKelvin = 1800;
export const kMostKelvin = 8000;

export const hoursOf = (home: Home): number[] =>
  [...new Set(home.layers.flatMap(l => (l.kind !== "lamp" && l.hour !== undefined ? [l.hour] : [])))].sort(
    (a, b) => a - b,
  );

// As the home's file has it.
export function stateOfFile(home: Home): LightState {
  const hours = hoursOf(home);
  const on = (kind: Layer["kind"]) => home.layers.some(l => l.kind === kind && l.on);
  return {
    dials: home.layers.map(l => ({ on: l.on, level: 1, kelvin: null })),
    sun: { on: on("sun"), level: 1, kelvin: null },
    sky: { on: on("sky"), level: 1, kelvin: null },
    hour: home.hour ?? hours[0] ?? 12,
  };
}

export const withDial = (state: LightState, layer: number, change: Partial<Dial>): LightState => ({
  ...state,
  dials: state.dials.map((dial, i) => (i === layer ? { ...dial, ...change } : dial)),
});

// Share of the light of one of the baked hours at an hour: linear between two neighbours.
export function hourWeight(hours: readonly number[], baked: number | undefined, hour: number): number {
  if (baked === undefined || hours.length === 0) return 1;
  const held = clamp(hour, hours[0]!, hours[hours.length - 1]!);
  const i = hours.indexOf(baked);
  const before = hours[i - 1];
  const after = hours[i + 1];
  if (held === baked) return 1;
  if (held < baked) return before === undefined ? 0 : Math.max(0, (held - before) / (baked - before));
  return after === undefined ? 0 : Math.max(0, (after - held) / (after - baked));
}

// From the colour of one temperature to that of another, at the same luminance of white.
export function tint(fromKelvin: number, toKelvin: number): Vec3 {
  const from = blackBody(fromKelvin);
  const to = blackBody(toKelvin);
  const gain = luminance(from) / luminance(to);
  return [0, 1, 2].map(c => Math.min(50, (to[c]! * gain) / Math.max(from[c]!, 0.01))) as unknown as Vec3;
}

export function dialFactor(dial: Dial, ownKelvin: number | undefined): Vec3 {
  if (!dial.on) return [0, 0, 0];
  if (dial.kelvin === null || ownKelvin === undefined) return [dial.level, dial.level, dial.level];
  const [r, g, b] = tint(ownKelvin, dial.kelvin);
  return [r * dial.level, g * dial.level, b * dial.level];
}

// What each layer is multiplied by.
export function layerFactors(home: Home, state: LightState): Vec3[] {
  const hours = hoursOf(home);
  return home.layers.map((layer, i) => {
    if (layer.kind === "lamp") return dialFactor(state.dials[i]!, layer.kelvin);
    const factor = dialFactor(state[layer.kind], undefined);
    const weight = hourWeight(hours, layer.hour, state.hour);
    return [factor[0] * weight, factor[1] * weight, factor[2] * weight];
  });
}

export const sameFactors = (a: readonly Vec3[] | null, b: readonly Vec3[]): boolean =>
  a !== null && a.length === b.length && a.every((f, i) => f.every((v, c) => v === b[i]![c]));
