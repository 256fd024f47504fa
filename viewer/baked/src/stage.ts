// The picture: owns what is on the GPU, and draws a frame when something has changed.
import * as THREE from "three";
import { kRadPerDegree, type Vec3 } from "../../src/vector.js";
import { adapted, lookedAtEv100 } from "./adaptation.js";
import type { Bvh, Hit } from "./bvh.js";
import { Display } from "./display.js";
import type { Gltf, Home } from "./document.js";
import { scaleOf, type Scale } from "./false_colour.js";
import type { Geometry } from "./geometry.js";
import { layerFactors, sameFactors, type LightState } from "./light_state.js";
import { LayerKeeper, type LayerSource } from "./layer_keeper.js";
import { bytesOfLayer, LightChip, type UnpackedLight } from "./light_chip.js";
import type { Eye } from "./link.js";
import { kProbeDefines, Probe } from "./probe.js";
import { middleOf, roomInView } from "./rooms.js";
import { Sky } from "./sky.js";
import { SpotMeter } from "./spot_meter.js";
import { Sunlight } from "./sunlight.js";
import { differ, followed, gainsFor } from "./white_balance.js";
import { Surfaces, type TextureSource, type Uniforms } from "./surfaces.js";
import { kFinishGlsl } from "./surface_shader.js";

const kProbePx = 128;
const kMeterMs = 200;
const kNearM = 0.05;
const kFarM = 1000;
const kPanoramaWidth = 512;
const kProbeHeightM = 1.5;
const kStrayM = 3;
const kMostBiasEv = 2;
const kPictures = 8; // that are averaged where nothing moves
const kCalmMs = 400; // after the last turn of a dial, or step
const kRestMs = 150; // after the last change, so that dials answer at once

// Layers of light as they are packed, and how many bytes of them may be on the chip at once.
export interface StageLight {
  readonly mostBytes: number;
  unpack(layer: number): Promise<UnpackedLight>;
  failed(error: unknown): void;
}

export class Stage {
  readonly scene = new THREE.Scene();
  readonly camera = new THREE.PerspectiveCamera(60, 1, kNearM, kFarM);
  readonly sunlight: Sunlight;
  readonly sky: Sky;
  readonly display: Display;
  readonly spot: SpotMeter;
  readonly surfaces: Surfaces;
  readonly probe: Probe;
  world: Bvh | null = null;
  automatic = true; // exposure
  complete = false; // all layers are there
  asBaked = true; // what is seen first is what the home's exposure was made for
  frames = 0;
  scale: Scale | null = null; // of false colours
  private readonly home: Home;
  private readonly layers: LayerKeeper<UnpackedLight>;
  private touchedMs = -Infinity; // when light or eye were last set
  private room: number | null | undefined = undefined;
  private factors: Vec3[] | null = null;
  private wantedEv100: number | null = null;
  private wantedGains: Vec3 | null = null; // of the white balance
  private biasEv: number | null = null; // of the home's exposure over the automatic one at its first camera
  private due = true;
  private pictures = 0; // of the average
  private drawnMs = -Infinity;
  private fence: WebGLSync | null = null; // until the chip has drawn the last of them
  private scaleDue = false;
  private metering = false;
  private meteredMs = -Infinity;
  private meterDue = true;

  constructor(
    readonly renderer: THREE.WebGLRenderer,
    document: Gltf,
    geometry: Geometry,
    textures: TextureSource,
    packed: THREE.DataArrayTexture | null,
    light: StageLight,
    private readonly changed: () => void,
  ) {
    this.home = document.extensions.ROOMLIGHT_light_layers;
    renderer.autoClear = false;
    renderer.info.autoReset = false;
    const chip = new LightChip(renderer, this.home);
    const source: LayerSource<UnpackedLight> = {
      bytes: layer => bytesOfLayer(this.home, layer),
      unpack: light.unpack,
      calm: isLate => this.calm(isLate),
    };
    this.layers = new LayerKeeper(chip, source, light.mostBytes, () => this.showLight(), light.failed);
    this.sunlight = new Sunlight(this.home);
    this.display = new Display(renderer, this.home, 4);
    this.probe = new Probe(renderer, this.scene, this.display.uniforms, kProbePx);
    const uniforms: Uniforms = {
      ...this.display.uniforms,
      ...this.probe.uniforms,
      ...this.sunlight.uniforms,
      uLight: { value: chip.light.target.texture },
      ...(chip.lean ? { uLean: { value: chip.lean.target.texture } } : {}),
      ...(packed ? { uPacked: { value: packed } } : {}),
    };
    this.surfaces = new Surfaces(document, geometry, uniforms, textures, {
      ...kProbeDefines(kProbePx),
      ...this.sunlight.defines,
      ...(chip.lean ? { LEAN: "" } : {}),
    });
    this.scene.add(this.surfaces.group);
    this.sky = new Sky(renderer, kPanoramaWidth, kPanoramaWidth / 2, kFinishGlsl, this.display.uniforms);
    this.scene.add(this.sky.mesh);
    this.scene.matrixWorldAutoUpdate = false;
    this.spot = new SpotMeter(renderer, chip.light, this.sunlight, geometry);
  }

