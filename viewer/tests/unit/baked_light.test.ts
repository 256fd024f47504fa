import assert from "node:assert/strict";
import { test } from "node:test";
import { adapted, lookedAtEv100 } from "../../baked/src/adaptation.js";
import { checkDocument } from "../../baked/src/document.js";
import { cssColour, falseColour, roundSteps, scaleOf } from "../../baked/src/false_colour.js";
import { parseGlb } from "../../baked/src/glb.js";
import { hourWeight, layerFactors, stateOfFile, tint, withDial } from "../../baked/src/light_state.js";
import { linkOf, readLink } from "../../baked/src/link.js";
import { readoutAt } from "../../baked/src/readout.js";
import { everythingOn, evening, lightOf, sceneOf, storedScenes, storeScenes } from "../../baked/src/scenes.js";
import { kStrings, languageOf, speaker, type StringKey } from "../../baked/src/strings.js";
import { toned } from "../../baked/src/tone.js";
import type { Vec3 } from "../../src/vector.js";
import { bakedHome } from "../double/baked_home.js";
import { near, nearAll } from "./near.js";

const home = checkDocument(parseGlb(bakedHome()).json).extensions.ROOMLIGHT_light_layers;
const file = stateOfFile(home);

test("layers are multiplied by their dials, daylight by the weights of the hours", () => {
  nearAll(layerFactors(home, file)[0]!, [1, 1, 1]);
  nearAll(layerFactors(home, file)[1]!, [0, 0, 0]);
  const dimmed = withDial(file, 1, { on: true, level: 0.25 });
  nearAll(layerFactors(home, dimmed)[1]!, [0.25, 0.25, 0.25]);
  const sunny = { ...file, hour: 13.5, sun: { on: true, level: 0.5, kelvin: null } };
  const factors = layerFactors(home, sunny);
  near(factors[2]![0], 0.5 * 0.75);
  near(factors[4]![0], 0.5 * 0.25);
  near(factors[3]![0], 0);
});

test("weights of hours add up to one, and hold beyond the first and last", () => {
  const hours = [8, 12, 18.5];
  for (let hour = 0; hour <= 24; hour += 0.25)
    near(
      hours.reduce((sum, baked) => sum + hourWeight(hours, baked, hour), 0),
      1,
    );
  near(hourWeight(hours, 8, 3), 1);
  near(hourWeight(hours, undefined, 3), 1);
});

test("a tint keeps luminance and becomes none at the lamp's own temperature", () => {
  nearAll(tint(2700, 2700), [1, 1, 1]);
  const cooler = tint(2700, 6500);
  assert.ok(cooler[0] < 1 && cooler[2] > 1);
});

test("a link brings back the eye, the hour, the exposure and the dials", () => {
  const light = {
    ...withDial(withDial(file, 0, { level: 0.4, kelvin: 3000 }), 1, { on: true }),
    hour: 16.25,
    sun: { on: true, level: 1.2, kelvin: null },
  };
  const eye = { position: [1.25, 1.6, -2.5], yawDeg: 45.5, pitchDeg: -10, fovDeg: 60 } as const;
  const link = linkOf({ eye, ev100: 6.9, light }, file);
  assert.equal(link, "#eye=1.25,1.6,-2.5,45.5,-10,60&hour=16.25&ev=6.9&sun=1.120&d=0:1.40.3000_1:1.100");
  assert.deepEqual(readLink(link, file), { eye, ev100: 6.9, light });
  assert.deepEqual(readLink("", file), { eye: null, ev100: null, light: file });
  assert.deepEqual(readLink("#eye=1,2&ev=x&d=99:1.50_0:&sun=5", file), { eye: null, ev100: null, light: file });
});

test("scenes are kept, and a browser that keeps none is told apart", () => {
  const kept = new Map<string, string>();
  const store = () => ({
    getItem: (k: string) => kept.get(k) ?? null,
    setItem: (k: string, v: string) => void kept.set(k, v),
  });
  const light = withDial(file, 0, { level: 0.3 });
  assert.ok(storeScenes(store, "k", [sceneOf("Mine", light, home)]));
  const [scene] = storedScenes(store, "k");
  assert.deepEqual(lightOf(scene!, home), light);
  const denied = () => {
    throw new Error("denied");
  };
  assert.equal(storeScenes(denied, "k", []), false);
  assert.deepEqual(storedScenes(denied, "k"), []);
  kept.set("k", "{]");
  assert.deepEqual(storedScenes(store, "k"), []);
  assert.ok(everythingOn(home).dials.every(d => d.on));
  assert.deepEqual(
    evening(home).dials.map(d => d.on),
    [true, false, false, false, false, false],
  );
  assert.equal(evening(home).sky.on, false);
});

