// All that this window knows and does: the line to the server, the model of the home, the eye, and what the controls
// show. Components read its fields, call its methods, and listen to topics.
import { poseFrom, type Pose, type Viewport } from "./camera.js";
import { Connection, Refused, type Link, type Listener } from "./connection.js";
import { ConnectionLost, EditQueue } from "./edits.js";
import { Eye } from "./eye.js";
import { FinalPictures } from "./final_pictures.js";
import type { FrameHeader } from "./frame.js";
import { boxAt, lampBox, middle, poseForLamp, poseForRoom, poseForThing, type Surroundings } from "./framing.js";
import { LightMeter } from "./light_meter.js";
import { changed, edited, modelFrom, type Model } from "./model.js";
import type { PictureState } from "./picture_words.js";
import type {
  Box,
  Display,
  EditFields,
  Job,
  MeterHit,
  PickHit,
  Progress,
  RenderRequest,
  Request,
  ServerMessage,
  Split,
  Target,
  Welcome,
} from "./protocol.js";
import type { Vec3 } from "./vector.js";

export type Topic = "link" | "model" | "ui" | "camera" | "frame" | "meter" | "jobs";
export type Tab = "home" | "light" | "view" | "compare" | "render";
export type Navigation = "walk" | "orbit";

export interface Selection {
  readonly kind: "room" | "camera" | "lamp" | "object";
  readonly id: string; // of rooms and cameras the number in their list
}

export class Session implements Listener {
  link: Link = { state: "opening" };
  model: Model | null = null;
  display: Display | null = null;
  technique = "";
  split: Split | null = null;
  dividerAt = 0.5; // of the stage's width
  selection: Selection | null = null;
  pivot: Vec3 | null = null; // what orbiting goes around
  tab: Tab = "home";
  sheetOpen = true; // the panel on narrow screens
  navigation: Navigation = "walk";
  movesAlone = false; // things, without what stands on them
  notice: { readonly text: string; readonly bad: boolean } | null = null;
  progress: Progress | null = null;
  lastFrame: FrameHeader | null = null;
  private frames: readonly FrameHeader[] = []; // the newest of each side that is shown
  readonly eye: Eye;
  readonly meter: LightMeter;
  readonly pictures: FinalPictures;
  onFrame: ((header: FrameHeader, picture: Uint8Array) => void) | null = null;
  onNewLine: (() => void) | null = null; // frames are counted afresh from here on

  private readonly connection: Connection;
  private readonly edits: EditQueue;
  private server: Model | null = null; // what the server has said, without edits under way
  private readonly listeners = new Map<Topic, Set<() => void>>();
  private frameTimesMs: number[] = [];
  private movedAtMs = -Infinity; // when a frame came that shows another eye or home than the one before
  private wantedRevision = 0; // of the newest state in which something was changed
  private noticeTimer = 0;

  constructor(origin: URL, token: string) {
    this.connection = new Connection(origin, token, this);
    this.eye = new Eye(
      notice => this.connection.notify(notice),
      () => this.emit("camera"),
    );
    this.meter = new LightMeter(
      (xPx, yPx) => this.measure(xPx, yPx),
      () => this.emit("meter"),
    );
    this.pictures = new FinalPictures(
      token,
      () => this.emit("jobs"),
      message => this.tell(message, true),
    );
    this.edits = new EditQueue(
      ({ target, gesture, fields }) => this.connection.request({ type: "edit", target, gesture, ...fields }),
      (edit, failure) => {
        if (failure) this.fail(failure);
        else if (this.server) this.server = edited(this.server, edit.target, edit.fields);
        this.publishModel();
      },
    );
  }

  start(): void {
    this.connection.open();
  }

  on(topic: Topic, listener: () => void): () => void {
    const set = this.listeners.get(topic) ?? new Set();
    this.listeners.set(topic, set);
    set.add(listener);
    return () => set.delete(listener);
  }

  // Listener of the connection.

  linked(link: Link): void {
    this.link = link;
    this.emit("link");
  }

  welcome(welcome: Welcome): void {
    const again = this.server !== null;
    this.onNewLine?.();
    this.server = modelFrom(welcome);
    this.wantedRevision = 0;
    if (again) {
      // The server may have been started afresh: it is told what this window shows.
      if (this.display) this.connection.notify({ type: "display", ...this.display });
      if (this.technique !== welcome.technique) void this.ask({ type: "technique", technique: this.technique });
      if (JSON.stringify(this.split) !== JSON.stringify(welcome.split))
        void this.ask({ type: "split", split: this.split });
      this.pictures.forgetRunning();
    } else {
      document.title = `${welcome.home} – roomlight`;
      this.eye.pose = poseFrom(welcome.camera);
      this.display = welcome.display;
      this.technique = welcome.technique;
      this.split = welcome.split;
    }
    this.progress = null;
    this.sendViewport();
    this.eye.touch();
    this.edits.resume();
    this.publishModel();
    this.emit("ui");
  }

