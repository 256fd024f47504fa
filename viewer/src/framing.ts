// Where to stand to see a room or a thing well.
import { anglesOf, lookAt, type Pose } from "./camera.js";
import type { Box, Room } from "./protocol.js";
import { add, clamp, length, mix, normalize, scale, subtract, type Vec3 } from "./vector.js";

const kEyeHeightM = 1.6;
const kWallGapM = 0.45; // from the walls when standing in a corner
const kNearM = 0.8;
const kFarM = 4.5;

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

// Turns to the thing where the eye stands in the same room at a good distance; else walks to a good place first.
export function poseForThing(box: Box, rooms: readonly Room[], from: Pose): Pose {
  const center = middle(box);
  const size = length(subtract(box.high, box.low));
  const wanted = clamp(size * 1.6, kNearM, kFarM);
  const distance = length(subtract(center, from.position));
  const room = roomAround(rooms, center);
  const together = room === null || roomAround(rooms, from.position) === room;
  if (together && distance >= wanted * 0.6 && distance <= wanted * 2.2) return lookAt(from, center);
  const toEye = subtract(from.position, center);
  const level = normalize([toEye[0], 0, toEye[2]], [0, 0, 1]);
  const eyeHeight = room ? eyeIn(room, 0, 0)[1] : from.position[1];
  const candidates: Vec3[] = [];
  for (let step = 0; step < 16; ++step) {
    // The nearest directions to where the eye is come first.
    const angle = (Math.PI / 8) * Math.ceil(step / 2) * (step % 2 ? 1 : -1);
    const aside: Vec3 = [
      level[0] * Math.cos(angle) + level[2] * Math.sin(angle),
      0,
      level[2] * Math.cos(angle) - level[0] * Math.sin(angle),
    ];
    const eye = add(center, scale(aside, wanted));
    candidates.push([eye[0], eyeHeight, eye[2]]);
  }
  const good = room ? candidates.find(eye => overFloor(room.floor, eye[0], eye[2])) : candidates[0];
  const middleOfRoom = room ? eyeIn(room, middle(room)[0], middle(room)[2]) : from.position;
  const position = good ?? middleOfRoom;
  return { ...from, position, ...anglesOf(subtract(center, position)) };
}
