// Straight sunlight: how much of it arrives on cells finer than the texels of light (docs/reference/baked.md, sun). At
// most two suns shine at once: those of the baked hours before and after the one that is shown.
import * as THREE from "three";
import type { Vec3 } from "../../src/vector.js";
import type { Home, Layer } from "./document.js";
import type { Uniforms } from "./surfaces.js";
import { kUnit } from "./units.js";

const kMostPageCells = 2048;
const kSuns = 2;

type Mask = NonNullable<Layer["sun"]>["mask"];

// What a shader needs before it can call sunLeft(): declarations, with the sizes that depend on the home.
export const kSunGlsl = `
  #ifdef SUN_TILE
    uniform highp usampler2D uSunTiles; // 1 + the place of a tile's cells; 0: dark
    uniform highp sampler2DArray uSunCells;
    uniform vec2 uSunTexels; // of the atlas
    uniform int uSunCount;
    uniform int uSunRow[${kSuns}];
    uniform vec3 uSunLux[${kSuns}]; // on a surface that faces it
    uniform vec3 uSunDirection[${kSuns}]; // towards it
    uniform float uSunSize[${kSuns}]; // angular radius, rad
    // What is left of the sun's light at a place of the atlas: quadratic B-splines, as lines between cells would leave
    // stairs along slanted edges of patches. Two reads between cells for each three of them.
    vec3 sunLeft(int sun, vec2 uv) {
      vec2 texel = uv * uSunTexels;
      ivec2 tile = ivec2(texel) / SUN_TILE;
      int at = int(texelFetch(uSunTiles, tile + ivec2(0, uSunRow[sun]), 0).r) - 1;
      if (at < 0) return vec3(0.0);
      vec2 corner = vec2(at % SUN_COLUMNS, at / SUN_COLUMNS % SUN_ROWS) * float(SUN_EDGE) + 1.0;
      vec2 cell = (texel - vec2(tile * SUN_TILE)) * float(SUN_FINE);
      vec2 middle = floor(cell) + 0.5, off = cell - middle;
      vec2 half1 = 0.375 - 0.5 * off * off;
      vec2 before = 0.5 * (0.5 - off) * (0.5 - off) + half1, after = 1.0 - before;
      vec2 size = vec2(SUN_COLUMNS, SUN_ROWS) * float(SUN_EDGE);
      vec2 low = (corner + middle - 1.0 + half1 / before) / size, high = (corner + middle + 1.0 - half1 / after) / size;
      float page = float(at / (SUN_COLUMNS * SUN_ROWS));
      vec3 left = (textureLod(uSunCells, vec3(low, page), 0.0).rgb * before.x
        + textureLod(uSunCells, vec3(high.x, low.y, page), 0.0).rgb * after.x) * before.y
        + (textureLod(uSunCells, vec3(low.x, high.y, page), 0.0).rgb * before.x
        + textureLod(uSunCells, vec3(high, page), 0.0).rgb * after.x) * after.y;
      #ifdef SUN_GREY
        return left.rrr;
      #else
        return left;
      #endif
    }
  #endif`;

// Cells of listed tiles from differences along their rows, plane by plane.
export function undoDifferences(bytes: Uint8Array, edge: number): void {
  for (let i = 0; i < bytes.length; ++i) if (i % edge !== 0) bytes[i]! += bytes[i - 1]!;
}

export class Sunlight {
  readonly uniforms: Uniforms;
  readonly defines: Readonly<Record<string, string>>;
  private readonly cells: THREE.DataArrayTexture | null = null;
  private readonly tiles: THREE.DataTexture | null = null;
  private readonly first = new Map<number, { place: number; row: number }>(); // by layer
  private readonly lux: THREE.Vector3[] = [];
  private readonly directions: THREE.Vector3[] = [];
  private readonly sizes: number[] = [];
  private readonly rows: number[] = [];
  private readonly count = { value: 0 };
  private readonly across: number;
  private readonly down: number;
  private readonly edge: number = 0; // cells of a tile, one around it included
  private readonly columns: number = 0;
  private readonly pageRows: number = 0;
  private readonly channels: number = 1; // bytes a cell

