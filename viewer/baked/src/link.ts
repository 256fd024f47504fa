// What stands behind the # of the address: eye, hour, exposure, and the dials that differ from the file's.
//   #eye=x,y,z,yaw,pitch,fov&hour=17.5&ev=6.9&sun=1.80&sky=0.100&d=3:1.50.2700_7:0.100
// A dial is on or not (1, 0), its level in per cent, and its colour temperature if it is not its own.
import { clamp, type Vec3 } from "../../src/vector.js";
import { kLeastKelvin, kMostKelvin, kMostLevel, type Dial, type LightState } from "./light_state.js";

export interface Eye {
  readonly position: Vec3;
  readonly yawDeg: number; // 0 looks along -z, counter-clockwise seen from above
  readonly pitchDeg: number;
  readonly fovDeg: number; // vertical
}

export interface Linked {
  readonly eye: Eye | null;
  readonly ev100: number | null; // null: automatic
  readonly light: LightState;
}

const same = (a: Dial, b: Dial): boolean => a.on === b.on && a.level === b.level && a.kelvin === b.kelvin;

const dialText = ({ on, level, kelvin }: Dial): string =>
  [on ? 1 : 0, Math.round(100 * level), ...(kelvin === null ? [] : [Math.round(kelvin)])].join(".");

function dialOf(text: string): Dial | null {
  const match = /^([01])\.(\d{1,3})(?:\.(\d{4,5}))?$/.exec(text);
  if (!match) return null;
  return {
    on: match[1] === "1",
    level: clamp(Number(match[2]) / 100, 0, kMostLevel),
    kelvin: match[3] === undefined ? null : clamp(Number(match[3]), kLeastKelvin, kMostKelvin),
  };
}

export function linkOf({ eye, ev100, light }: Linked, file: LightState): string {
  const parts: string[] = [];
  const short = (value: number) => String(Number(value.toFixed(2)));
  if (eye) parts.push(`eye=${[...eye.position, eye.yawDeg, eye.pitchDeg, eye.fovDeg].map(short).join(",")}`);
  if (light.hour !== file.hour) parts.push(`hour=${short(light.hour)}`);
  if (ev100 !== null) parts.push(`ev=${short(ev100)}`);
  for (const name of ["sun", "sky"] as const)
    if (!same(light[name], file[name])) parts.push(`${name}=${dialText(light[name])}`);
  const dials = light.dials.flatMap((dial, i) => (same(dial, file.dials[i]!) ? [] : [`${i}:${dialText(dial)}`]));
  if (dials.length > 0) parts.push(`d=${dials.join("_")}`);
  return `#${parts.join("&")}`;
}

// What cannot be read stays as in the file.
export function readLink(hash: string, file: LightState): Linked {
  const given = new URLSearchParams(hash.replace(/^#/, ""));
  const number = (name: string): number | null => {
    const text = given.get(name);
    const value = text ? Number(text) : NaN;
    return Number.isFinite(value) ? value : null;
  };
  const eye = (given.get("eye") ?? "").split(",").map(Number);
  const dials = [...file.dials];
  for (const part of (given.get("d") ?? "").split("_")) {
    const [layer, text] = part.split(":");
    const dial = dialOf(text ?? "");
    if (dial && dials[Number(layer)]) dials[Number(layer)] = dial;
  }
  return {
    eye:
      eye.length === 6 && eye.every(Number.isFinite)
        ? {
            position: [eye[0]!, eye[1]!, eye[2]!],
            yawDeg: eye[3]!,
            pitchDeg: clamp(eye[4]!, -89, 89),
            fovDeg: clamp(eye[5]!, 20, 110),
          }
        : null,
    ev100: number("ev"),
    light: {
      dials,
      sun: dialOf(given.get("sun") ?? "") ?? file.sun,
      sky: dialOf(given.get("sky") ?? "") ?? file.sky,
      hour: clamp(number("hour") ?? file.hour, 0, 24),
    },
  };
}
