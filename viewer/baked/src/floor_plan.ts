// The plan of the storey that the eye is on: outlines of rooms, and where the eye looks. A click goes there.
import { kRadPerDegree, type Vec3 } from "../../src/vector.js";
import type { Room } from "./document.js";
import type { Eye } from "./link.js";
import { boxOf, middleOf, roomAt, storeysOf } from "./rooms.js";

const kMarginPx = 10;

export interface PlanFrame {
  readonly scale: number; // pixels a metre
  readonly left: number; // of the picture, at x = 0
  readonly top: number; // at z = 0
}

// The storey whose floor is the highest at or below the eye.
export function storeyAt(rooms: readonly Room[], eyeY: number): number {
  const storeys = storeysOf(rooms);
  return storeys.filter(y => y <= eyeY).at(-1) ?? storeys[0] ?? 0;
}

export const roomsOn = (rooms: readonly Room[], elevationM: number): Room[] =>
  rooms.filter(room => Math.abs(room.elevationM - elevationM) < 0.01);

export function frameOf(rooms: readonly Room[], widthPx: number, heightPx: number): PlanFrame {
  const boxes = rooms.map(boxOf);
  const low = [0, 2].map(axis => Math.min(...boxes.map(b => b.low[axis]!)));
  const high = [0, 2].map(axis => Math.max(...boxes.map(b => b.high[axis]!)));
  const [w, h] = [high[0]! - low[0]!, high[1]! - low[1]!];
  const scale = Math.min((widthPx - 2 * kMarginPx) / w, (heightPx - 2 * kMarginPx) / h);
  return {
    scale,
    left: (widthPx - scale * (low[0]! + high[0]!)) / 2,
    top: (heightPx - scale * (low[1]! + high[1]!)) / 2,
  };
}

export function drawPlan(canvas: HTMLCanvasElement, rooms: readonly Room[], eye: Eye): void {
  const context = canvas.getContext("2d");
  if (!context) return;
  const share = Math.min(2, devicePixelRatio);
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  canvas.width = Math.round(width * share);
  canvas.height = Math.round(height * share);
  context.scale(share, share);
  const shown = roomsOn(rooms, storeyAt(rooms, eye.position[1]));
  if (shown.length === 0) return;
  const { scale, left, top } = frameOf(shown, width, height);
  const inside = roomAt(rooms, eye.position);
  for (const room of shown) {
    context.beginPath();
    room.floor.forEach(([x, z]) => context.lineTo(left + scale * x, top + scale * z));
    context.closePath();
    context.fillStyle = inside !== null && rooms[inside] === room ? "#4a4132" : "#2a2a2a";
    context.fill();
    context.strokeStyle = "#8a8a8a";
    context.stroke();
    const [x, z] = middleOf(room);
    context.fillStyle = "#d0d0d0";
    context.font = "10px system-ui, sans-serif";
    context.textAlign = "center";
    const { low, high } = boxOf(room);
    context.fillText(room.name, left + scale * x, top + scale * z + 3, scale * (high[0] - low[0]) - 4);
  }
  const [x, z] = [left + scale * eye.position[0], top + scale * eye.position[2]];
  const yaw = eye.yawDeg * kRadPerDegree;
  const half = 30 * kRadPerDegree;
  const middle = Math.atan2(-Math.cos(yaw), -Math.sin(yaw));
  context.fillStyle = "rgba(240, 185, 84, 0.4)";
  context.beginPath();
  context.moveTo(x, z);
  context.arc(x, z, 22, middle - half, middle + half);
  context.fill();
  context.fillStyle = "#f0b954";
  context.beginPath();
  context.arc(x, z, 4, 0, 2 * Math.PI);
  context.fill();
}

// The place on the floor of the storey that was clicked on.
export function placeOnPlan(canvas: HTMLCanvasElement, rooms: readonly Room[], eye: Eye, x: number, y: number): Vec3 {
  const elevationM = storeyAt(rooms, eye.position[1]);
  const { scale, left, top } = frameOf(roomsOn(rooms, elevationM), canvas.clientWidth, canvas.clientHeight);
  return [(x - left) / scale, elevationM, (y - top) / scale];
}
