import assert from "node:assert/strict";
import { test } from "node:test";
import { checkDocument, type Home } from "../../baked/src/document.js";
import { parseGlb } from "../../baked/src/glb.js";
import { layerFactors, stateOfFile } from "../../baked/src/light_state.js";
import { Sunlight, undoDifferences } from "../../baked/src/sunlight.js";
import { kUnit } from "../../baked/src/units.js";
import { bakedHome, kStraightLux } from "../double/baked_home.js";
import { near, nearAll } from "./near.js";

const homeOf = (bytes: Uint8Array): Home => checkDocument(parseGlb(bytes).json).extensions.ROOMLIGHT_light_layers;

test("differences along rows are undone, each row for itself", () => {
  const bytes = Uint8Array.from([255, 1, 0, 7, 0, 250]);
  undoDifferences(bytes, 3);
  assert.deepEqual([...bytes], [255, 0, 0, 7, 7, 1]);
});

test("cells of a tile have those of its neighbours around them, and nothing where there is none", () => {
  const home = homeOf(bakedHome({ sunPatch: true }));
  const sun = home.layers.findIndex(l => l.sun);
  const given = home.layers[sun]!.sun!;
  const { tile } = home.atlas;
  const edge = tile * given.mask.fine;
  // Two tiles side by side: one dark but for its last column, one of ones.
  const mask = { ...given.mask, tiles: [0, 1] };
  const layers = home.layers.map((l, i) => (i === sun ? { ...l, sun: { ...given, mask } } : { ...l, sun: undefined }));
  const sunlight = new Sunlight({ ...home, layers } as Home);
  const bytes = new Uint8Array(2 * edge ** 2);
  for (let y = 0; y < edge; ++y) {
    bytes[y * edge + edge - 1] = 9;
    bytes[edge ** 2 + y * edge] = 1;
  }
  sunlight.add(sun, bytes);
  const cells = sunlight.uniforms.uSunCells!.value as { image: { data: Uint8Array; width: number } };
  const at = (place: number, x: number, y: number) =>
    cells.image.data[(y + 1) * cells.image.width + place * (edge + 2) + x + 1];
  assert.equal(at(0, edge - 2, 0), 0);
  assert.equal(at(0, edge - 1, 0), 9);
  assert.equal(at(0, edge, 0), 1);
  assert.equal(at(1, -1, 5), 9);
  assert.equal(at(1, edge - 1, edge - 1), 1);
  assert.equal(at(1, edge - 1, edge), 0);
  const tiles = sunlight.uniforms.uSunTiles!.value as { image: { data: Uint32Array } };
  assert.deepEqual([...tiles.image.data.subarray(0, 3)], [1, 2, 0]);
});

test("between two hours both suns shine, by their weights and the dial", () => {
  const home = homeOf(bakedHome({ sunPatch: true }));
  const sunlight = new Sunlight(home);
  const state = { ...stateOfFile(home), hour: 13.5, sun: { on: true, level: 0.5, kelvin: null } };
  sunlight.update(layerFactors(home, state));
  assert.equal(sunlight.uniforms.uSunCount!.value, 2);
  const lux = sunlight.uniforms.uSunLux!.value as { toArray(): number[] }[];
  nearAll(
    lux[0]!.toArray(),
    kStraightLux.map(c => (c * 0.5 * 0.75) / kUnit),
  );
  nearAll(
    lux[1]!.toArray(),
    kStraightLux.map(c => (c * 0.5 * 0.25) / kUnit),
  );
  const rows = sunlight.uniforms.uSunRow!.value as number[];
  assert.deepEqual(rows, [0, home.atlas.height / home.atlas.tile]);
  near((sunlight.uniforms.uSunSize!.value as number[])[0]!, (0.27 * Math.PI) / 180);
  sunlight.update(layerFactors(home, stateOfFile(home)));
  assert.equal(sunlight.uniforms.uSunCount!.value, 0);
});

test("a home without such suns needs no cells", () => {
  const sunlight = new Sunlight(homeOf(bakedHome()));
  assert.deepEqual(sunlight.defines, {});
  sunlight.update([[1, 1, 1]]);
});

test("masks with cells or tiles that cannot be are faults", () => {
  const { json } = parseGlb(bakedHome({ sunPatch: true }));
  const faulty = (change: (mask: { fine: number; channels: number; tiles: number[] }) => void) => {
    const copy = JSON.parse(JSON.stringify(json)) as {
      extensions: {
        ROOMLIGHT_light_layers: { layers: { sun?: { mask: { fine: number; channels: number; tiles: number[] } } }[] };
      };
    };
    change(copy.extensions.ROOMLIGHT_light_layers.layers.find(l => l.sun)!.sun!.mask);
    return () => checkDocument(copy);
  };
  assert.doesNotThrow(faulty(() => undefined));
  assert.throws(
    faulty(mask => (mask.fine = 64)),
    /sun\.mask\.fine/,
  );
  assert.throws(
    faulty(mask => (mask.fine = 3)),
    /sun\.mask\.fine/,
    "not that of other hours",
  );
  assert.throws(
    faulty(mask => (mask.channels = 2)),
    /channels/,
  );
  assert.throws(
    faulty(mask => (mask.tiles = [8])),
    /sun\.mask\.tiles/,
  );
  assert.throws(
    faulty(mask => (mask.tiles = new Array<number>(1000).fill(0))),
    /sun\.mask\.tiles/,
  );
});