  message(message: ServerMessage): void {
    if (message.type === "state" && this.server) {
      this.server = changed(this.server, message);
      // Plans count as revisions too, and change no picture.
      if (message.lamps?.length || message.objects?.length || message.sun) this.wantedRevision = message.revision;
      this.publishModel();
    } else if (message.type === "progress") {
      this.progress = message.stage === "done" ? null : message;
      this.emit("ui");
    } else if (message.type === "job") {
      this.pictures.update(message);
    } else if (message.type === "error") {
      this.tell(message.message, true);
    }
  }

  frame(header: FrameHeader, picture: Uint8Array): void {
    const now = performance.now();
    this.meter.shown(header);
    const before = this.frames.find(({ side }) => side === header.side);
    const moved =
      before &&
      (this.eye.poseOf(before.camera) !== this.eye.poseOf(header.camera) || before.revision !== header.revision);
    if (moved) this.movedAtMs = now;
    const isOther = ({ side }: FrameHeader) => side !== "whole" && header.side !== "whole" && side !== header.side;
    this.frames = [header, ...this.frames.filter(isOther)];
    if (header.side !== "right") this.frameTimesMs = [...this.recentFrames(now), now];
    this.lastFrame = header;
    this.onFrame?.(header, picture);
    this.emit("frame");
  }

  // What happens to the picture now.
  pictureState(): PictureState {
    const { frames, eye, progress, pictures, wantedRevision } = this;
    const now = performance.now();
    const times = this.recentFrames(now);
    const seconds = (times.at(-1)! - times[0]!) / 1000;
    return {
      frames,
      moving: now - this.movedAtMs < 1000 && frames.some(({ samples }) => samples === 0),
      framesPerSecond: times.length > 1 && seconds > 0.2 ? (times.length - 1) / seconds : null,
      awaited:
        frames.some(({ camera }) => camera < eye.newest) || frames.every(({ revision }) => revision < wantedRevision),
      progress,
      rendering: pictures.busy,
    };
  }

  trouble(message: string): void {
    this.tell(message, true);
  }

  reconnect(): void {
    this.connection.open();
  }

  // The picture.

  setViewport(viewport: Viewport): void {
    this.eye.viewport = viewport;
    this.sendViewport();
    this.eye.touch();
  }

  acknowledge(frame: number): void {
    this.connection.notify({ type: "ack", frame });
  }

  setDisplay(change: Partial<Display>): void {
    if (!this.display) return;
    this.display = { ...this.display, ...change };
    this.connection.notify({ type: "display", ...change });
    this.emit("ui");
  }

  setTechnique(technique: string): void {
    const before = this.technique;
    this.technique = technique;
    void this.orBack({ type: "technique", technique }, () => (this.technique = before));
  }

  setSplit(split: Split | null): void {
    const before = this.split;
    this.split = split;
    void this.orBack({ type: "split", split }, () => (this.split = before));
  }

  // Things.

  // Values are shown at once and sent; one gesture is one step of undo.
  edit(target: Target, fields: EditFields, gesture: string): void {
    this.edits.push({ target, fields, gesture });
    this.publishModel();
  }

  undo(): void {
    void this.afterEdits({ type: "undo" });
  }

  redo(): void {
    void this.afterEdits({ type: "redo" });
  }

  plan(action: "keep" | "apply" | "drop", name: string): void {
    void this.afterEdits({ type: "plan", do: action, name });
  }

  // Leaves the eye where it is; showSelected() goes there.
  select(selection: Selection | null): void {
    this.selection = selection;
    const box = selection && this.boxOf(selection);
    if (box) this.pivot = middle(box);
    this.emit("ui");
  }

  showSelected(): void {
    const pose = this.selection && this.poseFor(this.selection);
    if (pose) this.eye.goTo(pose);
  }

  boxOf(selection: Selection): Box | null {
    const { kind, id } = selection;
    if (kind === "object") return this.model?.things.get(id) ?? null;
    if (kind === "room") return this.model?.welcome.rooms[Number(id)] ?? null;
    const lamp = kind === "lamp" ? this.model?.lamps.get(id) : undefined;
    return lamp ? boxAt(lamp.position) : null;
  }

