// Where to stand to see a room or a thing well.
import { anglesOf, lookAt, verticalFovRad, type Pose, type Viewport } from "./camera.js";
import type { Box, Lamp, Room, Thing } from "./protocol.js";
import { add, clamp, length, mix, normalize, subtract, type Vec3 } from "./vector.js";

const kEyeHeightM = 1.6;
const kWallGapM = 0.45; // from the walls when standing in a corner
const kNearM = 0.8;
const kFarM = 4.5;
const kBesideM = 0.35; // from the middle of a lamp in a wall to its room
const kOffThingsM = 0.2;
const kReachOfHeightM = 1.2; // of the eye above and below what it looks at, where no floor is known
const kMarginOfLamps = 1.1;
const kLargestShadeM = 2.5; // the diagonal of its box
const kLampBoxM = 0.15; // half of the side of the box that stands for a lamp without a body

export const middle = (box: Box): Vec3 => mix(box.low, box.high, 0.5);

// Whether a place lies over the floor: how often a ray along +x crosses its outline.
export function overFloor(floor: Room["floor"], x: number, z: number): boolean {
  let inside = false;
  for (let i = 0, j = floor.length - 1; i < floor.length; j = i++) {
    const [ax, az] = floor[i]!;
    const [bx, bz] = floor[j]!;
    if (az > z !== bz > z && x < ((bx - ax) * (z - az)) / (bz - az) + ax) inside = !inside;
  }
  return inside;
}

export function roomAround(rooms: readonly Room[], place: Vec3): Room | null {
  const heightGap = 0.3;
  return (
    rooms.find(
      room =>
        place[1] >= room.low[1] - heightGap &&
        place[1] <= room.high[1] + heightGap &&
        overFloor(room.floor, place[0], place[2]),
    ) ?? null
  );
}

function eyeIn(room: Room, x: number, z: number): Vec3 {
  return [x, room.low[1] + Math.min(kEyeHeightM, 0.7 * (room.high[1] - room.low[1])), z];
}

// Places in the corners of a room, a little off the walls, that lie over its floor.
function corners(room: Room): Vec3[] {
  const [cx, , cz] = middle(room);
  return room.floor
    .map(([x, z]) => {
      const inwards = normalize([cx - x, 0, cz - z]);
      return eyeIn(room, x + inwards[0] * kWallGapM * 1.5, z + inwards[2] * kWallGapM * 1.5);
    })
    .filter(place => overFloor(room.floor, place[0], place[2]));
}

// In the corner from which most of the room lies ahead, looking at its middle a little below the eye.
export function poseForRoom(room: Room, from: Pose): Pose {
  const center = middle(room);
  const eye = corners(room).reduce(
    (best, place) => (length(subtract(place, center)) > length(subtract(best, center)) ? place : best),
    eyeIn(room, center[0], center[2]),
  );
  const target: Vec3 = [center[0], eye[1] - 0.35, center[2]];
  if (length(subtract(target, eye)) < 0.5) return { ...from, position: eye, pitchRad: 0 };
  return lookAt({ ...from, position: eye }, target);
}

// What there is to stand in, and what may be in the way.
export interface Surroundings {
  readonly rooms: readonly Room[];
  readonly bounds: Box | null;
  readonly things: readonly Box[]; // hide what is behind them; may hold what is looked at
}

interface Distances {
  readonly nearest: number; // m, from the middle of what is looked at
  readonly wanted: number;
  readonly farthest: number;
}

function holds(box: Box, place: Vec3, marginM: number): boolean {
  return place.every((value, axis) => value > box.low[axis]! - marginM && value < box.high[axis]! + marginM);
}

