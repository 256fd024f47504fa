import assert from "node:assert/strict";
import { test } from "node:test";
import { LayerKeeper, type Chip } from "../../baked/src/layer_keeper.js";
import { bytesForLayers, bytesOfLayer } from "../../baked/src/light_chip.js";
import { checkDocument } from "../../baked/src/document.js";
import { parseGlb } from "../../baked/src/glb.js";
import type { Vec3 } from "../../src/vector.js";
import { bakedHome } from "../double/baked_home.js";

// As 16-bit floats have it.
function half(value: number): number {
  if (value === 0) return 0;
  const step = 2 ** (Math.floor(Math.log2(Math.abs(value))) - 10);
  return Math.round(value / step) * step;
}

// A chip whose layers are one number.
class OneTexel implements Chip<number> {
  readonly here = new Map<number, number>();
  most = 0; // layers that were here at once
  shown = 0;
  private rest = 0;
  private newRest = 0;

  put(layer: number, lux: number): void {
    assert.ok(!this.here.has(layer), `layer ${layer} is here already`);
    this.here.set(layer, lux);
    this.most = Math.max(this.most, this.here.size);
  }
  drop(layer: number): void {
    assert.ok(this.here.delete(layer), `layer ${layer} is not here`);
  }
  show(factors: readonly Vec3[], only?: number): void {
    const sum = [...this.here]
      .filter(([layer]) => layer === (only ?? layer))
      .reduce(
        (s, [layer, lux]) => half(s + (factors[layer]?.[0] ?? 0) * lux),
        only === undefined ? this.rest : this.shown,
      );
    this.shown = sum;
  }
  addToRest(layer: number, [factor]: Vec3): void {
    this.rest = half(this.rest + factor * this.here.get(layer)!);
  }
  startNewRest(): void {
    this.newRest = 0;
  }
  addToNewRest(layer: number, [factor]: Vec3): void {
    this.newRest = half(this.newRest + factor * this.here.get(layer)!);
  }
  useNewRest(): void {
    this.rest = this.newRest;
  }
}

const grey = (values: readonly number[]): Vec3[] => values.map(v => [v, v, v]);

// Layers of one byte each.
function kept(lux: readonly number[], mostBytes: number, factors: readonly number[]) {
  const chip = new OneTexel();
  const unpacked: number[] = [];
  const failures: unknown[] = [];
  const seen: number[] = []; // each time that it has changed
  const state = { failing: -1, moving: false, meanwhile: (): void => undefined };
  const source = {
    bytes: () => 1,
    unpack: async (layer: number) => {
      unpacked.push(layer);
      await Promise.resolve();
      state.meanwhile();
      if (state.failing === layer) throw new Error("full");
      return lux[layer]!;
    },
    calm: async (isLate: () => boolean) => {
      while (state.moving && !isLate()) await new Promise(done => setImmediate(done));
    },
  };
  const keeper = new LayerKeeper(
    chip,
    source,
    mostBytes,
    () => seen.push(chip.shown),
    error => failures.push(error),
  );
  keeper.update(grey(factors));
  lux.forEach((value, layer) => keeper.come(layer, value));
  const settled = async () => {
    for (let i = 0; i < 1000 && keeper.busy; ++i) await new Promise(done => setImmediate(done));
    assert.ok(!keeper.busy);
  };
  return { chip, keeper, unpacked, failures, seen, state, settled };
}

const sumOf = (lux: readonly number[], factors: readonly number[]) => lux.reduce((s, v, i) => s + v * factors[i]!, 0);
const isNear = (a: number, b: number) => assert.ok(Math.abs(a - b) <= 0.002 * Math.abs(b), `${a} is not ${b}`);

test("layers that fit are unpacked once", async () => {
  const lux = [100, 20, 3];
  const { chip, keeper, unpacked, settled } = kept(lux, 3, [1, 0, 1]);
  isNear(chip.shown, 103);
  keeper.update(grey([0.5, 1, 0]));
  assert.ok(!keeper.busy);
  isNear(chip.shown, 70);
  await settled();
  assert.deepEqual(unpacked, []);
});

test("layers that do not fit are shown all the same, and follow their dials", async () => {
  const lux = [100, 20, 3, 7, 50];
  const { chip, keeper, settled } = kept(lux, 2, [1, 1, 0, 0.5, 1]);
  assert.equal(chip.here.size, 2);
  isNear(chip.shown, 173.5);
  for (const factors of [
    [1, 1, 1, 0.5, 1],
    [0, 0, 1, 1, 0],
    [0.1, 0.2, 0.3, 0.4, 0.5],
    [0, 0, 0, 0, 0],
    [0, 0, 1, 0, 0],
  ]) {
    keeper.update(grey(factors));
    await settled();
    isNear(chip.shown, sumOf(lux, factors));
    assert.ok(chip.here.size <= 2);
  }
  assert.ok(chip.most <= 3, "one more than fits, while it is added");
});

