// Reflections: a cube around the middle of the room that the eye is in, drawn from the lit scene and filtered for all
// roughnesses. One face a frame, then the filter; what was there stays until the new one is done.
import * as THREE from "three";
import type { Vec3 } from "../../src/vector.js";
import type { Uniforms } from "./surfaces.js";

const kFaces = 6;
export const kProbeDefines = (sizePx: number): Record<string, string> => {
  const level = Math.log2(sizePx);
  return {
    PROBE: "",
    CUBEUV_TEXEL_WIDTH: (1 / (3 * Math.max(sizePx, 7 * 16))).toFixed(12),
    CUBEUV_TEXEL_HEIGHT: (1 / (4 * sizePx)).toFixed(12),
    CUBEUV_MAX_MIP: level.toFixed(1),
  };
};

export class Probe {
  readonly uniforms: Uniforms = {
    uProbe: { value: null },
    uReflect: { value: false },
    uProbeAt: { value: new THREE.Vector3() },
    uAround: { value: null },
  };
  private cube: THREE.WebGLCubeRenderTarget; // what is drawn
  private seen: THREE.WebGLCubeRenderTarget; // what is shown
  private readonly eyes: THREE.CubeCamera;
  private readonly filter: THREE.PMREMGenerator;
  private shown: THREE.WebGLRenderTarget | null = null;
  private spare: THREE.WebGLRenderTarget | null = null;
  private step = -1; // faces that are drawn; -1: nothing to do
  private stale = false;
  private place: Vec3 | null = null;
  private next: Vec3 | null = null;

  constructor(
    private readonly renderer: THREE.WebGLRenderer,
    private readonly scene: THREE.Scene,
    private readonly display: Uniforms,
    sizePx: number,
  ) {
    const cube = () =>
      new THREE.WebGLCubeRenderTarget(sizePx, {
        type: THREE.HalfFloatType,
        // A mean of two distances is where nothing is.
        minFilter: THREE.NearestFilter,
        magFilter: THREE.NearestFilter,
      });
    this.cube = cube();
    this.seen = cube();
    this.eyes = new THREE.CubeCamera(0.05, 500, this.cube);
    this.eyes.coordinateSystem = THREE.WebGLCoordinateSystem;
    this.eyes.updateCoordinateSystem();
    this.filter = new THREE.PMREMGenerator(renderer);
  }

  get busy(): boolean {
    return this.step >= 0 || this.stale;
  }

  // Where it stands from now on.
  move(at: Vec3): void {
    this.next = at;
    this.stale = true;
    this.step = -1;
  }

  // From where it stands, or will; infinite before it stands anywhere.
  distanceTo(place: THREE.Vector3): number {
    return this.next ? place.distanceTo(new THREE.Vector3(...this.next)) : Infinity;
  }

  // The light has changed.
  touch(): void {
    this.stale = this.next !== null;
  }

  // Does one piece of the work.
  work(): void {
    if (this.step < 0) {
      if (!this.stale || !this.next) return;
      this.stale = false;
      this.step = 0;
      this.place = this.next;
      this.eyes.position.set(...this.place);
      this.eyes.updateMatrixWorld(true);
    }
    const xr = this.renderer.xr.enabled;
    this.renderer.xr.enabled = false;
    if (this.step < kFaces) this.drawFace(this.step++);
    else this.finish();
    this.renderer.setRenderTarget(null);
    this.renderer.xr.enabled = xr;
  }

  private drawFace(face: number): void {
    const { uLux, uEncode } = this.display;
    const [lux, encode] = [uLux!.value as boolean, uEncode!.value as boolean];
    this.uniforms.uReflect!.value = uLux!.value = uEncode!.value = false;
    this.renderer.setRenderTarget(this.cube, face);
    this.renderer.setClearColor(0x000000, 0);
    this.renderer.clear();
    this.renderer.render(this.scene, this.eyes.children[face] as THREE.PerspectiveCamera);
    this.uniforms.uReflect!.value = this.shown !== null;
    uLux!.value = lux;
    uEncode!.value = encode;
  }

  private finish(): void {
    const done = this.filter.fromCubemap(this.cube.texture, this.spare);
    this.spare = this.shown;
    this.shown = done;
    this.step = -1;
    [this.cube, this.seen] = [this.seen, this.cube];
    this.uniforms.uAround!.value = this.seen.texture;
    this.uniforms.uProbe!.value = done.texture;
    this.uniforms.uReflect!.value = true;
    (this.uniforms.uProbeAt!.value as THREE.Vector3).set(...this.place!);
  }
}
