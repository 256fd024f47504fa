// The light meter: reads where it is held, one request at a time, the newest place wins.
import type { FrameHeader } from "./frame.js";
import type { MeterHit } from "./protocol.js";

export interface Reading {
  readonly at: readonly [number, number]; // CSS pixels of the stage
  readonly hit: MeterHit | null; // null: only sky there
}

export class LightMeter {
  on = false;
  reading: Reading | null = null;
  private busy = false;
  private next: readonly [number, number] | null = null;
  private seen = { camera: 0, revision: 0 }; // of the last frame that it was read anew for

  constructor(
    // Resolves with what is measured there, undefined if that could not be found out.
    private readonly ask: (xPx: number, yPx: number) => Promise<MeterHit | null | undefined>,
    private readonly changed: () => void,
  ) {}

  turn(on: boolean): void {
    this.on = on;
    this.reading = null;
    this.next = null;
    this.changed();
  }

  hold(xPx: number, yPx: number): void {
    this.next = [xPx, yPx];
    if (!this.busy) void this.read();
  }

  // What it reads changes with the eye and with the home.
  shown({ camera, revision, quick }: FrameHeader): void {
    const { reading, seen } = this;
    if (!this.on || !reading || quick || (seen.camera === camera && seen.revision === revision)) return;
    this.seen = { camera, revision };
    this.hold(reading.at[0], reading.at[1]);
  }

  private async read(): Promise<void> {
    this.busy = true;
    while (this.on && this.next) {
      const at = this.next;
      this.next = null;
      const hit = await this.ask(at[0], at[1]);
      if (hit === undefined || !this.on) break;
      this.reading = { at, hit };
      this.changed();
    }
    this.busy = false;
  }
}
