// Hands on the stage: pointers, wheel and keys become moves of the eye, pulls of handles, picks and the place of the
// light meter.
import { dolly, look, orbit, pixelsPerTangent, rayThrough, turned, walk, type Pose, type Ray } from "./camera.js";
import { dragBy, gizmoAt, handleAt, type Gizmo, type Handle } from "./gizmo.js";
import { heldBy, type Held } from "./held.js";
import { middle } from "./framing.js";
import type { Selection, Session } from "./session.js";
import { add, kRadPerDegree, scale, type Vec3 } from "./vector.js";

const kClickPx = 5; // a pointer that moved less was a click
const kMouseReachPx = 8;
const kTouchReachPx = 20;
const kWalkMPerS = 1.5;
const kFast = 3; // times that with Shift
const kTurnRadPerS = 80 * kRadPerDegree;
const kWalkMPerWheelPx = 0.004;
const kTouchWalkMPerPx = 0.012;
const kOrbitRadPerPx = 0.008;
const kMetresAheadToOrbit = 2.5; // where nothing has been picked

type Mode = "look" | "orbit" | "pan";

interface Pointer {
  x: number;
  y: number;
  readonly startX: number;
  readonly startY: number;
  moved: boolean;
}

interface Pull {
  readonly handle: Handle;
  readonly held: Held;
  readonly from: Ray;
  readonly pose: Pose;
  readonly gesture: string;
}

// Keys that move while they are held: metres forward, to the right and up, and turns to the left.
const kMoves: Readonly<Record<string, readonly [number, number, number, number]>> = {
  KeyW: [1, 0, 0, 0],
  KeyS: [-1, 0, 0, 0],
  KeyA: [0, -1, 0, 0],
  KeyD: [0, 1, 0, 0],
  KeyQ: [0, 0, 0, 1],
  KeyE: [0, 0, 0, -1],
  PageUp: [0, 0, 0.5, 0],
  PageDown: [0, 0, -0.5, 0],
  ArrowUp: [1, 0, 0, 0],
  ArrowDown: [-1, 0, 0, 0],
  ArrowLeft: [0, 0, 0, 1],
  ArrowRight: [0, 0, 0, -1],
};

let pulls = 0;

export class Input {
  active: Handle | null = null; // handle under the pointer or pulled
  private pointers = new Map<number, Pointer>();
  private mode: Mode = "look";
  private pull: Pull | null = null;
  private keys = new Set<string>();
  private fast = false;
  private lastTickMs = 0;
  private ticking = false;
  private readonly abort = new AbortController();

  constructor(
    private readonly stage: HTMLElement,
    private readonly session: Session,
    private readonly redraw: () => void,
  ) {
    const { signal } = this.abort;
    stage.addEventListener("pointerdown", event => this.down(event), { signal });
    stage.addEventListener("pointermove", event => this.moved(event), { signal });
    stage.addEventListener("pointerup", event => this.up(event, true), { signal });
    stage.addEventListener("pointercancel", event => this.up(event, false), { signal });
    stage.addEventListener("wheel", event => this.wheel(event), { signal, passive: false });
    stage.addEventListener("contextmenu", event => event.preventDefault(), { signal });
    stage.addEventListener("blur", () => this.keys.clear(), { signal });
    window.addEventListener("keyup", event => this.keyUp(event), { signal });
    window.addEventListener("blur", () => this.keys.clear(), { signal });
  }

  dispose(): void {
    this.abort.abort();
    this.keys.clear();
  }

  // The handles as they are drawn over the picture of this pose.
  gizmo(pose: Pose): Gizmo | null {
    const { model, selection, eye } = this.session;
    const held = model && heldBy(model, selection);
    return held && gizmoAt(pose, eye.viewport, held.place, held.canTurn);
  }

