// A tree of boxes over the triangles of a home: what a ray hits, and what is near a place.
import type { Vec3 } from "../../src/vector.js";

export interface Hit {
  readonly distance: number;
  readonly triangle: number; // its first index is 3 * triangle
  readonly u: number; // weight of the second vertex
  readonly v: number; // of the third
}

const kLeaf = 4;
const kMostDepth = 64;

export class Bvh {
  // A node: its box, then either the right child (the left one follows it) or the first triangle and how many.
  private readonly boxes: Float32Array;
  private readonly links: Int32Array; // 2: right child, 0 | first, count
  private readonly order: Uint32Array;

  constructor(
    readonly positions: Float32Array,
    readonly index: Uint32Array,
  ) {
    const count = index.length / 3;
    this.order = Uint32Array.from({ length: count }, (_, i) => i);
    this.boxes = new Float32Array(6 * Math.max(1, 2 * count));
    this.links = new Int32Array(2 * Math.max(1, 2 * count));
    const centers = new Float32Array(3 * count);
    for (let t = 0; t < count; ++t) {
      for (let axis = 0; axis < 3; ++axis) {
        const [a, b, c] = this.along(t, axis);
        centers[3 * t + axis] = (Math.min(a, b, c) + Math.max(a, b, c)) / 2;
      }
    }
    this.build(centers);
  }

  private along(triangle: number, axis: number): [number, number, number] {
    const { positions, index } = this;
    const at = 3 * triangle;
    return [
      positions[3 * index[at]! + axis]!,
      positions[3 * index[at + 1]! + axis]!,
      positions[3 * index[at + 2]! + axis]!,
    ];
  }

  corner(triangle: number, corner: number): Vec3 {
    const at = 3 * this.index[3 * triangle + corner]!;
    return [this.positions[at]!, this.positions[at + 1]!, this.positions[at + 2]!];
  }

  private build(centers: Float32Array): void {
    const { order, links } = this;
    let nodes = 0;
    // Each task: range of triangles, and the node whose right child it is.
    const tasks: [number, number, number, number][] = [[0, order.length, -1, 0]];
    while (tasks.length > 0) {
      const [from, to, parent, depth] = tasks.pop()!;
      const node = nodes++;
      if (parent >= 0) links[2 * parent] = node;
      this.bound(node, from, to);
      if (to - from <= kLeaf || depth >= kMostDepth - 2) {
        links[2 * node] = from;
        links[2 * node + 1] = to - from;
        continue;
      }
      const middle = this.split(centers, from, to);
      tasks.push([middle, to, node, depth + 1], [from, middle, -1, depth + 1]);
    }
  }

  private bound(node: number, from: number, to: number): void {
    const { boxes, order, positions, index } = this;
    const at = 6 * node;
    boxes.fill(Infinity, at, at + 3);
    boxes.fill(-Infinity, at + 3, at + 6);
    for (let i = from; i < to; ++i) {
      for (let corner = 0; corner < 3; ++corner) {
        const vertex = 3 * index[3 * order[i]! + corner]!;
        for (let axis = 0; axis < 3; ++axis) {
          const x = positions[vertex + axis]!;
          if (x < boxes[at + axis]!) boxes[at + axis] = x;
          if (x > boxes[at + 3 + axis]!) boxes[at + 3 + axis] = x;
        }
      }
    }
  }

  // Halves the widest extent of the centres; where all are on one side, their number.
  private split(centers: Float32Array, from: number, to: number): number {
    const { order } = this;
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (let i = from; i < to; ++i) {
      for (let axis = 0; axis < 3; ++axis) {
        const x = centers[3 * order[i]! + axis]!;
        low[axis] = Math.min(low[axis]!, x);
        high[axis] = Math.max(high[axis]!, x);
      }
    }
    const extent = low.map((l, axis) => high[axis]! - l);
    const axis = extent.indexOf(Math.max(...extent));
    const plane = (low[axis]! + high[axis]!) / 2;
    let left = from;
    for (let i = from; i < to; ++i) {
      if (centers[3 * order[i]! + axis]! >= plane) continue;
      const swapped = order[i]!;
      order[i] = order[left]!;
      order[left++] = swapped;
    }
    return left > from && left < to ? left : (from + to) >> 1;
  }

  // The nearest triangle within `most` metres; the direction is a unit vector.
  raycast(origin: Vec3, direction: Vec3, most = Infinity): Hit | null {
    const { boxes, links, order } = this;
    const inverse = direction.map(d => 1 / (Math.abs(d) > 1e-12 ? d : 1e-12));
    let best: Hit | null = null;
    let far = most;
    const stack = order.length > 0 ? [0] : [];
    while (stack.length > 0) {
      const node = stack.pop()!;
      let enter = 0;
      let leave = far;
      for (let axis = 0; axis < 3; ++axis) {
        const a = (boxes[6 * node + axis]! - origin[axis]!) * inverse[axis]!;
        const b = (boxes[6 * node + 3 + axis]! - origin[axis]!) * inverse[axis]!;
        enter = Math.max(enter, Math.min(a, b));
        leave = Math.min(leave, Math.max(a, b));
      }
      if (enter > leave + 1e-6) continue;
      const count = links[2 * node + 1]!;
      const first = links[2 * node]!;
      if (count === 0) {
        stack.push(first, node + 1);
        continue;
      }
      for (let i = first; i < first + count; ++i) {
        const hit = this.intersect(order[i]!, origin, direction, far);
        if (!hit) continue;
        best = hit;
        far = hit.distance;
      }
    }
    return best;
  }

