// Scenes: settings of the dials by name. Two come with every home, others are kept by the browser.
import * as v from "valibot";
import type { Home } from "./document.js";
import { linkOf, readLink } from "./link.js";
import { hoursOf, stateOfFile, type LightState } from "./light_state.js";

export interface Scene {
  readonly name: string;
  readonly light: string; // as in a link
}

export interface Store {
  getItem(key: string): string | null;
  setItem(key: string, value: string): void;
}

const kSchema = v.array(v.object({ name: v.string(), light: v.string() }));

export const everythingOn = (home: Home): LightState => {
  const file = stateOfFile(home);
  const on = { on: true, level: 1, kelvin: null };
  return { ...file, dials: file.dials.map(() => on), sun: on, sky: on };
};

// No daylight where lamps were on in the file, dimmed and warm.
export const evening = (home: Home): LightState => {
  const file = stateOfFile(home);
  const off = { on: false, level: 1, kelvin: null };
  const someOn = home.layers.some(l => l.kind === "lamp" && l.on);
  const dials = home.layers.map(({ kind, on, kelvin }) =>
    kind === "lamp" && (on || !someOn)
      ? { on: true, level: 0.5, kelvin: kelvin !== undefined && kelvin > 2700 ? 2700 : null }
      : { ...off },
  );
  return { dials, sun: off, sky: off, hour: hoursOf(home).at(-1) ?? file.hour };
};

// The same home has the same key.
export function keyOf(home: Home): string {
  let hash = 2166136261;
  for (const char of home.layers.map(l => `${l.room}/${l.name}`).join("\n"))
    hash = Math.imul(hash ^ char.codePointAt(0)!, 16777619);
  return `roomlight-scenes-${(hash >>> 0).toString(16)}`;
}

// Nothing where there is nothing, or nothing may be read.
export function storedScenes(store: () => Store, key: string): Scene[] {
  try {
    const result = v.safeParse(kSchema, JSON.parse(store().getItem(key) ?? "[]"));
    return result.success ? result.output : [];
  } catch {
    return [];
  }
}

// False if the browser does not keep them: denied, or full.
export function storeScenes(store: () => Store, key: string, scenes: readonly Scene[]): boolean {
  try {
    store().setItem(key, JSON.stringify(scenes));
    return true;
  } catch {
    return false;
  }
}

export const sceneOf = (name: string, light: LightState, home: Home): Scene => ({
  name,
  light: linkOf({ eye: null, ev100: null, light }, stateOfFile(home)),
});

export const lightOf = (scene: Scene, home: Home): LightState => readLink(scene.light, stateOfFile(home)).light;