test("contrast is about middle grey, and saturation leaves luminance", () => {
  const linear = (v: number) => (v > 0.04045 ? ((v + 0.055) / 1.055) ** 2.4 : v / 12.92);
  const shown = (color: Vec3, contrast: number, saturation: number) =>
    toned(color, "clip", { contrast, saturation }).map(linear) as unknown as Vec3;
  nearAll(shown([0.18, 0.18, 0.18], 1.5, 1), [0.18, 0.18, 0.18], 1e-5);
  nearAll(shown([0.36, 0.36, 0.36], 1.5, 1), [0.36 * 2 ** 0.5, 0.36 * 2 ** 0.5, 0.36 * 2 ** 0.5], 1e-5);
  const grey = 0.2126 * 0.4 + 0.7152 * 0.2 + 0.0722 * 0.1;
  nearAll(shown([0.4, 0.2, 0.1], 1, 0), [grey, grey, grey], 1e-5);
});

test("tone curves are those of the pictures", () => {
  // Reckoned by src/base/tone_curves.h.
  const curves = ["neutral", "agx", "filmic", "clip"] as const;
  const expected: [Vec3, Vec3[]][] = [
    [
      [0.18, 0.18, 0.18],
      [
        [0.41, 0.41, 0.41],
        [0.5005, 0.5005, 0.5005],
        [0.5535, 0.5535, 0.5535],
        [0.4614, 0.4614, 0.4614],
      ],
    ],
    [
      [2, 0.5, 0.1],
      [
        [0.9822, 0.6022, 0.4246],
        [0.91, 0.7011, 0.4964],
        [0.9616, 0.7862, 0.7297],
        [1.0, 0.7354, 0.3492],
      ],
    ],
    [
      [0.02, 0.3, 0.05],
      [
        [0.0323, 0.568, 0.198],
        [0.216, 0.6141, 0.3054],
        [0.1871, 0.6933, 0.2997],
        [0.1517, 0.5838, 0.2478],
      ],
    ],
    [
      [8, 9, 10],
      [
        [0.9588, 0.9783, 0.9973],
        [0.9717, 0.9763, 0.9802],
        [1.0, 1.0, 1.0],
        [1.0, 1.0, 1.0],
      ],
    ],
    [
      [0.6, 0.4, 0.9],
      [
        [0.7624, 0.6261, 0.9215],
        [0.7159, 0.6521, 0.7808],
        [0.7606, 0.6485, 0.8965],
        [0.7977, 0.6652, 0.9547],
      ],
    ],
  ];
  for (const [exposed, shown] of expected) curves.forEach((tone, i) => nearAll(toned(exposed, tone), shown[i]!, 2e-4));
  for (const tone of ["neutral", "agx", "filmic"] as const) {
    let last = -1;
    for (let ev = -8; ev < 6; ++ev) {
      const [v] = toned([2 ** ev, 2 ** ev, 2 ** ev], tone);
      assert.ok(v >= last && v <= 1, `${tone} at ${ev}`);
      last = v;
    }
  }
});

test("exposure puts an even picture at middle grey, whatever a few lamps do", () => {
  const even = new Array<number>(48 * 27).fill(50);
  near(lookedAtEv100(even, 48)!, Math.log2(50 / (0.18 * 1.2)), 1e-9);
  const lamps = even.map((l, i) => (i % 100 === 0 ? 1e5 : l));
  near(lookedAtEv100(lamps, 48)!, Math.log2(50 / (0.18 * 1.2)), 1e-9);
  assert.equal(lookedAtEv100(new Array<number>(48).fill(0), 48), null);
  let ev = 2;
  for (let i = 0; i < 300; ++i) ev = adapted(ev, 8, 1 / 60);
  assert.equal(ev, 8);
});

test("false colours run from dark violet to light yellow over round steps", () => {
  const [dark, light] = [falseColour(0), falseColour(1)];
  assert.ok(dark[2] > dark[1] && light[0] > light[2]);
  assert.match(cssColour(0.5), /^rgb\(\d+ \d+ \d+\)$/);
  nearAll(roundSteps(1, 10) as unknown as [number, number, number], [1, 1.5, 2, 3, 5, 7.5, 10] as never, 1e-9);
  const scale = scaleOf(Array.from({ length: 100 }, (_, i) => 10 + i));
  assert.ok(scale.low <= 15 && scale.high >= 108 && scale.high <= 216);
});

test("amounts of light survive three bytes", () => {
  for (const amount of [0.01, 1, 123.4, 98765]) {
    // As the shader writes them.
    const share = (Math.log2(amount) + 24) / 48;
    const high = Math.floor(share * 256);
    const middle = Math.floor((share * 256 - high) * 256);
    const low = ((share * 256 - high) * 256 - middle) * 255;
    near(readoutAt(Uint8Array.from([high, middle, Math.round(low), 255]), 0) / amount, 1, 1e-4);
  }
});

test("all strings are there in both languages, with the same places for values", () => {
  const keys = Object.keys(kStrings.en) as StringKey[];
  assert.deepEqual(Object.keys(kStrings.de), keys);
  const places = (text: string) => (text.match(/\{\d\}/g) ?? []).sort().join();
  for (const key of keys) {
    assert.notEqual(kStrings.de[key].trim(), "", key);
    assert.equal(places(kStrings.de[key]), places(kStrings.en[key]), key);
  }
  assert.equal(languageOf("de-AT"), "de");
  assert.equal(languageOf("da"), "en");
  assert.equal(speaker("de")("deleteScene", "Lesen"), "Lesen löschen");
});
