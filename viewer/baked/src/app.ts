// The page with a home in it: what is set, and what follows from that.
import { html, render } from "lit";
import { Bvh } from "./bvh.js";
import { Controls } from "./controls.js";
import type { Camera, Home, Layer, Room } from "./document.js";
import { drawPlan, placeOnPlan } from "./floor_plan.js";
import { Headset, headsetSupported } from "./headset.js";
import { stateOfFile, withDial, type Dial, type LightState } from "./light_state.js";
import { linkOf, readLink } from "./link.js";
import { bytesForLayers } from "./light_chip.js";
import { LightReader, loadLight, packedTextures, textureBytes, textureSource, type LoadedHome } from "./load.js";
import { eyeOfCamera, Mover } from "./mover.js";
import { overlay } from "./overlay.js";
import { Pace } from "./pace.js";
import { panel } from "./panel.js";
import { boxAround, insideOutline, middleOf, roomAt } from "./rooms.js";
import * as scenes from "./scenes.js";
import { Stage } from "./stage.js";
import { speaker, type Language, type Say } from "./strings.js";
import { freePlace, hasHeadroom, kEyeHeightM } from "./walk.js";
import type { Vec3 } from "../../src/vector.js";
import type { WebGLRenderer } from "three";

const kMessageMs = 6000;
const kMostPixelShare = 2;
const kLinkMs = 400;
const kLoadingMs = 500; // between pictures while light comes
const kNarrowPx = 700; // as in page.css
const kPanelPx = 320;
const kFloorSlope = 0.6;

export class App {
  readonly home: Home;
  readonly fileLight: LightState;
  readonly stage: Stage;
  readonly mover = new Mover(() => matchMedia("(prefers-reduced-motion: reduce)").matches);
  readonly controls: Controls;
  say: Say;
  light: LightState;
  scenes: scenes.Scene[];
  falseColours = false;
  metering = false;
  reading: { at: readonly [number, number]; lux: number } | null = null;
  message = "";
  loadedShare = 0;
  canEnterVr = false;
  panelOpen = innerWidth > kNarrowPx;
  private loaded: LoadedHome | null; // until its light is on the GPU
  private readonly reader: LightReader;
  private readonly canvas: HTMLCanvasElement;
  private readonly key: string;
  private readonly pace = new Pace();
  private drewLast = false;
  private lastMs = 0;
  private renderDue = false;
  private messageTimer = 0;
  private linkTimer = 0;
  private readBusy = false;
  private readNext: readonly [number, number] | null = null;
  private inVr = false;
  private frameAsked = 0;

  constructor(
    renderer: WebGLRenderer,
    loaded: LoadedHome,
    private readonly root: HTMLElement,
    public language: Language,
  ) {
    this.say = speaker(language);
    this.loaded = loaded;
    this.home = loaded.document.extensions.ROOMLIGHT_light_layers;
    this.fileLight = stateOfFile(this.home);
    this.key = scenes.keyOf(this.home);
    this.scenes = scenes.storedScenes(() => localStorage, this.key);
    this.canvas = renderer.domElement;
    const anisotropy = Math.min(8, renderer.capabilities.getMaxAnisotropy());
    const textures = textureSource(loaded, anisotropy);
    const packed = packedTextures(loaded, anisotropy);
    const deviceGib = (navigator as { deviceMemory?: number }).deviceMemory;
    const mostBytes = bytesForLayers(this.home, textureBytes(loaded), deviceGib);
    this.reader = new LightReader(loaded, mostBytes < Infinity);
    const light = {
      mostBytes,
      unpack: (layer: number) => this.reader.unpack(layer),
      failed: (error: unknown) => {
        console.error(error);
        this.tell(this.say("failed"));
      },
    };
    this.stage = new Stage(renderer, loaded.document, loaded.geometry, textures, packed, light, () => this.refresh());
    const linked = readLink(location.hash, this.fileLight);
    this.light = linked.light;
    const camera = this.home.cameras[this.home.camera] ?? this.home.cameras[0];
    this.stage.asBaked = location.hash.length < 2 && camera !== undefined;
    if (linked.ev100 !== null) {
      this.stage.automatic = false;
      this.stage.setEv100(linked.ev100);
    }
    this.controls = new Controls(this.canvas, {
      click: (x, y) => this.click(x, y),
      hover: (x, y) => this.hover(x, y),
      zoom: factor => this.setFov(this.mover.eye.fovDeg * factor),
    });
    this.mover.stand(linked.eye ?? (camera ? eyeOfCamera(camera) : this.firstEye(loaded)));
    addEventListener("resize", () => this.resize());
    addEventListener("hashchange", () => this.followLink());
    addEventListener("keydown", event => this.shortcut(event));
    this.resize();
  }

