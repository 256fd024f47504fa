// The eye of this window: its pose, moves from one place to another, and which pose each numbered camera message had.
import { between, cutHeightSeen, directionOf, verticalFovRad, type Pose, type Viewport } from "./camera.js";
import type { Notice } from "./protocol.js";
import { kRadPerDegree } from "./vector.js";

const kShortestIntervalMs = 12; // between camera messages, on screens that are faster than 60 Hz
const kMoveMs = 450;
const kRemembered = 240; // poses of sent messages

export class Eye {
  pose: Pose = { position: [0, 1.6, 0], yawRad: 0, pitchRad: 0, fovRad: 55 * kRadPerDegree };
  viewport: Viewport = { width: 960, height: 540 };
  private lastNumber = 0;
  private lastSentMs = 0;
  private dirty = false;
  private ticking = false;
  private sent = new Map<number, Pose>();
  private move: { from: Pose; to: Pose; beginMs: number } | null = null;

  constructor(
    private readonly send: (notice: Notice) => void,
    private readonly changed: () => void,
  ) {}

  set(pose: Pose): void {
    this.move = null;
    this.pose = pose;
    this.touch();
  }

  // Goes there within half a second, or at once for whoever prefers reduced motion.
  goTo(pose: Pose): void {
    if (window.matchMedia("(prefers-reduced-motion: reduce)").matches) {
      this.set(pose);
      return;
    }
    this.move = { from: this.pose, to: pose, beginMs: performance.now() };
    this.touch();
  }

  // Marks the camera as new: it is sent at once, or where one has just been sent with an animation frame after it, the
  // newest pose only.
  touch(): void {
    this.dirty = true;
    this.changed();
    if (this.ticking) return;
    if (!this.move) this.flushIfDue();
    this.ticking = this.dirty || this.move !== null;
    if (this.ticking) requestAnimationFrame(now => this.tick(now));
  }

  // What is asked about the picture next must be asked of the newest camera.
  flush(): void {
    if (!this.dirty) return;
    this.dirty = false;
    this.sendFor(this.viewport);
  }

  // The camera as a picture of another shape wants it: see verticalFovRad. Touch the eye afterwards.
  sendFor(viewport: Viewport): void {
    this.lastSentMs = performance.now();
    const { pose } = this;
    const cutHeight = cutHeightSeen(pose);
    this.sent.set(++this.lastNumber, pose);
    this.sent.delete(this.lastNumber - kRemembered);
    this.send({
      type: "camera",
      number: this.lastNumber,
      position: pose.position,
      direction: directionOf(pose.yawRad, pose.pitchRad),
      verticalFov: verticalFovRad(pose, viewport) / kRadPerDegree,
      ...(cutHeight === undefined ? {} : { cutHeight }),
    });
  }

  // Number of the camera message that was sent last.
  get newest(): number {
    return this.lastNumber;
  }

  // The pose that a frame shows.
  poseOf(number: number): Pose {
    return this.sent.get(number) ?? this.pose;
  }

  private flushIfDue(): void {
    if (performance.now() - this.lastSentMs >= kShortestIntervalMs) this.flush();
  }

  private tick(nowMs: number): void {
    if (this.move) {
      const t = Math.min(1, Math.max(0, (nowMs - this.move.beginMs) / kMoveMs));
      this.pose = between(this.move.from, this.move.to, t * t * (3 - 2 * t));
      this.dirty = true;
      this.changed();
      if (t >= 1) this.move = null;
    }
    this.flushIfDue();
    this.ticking = this.dirty || this.move !== null;
    if (this.ticking) requestAnimationFrame(now => this.tick(now));
  }
}
