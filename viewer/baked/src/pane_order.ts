// Panes hide a part of what is behind them, so that those further off are drawn first. Sheets are put in order by their
// middles: right for those of one shape behind each other, as glass and table tops are, however they are cut into
// triangles.
import * as THREE from "three";
import { sheetsOf } from "./sheets.js";

const kMoved2 = 0.05 ** 2; // m2: a shorter way changes no order that is seen
const kMostTriangles = 30000; // more are drawn as they come

export class PaneOrder {
  private readonly middles: Float32Array; // of each triangle's sheet
  private readonly source: Uint32Array;
  private readonly order: Uint32Array;
  private readonly distances: Float32Array;
  private seenFrom: THREE.Vector3 | null = null;

  // `index`: three vertices a triangle, of `positions` with three numbers each. `attribute` is what is drawn.
  constructor(
    index: Uint32Array,
    positions: Float32Array,
    readonly attribute: THREE.BufferAttribute,
  ) {
    const count = index.length / 3 <= kMostTriangles ? index.length / 3 : 0;
    this.source = index;
    this.order = Uint32Array.from({ length: count }, (_, i) => i);
    this.distances = new Float32Array(count);
    this.middles = new Float32Array(3 * count);
    for (const { triangles, middle } of sheetsOf(index, positions, count))
      for (const triangle of triangles) this.middles.set(middle, 3 * triangle);
  }

  // Puts them in order as they are seen from there.
  sort(eye: THREE.Vector3): void {
    if (this.order.length < 2 || (this.seenFrom && this.seenFrom.distanceToSquared(eye) < kMoved2)) return;
    this.seenFrom = eye.clone();
    const { middles, distances, order, source } = this;
    for (let i = 0; i < distances.length; ++i)
      distances[i] =
        (middles[3 * i]! - eye.x) ** 2 + (middles[3 * i + 1]! - eye.y) ** 2 + (middles[3 * i + 2]! - eye.z) ** 2;
    order.sort((a, b) => distances[b]! - distances[a]! || a - b);
    const drawn = this.attribute.array;
    order.forEach((triangle, at) => {
      for (let k = 0; k < 3; ++k) drawn[3 * at + k] = source[3 * triangle + k]!;
    });
    this.attribute.needsUpdate = true;
  }
}