  constructor(private readonly home: Home) {
    const { width, height, tile } = home.atlas;
    this.across = width / tile;
    this.down = height / tile;
    for (let k = 0; k < kSuns; ++k) {
      this.lux.push(new THREE.Vector3());
      this.directions.push(new THREE.Vector3(0, 1, 0));
      this.sizes.push(0);
      this.rows.push(0);
    }
    const masks = home.layers.flatMap(({ sun }, layer) => (sun ? [{ layer, mask: sun.mask }] : []));
    const fine = masks[0]?.mask.fine;
    if (fine === undefined) {
      this.uniforms = {};
      this.defines = {};
      return;
    }
    let places = 0;
    masks.forEach(({ layer, mask }, i) => {
      this.first.set(layer, { place: places, row: i * this.down });
      places += mask.tiles.length;
    });
    const grey = masks.every(({ mask }) => mask.channels === 1);
    this.channels = grey ? 1 : 4;
    this.edge = tile * fine + 2;
    this.columns = Math.floor(kMostPageCells / this.edge);
    this.pageRows = Math.max(1, Math.min(this.columns, Math.ceil(places / this.columns)));
    const pages = Math.max(1, Math.ceil(places / (this.columns * this.pageRows)));
    const [pageWidth, pageHeight] = [this.columns * this.edge, this.pageRows * this.edge];
    const cells = new THREE.DataArrayTexture(
      new Uint8Array(pageWidth * pageHeight * pages * this.channels),
      pageWidth,
      pageHeight,
      pages,
    );
    cells.format = grey ? THREE.RedFormat : THREE.RGBAFormat;
    cells.minFilter = cells.magFilter = THREE.LinearFilter;
    cells.unpackAlignment = 1;
    cells.needsUpdate = true;
    const numbers = new Uint32Array(this.across * this.down * masks.length);
    const tiles = new THREE.DataTexture(numbers, this.across, this.down * masks.length);
    tiles.format = THREE.RedIntegerFormat;
    tiles.type = THREE.UnsignedIntType;
    tiles.internalFormat = "R32UI";
    tiles.needsUpdate = true;
    this.cells = cells;
    this.tiles = tiles;
    this.uniforms = {
      uSunTiles: { value: tiles },
      uSunCells: { value: cells },
      uSunTexels: { value: new THREE.Vector2(width, height) },
      uSunCount: this.count,
      uSunRow: { value: this.rows },
      uSunLux: { value: this.lux },
      uSunDirection: { value: this.directions },
      uSunSize: { value: this.sizes },
    };
    this.defines = {
      SUN_TILE: `${tile}`,
      SUN_FINE: `${fine}`,
      SUN_EDGE: `${this.edge}`,
      SUN_COLUMNS: `${this.columns}`,
      SUN_ROWS: `${this.pageRows}`,
      ...(grey ? { SUN_GREY: "" } : {}),
    };
  }

  // Bytes of a layer's mask once they are unpacked.
  static bytesOf({ fine, channels, tiles }: Mask, tile: number): number {
    return (tile * fine) ** 2 * channels * tiles.length;
  }

  // The mask of a layer: differences, which are undone in place.
  add(layer: number, bytes: Uint8Array): void {
    const sun = this.home.layers[layer]?.sun;
    const first = this.first.get(layer);
    if (!sun || !first || !this.cells || !this.tiles) return;
    const { tiles, channels } = sun.mask;
    const inner = this.edge - 2;
    undoDifferences(bytes, inner);
    const places = new Map(tiles.map((tile, i) => [tile, i]));
    const numbers = this.tiles.image.data as unknown as Uint32Array;
    tiles.forEach((tile, i) => {
      numbers[first.row * this.across + tile] = first.place + i + 1;
      this.fill(first.place + i, (dx, dy, channel) => {
        const column = (tile % this.across) + dx;
        const of = column < 0 || column >= this.across ? undefined : places.get(tile + dy * this.across + dx);
        if (of === undefined) return null;
        const at = (of * channels + Math.min(channel, channels - 1)) * inner ** 2;
        return bytes.subarray(at, at + inner ** 2);
      });
    });
    this.cells.needsUpdate = this.tiles.needsUpdate = true;
  }

  // `planeOf(dx, dy, channel)`: cells of the tile, and of its neighbours, of which the border is copied.
  private fill(place: number, planeOf: (dx: number, dy: number, channel: number) => Uint8Array | null): void {
    const { edge, channels } = this;
    const data = this.cells!.image.data as Uint8Array;
    const perPage = this.columns * this.pageRows;
    const left = (place % this.columns) * edge;
    const top = (Math.floor(place / this.columns) % this.pageRows) * edge;
    const width = this.columns * edge;
    const page = Math.floor(place / perPage);
    const first = (page * width * this.pageRows * edge + top * width + left) * channels;
    const inner = edge - 2;
    // Cells before, inside and behind a tile: where they go to, and where they come from.
    const parts = [
      { step: -1, to: 0, from: inner - 1, count: 1 },
      { step: 0, to: 1, from: 0, count: inner },
      { step: 1, to: edge - 1, from: 0, count: 1 },
    ];
    for (let c = 0; c < channels; ++c)
      for (const down of parts)
        for (const across of parts) {
          const plane = c < 3 ? planeOf(across.step, down.step, c) : null;
          for (let y = 0; y < down.count; ++y) {
            const to = first + ((down.to + y) * width + across.to) * channels;
            const from = (down.from + y) * inner + across.from;
            if (channels === 1 && plane) {
              data.set(plane.subarray(from, from + across.count), to);
              continue;
            }
            for (let x = 0; x < across.count; ++x) data[to + x * channels + c] = c < 3 ? (plane?.[from + x] ?? 0) : 255;
          }
        }
    this.cells!.addLayerUpdate(page);
  }

  // What layers are multiplied by.
  update(factors: readonly Vec3[]): void {
    this.count.value = 0;
    for (const [layer, { row }] of this.first) {
      const factor = factors[layer];
      const sun = this.home.layers[layer]!.sun!;
      const k = this.count.value;
      if (!factor?.some(c => c > 0) || k >= kSuns) continue;
      this.lux[k]!.set(...sun.lux)
        .multiply(new THREE.Vector3(...factor))
        .divideScalar(kUnit);
      this.directions[k]!.set(...sun.direction).normalize();
      this.sizes[k] = (sun.halfAngleDeg * Math.PI) / 180;
      this.rows[k] = row;
      this.count.value = k + 1;
    }
  }
}
