// Lines drawn over the picture: the box or outline of what is selected, and the handles to move it.
import { projectSegment, type Pose, type Viewport } from "./camera.js";
import { kDiscPx, type Gizmo, type Handle } from "./gizmo.js";
import type { Box, Room } from "./protocol.js";
import type { Vec3 } from "./vector.js";

export interface OverlayScene {
  readonly pose: Pose;
  readonly viewport: Viewport;
  readonly box: Box | null;
  readonly warnings: readonly Box[]; // things that run into each other
  readonly room: Room | null;
  readonly gizmo: Gizmo | null;
  readonly active: Handle | null; // under the pointer or held
  readonly cross: readonly [number, number] | null; // where the light is measured
}

const kAccent = "#f0b954";
const kWarning = "#ff8f80";
const kCasing = "rgba(0, 0, 0, 0.55)";
const kHandleColors: Readonly<Record<Handle, string>> = {
  x: "#ff7a6b",
  y: "#86d97a",
  z: "#7db3ff",
  floor: "#ffffff",
  turn: "#f0b954",
};

// A line with a dark casing, to be seen on any picture.
function stroke(context: CanvasRenderingContext2D, color: string, widthPx: number): void {
  context.lineWidth = widthPx + 2;
  context.strokeStyle = kCasing;
  context.stroke();
  context.lineWidth = widthPx;
  context.strokeStyle = color;
  context.stroke();
}

function addSegment(context: CanvasRenderingContext2D, scene: OverlayScene, from: Vec3, to: Vec3): void {
  const ends = projectSegment(scene.pose, scene.viewport, from, to);
  if (!ends) return;
  context.moveTo(ends[0].x, ends[0].y);
  context.lineTo(ends[1].x, ends[1].y);
}

function drawBox(context: CanvasRenderingContext2D, scene: OverlayScene, box: Box, color: string): void {
  const corner = (i: number): Vec3 => [
    i & 1 ? box.high[0] : box.low[0],
    i & 2 ? box.high[1] : box.low[1],
    i & 4 ? box.high[2] : box.low[2],
  ];
  context.beginPath();
  for (let i = 0; i < 8; ++i) {
    for (const bit of [1, 2, 4]) if (!(i & bit)) addSegment(context, scene, corner(i), corner(i | bit));
  }
  stroke(context, color, 1.25);
}

function drawFloor(context: CanvasRenderingContext2D, scene: OverlayScene, room: Room): void {
  context.beginPath();
  room.floor.forEach(([x, z], i) => {
    const [nextX, nextZ] = room.floor[(i + 1) % room.floor.length]!;
    addSegment(context, scene, [x, room.low[1] + 0.01, z], [nextX, room.low[1] + 0.01, nextZ]);
  });
  stroke(context, kAccent, 1.5);
}

function drawArrowHead(
  context: CanvasRenderingContext2D,
  gizmo: Gizmo,
  tip: { x: number; y: number },
  color: string,
): void {
  const angle = Math.atan2(tip.y - gizmo.center.y, tip.x - gizmo.center.x);
  context.beginPath();
  for (const [along, aside] of [
    [9, 0],
    [-6, 6.5],
    [-6, -6.5],
  ] as const) {
    context.lineTo(
      tip.x + along * Math.cos(angle) - aside * Math.sin(angle),
      tip.y + along * Math.sin(angle) + aside * Math.cos(angle),
    );
  }
  context.closePath();
  context.lineWidth = 2;
  context.strokeStyle = kCasing;
  context.stroke();
  context.fillStyle = color;
  context.fill();
}

function drawGizmo(context: CanvasRenderingContext2D, gizmo: Gizmo, active: Handle | null): void {
  const width = (handle: Handle) => (handle === active ? 4.5 : 2.5);
  if (gizmo.ring.length > 1) {
    context.beginPath();
    gizmo.ring.forEach(point => context.lineTo(point.x, point.y));
    stroke(context, kHandleColors.turn, width("turn"));
  }
  for (const { handle, tip } of gizmo.arrows) {
    context.beginPath();
    context.moveTo(gizmo.center.x, gizmo.center.y);
    context.lineTo(tip.x, tip.y);
    stroke(context, kHandleColors[handle], width(handle));
    drawArrowHead(context, gizmo, tip, kHandleColors[handle]);
  }
  context.beginPath();
  context.arc(gizmo.center.x, gizmo.center.y, active === "floor" ? kDiscPx + 2 : kDiscPx, 0, 2 * Math.PI);
  context.fillStyle = active === "floor" ? kAccent : kHandleColors.floor;
  context.fill();
  context.lineWidth = 2;
  context.strokeStyle = kCasing;
  context.stroke();
}

function drawCross(context: CanvasRenderingContext2D, x: number, y: number): void {
  context.beginPath();
  context.arc(x, y, 6, 0, 2 * Math.PI);
  for (const [dx, dy] of [
    [1, 0],
    [-1, 0],
    [0, 1],
    [0, -1],
  ] as const) {
    context.moveTo(x + 9 * dx, y + 9 * dy);
    context.lineTo(x + 14 * dx, y + 14 * dy);
  }
  stroke(context, "#ffffff", 1.25);
}

export function drawOverlay(canvas: HTMLCanvasElement, scene: OverlayScene): void {
  const context = canvas.getContext("2d");
  if (!context) return;
  const pixelRatio = canvas.width / scene.viewport.width;
  context.setTransform(pixelRatio, 0, 0, pixelRatio, 0, 0);
  context.clearRect(0, 0, scene.viewport.width, scene.viewport.height);
  context.lineJoin = "round";
  context.lineCap = "round";
  if (scene.room) drawFloor(context, scene, scene.room);
  if (scene.box) drawBox(context, scene, scene.box, kAccent);
  for (const box of scene.warnings) drawBox(context, scene, box, kWarning);
  if (scene.gizmo) drawGizmo(context, scene.gizmo, scene.active);
  if (scene.cross) drawCross(context, scene.cross[0], scene.cross[1]);
}
