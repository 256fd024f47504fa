// Keys, mouse, touch and gamepads: what they wish of the eye.
import type { Wish } from "./mover.js";

const kDegPerPixel = 0.22;
const kTurnDegPerSecond = 90;
const kClickPixels = 6;
const kClickMs = 500;
const kDeadZone = 0.15;

const kWalk: Readonly<Record<string, readonly [number, number]>> = {
  KeyW: [1, 0],
  ArrowUp: [1, 0],
  KeyS: [-1, 0],
  ArrowDown: [-1, 0],
  KeyA: [0, -1],
  KeyD: [0, 1],
};
const kTurn: Readonly<Record<string, number>> = { KeyQ: 1, ArrowLeft: 1, KeyE: -1, ArrowRight: -1 };
const kTilt: Readonly<Record<string, number>> = { PageUp: 1, PageDown: -1 };

export interface ControlEvents {
  click(xPx: number, yPx: number): void;
  hover(xPx: number, yPx: number): void;
  zoom(factor: number): void;
}

export class Controls {
  stick: readonly [number, number] = [0, 0]; // forward, right: of the stick on the screen
  private readonly held = new Set<string>();
  private readonly pointers = new Map<number, { x: number; y: number }>();
  private press: { x: number; y: number; atMs: number } | null = null;
  private turnDeg = 0;
  private tiltDeg = 0;

  constructor(
    private readonly element: HTMLElement,
    private readonly events: ControlEvents,
  ) {
    element.addEventListener("keydown", event => this.key(event, true));
    element.addEventListener("keyup", event => this.key(event, false));
    element.addEventListener("blur", () => this.held.clear());
    element.addEventListener("pointerdown", event => this.down(event));
    element.addEventListener("pointermove", event => this.move(event));
    element.addEventListener("pointerup", event => this.up(event));
    element.addEventListener("pointercancel", event => this.forget(event));
    element.addEventListener("wheel", event => this.wheel(event), { passive: false });
  }

  // What is wished since the last time.
  wish(seconds: number): Wish {
    let [forward, right] = this.stick;
    let turn = 0;
    let tilt = 0;
    for (const code of this.held) {
      forward += kWalk[code]?.[0] ?? 0;
      right += kWalk[code]?.[1] ?? 0;
      turn += kTurn[code] ?? 0;
      tilt += kTilt[code] ?? 0;
    }
    for (const pad of gamepads()) {
      const axis = (i: number) => (Math.abs(pad.axes[i] ?? 0) > kDeadZone ? pad.axes[i]! : 0);
      right += axis(0);
      forward -= axis(1);
      turn -= axis(2);
      tilt -= axis(3);
    }
    const result: Wish = {
      forward: Math.max(-1, Math.min(1, forward)),
      right: Math.max(-1, Math.min(1, right)),
      turnDeg: this.turnDeg + turn * kTurnDegPerSecond * seconds,
      tiltDeg: this.tiltDeg + tilt * kTurnDegPerSecond * seconds,
      fast: this.held.has("ShiftLeft") || this.held.has("ShiftRight") || gamepads().some(p => p.buttons[0]?.pressed),
    };
    this.turnDeg = this.tiltDeg = 0;
    return result;
  }

  private key(event: KeyboardEvent, down: boolean): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { code } = event;
    const known = [kWalk, kTurn, kTilt].some(keys => keys[code] !== undefined);
    if (!known && !code.startsWith("Shift")) return;
    if (down) this.held.add(code);
    else this.held.delete(code);
    if (known) event.preventDefault();
  }

  private down(event: PointerEvent): void {
    this.element.focus({ preventScroll: true });
    this.element.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    this.press =
      this.pointers.size === 1 && event.button === 0
        ? { x: event.clientX, y: event.clientY, atMs: event.timeStamp }
        : null;
  }

  private move(event: PointerEvent): void {
    const before = this.pointers.get(event.pointerId);
    if (!before) {
      if (event.pointerType === "mouse") this.events.hover(event.offsetX, event.offsetY);
      return;
    }
    const apart = () => {
      const [a, b] = [...this.pointers.values()];
      return a && b ? Math.hypot(a.x - b.x, a.y - b.y) : 0;
    };
    const wide = apart();
    const [dx, dy] = [event.clientX - before.x, event.clientY - before.y];
    before.x = event.clientX;
    before.y = event.clientY;
    if (this.pointers.size > 1) {
      if (wide > 0 && apart() > 0) this.events.zoom(wide / apart());
      return;
    }
    this.turnDeg += dx * kDegPerPixel;
    this.tiltDeg += dy * kDegPerPixel;
    if (this.press && Math.hypot(event.clientX - this.press.x, event.clientY - this.press.y) > kClickPixels)
      this.press = null;
  }

  private up(event: PointerEvent): void {
    const { press } = this;
    this.forget(event);
    if (!press || event.timeStamp - press.atMs > kClickMs) return;
    this.events.click(event.offsetX, event.offsetY);
  }

  private forget(event: PointerEvent): void {
    this.pointers.delete(event.pointerId);
    this.press = null;
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    this.events.zoom(Math.exp(Math.sign(event.deltaY) * 0.06));
  }
}

const gamepads = (): Gamepad[] =>
  (navigator.getGamepads?.() ?? []).filter((pad): pad is Gamepad => pad !== null && pad.connected);