  get automatic(): boolean {
    return this.stage.automatic;
  }
  get ev100(): number {
    return this.stage.display.ev100;
  }

  async start(): Promise<void> {
    const { loaded } = this;
    if (!loaded) return;
    this.stage.setEye(this.mover.eye);
    this.stage.setLight(this.light);
    this.nextFrame();
    this.refresh();
    const isOn = (i: number) => {
      const layer = this.home.layers[i]!;
      return layer.kind === "lamp"
        ? this.light.dials[i]!.on
        : this.light[layer.kind].on && layer.hour === this.light.hour;
    };
    let shownMs = 0;
    await loadLight(loaded, this.reader, this.stage, isOn, share => {
      this.loadedShare = share;
      // Not after each of very many.
      if (share < 1 && performance.now() - shownMs < kLoadingMs) return;
      shownMs = performance.now();
      this.stage.touch();
      this.refresh();
    });
    this.loadedShare = 1;
    this.stage.complete = true;
    const { positions, index } = loaded.geometry;
    this.loaded = null;
    this.reader.release();
    const world = new Bvh(positions, index);
    this.stage.useWorld(world);
    this.mover.useWorld(world);
    this.canEnterVr = await headsetSupported();
    this.refresh();
  }

  private firstEye(loaded: LoadedHome) {
    const room = this.home.rooms[0];
    const { low, high } = boxAround(loaded.geometry.positions);
    const [x, z] = room ? middleOf(room) : [(low[0] + high[0]) / 2, (low[2] + high[2]) / 2];
    return {
      position: [x, (room?.elevationM ?? low[1]) + kEyeHeightM, z] as const,
      yawDeg: 0,
      pitchDeg: 0,
      fovDeg: 60,
    };
  }

  private nextFrame(): void {
    cancelAnimationFrame(this.frameAsked);
    if (!this.inVr) this.frameAsked = requestAnimationFrame(nowMs => this.frame(nowMs));
  }

  // One frame of the browser.
  private frame(nowMs: number): void {
    this.nextFrame();
    this.advance(nowMs);
  }

  private advance(nowMs: number): void {
    const seconds = Math.min(0.25, Math.max(0, (nowMs - this.lastMs) / 1000));
    this.lastMs = nowMs;
    if (!this.inVr && this.mover.update(seconds, this.controls.wish(seconds))) this.moved();
    const automaticBefore = this.ev100;
    const drawn = !this.inVr && this.stage.frame(nowMs, seconds);
    if (drawn && this.drewLast && this.pace.took(seconds * 1000)) {
      this.resize();
      this.stage.draw(); // a canvas of another size is black until then
    }
    this.drewLast = drawn;
    if (Math.abs(automaticBefore - this.ev100) > 0.02) this.refresh();
    const { dataset } = this.canvas;
    dataset.frames = String(this.stage.frames);
    dataset.calls = String(this.stage.renderer.info.render.calls);
    dataset.settled = String(this.loadedShare === 1 && !this.stage.restless && !this.mover.moving && !this.renderDue);
    dataset.ev100 = this.ev100.toFixed(3);
    dataset.white = this.stage.display.whiteGains.map(g => g.toFixed(3)).join(",");
  }

  private moved(): void {
    this.stage.setEye(this.mover.eye);
    this.reading = null;
    this.drawPlan();
    this.linkLater();
    if (this.metering) this.readAhead();
  }

