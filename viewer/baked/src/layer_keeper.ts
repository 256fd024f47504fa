// Which layers of light are on the chip: all of them where they fit, else those used last. What the others give is one
// sum, the rest. A layer whose factor changes is unpacked again; what it gave is taken out of the rest, whose halves
// keep the rounding of what was there before. So the rest is added up anew once nothing changes for a moment.
import type { Vec3 } from "../../src/vector.js";

// The sums on the chip. T: a layer, unpacked.
export interface Chip<T> {
  put(layer: number, unpacked: T): void;
  drop(layer: number): void;
  // What is shown: the rest and all layers that are here, or with `only` that layer on top of what was shown.
  show(factors: readonly Vec3[], only?: number): void;
  // Adds a layer that is here to the rest.
  addToRest(layer: number, factor: Vec3): void;
  // The same to another one, empty at first, that then takes its place.
  startNewRest(): void;
  addToNewRest(layer: number, factor: Vec3): void;
  useNewRest(): void;
}

export interface LayerSource<T> {
  bytes(layer: number): number; // on the chip
  unpack(layer: number): Promise<T>;
  calm(isLate: () => boolean): Promise<void>; // until nothing has changed for a moment, or it is too late
}

const kShowMs = 500; // between pictures while several layers are unpacked
const kNone: Vec3 = [0, 0, 0];
const isNone = (factor: Vec3): boolean => factor.every(c => c === 0);
const same = (a: Vec3, b: Vec3): boolean => a.every((c, i) => c === b[i]);
const negative = ([r, g, b]: Vec3): Vec3 => [-r, -g, -b];

export class LayerKeeper<T> {
  private readonly here = new Set<number>(); // those used last come last
  private readonly aside = new Map<number, Vec3>(); // what they are multiplied by in the rest
  private readonly failing = new Set<number>(); // of those aside, until the next turn of a dial
  private factors: readonly Vec3[] = [];
  private asideChanges = 0;
  private rough = false; // light was taken out of the rest
  private working = false;
  private shownMs = -Infinity;

  constructor(
    private readonly chip: Chip<T>,
    private readonly source: LayerSource<T>,
    private readonly mostBytes: number,
    private readonly changed: () => void, // what is shown, since update() returned
    private readonly failed: (error: unknown) => void,
  ) {}

  // Whether what is shown still changes.
  get busy(): boolean {
    return this.working;
  }

  // A layer is there for the first time. True if it changes what is shown.
  come(layer: number, unpacked: T): boolean {
    this.chip.put(layer, unpacked);
    const shines = !isNone(this.factorOf(layer));
    if (shines) this.chip.show(this.factors, layer);
    if (this.bytesHere() + this.source.bytes(layer) > this.mostBytes) this.setAside(layer);
    else this.here.add(layer);
    return shines;
  }

  // Shows the layers times these factors. Those aside follow as they are unpacked.
  update(factors: readonly Vec3[]): void {
    for (const layer of [...this.here]) {
      if (same(factors[layer] ?? kNone, this.factorOf(layer))) continue;
      this.here.delete(layer);
      this.here.add(layer);
    }
    this.factors = factors;
    this.failing.clear();
    this.show();
    if (!this.working && (this.rough || this.outdated() !== undefined)) void this.work();
  }

  private show(): void {
    this.chip.show(this.factors);
    this.shownMs = performance.now();
  }

  private factorOf(layer: number): Vec3 {
    return this.factors[layer] ?? kNone;
  }
  private bytesHere(): number {
    return [...this.here].reduce((sum, layer) => sum + this.source.bytes(layer), 0);
  }
  // One that is in the rest times another factor than it should be.
  private outdated(): number | undefined {
    const isOutdated = ([layer, factor]: readonly [number, Vec3]) =>
      !same(factor, this.factorOf(layer)) && !this.failing.has(layer);
    return [...this.aside].find(isOutdated)?.[0];
  }

  private async work(): Promise<void> {
    this.working = true;
    try {
      for (;;) {
        const layer = this.outdated();
        if (layer !== undefined) await this.fetch(layer);
        else if (this.rough) await this.renew();
        else break;
      }
    } catch (error) {
      this.failed(error);
    }
    this.working = false;
    this.changed();
  }

  // Shown with the others that are outdated, as one of two hours alone would be a flash or a gap.
  private async fetch(layer: number): Promise<void> {
    try {
      const unpacked = await this.source.unpack(layer);
      this.take(layer, unpacked);
    } catch (error) {
      this.failing.add(layer);
      this.failed(error);
    }
    if (this.outdated() !== undefined && performance.now() - this.shownMs < kShowMs) return;
    this.show();
    this.changed();
  }

  // Out of the rest, and onto the chip.
  private take(layer: number, unpacked: T): void {
    this.chip.put(layer, unpacked);
    const given = this.aside.get(layer)!;
    this.aside.delete(layer);
    ++this.asideChanges;
    if (!isNone(given)) {
      this.chip.addToRest(layer, negative(given));
      this.rough = true;
    }
    this.here.add(layer);
    for (const other of [...this.here]) if (other !== layer && this.bytesHere() > this.mostBytes) this.setAside(other);
  }

  private setAside(layer: number): void {
    const factor = this.factorOf(layer);
    if (!isNone(factor)) this.chip.addToRest(layer, factor);
    this.aside.set(layer, factor);
    ++this.asideChanges;
    this.here.delete(layer);
    this.chip.drop(layer);
  }

  // Adds the rest up again. Left for another time where something changes meanwhile.
  private async renew(): Promise<void> {
    const changes = this.asideChanges;
    const isLate = () => this.asideChanges !== changes || this.outdated() !== undefined;
    this.chip.startNewRest();
    for (const [layer, factor] of [...this.aside]) {
      if (isNone(factor)) continue;
      await this.source.calm(isLate);
      if (isLate()) return;
      const unpacked = await this.source.unpack(layer);
      if (isLate()) return;
      this.chip.put(layer, unpacked);
      this.chip.addToNewRest(layer, factor);
      this.chip.drop(layer);
    }
    this.chip.useNewRest();
    this.rough = false;
    this.show();
  }
}