  touch(): void {
    this.due = true;
  }

  // A layer has come: its light is added to what is there. Seen with the next frame that is due.
  include(layer: number, unpacked: UnpackedLight): void {
    if (!this.layers.come(layer, unpacked)) return;
    this.sky.update(this.factors ?? [], layer);
    this.probe.touch();
    this.scaleDue = this.meterDue = true;
  }

  setLight(state: LightState): void {
    const factors = layerFactors(this.home, state);
    if (sameFactors(this.factors, factors)) return;
    this.factors = factors;
    this.touchedMs = performance.now();
    this.layers.update(factors);
    this.sunlight.update(factors);
    this.sky.update(factors);
    this.surfaces.setFactors(factors);
    this.showLight();
  }

  private showLight(): void {
    this.probe.touch();
    this.due = this.scaleDue = this.meterDue = true;
  }

  // Until all light is there, and nobody turns a dial, walks or wears a headset.
  private async calm(isLate: () => boolean): Promise<void> {
    const busy = () => !this.complete || this.renderer.xr.isPresenting || performance.now() - this.touchedMs < kCalmMs;
    while (busy() && !isLate()) await new Promise(done => setTimeout(done, kCalmMs / 8));
  }

  setEye({ position, yawDeg, pitchDeg, fovDeg }: Eye): void {
    this.camera.position.set(...position);
    this.camera.rotation.set(pitchDeg * kRadPerDegree, yawDeg * kRadPerDegree, 0, "YXZ");
    // `fovDeg` is for pictures that are wider than high; on a phone held upright rooms would be seen through a slit.
    const { aspect } = this.camera;
    const tall = Math.tan((fovDeg / 2) * kRadPerDegree) * (aspect < 1 ? Math.min(1 / aspect, 1.6) : 1);
    this.camera.fov = (2 * Math.atan(tall)) / kRadPerDegree;
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld(true);
    this.findRoom();
    this.touchedMs = performance.now();
    this.due = this.meterDue = true;
  }

  // What the eye can walk into, once it is known.
  useWorld(world: Bvh): void {
    this.world = world;
    this.findRoom();
  }

  private findRoom(): void {
    const { x, y, z } = this.camera.position;
    const ahead = this.camera.getWorldDirection(new THREE.Vector3());
    const room = roomInView(this.home.rooms, this.world, [x, y, z], [ahead.x, ahead.y, ahead.z]);
    // Outside of rooms what is reflected is seen from where the eye is.
    const strayed = room === null && this.probe.distanceTo(this.camera.position) > kStrayM;
    if (room !== this.room || strayed) this.enter(room);
  }

  private enter(room: number | null): void {
    if (room !== this.room) this.scaleDue = true;
    this.room = room;
    const found = room === null ? null : this.home.rooms[room]!;
    const { x, y, z } = this.camera.position;
    const middle = found ? middleOf(found) : [x, z];
    const at: Vec3 = found ? [middle[0]!, found.elevationM + kProbeHeightM, middle[1]!] : [x, y, z];
    let cramped = false;
    this.world?.forEachNear(at, 0.15, () => (cramped = true));
    this.probe.move(cramped ? [x, y, z] : at);
  }

  setFalseColours(on: boolean): void {
    this.scale = on ? (this.scale ?? { low: 1, high: 1000 }) : null;
    this.display.luxScale = this.scale;
    this.scaleDue = on;
    for (const pane of this.surfaces.panes) pane.visible = !on;
    this.due = this.meterDue = true;
  }

  setEv100(ev100: number): void {
    this.display.ev100 = ev100;
    this.due = true;
  }

  resize(widthPx: number, heightPx: number, pixelShare: number): void {
    this.renderer.setPixelRatio(pixelShare);
    this.renderer.setSize(widthPx, heightPx, false);
    const size = this.renderer.getDrawingBufferSize(new THREE.Vector2());
    this.display.resize(Math.max(1, size.x), Math.max(1, size.y));
    this.camera.aspect = widthPx / Math.max(1, heightPx);
    this.due = true;
  }

  // Does a piece of what reflections need after a change.
  reflect(): void {
    if (this.scale !== null || !this.probe.busy || !this.factors) return;
    this.probe.work();
    if (!this.probe.busy) this.due = true;
  }

  // Draws if there is something new to see. `seconds` since the last call; true if it drew.
  frame(nowMs: number, seconds: number): boolean {
    this.reflect();
    this.adapt(seconds);
    const drawn = this.due;
    if (drawn) {
      this.draw();
      this.drawnMs = nowMs;
    } else if (this.refining && nowMs - this.drawnMs > kRestMs && this.chipIsReady()) this.refine();
    if (this.meterDue && !this.metering && nowMs - this.meteredMs > kMeterMs) void this.measure(nowMs);
    return drawn;
  }