  // Möller & Trumbore 1997, from both sides.
  private intersect(triangle: number, o: Vec3, d: Vec3, most: number): Hit | null {
    const a = this.corner(triangle, 0);
    const b = this.corner(triangle, 1);
    const c = this.corner(triangle, 2);
    const e1 = [b[0] - a[0], b[1] - a[1], b[2] - a[2]] as const;
    const e2 = [c[0] - a[0], c[1] - a[1], c[2] - a[2]] as const;
    const px = d[1] * e2[2] - d[2] * e2[1];
    const py = d[2] * e2[0] - d[0] * e2[2];
    const pz = d[0] * e2[1] - d[1] * e2[0];
    const det = e1[0] * px + e1[1] * py + e1[2] * pz;
    if (Math.abs(det) < 1e-14) return null;
    const tx = o[0] - a[0];
    const ty = o[1] - a[1];
    const tz = o[2] - a[2];
    const u = (tx * px + ty * py + tz * pz) / det;
    if (u < 0 || u > 1) return null;
    const qx = ty * e1[2] - tz * e1[1];
    const qy = tz * e1[0] - tx * e1[2];
    const qz = tx * e1[1] - ty * e1[0];
    const v = (d[0] * qx + d[1] * qy + d[2] * qz) / det;
    if (v < 0 || u + v > 1) return null;
    const distance = (e2[0] * qx + e2[1] * qy + e2[2] * qz) / det;
    return distance > 1e-5 && distance < most ? { distance, triangle, u, v } : null;
  }

  // Of all triangles whose boxes touch that of a sphere.
  forEachNear(center: Vec3, radius: number, visit: (triangle: number) => void): void {
    const { boxes, links, order } = this;
    const stack = order.length > 0 ? [0] : [];
    while (stack.length > 0) {
      const node = stack.pop()!;
      const apart = [0, 1, 2].some(
        axis =>
          boxes[6 * node + axis]! > center[axis]! + radius || boxes[6 * node + 3 + axis]! < center[axis]! - radius,
      );
      if (apart) continue;
      const count = links[2 * node + 1]!;
      const first = links[2 * node]!;
      if (count === 0) stack.push(first, node + 1);
      else for (let i = first; i < first + count; ++i) visit(order[i]!);
    }
  }

  // Not of unit length.
  normalOf(triangle: number): Vec3 {
    const [a, b, c] = [this.corner(triangle, 0), this.corner(triangle, 1), this.corner(triangle, 2)];
    const e1 = [b[0] - a[0], b[1] - a[1], b[2] - a[2]] as const;
    const e2 = [c[0] - a[0], c[1] - a[1], c[2] - a[2]] as const;
    return [e1[1] * e2[2] - e1[2] * e2[1], e1[2] * e2[0] - e1[0] * e2[2], e1[0] * e2[1] - e1[1] * e2[0]];
  }

  // The point of a triangle that is nearest to a place (Ericson 2005, "Real-time collision detection", 5.1.5).
  nearestOn(triangle: number, p: Vec3): Vec3 {
    const [a, b, c] = [this.corner(triangle, 0), this.corner(triangle, 1), this.corner(triangle, 2)];
    const minus = (x: Vec3, y: Vec3): Vec3 => [x[0] - y[0], x[1] - y[1], x[2] - y[2]];
    const times = (x: Vec3, y: Vec3) => x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
    const along = (x: Vec3, e: Vec3, t: number): Vec3 => [x[0] + e[0] * t, x[1] + e[1] * t, x[2] + e[2] * t];
    const ab = minus(b, a);
    const ac = minus(c, a);
    const [d1, d2] = [times(ab, minus(p, a)), times(ac, minus(p, a))];
    if (d1 <= 0 && d2 <= 0) return a;
    const [d3, d4] = [times(ab, minus(p, b)), times(ac, minus(p, b))];
    if (d3 >= 0 && d4 <= d3) return b;
    const vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return along(a, ab, d1 / (d1 - d3));
    const [d5, d6] = [times(ab, minus(p, c)), times(ac, minus(p, c))];
    if (d6 >= 0 && d5 <= d6) return c;
    const vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return along(a, ac, d2 / (d2 - d6));
    const va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return along(b, minus(c, b), (d4 - d3) / (d4 - d3 + (d5 - d6)));
    const sum = va + vb + vc;
    return along(along(a, ab, vb / sum), ac, vc / sum);
  }
}