  private poseFor(selection: Selection): Pose | null {
    if (!this.model) return null;
    const { welcome, lamps, things } = this.model;
    if (selection.kind === "camera") {
      const camera = welcome.cameras[Number(selection.id)];
      return camera ? poseFrom(camera) : null;
    }
    if (selection.kind === "room") {
      const room = welcome.rooms[Number(selection.id)];
      return room ? poseForRoom(room, this.eye.pose) : null;
    }
    const { pose, viewport } = this.eye;
    if (selection.kind === "lamp") {
      const lamp = lamps.get(selection.id);
      return lamp ? poseForLamp(lampBox(lamp, things.values()), this.surroundings(this.model), pose, viewport) : null;
    }
    const box = this.boxOf(selection);
    return box && poseForThing(box, this.surroundings(this.model), pose);
  }

  private surroundings({ welcome, things }: Model): Surroundings {
    const [low, high] = welcome.bounds;
    return {
      rooms: welcome.rooms,
      bounds: low && high ? { low, high } : null,
      things: [...things.values()].filter(({ hidden, movable }) => movable && !hidden),
    };
  }

  // What is seen at a place of the stage, fractions from its top left corner.
  async pick(x: number, y: number): Promise<PickHit | null> {
    this.eye.flush();
    const answer = await this.ask({ type: "pick", x, y });
    return answer?.type === "picked" ? answer.hit : null;
  }

  // Pictures and files.

  async render(request: RenderRequest): Promise<void> {
    await this.edits.empty();
    const { width = 16, height = 9 } = request;
    this.eye.sendFor({ width, height });
    const asked = this.ask({ type: "render", ...request });
    this.eye.touch();
    await asked;
  }

  cancel(job: Job["job"]): void {
    void this.ask({ type: "cancel", job });
  }

  async save(): Promise<void> {
    const answer = await this.afterEdits({ type: "save" });
    if (answer?.type !== "saved") return;
    const address = URL.createObjectURL(new Blob([answer.text], { type: "application/json" }));
    const link = document.createElement("a");
    link.href = address;
    link.download = answer.name;
    link.click();
    window.setTimeout(() => URL.revokeObjectURL(address), 10000);
    this.tell(`Saved ${answer.name}: lamps and sun as they are now. Moved things are not in it.`, false);
  }

  // A line for the user; it stays for some seconds.
  tell(text: string, bad: boolean): void {
    this.notice = { text, bad };
    window.clearTimeout(this.noticeTimer);
    this.noticeTimer = window.setTimeout(
      () => {
        this.notice = null;
        this.emit("ui");
      },
      bad ? 9000 : 5000,
    );
    this.emit("ui");
  }

  // Shows something else in the controls: sets fields of this session and tells who listens.
  show(
    change: Partial<Pick<Session, "tab" | "sheetOpen" | "navigation" | "movesAlone" | "dividerAt" | "pivot">>,
  ): void {
    Object.assign(this, change);
    this.emit("ui");
  }

  // When they came; of the last second.
  private recentFrames(now: number): number[] {
    return this.frameTimesMs.filter(time => now - time < 1000);
  }

  private async measure(xPx: number, yPx: number): Promise<MeterHit | null | undefined> {
    const { width, height } = this.eye.viewport;
    this.eye.flush();
    const answer = await this.ask({ type: "meter", x: xPx / width, y: yPx / height });
    return answer?.type === "metered" ? answer.hit : undefined;
  }

  private sendViewport(): void {
    const { width, height } = this.eye.viewport;
    const pixelRatio = Math.min(2, Math.max(0.5, window.devicePixelRatio || 1));
    this.connection.notify({ type: "viewport", width: Math.max(16, width), height: Math.max(16, height), pixelRatio });
  }

  // What counts on the edits made so far is asked once they are done; not at all without a connection, for who knows
  // when that would be.
  private async afterEdits(request: Request): Promise<ServerMessage | null> {
    if (!this.connection.isOpen) return null;
    await this.edits.empty();
    return this.ask(request);
  }

  // Shown at once, and taken back where the server refuses.
  private async orBack(request: Request, back: () => void): Promise<void> {
    this.emit("ui");
    if ((await this.ask(request)) !== null) return;
    back();
    this.emit("ui");
  }

  // Null where the server refused or the line was lost; the user has been told.
  private async ask(request: Request): Promise<ServerMessage | null> {
    try {
      return await this.connection.request(request);
    } catch (error) {
      this.fail(error);
      return null;
    }
  }

  private fail(error: unknown): void {
    // The state line tells of lost connections already.
    if (error instanceof Refused) this.tell(error.message, true);
    else if (!(error instanceof ConnectionLost)) throw error;
  }

  private publishModel(): void {
    this.model = this.server && this.edits.overlay(this.server);
    this.emit("model");
  }

  private emit(topic: Topic): void {
    this.listeners.get(topic)?.forEach(listener => listener());
  }
}