  // Draws the controls anew, with the next frame.
  refresh(): void {
    if (this.renderDue) return;
    this.renderDue = true;
    requestAnimationFrame(() => {
      this.renderDue = false;
      document.documentElement.lang = this.language;
      this.canvas.setAttribute("aria-label", this.say("view"));
      render(html`${overlay(this)} ${panel(this)}`, this.root);
      this.drawPlan();
    });
  }

  private drawPlan(): void {
    const canvas = document.getElementById("plan");
    if (canvas instanceof HTMLCanvasElement && canvas.clientWidth > 0)
      drawPlan(canvas, this.home.rooms, this.mover.eye);
  }

  // Beside the controls on wide screens, behind them on narrow ones.
  private resize(): void {
    if (this.inVr) return;
    const widthPx = innerWidth - (this.panelOpen && innerWidth > kNarrowPx ? kPanelPx : 0);
    this.canvas.style.width = `${widthPx}px`;
    this.stage.resize(widthPx, innerHeight, Math.min(devicePixelRatio, kMostPixelShare) * this.pace.share);
    this.stage.setEye(this.mover.eye);
  }

  // Light.
  useLight(light: LightState): void {
    this.light = light;
    this.stage.setLight(light);
    this.reading = null;
    this.linkLater();
    this.refresh();
  }
  setDials(layers: readonly number[], change: Partial<Dial>): void {
    this.useLight(layers.reduce((light, layer) => withDial(light, layer, change), this.light));
  }
  setDaylight(kind: Exclude<Layer["kind"], "lamp">, change: Partial<Dial>): void {
    this.useLight({ ...this.light, [kind]: { ...this.light[kind], ...change } });
  }
  setHour(hour: number): void {
    this.useLight({ ...this.light, hour });
  }
  useScene(name: "everythingOn" | "evening"): void {
    this.useLight({ ...scenes[name](this.home), ...(name === "everythingOn" ? { hour: this.light.hour } : {}) });
  }
  useStored(scene: scenes.Scene): void {
    this.useLight(scenes.lightOf(scene, this.home));
  }
  saveScene(name: string): boolean {
    const others = this.scenes.filter(s => s.name !== name);
    return this.store([...others, scenes.sceneOf(name, this.light, this.home)]);
  }
  forget(scene: scenes.Scene): void {
    this.store(this.scenes.filter(s => s !== scene));
  }
  private store(list: scenes.Scene[]): boolean {
    const kept = scenes.storeScenes(() => localStorage, this.key, list);
    if (kept) this.scenes = list;
    else this.tell(this.say("notStored"));
    this.refresh();
    return kept;
  }

  // Picture.
  setAutomatic(on: boolean): void {
    this.stage.automatic = on;
    this.stage.touch();
    this.linkLater();
    this.refresh();
  }
  setEv100(ev100: number): void {
    this.stage.automatic = false;
    this.stage.setEv100(ev100);
    this.linkLater();
    this.refresh();
  }
  setFalseColours(on: boolean): void {
    this.falseColours = on;
    this.stage.setFalseColours(on);
    this.refresh();
  }
  setMetering(on: boolean): void {
    this.metering = on;
    this.reading = null;
    this.readAhead();
    this.refresh();
  }
  // What keys alone can point at: the middle of the picture.
  private readAhead(): void {
    this.hover(this.canvas.clientWidth / 2, this.canvas.clientHeight / 2);
  }
  setThroughWalls(on: boolean): void {
    this.mover.throughWalls = on;
    this.refresh();
  }
  setFov(fovDeg: number): void {
    this.mover.zoom(fovDeg / this.mover.eye.fovDeg);
    this.moved();
    this.refresh();
  }

