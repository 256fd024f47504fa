// Sheets: triangles of one plane that hang together.
import { cross, dot, length, normalize, subtract, type Vec3 } from "../../src/vector.js";

const kAlike = 0.999; // cosine between normals
const kInPlaneM = 0.001;
const kMostPlaces = 2 ** 26;

const edgeKey = (a: number, b: number): number => Math.min(a, b) * kMostPlaces + Math.max(a, b);

class Triangles {
  readonly edges: readonly (readonly number[])[]; // of each triangle, by the places of its corners
  private readonly byEdge = new Map<number, number[]>();

  constructor(
    private readonly index: Uint32Array,
    private readonly positions: Float32Array,
    readonly count: number,
  ) {
    const places = new Map<string, number>(); // vertices of one place are one
    const placeOf = (corner: Vec3) => {
      const key = corner.join();
      if (!places.has(key)) places.set(key, places.size);
      return places.get(key)!;
    };
    this.edges = Array.from({ length: count }, (_, t) => {
      const [a, b, c] = this.corners(t).map(placeOf) as [number, number, number];
      return [edgeKey(a, b), edgeKey(b, c), edgeKey(c, a)];
    });
    this.edges.forEach((edges, t) => {
      for (const edge of edges) {
        const known = this.byEdge.get(edge);
        if (known) known.push(t);
        else this.byEdge.set(edge, [t]);
      }
    });
  }

  corners(t: number): readonly [Vec3, Vec3, Vec3] {
    const corner = (k: number): Vec3 => {
      const i = 3 * this.index[3 * t + k]!;
      return [this.positions[i]!, this.positions[i + 1]!, this.positions[i + 2]!];
    };
    return [corner(0), corner(1), corner(2)];
  }
  // As long as twice its area.
  normal(t: number): Vec3 {
    const [a, b, c] = this.corners(t);
    return cross(subtract(b, a), subtract(c, a));
  }
  beside(t: number): readonly number[] {
    return this.edges[t]!.flatMap(edge => this.byEdge.get(edge)!);
  }
}

// The triangles of each sheet, found from the largest on: small ones tell their plane badly.
export function sheetsOf(index: Uint32Array, positions: Float32Array, count: number): number[][] {
  const triangles = new Triangles(index, positions, count);
  const areas = Float64Array.from({ length: count }, (_, t) => length(triangles.normal(t)) / 2);
  const known = new Uint8Array(count);
  const sheets: number[][] = [];
  for (const first of Array.from(areas.keys()).sort((a, b) => areas[b]! - areas[a]! || a - b)) {
    if (known[first]) continue;
    const n = normalize(triangles.normal(first));
    const [origin] = triangles.corners(first);
    const inPlane = (t: number) =>
      triangles.corners(t).every(p => Math.abs(dot(n, subtract(p, origin))) < kInPlaneM) &&
      Math.abs(dot(n, normalize(triangles.normal(t), n))) > kAlike;
    const sheet = [first];
    known[first] = 1;
    for (let i = 0; i < sheet.length; ++i)
      for (const t of triangles.beside(sheet[i]!))
        if (!known[t] && inPlane(t)) {
          known[t] = 1;
          sheet.push(t);
        }
    sheets.push(sheet);
  }
  return sheets;
}

// Of the triangles together, by area.
export function middleOf(sheet: readonly number[], index: Uint32Array, positions: Float32Array): Vec3 {
  const triangles = new Triangles(index, positions, 0);
  let area = 0;
  const sum: [number, number, number] = [0, 0, 0];
  for (const t of sheet) {
    const own = Math.max(length(triangles.normal(t)), 1e-12);
    area += own;
    for (const corner of triangles.corners(t)) for (let c = 0; c < 3; ++c) sum[c]! += (own * corner[c]!) / 3;
  }
  return [sum[0] / area, sum[1] / area, sum[2] / area];
}
