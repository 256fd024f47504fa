// A person walking: three spheres above the height of a step keep off the walls, feet follow floors and stairs.
import type { Vec3 } from "../../src/vector.js";
import type { Bvh } from "./bvh.js";

export const kEyeHeightM = 1.6;
const kRadiusM = 0.2;
const kSpheresM = [0.65, 1.05, 1.45]; // above the feet
const kStepUpM = 0.42;
const kStepDownM = 0.6; // deeper is an edge that nobody steps over
const kFloorSlope = 0.6; // least y of a floor's normal
const kStrideM = 0.08; // of one piece of a move
const kMostGapM = 0.8; // without a floor, as on a threshold
const kSearchStepM = 0.25;
const kSearchRings = 12;
const kFeetM = 0.12; // how far around the middle feet find a floor

export interface Body {
  readonly feet: Vec3;
  readonly gapM: number; // since there was a floor
}

// Height of the floor below; null where there is none within reach.
export function floorBelow(world: Bvh, x: number, y: number, z: number, up: number, down: number): number | null {
  let from = y + up;
  // Past what is not a floor, such as the side of a stair that is hit on its edge.
  for (let tries = 0; tries < 8; ++tries) {
    const hit = world.raycast([x, from, z], [0, -1, 0], from - (y - down));
    if (!hit) return null;
    const n = world.normalOf(hit.triangle);
    if (Math.abs(n[1]) >= kFloorSlope * Math.hypot(...n)) return from - hit.distance;
    from -= hit.distance + 1e-3;
  }
  return null;
}

function pushedOut(world: Bvh, feet: Vec3): Vec3 {
  let [x, , z] = feet;
  for (let round = 0; round < 4; ++round) {
    let moved = false;
    for (const height of kSpheresM) {
      const y = feet[1] + height;
      world.forEachNear([x, y, z], kRadiusM, triangle => {
        const p = world.nearestOn(triangle, [x, y, z]);
        const [dx, dy, dz] = [x - p[0], y - p[1], z - p[2]];
        const reach = kRadiusM ** 2 - dy ** 2;
        const flat = Math.hypot(dx, dz);
        if (reach <= 0 || flat ** 2 >= reach - 1e-7) return;
        if (flat < 1e-6) return;
        const push = (Math.sqrt(reach) - flat) / flat;
        x += dx * push;
        z += dz * push;
        moved = true;
      });
    }
    if (!moved) break;
  }
  return [x, feet[1], z];
}

function stride(world: Bvh, body: Body, dx: number, dz: number): Body {
  const [x, y, z] = pushedOut(world, [body.feet[0] + dx, body.feet[1], body.feet[2] + dz]);
  const went = Math.hypot(x - body.feet[0], z - body.feet[2]);
  if (went > 3 * kStrideM) return body; // squeezed through
  const floors = [
    [0, 0],
    [kFeetM, 0],
    [-kFeetM, 0],
    [0, kFeetM],
    [0, -kFeetM],
  ].flatMap(([ox, oz]) => floorBelow(world, x + ox!, y, z + oz!, kStepUpM, kStepDownM) ?? []);
  if (floors.length > 0) return { feet: [x, Math.max(...floors), z], gapM: 0 };
  const gapM = body.gapM + went;
  return gapM > kMostGapM ? body : { feet: [x, y, z], gapM };
}

// `dx`, `dz`: metres wanted.
export function walked(world: Bvh, body: Body, dx: number, dz: number): Body {
  const pieces = Math.min(50, Math.ceil(Math.hypot(dx, dz) / kStrideM));
  let at = body;
  for (let i = 0; i < pieces; ++i) at = stride(world, at, dx / pieces, dz / pieces);
  return at;
}

// Whether somebody can stand there: head room over a floor.
export const hasHeadroom = (world: Bvh, [x, y, z]: Vec3): boolean =>
  world.raycast([x, y + 0.1, z], [0, 1, 0], kEyeHeightM) === null;

// The standing place nearest to a point that is wanted, on its floor and clear of furniture; the point itself if there
// is none within reach.
export function freePlace(world: Bvh, wanted: Vec3, allowed: (x: number, z: number) => boolean): Vec3 {
  const [x, y, z] = wanted;
  for (let ring = 0; ring <= kSearchRings; ++ring) {
    const count = Math.max(1, 6 * ring);
    for (let i = 0; i < count; ++i) {
      const angle = (2 * Math.PI * i) / count;
      const [px, pz] = [x + ring * kSearchStepM * Math.cos(angle), z + ring * kSearchStepM * Math.sin(angle)];
      if (!allowed(px, pz)) continue;
      const floor = floorBelow(world, px, y, pz, 0.3, 0.5);
      if (floor === null || Math.abs(floor - y) > 0.25) continue;
      const place: Vec3 = [px, floor, pz];
      const out = pushedOut(world, place);
      if (hasHeadroom(world, place) && Math.hypot(out[0] - px, out[2] - pz) < 1e-4) return place;
    }
  }
  return wanted;
}
