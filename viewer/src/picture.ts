// Frames onto a canvas: decoded off the main thread, drawn with the next animation frame, the newest of each side only.
import type { FrameHeader, FrameSide } from "./frame.js";

interface Shown {
  readonly header: FrameHeader;
  readonly bitmap: ImageBitmap;
}

export class Picture {
  private shown = new Map<FrameSide, Shown>();
  private line = 0; // counts connections
  private decoded = 0; // the newest frame that was
  private acknowledged = 0; // and with it all before it
  private scheduled = false;
  private divider = 0.5;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly acknowledge: (frame: number) => void,
    private readonly drawn: (header: FrameHeader) => void,
    private readonly broken: (message: string) => void,
  ) {}

  async accept(header: FrameHeader, bytes: Uint8Array): Promise<void> {
    const { line } = this;
    try {
      const bitmap = await createImageBitmap(new Blob([bytes as Uint8Array<ArrayBuffer>], { type: "image/jpeg" }));
      if (line === this.line) this.keep(header, bitmap);
      else bitmap.close();
    } catch {
      this.broken(`Frame ${header.number} could not be decoded.`);
    }
    if (line !== this.line) return;
    this.decoded = Math.max(this.decoded, header.number);
    this.schedule();
  }

  // Where the divider between two sides stands, 0 to 1 of the width.
  setDivider(at: number): void {
    this.divider = at;
    this.schedule();
  }

  resize(widthPx: number, heightPx: number): void {
    if (this.canvas.width === widthPx && this.canvas.height === heightPx) return;
    this.canvas.width = widthPx;
    this.canvas.height = heightPx;
    this.draw();
  }

  // What the newest frame shows, of either side.
  get newest(): FrameHeader | null {
    let best: FrameHeader | null = null;
    for (const { header } of this.shown.values()) if (!best || header.number > best.number) best = header;
    return best;
  }

  private keep(header: FrameHeader, bitmap: ImageBitmap): void {
    const newest = this.newest;
    // Decoding may overtake: an older frame of this side, or of a split that is over, is not shown.
    const sameKind = newest && (newest.side === "whole") === (header.side === "whole");
    const before = sameKind ? this.shown.get(header.side)?.header : newest;
    if (before && before.number > header.number) {
      bitmap.close();
      return;
    }
    if (!sameKind) this.clear();
    this.shown.get(header.side)?.bitmap.close();
    this.shown.set(header.side, { header, bitmap });
  }

  // The server may count afresh with a new connection, and waits for none of the frames before it.
  forget(): void {
    const shown = [...this.shown.entries()];
    for (const [side, { header, bitmap }] of shown) this.shown.set(side, { header: { ...header, number: 0 }, bitmap });
    ++this.line;
    this.decoded = this.acknowledged = 0;
  }

  private clear(): void {
    for (const { bitmap } of this.shown.values()) bitmap.close();
    this.shown.clear();
  }

  private schedule(): void {
    if (this.scheduled) return;
    this.scheduled = true;
    requestAnimationFrame(() => {
      this.scheduled = false;
      this.draw();
      if (this.decoded > this.acknowledged) this.acknowledge((this.acknowledged = this.decoded));
    });
  }

  private draw(): void {
    const context = this.canvas.getContext("2d", { alpha: false });
    const newest = this.newest;
    if (!context || !newest) return;
    const { width, height } = this.canvas;
    context.imageSmoothingQuality = "high";
    const cut = Math.round(this.divider * width);
    for (const side of ["whole", "left", "right"] as const) {
      const shown = this.shown.get(side);
      if (!shown) continue;
      context.save();
      context.beginPath();
      context.rect(side === "right" ? cut : 0, 0, side === "left" ? cut : width, height);
      context.clip();
      context.drawImage(shown.bitmap, 0, 0, width, height);
      context.restore();
    }
    this.drawn(newest);
  }
}