// Whether the straight line between two places passes through a box (slabs: Kay & Kajiya 1986).
function blocks(box: Box, from: Vec3, to: Vec3): boolean {
  let enter = 0;
  let leave = 1;
  for (let axis = 0; axis < 3; ++axis) {
    const along = to[axis]! - from[axis]!;
    const a = (box.low[axis]! - from[axis]!) / along;
    const b = (box.high[axis]! - from[axis]!) / along;
    if (Number.isNaN(a) || Number.isNaN(b)) continue; // along a face
    enter = Math.max(enter, Math.min(a, b));
    leave = Math.min(leave, Math.max(a, b));
  }
  return enter < leave;
}

// The room of a place, for one in a wall or in a ceiling that beside it.
function roomOf(rooms: readonly Room[], place: Vec3): Room | null {
  const around = roomAround(rooms, place);
  if (around) return around;
  for (let step = 0; step < 8; ++step) {
    const angle = (Math.PI / 4) * step;
    const aside: Vec3 = [kBesideM * Math.cos(angle), 0, kBesideM * Math.sin(angle)];
    const beside = roomAround(rooms, add(place, aside));
    if (beside) return beside;
  }
  return null;
}

// How well a box is seen from a place; of two, more is better.
class Outlook {
  private readonly center: Vec3;
  private readonly ends: readonly Vec3[];
  private readonly obstacles: readonly Box[];

  constructor(
    private readonly box: Box,
    readonly room: Room | null,
    private readonly around: Surroundings,
  ) {
    this.center = middle(box);
    const [x, , z] = this.center;
    this.ends = [
      [x, box.low[1], z],
      [x, box.high[1], z],
    ];
    // Its shade, the table that it stands in: the boxes of such things are fuller than they are.
    this.obstacles = around.things.filter(thing => !holds(thing, this.center, 0.01));
  }

  canStandAt(eye: Vec3): boolean {
    const { room } = this;
    const { bounds } = this.around;
    if (room) return overFloor(room.floor, eye[0], eye[2]);
    return !bounds || !holds(bounds, this.center, 0) || holds(bounds, eye, 0);
  }

  isGood(eye: Vec3): boolean {
    return this.outside(eye) && this.isSeen(eye, this.center) && this.overTheFloor(eye);
  }

  rank(eye: Vec3): number {
    const ends = this.ends.filter(end => this.isSeen(eye, end)).length;
    return (
      (this.outside(eye) ? 16 : 0) +
      (this.overTheFloor(eye) ? 8 : 0) +
      (this.isSeen(eye, this.center) ? 6 : 0) +
      2 * ends +
      (this.offTheWalls(eye) ? 1 : 0)
    );
  }

  private outside(eye: Vec3): boolean {
    return [this.box, ...this.around.things].every(thing => !holds(thing, eye, kOffThingsM));
  }

  private isSeen(eye: Vec3, place: Vec3): boolean {
    return !this.obstacles.some(thing => blocks(thing, eye, place));
  }

  // No corner of the room between; the last bit may lie in a wall.
  private overTheFloor(eye: Vec3): boolean {
    const { room, center } = this;
    if (!room) return true;
    const way = Math.hypot(center[0] - eye[0], center[2] - eye[2]);
    for (let gone = 0; gone < way - kBesideM; gone += 0.2) {
      const [x, , z] = mix(eye, center, gone / way);
      if (!overFloor(room.floor, x, z)) return false;
    }
    return true;
  }

  private offTheWalls([x, , z]: Vec3): boolean {
    const { room } = this;
    return (
      !room ||
      [-kOffThingsM, kOffThingsM].every(m => overFloor(room.floor, x + m, z) && overFloor(room.floor, x, z + m))
    );
  }
}

// All around a place at a distance; the nearest directions to where the eye is come first.
function ring(center: Vec3, from: Vec3, heightM: number, distanceM: number): Vec3[] {
  const toEye = subtract(from, center);
  const level = normalize([toEye[0], 0, toEye[2]], [0, 0, 1]);
  // From another height the eye may stand nearer.
  const aside = Math.max(0.5 * distanceM, Math.sqrt(Math.max(0, distanceM ** 2 - (heightM - center[1]) ** 2)));
  const places: Vec3[] = [];
  for (let step = 0; step < 16; ++step) {
    const angle = (Math.PI / 8) * Math.ceil(step / 2) * (step % 2 ? 1 : -1);
    const x = level[0] * Math.cos(angle) + level[2] * Math.sin(angle);
    const z = level[2] * Math.cos(angle) - level[0] * Math.sin(angle);
    places.push([center[0] + aside * x, heightM, center[2] + aside * z]);
  }
  return places;
}

