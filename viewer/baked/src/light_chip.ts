// The sums of light on the chip: illuminance, and where normal maps ask for it where that comes from.
import type { Vec3 } from "../../src/vector.js";
import type { Home } from "./document.js";
import type { Chip } from "./layer_keeper.js";
import { LightSum, texelsFor } from "./light_sum.js";
import { luminance } from "./white_balance.js";
import type { WebGLRenderer } from "three";

export interface UnpackedLight {
  readonly light: Uint32Array<ArrayBuffer>;
  readonly lean: Uint32Array<ArrayBuffer> | null;
}

const kMostBytes = 170e6; // of textures that the page keeps, its pictures left out
const kBytesPerGib = 45e6; // of the device's memory, where it tells
const kSumsAside = 2; // beside what is shown: the rest, and a new one
const kSumTexelBytes = 8;

// What layers may take on the chip beside `others`, bytes of other textures. No limit where all of them fit, or take no
// more than the sums that stand in for those that are aside.
export function bytesForLayers(home: Home, others: number, deviceGib: number | undefined): number {
  const { atlas, layers } = home;
  const all = layers.reduce((sum, _, layer) => sum + bytesOfLayer(home, layer), 0);
  const sum = (layers.some(layer => layer.lean) ? 2 : 1) * kSumTexelBytes * atlas.width * atlas.height;
  const left = Math.min(kMostBytes, kBytesPerGib * (deviceGib ?? Infinity)) - others - sum;
  const aside = kSumsAside * sum;
  return all <= Math.max(left, aside) ? Infinity : Math.max(0, left - aside);
}

export function bytesOfLayer({ atlas, layers }: Home, layer: number): number {
  const { light, lean } = layers[layer]!;
  const bytes = (tiles: number) => 4 * texelsFor(tiles, atlas.tile);
  return bytes(light.tiles.length) + (lean ? bytes(lean.tiles.length) : 0);
}

export class LightChip implements Chip<UnpackedLight> {
  readonly light: LightSum;
  readonly lean: LightSum | null;
  private readonly sums: readonly LightSum[];

  constructor(
    renderer: WebGLRenderer,
    private readonly home: Home,
  ) {
    const { width, height, tile } = home.atlas;
    const sum = () => new LightSum(renderer, width, height, tile);
    this.light = sum();
    this.lean = home.layers.some(layer => layer.lean) ? sum() : null;
    this.sums = this.lean ? [this.light, this.lean] : [this.light];
  }

  put(layer: number, unpacked: UnpackedLight): void {
    const { light, lean } = this.home.layers[layer]!;
    this.light.add(layer, light.tiles, unpacked.light, light.scale);
    if (lean && unpacked.lean) this.lean?.add(layer, lean.tiles, unpacked.lean, light.scale);
  }
  drop(layer: number): void {
    for (const sum of this.sums) sum.drop(layer);
  }
  show(factors: readonly Vec3[], only?: number): void {
    this.light.update(factors, only);
    this.lean?.update(
      factors.map((factor, i) => this.luminanceShare(i, factor)),
      only,
    );
  }
  addToRest(layer: number, factor: Vec3): void {
    this.light.addToRest(layer, factor);
    this.lean?.addToRest(layer, this.luminanceShare(layer, factor));
  }
  startNewRest(): void {
    for (const sum of this.sums) sum.startNewRest();
  }
  addToNewRest(layer: number, factor: Vec3): void {
    this.light.addToNewRest(layer, factor);
    this.lean?.addToNewRest(layer, this.luminanceShare(layer, factor));
  }
  useNewRest(): void {
    for (const sum of this.sums) sum.useNewRest();
  }

  // What a factor leaves of the luminance of a layer.
  private luminanceShare(layer: number, [r, g, b]: Vec3): Vec3 {
    const { color } = this.home.layers[layer]!;
    const share = luminance([r * color[0], g * color[1], b * color[2]]) / luminance(color);
    return [share, share, share];
  }
}