  draw(): void {
    this.due = false;
    this.pictures = 0;
    this.renderer.info.reset();
    this.surfaces.orderPanes(this.camera.position);
    this.display.draw(this.scene, this.camera);
    ++this.frames;
  }

  // Where nothing else changes, pictures are averaged.
  private get refining(): boolean {
    const more = this.pictures < kPictures || this.fence !== null;
    const metered = !this.meterDue && !this.metering; // of the picture that stands alone
    return more && metered && this.complete && this.scale === null && !this.probe.busy && !this.adapting;
  }

  // Pictures do not queue up: one that moves would have to wait for all of them.
  private chipIsReady(): boolean {
    if (this.fence === null) return true;
    const gl = this.renderer.getContext() as WebGL2RenderingContext;
    if (gl.clientWaitSync(this.fence, 0, 0) === gl.TIMEOUT_EXPIRED) return false;
    gl.deleteSync(this.fence);
    this.fence = null;
    return true;
  }

  private refine(): void {
    if (this.pictures === kPictures) return;
    this.renderer.info.reset();
    this.display.refine(this.scene, this.camera, this.pictures);
    if (++this.pictures === kPictures) this.display.presentAverage();
    const gl = this.renderer.getContext() as WebGL2RenderingContext;
    this.fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
  }

  // True while a picture, reflections or the exposure still change.
  get restless(): boolean {
    return (
      this.due ||
      this.layers.busy ||
      this.refining ||
      this.meterDue ||
      this.metering ||
      (this.probe.busy && this.scale === null) ||
      this.adapting
    );
  }

  private get exposing(): boolean {
    return this.automatic && this.wantedEv100 !== null && Math.abs(this.wantedEv100 - this.display.ev100) > 1e-6;
  }
  private get balancing(): boolean {
    return this.wantedGains !== null && this.wantedGains !== this.display.whiteGains;
  }
  private get adapting(): boolean {
    return this.scale === null && (this.exposing || this.balancing);
  }

  private adapt(seconds: number): void {
    if (!this.adapting) return;
    const step = Math.min(seconds, 0.1);
    if (this.exposing) this.setEv100(adapted(this.display.ev100, this.wantedEv100!, step));
    if (this.balancing) this.display.whiteGains = followed(this.display.whiteGains, this.wantedGains!, seconds);
    this.due = true;
    if (!this.adapting) this.meterDue = true; // what was too bright to be told is seen now
  }

  private async measure(nowMs: number): Promise<void> {
    this.metering = true;
    this.meterDue = false;
    this.meteredMs = nowMs;
    const { scale, scaleDue } = this;
    const finished = this.complete && !this.probe.busy && !this.due; // the picture read
    const { amounts, width } = await this.display.meter();
    if (scale === null && this.complete) await this.balance();
    this.metering = false;
    if ((scale === null) !== (this.scale === null)) this.meterDue = this.due = true;
    else if (scale === null) this.aim(lookedAtEv100(amounts, width), finished);
    else if (scaleDue) {
      this.scaleDue = false;
      this.scale = this.display.luxScale = scaleOf(amounts);
      this.due = true;
      this.changed();
    }
  }

  private async balance(): Promise<void> {
    const { whites } = this.home.display;
    if (whites.length === 0) return;
    const gains = gainsFor(whites, await this.display.lightColour(this.scene, this.camera));
    if (!gains || !differ(gains, this.wantedGains ?? this.display.whiteGains)) return;
    if (this.wantedGains === null) {
      this.display.whiteGains = gains; // nobody has seen anything yet that it would jump from
      this.due = true;
    }
    this.wantedGains = gains;
  }

  private aim(automatic: number | null, finished: boolean): void {
    if (automatic === null) return;
    if (this.biasEv === null) {
      if (!finished) {
        this.meterDue = true;
        return;
      }
      const bias = this.home.display.ev100 - automatic;
      this.biasEv = this.asBaked ? Math.max(-kMostBiasEv, Math.min(kMostBiasEv, bias)) : 0;
    }
    this.wantedEv100 = automatic + this.biasEv;
  }

  // What is seen at a place of the canvas, in CSS pixels.
  hitAt(xPx: number, yPx: number): { hit: Hit; at: Vec3; direction: Vec3 } | null {
    const { clientWidth, clientHeight } = this.renderer.domElement;
    const far = new THREE.Vector3((2 * xPx) / clientWidth - 1, 1 - (2 * yPx) / clientHeight, 0.5);
    const d = far.unproject(this.camera).sub(this.camera.position).normalize();
    const { x, y, z } = this.camera.position;
    const direction: Vec3 = [d.x, d.y, d.z];
    const hit = this.world?.raycast([x, y, z], direction);
    if (!hit) return null;
    const s = hit.distance;
    return { hit, at: [x + d.x * s, y + d.y * s, z + d.z * s], direction };
  }

  screenshot(): Promise<Blob | null> {
    if (this.pictures === kPictures && !this.due) this.display.presentAverage();
    else this.display.draw(this.scene, this.camera);
    return new Promise(resolve => this.renderer.domElement.toBlob(resolve, "image/png"));
  }
}
