// Sheets: triangles of one plane that hang together.
import { add, cross, dot, length, normalize, scale, subtract, type Vec3 } from "../../src/vector.js";

const kAlike = 0.999; // cosine between normals
const kInPlaneM = 0.001;
const kMostPlaces = 2 ** 26;

const edgeKey = (a: number, b: number): number => Math.min(a, b) * kMostPlaces + Math.max(a, b);

class Triangles {
  private readonly edges: readonly (readonly number[])[]; // of each triangle, by the places of its corners
  private readonly byEdge = new Map<number, number[]>();

  constructor(
    private readonly index: Uint32Array,
    private readonly positions: Float32Array,
    count: number,
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

export interface Sheet {
  readonly triangles: readonly number[];
  readonly middle: Vec3;
}

// Found from the largest triangle on: small ones tell their plane badly.
export function sheetsOf(index: Uint32Array, positions: Float32Array, count: number): Sheet[] {
  const all = new Triangles(index, positions, count);
  const areas = Float64Array.from({ length: count }, (_, t) => length(all.normal(t)) / 2);
  const known = new Uint8Array(count);
  const sheets: Sheet[] = [];
  for (const first of Array.from(areas.keys()).sort((a, b) => areas[b]! - areas[a]! || a - b)) {
    if (known[first]) continue;
    const n = normalize(all.normal(first));
    const [origin] = all.corners(first);
    const inPlane = (t: number) =>
      all.corners(t).every(p => Math.abs(dot(n, subtract(p, origin))) < kInPlaneM) &&
      Math.abs(dot(n, normalize(all.normal(t), n))) > kAlike;
    const triangles = [first];
    known[first] = 1;
    for (let i = 0; i < triangles.length; ++i)
      for (const t of all.beside(triangles[i]!))
        if (!known[t] && inPlane(t)) {
          known[t] = 1;
          triangles.push(t);
        }
    sheets.push({ triangles, middle: middleOf(all, triangles, areas) });
  }
  return sheets;
}

// Of triangles together, by area.
function middleOf(all: Triangles, triangles: readonly number[], areas: Float64Array): Vec3 {
  const weights = triangles.map(t => Math.max(areas[t]!, 1e-12));
  const sum = weights.reduce((a, b) => a + b, 0);
  return triangles.reduce<Vec3>(
    (middle, t, i) => all.corners(t).reduce((m, corner) => add(m, scale(corner, weights[i]! / (3 * sum))), middle),
    [0, 0, 0],
  );
}