  // True if the key moves the eye; arrows count on the stage only, for lists and sliders use them too.
  keyDown(event: KeyboardEvent, onStage: boolean): boolean {
    if (event.ctrlKey || event.metaKey || event.altKey || !(event.code in kMoves)) return false;
    if (!onStage && !event.code.startsWith("Key")) return false;
    this.fast = event.shiftKey;
    this.keys.add(event.code);
    this.startTicking();
    return true;
  }

  private keyUp(event: KeyboardEvent): void {
    this.fast = event.shiftKey;
    this.keys.delete(event.code);
  }

  private startTicking(): void {
    if (this.ticking) return;
    this.ticking = true;
    this.lastTickMs = performance.now();
    requestAnimationFrame(now => this.tick(now));
  }

  private tick(nowMs: number): void {
    // Never more than a tenth of a second's worth, after a pause of the browser.
    const seconds = Math.min(0.1, Math.max(0, (nowMs - this.lastTickMs) / 1000));
    this.lastTickMs = nowMs;
    let [ahead, aside, above, turn] = [0, 0, 0, 0];
    for (const key of this.keys) {
      const move = kMoves[key]!;
      ahead += move[0];
      aside += move[1];
      above += move[2];
      turn += move[3];
    }
    const metres = kWalkMPerS * seconds * (this.fast ? kFast : 1);
    if (this.keys.size > 0) {
      const pose = walk(this.session.eye.pose, ahead * metres, aside * metres, above * metres);
      this.session.eye.set(turned(pose, turn * kTurnRadPerS * seconds, 0));
      requestAnimationFrame(now => this.tick(now));
    } else {
      this.ticking = false;
    }
  }