// Turns to the box where the eye stands in the same room at a good distance; else walks to a good place first.
function poseFor(box: Box, around: Surroundings, from: Pose, distances: Distances): Pose {
  const center = middle(box);
  const room = roomOf(around.rooms, center);
  const outlook = new Outlook(box, room, around);
  const { nearest, wanted, farthest } = distances;
  const distance = length(subtract(center, from.position));
  const together = room === null || roomAround(around.rooms, from.position) === room;
  if (together && distance >= nearest && distance <= farthest && outlook.isGood(from.position))
    return lookAt(from, center);
  const highest = Math.min(center[1] + kReachOfHeightM, (around.bounds?.high[1] ?? Infinity) - kOffThingsM);
  const height = room
    ? eyeIn(room, 0, 0)[1]
    : clamp(from.position[1], Math.min(highest, center[1] - kReachOfHeightM), highest);
  let best: Vec3 | null = null;
  // Nearer than it should be only where there is no room.
  for (const distancesM of [[wanted, nearest, farthest], [0.75 * nearest], [0.5 * nearest]]) {
    for (const place of distancesM.flatMap(m => ring(center, from.position, height, m))) {
      if (outlook.canStandAt(place) && (!best || outlook.rank(place) > outlook.rank(best))) best = place;
    }
    if (best && outlook.isGood(best)) break;
  }
  const position = best ?? (room ? eyeIn(room, middle(room)[0], middle(room)[2]) : from.position);
  return { ...from, position, ...anglesOf(subtract(center, position)) };
}

export function poseForThing(box: Box, around: Surroundings, from: Pose): Pose {
  const size = length(subtract(box.high, box.low));
  const wanted = clamp(size * 1.6, kNearM, kFarM);
  return poseFor(box, around, from, { nearest: 0.6 * wanted, wanted, farthest: 2.2 * wanted });
}

// A lamp is seen whole, from outside of its shade; its box: see lampBox.
export function poseForLamp(box: Box, around: Surroundings, from: Pose, viewport: Viewport): Pose {
  const halfFov = verticalFovRad(from, viewport) / 2;
  const narrower = Math.min(halfFov, Math.atan(Math.tan(halfFov) * (viewport.width / viewport.height)));
  const whole = (0.5 * kMarginOfLamps * length(subtract(box.high, box.low))) / Math.sin(narrower);
  const nearest = clamp(whole, 1.5, kFarM);
  return poseFor(box, around, from, {
    nearest,
    wanted: Math.max(2, nearest),
    farthest: Math.max(2.5, 1.3 * nearest),
  });
}

// Stands for a lamp without a body.
export function boxAt([x, y, z]: Vec3): Box {
  return { low: [x - kLampBoxM, y - kLampBoxM, z - kLampBoxM], high: [x + kLampBoxM, y + kLampBoxM, z + kLampBoxM] };
}

// What is seen of a lamp: the thing that it is a part of, or one around it, as a shade is; else a small box.
export function lampBox(lamp: Lamp, things: Iterable<Thing>): Box {
  const size = (box: Box) => length(subtract(box.high, box.low));
  let shade: Box | null = null;
  for (const thing of things) {
    if (thing.hidden || !thing.movable) continue; // those that do not move are as large as the room
    if (thing.id === lamp.object) return thing;
    if (size(thing) > (shade ? size(shade) : kLargestShadeM) || !holds(thing, lamp.position, 0.02)) continue;
    shade = thing;
  }
  return shade ?? boxAt(lamp.position);
}
