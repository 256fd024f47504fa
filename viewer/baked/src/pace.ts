// How many pixels are drawn: fewer where frames take too long, unless that does not help (a display of 30 Hz, or a
// processor that is the bottleneck), and more again where there is time left.
const kSlowMs = 24;
const kFastMs = 13;
const kWindow = 20; // frames that are judged together
const kLeastShare = 0.5;
const kHelps = 0.93; // of the time before

export class Pace {
  share = 1; // of the pixels along one side
  private count = 0;
  private sumMs = 0;
  private tried: { share: number; meanMs: number } | null = null;
  private settled = false;

  // A frame that took so long after the one before; true if the share has changed.
  took(frameMs: number): boolean {
    if (this.settled) return false;
    this.sumMs += frameMs;
    if (++this.count < kWindow) return false;
    const meanMs = this.sumMs / this.count;
    this.count = this.sumMs = 0;
    const before = this.share;
    if (this.tried && meanMs > kHelps * this.tried.meanMs) {
      this.share = this.tried.share;
      this.settled = true;
    } else if (meanMs > kSlowMs && this.share > kLeastShare) {
      this.tried = { share: this.share, meanMs };
      this.share = Math.max(kLeastShare, this.share * 0.8);
    } else {
      this.tried = null;
      if (meanMs < kFastMs) this.share = Math.min(1, this.share * 1.1);
    }
    return this.share !== before;
  }
}