  private place(event: PointerEvent | WheelEvent): { x: number; y: number } {
    const box = this.stage.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  private ray(pose: Pose, x: number, y: number): Ray {
    return rayThrough(pose, this.session.eye.viewport, x, y);
  }

  private down(event: PointerEvent): void {
    this.stage.focus({ preventScroll: true });
    if (event.pointerType === "mouse") event.preventDefault();
    this.stage.setPointerCapture(event.pointerId);
    const { x, y } = this.place(event);
    this.pointers.set(event.pointerId, { x, y, startX: x, startY: y, moved: false });
    if (this.pointers.size > 1) {
      this.pull = null;
      return;
    }
    const walking = this.session.navigation === "walk";
    const other = event.button === 2 || event.altKey;
    this.mode = event.button === 1 ? "pan" : walking !== other ? "look" : "orbit";
    if (event.button === 0) this.takeHold(x, y, event.pointerType === "mouse" ? kMouseReachPx : kTouchReachPx);
  }

  private takeHold(x: number, y: number, reachPx: number): void {
    const { model, selection, eye } = this.session;
    const held = model && heldBy(model, selection);
    const gizmo = this.gizmo(eye.pose);
    const handle = gizmo && handleAt(gizmo, x, y, reachPx);
    if (!held || !handle) return;
    this.pull = { handle, held, from: this.ray(eye.pose, x, y), pose: eye.pose, gesture: `pull ${++pulls}` };
    this.active = handle;
    this.redraw();
  }

  private moved(event: PointerEvent): void {
    const { x, y } = this.place(event);
    const pointer = this.pointers.get(event.pointerId);
    if (!pointer) {
      this.hover(x, y);
      return;
    }
    const dx = x - pointer.x;
    const dy = y - pointer.y;
    pointer.x = x;
    pointer.y = y;
    pointer.moved ||= Math.hypot(x - pointer.startX, y - pointer.startY) > kClickPx;
    if (this.pointers.size === 2) this.twoFingers(pointer, dx, dy);
    else if (this.pull) this.pullTo(this.pull, x, y, event.shiftKey || this.session.movesAlone);
    else if (pointer.moved) this.drag(dx, dy);
  }

  private hover(x: number, y: number): void {
    if (this.session.meter.on) this.session.meter.hold(x, y);
    const gizmo = this.gizmo(this.session.eye.pose);
    const active = gizmo && handleAt(gizmo, x, y, kMouseReachPx);
    if (active !== this.active) {
      this.active = active;
      this.redraw();
    }
  }

  private pullTo(pull: Pull, x: number, y: number, alone: boolean): void {
    const drag = dragBy(pull.handle, pull.held.place, pull.from, this.ray(pull.pose, x, y));
    if (drag) this.session.edit(pull.held.target, pull.held.dragged(drag, alone), pull.gesture);
  }

  private pivot(): Vec3 {
    const { eye, pivot, selection } = this.session;
    const box = selection && this.session.boxOf(selection);
    if (box) return middle(box);
    return (
      pivot ??
      add(
        eye.pose.position,
        scale(this.ray(eye.pose, eye.viewport.width / 2, eye.viewport.height / 2).direction, kMetresAheadToOrbit),
      )
    );
  }

  private drag(dx: number, dy: number): void {
    const { eye } = this.session;
    if (this.mode === "look") {
      eye.set(look(eye.pose, eye.viewport, dx, dy));
    } else if (this.mode === "orbit") {
      const pivot = this.pivot();
      this.session.pivot = pivot;
      eye.set(orbit(eye.pose, pivot, -dx * kOrbitRadPerPx, -dy * kOrbitRadPerPx));
    } else {
      const metresPerPx = kMetresAheadToOrbit / pixelsPerTangent(eye.pose, eye.viewport);
      eye.set(walk(eye.pose, 0, -dx * metresPerPx, dy * metresPerPx));
    }
  }

  // Each finger does half. Two that pull the floor towards them or spread walk forward.
  private twoFingers(pointer: Pointer, dx: number, dy: number): void {
    const other = [...this.pointers.values()].find(p => p !== pointer);
    if (!other) return;
    other.moved = pointer.moved = true;
    const before = Math.hypot(pointer.x - dx - other.x, pointer.y - dy - other.y);
    const after = Math.hypot(pointer.x - other.x, pointer.y - other.y);
    const { eye } = this.session;
    if (this.session.navigation === "orbit") {
      eye.set(dolly(eye.pose, this.pivot(), before / Math.max(1, after)));
      return;
    }
    const metres = kTouchWalkMPerPx / 2;
    eye.set(walk(eye.pose, (after - before) * kTouchWalkMPerPx + dy * metres, -dx * metres));
  }

  private up(event: PointerEvent, done: boolean): void {
    const pointer = this.pointers.get(event.pointerId);
    this.pointers.delete(event.pointerId);
    const wasPull = this.pull !== null;
    this.pull = null;
    if (wasPull) this.redraw();
    if (!pointer || !done || pointer.moved || wasPull || event.button > 0 || this.pointers.size > 0) return;
    if (this.session.meter.on && event.pointerType !== "mouse") this.session.meter.hold(pointer.x, pointer.y);
    else void this.pick(pointer.x, pointer.y);
  }

  private async pick(x: number, y: number): Promise<void> {
    const { width, height } = this.session.eye.viewport;
    const hit = await this.session.pick(x / width, y / height);
    const { model } = this.session;
    const selection: Selection | null =
      hit?.lamp && model?.lamps.has(hit.lamp)
        ? { kind: "lamp", id: hit.lamp }
        : hit?.object && model?.things.has(hit.object)
          ? { kind: "object", id: hit.object }
          : null;
    this.session.select(selection);
    this.session.show({ pivot: hit?.point ?? null, ...(selection ? { tab: "home" as const } : {}) });
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const px = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? event.deltaY * 16 : event.deltaY;
    const { eye } = this.session;
    if (this.session.navigation === "orbit") eye.set(dolly(eye.pose, this.pivot(), Math.exp(px * 0.0012)));
    else eye.set(walk(eye.pose, -px * kWalkMPerWheelPx * (event.shiftKey ? kFast : 1), 0));
  }
}