  // Places.
  goToCamera(camera: Camera): void {
    this.mover.go(eyeOfCamera(camera));
  }
  goToRoom(room: Room): void {
    const [x, z] = middleOf(room);
    this.goToFloor([x, room.elevationM, z], room);
  }
  clickPlan(event: MouseEvent): void {
    const canvas = event.currentTarget as HTMLCanvasElement;
    const { rooms } = this.home;
    const at = placeOnPlan(canvas, rooms, this.mover.eye, event.offsetX, event.offsetY);
    const room = roomAt(rooms, at);
    if (room !== null) this.goToFloor(at, rooms[room]!);
  }
  // To where one can stand in that room.
  private goToFloor(wanted: Vec3, room: Room): void {
    const { world } = this.stage;
    const inside = (x: number, z: number) => insideOutline(room.floor, x, z);
    this.mover.goTo(world ? freePlace(world, wanted, inside) : wanted);
  }
  private click(x: number, y: number): void {
    if (this.metering) {
      this.hover(x, y);
      return;
    }
    const seen = this.stage.hitAt(x, y);
    const { world } = this.stage;
    if (!seen || !world || seen.direction[1] >= 0) return;
    const n = world.normalOf(seen.hit.triangle);
    if (Math.abs(n[1]) > kFloorSlope * Math.hypot(...n) && hasHeadroom(world, seen.at)) this.mover.goTo(seen.at);
  }

  // The meter: one reading at a time, the newest place wins.
  private hover(x: number, y: number): void {
    if (!this.metering) return;
    this.readNext = [x, y];
    if (!this.readBusy) void this.read();
  }
  private async read(): Promise<void> {
    this.readBusy = true;
    while (this.readNext && this.metering) {
      const at = this.readNext;
      this.readNext = null;
      const seen = this.stage.hitAt(at[0], at[1]);
      this.reading = seen ? { at, lux: await this.stage.spot.luxAt(seen.hit) } : null;
      this.refresh();
    }
    this.readBusy = false;
  }

  // The rest.
  setStick(forward: number, right: number): void {
    this.controls.stick = [forward, right];
    this.refresh();
  }
  togglePanel(): void {
    this.panelOpen = !this.panelOpen;
    this.resize();
    this.refresh();
  }
  setLanguage(language: Language): void {
    this.language = language;
    this.say = speaker(language);
    this.refresh();
  }
  tell(message: string): void {
    this.message = message;
    clearTimeout(this.messageTimer);
    this.messageTimer = window.setTimeout(() => {
      this.message = "";
      this.refresh();
    }, kMessageMs);
    this.refresh();
  }
  async savePicture(): Promise<void> {
    const blob = await this.stage.screenshot();
    if (!blob) return;
    const link = document.createElement("a");
    link.href = URL.createObjectURL(blob);
    link.download = `${document.title.replace(/[^\p{L}\p{N} _-]/gu, "") || "roomlight"}.png`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), kMessageMs);
  }
  hash(): string {
    const ev100 = this.automatic ? null : this.ev100;
    return linkOf({ eye: this.mover.eye, ev100, light: this.light }, this.fileLight);
  }
  async copyLink(): Promise<void> {
    this.putLink();
    try {
      await navigator.clipboard.writeText(location.href);
      this.tell(this.say("copied"));
    } catch {
      this.tell(this.say("notCopied"));
    }
  }
  toggleFullscreen(): void {
    const done = document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen();
    done.catch(() => undefined);
  }
  async enterVr(): Promise<void> {
    try {
      const headset = new Headset(this.stage, this.mover);
      await headset.enter(
        () => (this.inVr = true),
        nowMs => this.advance(nowMs),
        () => {
          this.inVr = false;
          this.resize();
          this.nextFrame();
        },
      );
    } catch {
      this.tell(this.say("vrFailed"));
    }
  }
  private linkLater(): void {
    clearTimeout(this.linkTimer);
    this.linkTimer = window.setTimeout(() => this.putLink(), kLinkMs);
  }
  putLink(): void {
    try {
      history.replaceState(null, "", this.hash());
    } catch {
      // Some browsers limit how often; the next change puts it.
    }
  }
  private followLink(): void {
    const linked = readLink(location.hash, this.fileLight);
    if (linked.eye) this.mover.go(linked.eye);
    if (linked.ev100 !== null) this.setEv100(linked.ev100);
    this.useLight(linked.light);
  }
  private shortcut(event: KeyboardEvent): void {
    const typing = event.target instanceof HTMLInputElement && event.target.type === "text";
    if (event.ctrlKey || event.metaKey || event.altKey || event.repeat || typing) return;
    if (event.code === "KeyF") this.setFalseColours(!this.falseColours);
    else if (event.code === "KeyM") this.setMetering(!this.metering);
    else if (event.code === "KeyP") void this.savePicture();
  }
}
