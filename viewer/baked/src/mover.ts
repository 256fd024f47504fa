// The eye: walks, looks around, glides to a place, and stands where a camera was.
import { clamp, kRadPerDegree, type Vec3 } from "../../src/vector.js";
import type { Bvh } from "./bvh.js";
import type { Camera } from "./document.js";
import type { Eye } from "./link.js";
import { floorBelow, kEyeHeightM, walked, type Body } from "./walk.js";

export interface Wish {
  readonly forward: number; // -1 to 1
  readonly right: number;
  readonly turnDeg: number; // counter-clockwise, since the last time
  readonly tiltDeg: number; // up
  readonly fast: boolean;
}

const kMetresPerSecond = 1.5;
const kFastMetresPerSecond = 3.6;
const kGlideSeconds = 0.7;
const kMostPitchDeg = 88;
const kFloorSearchM = 6;
const kSettleSeconds = 0.12; // of the eye's height over steps

export const eyeOfCamera = ({ position, forward, yFovDeg }: Camera): Eye => ({
  position,
  yawDeg: Math.atan2(-forward[0], -forward[2]) / kRadPerDegree,
  pitchDeg: clamp(Math.atan2(forward[1], Math.hypot(forward[0], forward[2])) / kRadPerDegree, -88, 88),
  fovDeg: yFovDeg,
});

export class Mover {
  world: Bvh | null = null;
  throughWalls = false;
  private body: Body = { feet: [0, 0, 0], gapM: 0 };
  private heightM = kEyeHeightM; // of the eye over the feet
  private grounded = false; // a floor was found: else there is nothing to walk on, and it floats
  private stood = false; // somewhere else since the last update
  private glide: { from: Eye; to: Eye; seconds: number } | null = null;
  private now: Eye = { position: [0, kEyeHeightM, 0], yawDeg: 0, pitchDeg: 0, fovDeg: 60 };

  constructor(private readonly calm: () => boolean) {} // whoever prefers reduced motion

  get eye(): Eye {
    return this.now;
  }

  get moving(): boolean {
    return this.glide !== null || this.stood;
  }

  stand(eye: Eye): void {
    this.glide = null;
    this.stood = true;
    this.now = { ...eye, pitchDeg: clamp(eye.pitchDeg, -kMostPitchDeg, kMostPitchDeg) };
    this.findFeet();
  }

  go(to: Eye): void {
    if (this.calm()) this.stand(to);
    else {
      // The short way round.
      const turn = ((((to.yawDeg - this.now.yawDeg) % 360) + 540) % 360) - 180;
      this.glide = { from: this.now, to: { ...to, yawDeg: this.now.yawDeg + turn }, seconds: 0 };
    }
  }

  // To a place on a floor, looking as now.
  goTo([x, y, z]: Vec3): void {
    this.go({ ...this.now, position: [x, y + kEyeHeightM, z] });
  }

  zoom(factor: number): void {
    this.now = { ...this.now, fovDeg: clamp(this.now.fovDeg * factor, 25, 100) };
  }

  useWorld(world: Bvh): void {
    this.world = world;
    this.findFeet();
  }

  private findFeet(): void {
    const [x, y, z] = this.now.position;
    const floor = this.world ? floorBelow(this.world, x, y, z, 0, kFloorSearchM) : null;
    this.grounded = floor !== null;
    const feetY = floor ?? y - kEyeHeightM;
    this.body = { feet: [x, feetY, z], gapM: 0 };
    this.heightM = y - feetY;
  }

  // True if the eye has moved.
  update(seconds: number, wish: Wish): boolean {
    const before = this.now;
    const stood = this.stood;
    this.stood = false;
    if (this.glide && (wish.forward !== 0 || wish.right !== 0 || wish.turnDeg !== 0)) this.glide = null;
    if (this.glide) this.followGlide(seconds);
    else this.follow(seconds, wish);
    return stood || before !== this.now;
  }

  private followGlide(seconds: number): void {
    const glide = this.glide!;
    glide.seconds += seconds;
    const t = Math.min(1, glide.seconds / kGlideSeconds);
    const s = t * t * (3 - 2 * t);
    const mix = (a: number, b: number) => a + (b - a) * s;
    const { from, to } = glide;
    this.now = {
      position: [0, 1, 2].map(i => mix(from.position[i]!, to.position[i]!)) as unknown as Vec3,
      yawDeg: mix(from.yawDeg, to.yawDeg),
      pitchDeg: mix(from.pitchDeg, to.pitchDeg),
      fovDeg: mix(from.fovDeg, to.fovDeg),
    };
    if (t >= 1) this.stand(to);
  }

  private follow(seconds: number, wish: Wish): void {
    const { turnDeg, tiltDeg } = wish;
    if (turnDeg !== 0 || tiltDeg !== 0) {
      const pitchDeg = clamp(this.now.pitchDeg + tiltDeg, -kMostPitchDeg, kMostPitchDeg);
      this.now = { ...this.now, yawDeg: this.now.yawDeg + turnDeg, pitchDeg };
    }
    const size = Math.hypot(wish.forward, wish.right);
    if (size > 0) {
      const yaw = this.now.yawDeg * kRadPerDegree;
      const reach = ((wish.fast ? kFastMetresPerSecond : kMetresPerSecond) * seconds) / Math.max(1, size);
      const dx = (-Math.sin(yaw) * wish.forward + Math.cos(yaw) * wish.right) * reach;
      const dz = (-Math.cos(yaw) * wish.forward - Math.sin(yaw) * wish.right) * reach;
      this.step(dx, dz);
    }
    this.settle(seconds, size > 0);
  }

  private step(dx: number, dz: number): void {
    const [x, y, z] = this.body.feet;
    if (this.world && this.grounded && !this.throughWalls) this.body = walked(this.world, this.body, dx, dz);
    else {
      const floor = this.world ? floorBelow(this.world, x + dx, y, z + dz, 0.5, 0.6) : null;
      this.grounded ||= floor !== null;
      this.body = { feet: [x + dx, floor ?? y, z + dz], gapM: 0 };
    }
  }

  // The eye follows the feet; once they walk, at the height of an eye.
  private settle(seconds: number, walking: boolean): void {
    const share = 1 - Math.exp(-seconds / kSettleSeconds);
    if (walking) this.heightM += (kEyeHeightM - this.heightM) * share;
    const [x, feetY, z] = this.body.feet;
    const wanted = feetY + this.heightM;
    const gap = wanted - this.now.position[1];
    const y = Math.abs(gap) < 1e-3 ? wanted : this.now.position[1] + gap * share;
    const [oldX, oldY, oldZ] = this.now.position;
    if (x !== oldX || y !== oldY || z !== oldZ) this.now = { ...this.now, position: [x, y, z] };
  }
}