test("a dim lamp that is left of a bright room is not rounded as the bright room was", async () => {
  const lux = [1, 1, 6000, 0.0123];
  const { chip, keeper, settled } = kept(lux, 1, [1, 1, 1, 1]);
  keeper.update(grey([0, 0, 0, 1]));
  await settled();
  isNear(chip.shown, 0.0123);
});

test("the lamp whose dial is turned is unpacked once", async () => {
  const lux = [100, 20, 3, 7];
  const { chip, keeper, unpacked, settled } = kept(lux, 2, [1, 1, 1, 1]);
  for (let level = 0.9; level > 0.05; level -= 0.1) {
    keeper.update(grey([1, 1, 1, level]));
    await settled();
    isNear(chip.shown, sumOf(lux, [1, 1, 1, level]));
  }
  assert.equal(unpacked.filter(layer => layer === 3).length, 1);
});

test("a dial is answered before the rest is added up anew", async () => {
  const { keeper, seen, settled } = kept([100, 20, 3, 60], 1, [1, 1, 1, 1]);
  keeper.update(grey([1, 1, 1, 0.5]));
  await settled();
  isNear(seen[0]!, 153);
});

test("a layer that comes while the rest is added up again is in it", async () => {
  const lux = [100, 20, 3, 60];
  const { chip, keeper, unpacked, state, settled } = kept(lux, 1, [1, 1, 1, 1, 1]);
  state.meanwhile = () => {
    if (unpacked.length === 4) keeper.come(4, (lux[4] = 500));
  };
  keeper.update(grey([1, 1, 1, 0.5, 1]));
  await settled();
  isNear(chip.shown, 653);
});

test("dials that are turned while the rest is added up again are not lost", async () => {
  const lux = [100, 20, 3, 7, 50, 11];
  const { chip, keeper, state, settled } = kept(lux, 1, [1, 1, 1, 1, 1, 1]);
  const turns = [
    [1, 0, 1, 1, 1, 1],
    [1, 0, 0.5, 1, 1, 1],
    [0.3, 0, 0.5, 1, 0, 1],
    [0.3, 0.1, 0.5, 1, 0, 0.25],
  ];
  let calls = 0;
  state.meanwhile = () => {
    if (++calls % 3 === 0 && turns.length > 1) keeper.update(grey(turns.shift()!));
  };
  keeper.update(grey([0, 1, 1, 1, 1, 1]));
  await settled();
  state.meanwhile = () => undefined;
  keeper.update(grey(turns.at(-1)!));
  await settled();
  isNear(chip.shown, sumOf(lux, turns.at(-1)!));
});

test("a dial is answered while somebody walks", async () => {
  const lux = [100, 20, 3, 7];
  const { chip, keeper, seen, state, settled } = kept(lux, 1, [1, 1, 1, 1]);
  state.moving = true;
  const answered = async (expected: number) => {
    const before = seen.length;
    for (let i = 0; i < 100 && seen.length === before; ++i) await new Promise(done => setImmediate(done));
    isNear(seen.at(-1)!, expected);
  };
  keeper.update(grey([1, 0.5, 1, 1]));
  await answered(120);
  keeper.update(grey([1, 0.5, 0, 1]));
  await answered(117);
  assert.ok(keeper.busy);
  state.moving = false;
  await settled();
  isNear(chip.shown, 117);
});

test("a layer that cannot be unpacked holds up no other, and is asked for again with the next turn", async () => {
  const lux = [100, 20, 3];
  const { chip, keeper, failures, state, settled } = kept(lux, 1, [1, 1, 1]);
  state.failing = 1;
  keeper.update(grey([1, 0.5, 0]));
  await settled();
  assert.equal(failures.length, 2); // the layer, and the rest that it is a part of
  isNear(chip.shown, 120);
  state.failing = -1;
  keeper.update(grey([1, 0.25, 0]));
  await settled();
  isNear(chip.shown, 105);
});

test("layers have what other textures and sums leave, and less on small devices", () => {
  const home = checkDocument(parseGlb(bakedHome()).json).extensions.ROOMLIGHT_light_layers;
  const layer = 4 * 6 * 32 ** 2;
  const sum = 8 * 128 * 64;
  assert.equal(bytesOfLayer(home, 0), layer);
  assert.equal(bytesForLayers(home, 0, undefined), Infinity);
  assert.equal(bytesForLayers(home, 170e6 - 6 * layer - sum, undefined), Infinity);
  assert.equal(bytesForLayers(home, 90e6 - 5 * layer - sum, 2), 5 * layer - 2 * sum < 0 ? 0 : 5 * layer - 2 * sum);
  const many = { ...home, layers: Array.from({ length: 50 }, () => home.layers[0]!) };
  assert.equal(bytesForLayers(many, 170e6 - 40 * layer - sum, undefined), 40 * layer - 2 * sum);
  assert.equal(bytesForLayers(many, 170e6 - 40 * layer - sum, 2), 0);
  const few = { ...home, layers: home.layers.slice(0, 5) };
  assert.equal(bytesForLayers(few, 300e6, undefined), Infinity, "the rest would take as much");
});
