// One connection to the double: answers requests and sends frames, at most two that are not acknowledged.
import type { WebSocket } from "ws";
import type { Pose } from "../../src/camera.js";
import { rayThrough } from "../../src/camera.js";
import type { Display, EditFields, Split } from "../../src/protocol.js";
import type { Desk } from "./desk.js";
import { draw, light, luminance, poseOf, trace } from "./home.js";
import { encodePng } from "./png.js";

const kFrameHeight = 180;
const kRestMs = 120; // without an input, before the picture is finished
const kSettled = 2;
const kFalseColour = 8;
const kJobSteps = 5;
const kJobStepMs = 120;

let files = 0;

interface Incoming {
  type: string;
  id?: number;
  [key: string]: unknown;
}

// How far a frame says that its picture is.
export interface Growth {
  flags: number;
  samples: number;
  samplesInAll?: number;
  relativeError?: number;
}

export type Camera = Parameters<typeof poseOf>[0];

export class Window {
  private readonly name = Math.random().toString(16).slice(2, 10);
  display: Display;
  private split: Split | null = null;
  private viewport = { width: 960, height: 540 };
  eye: Camera;
  private camera = 0;
  private frames = 0;
  private unacknowledged = 0;
  private dirty = false;
  private growth: Growth = { flags: 0, samples: 0 };
  private restTimer: NodeJS.Timeout | null = null;
  private side: 1 | 2 = 1;
  private timer: NodeJS.Timeout | null = null;
  private job: NodeJS.Timeout | null = null;

  constructor(
    private readonly desk: Desk,
    private readonly line: WebSocket,
    private readonly toAll: (change: object) => void,
  ) {
    const welcome = desk.welcome(this.name);
    this.display = welcome.display;
    this.eye = welcome.camera;
    this.send(welcome);
    line.on("message", (data, binary) => {
      if (!binary) this.receive(JSON.parse(String(data)) as Incoming);
    });
  }

  tell(change: object): void {
    this.send(change);
    this.show();
  }

  sendRaw(data: string | Buffer): void {
    this.line.send(data);
  }

  close(): void {
    if (this.timer) clearTimeout(this.timer);
    if (this.restTimer) clearTimeout(this.restTimer);
    if (this.job) clearInterval(this.job);
  }

  private send(message: object): void {
    this.line.send(JSON.stringify(message));
  }

  private refuse(id: number | undefined, message: string): void {
    this.send({ type: "error", id: id ?? null, code: "notPossible", field: null, message });
  }

  private changed(id: number | undefined, worked: boolean, why: string): void {
    if (!worked) {
      this.refuse(id, why);
      return;
    }
    this.send({ type: "ok", id });
    this.toAll(this.desk.state());
  }

  private receive(message: Incoming): void {
    const { type, id } = message;
    switch (type) {
      case "viewport":
        this.viewport = message as unknown as { width: number; height: number };
        return this.show();
      case "camera":
        this.camera = message.number as number;
        this.eye = message as unknown as Camera;
        return this.show();
      case "display":
        this.display = { ...this.display, ...(message as unknown as Display) };
        return this.show();
      case "split":
        this.split = message.split as Split | null;
        this.send({ type: "ok", id });
        return this.show();
      case "technique":
        this.send({ type: "ok", id });
        return this.show();
      case "edit": {
        const { target, gesture, type: _type, id: _id, ...fields } = message;
        const worked = this.desk.edit(
          target as string,
          fields as EditFields,
          (gesture as string | undefined) ?? "",
          this.name,
        );
        return this.changed(id, worked, "There is no such thing.");
      }
      case "undo":
        return this.changed(id, this.desk.step(true), "There is nothing to undo.");
      case "redo":
        return this.changed(id, this.desk.step(false), "There is nothing to redo.");
      case "plan":
        return this.plan(id, message.do as string, message.name as string);
      case "pick":
        return this.pick(message);
      case "meter":
        return this.meter(message);
      case "render":
        return this.render(id);
      case "cancel":
        return this.cancel(id);
      case "save":
        return this.send({ type: "saved", id, name: "box_home.json", text: '{"version": 1}\n' });
      case "ack":
        this.unacknowledged = Math.max(0, this.unacknowledged - 1);
        return this.pump();
      default:
        return this.refuse(id, `unknown type "${type}"`);
    }
  }

  private plan(id: number | undefined, action: string, name: string): void {
    const { plans } = this.desk;
    if (action === "keep") plans.set(name, this.desk.home);
    else if (action === "drop") plans.delete(name);
    else this.desk.replace(plans.get(name) ?? this.desk.home);
    this.changed(id, true, "");
  }

  private pose(): Pose {
    return poseOf(this.eye, this.viewport);
  }

  private hit({ x, y }: Incoming) {
    const { width, height } = this.viewport;
    return trace(this.desk.home, rayThrough(this.pose(), this.viewport, (x as number) * width, (y as number) * height));
  }

  private pick(message: Incoming): void {
    const { point, normal, distanceM, object } = this.hit(message);
    this.send({
      type: "picked",
      id: message.id,
      hit: { point, normal, distanceM, object, lamp: null, material: null },
    });
  }

  private meter(message: Incoming): void {
    const hit = this.hit(message);
    const illuminanceLux = luminance(light(this.desk.home, hit));
    const luminanceCdM2 = (illuminanceLux * luminance(hit.color)) / Math.PI;
    const reading = {
      point: hit.point,
      normal: hit.normal,
      object: hit.object,
      illuminanceLux,
      standardErrorLux: 0.2,
      luminanceCdM2,
      incidentEv100: Math.log2(illuminanceLux / 2.5),
      reflectedEv100: Math.log2(luminanceCdM2 / 0.125),
    };
    this.send({ type: "metered", id: message.id, hit: reading });
  }

  private render(id: number | undefined): void {
    this.send({ type: "ok", id, job: "job:1" });
    let step = 0;
    this.job = setInterval(() => {
      const fraction = ++step / kJobSteps;
      const running = step < kJobSteps;
      this.jobState(running ? "running" : "done", fraction);
      if (!running && this.job) clearInterval(this.job);
    }, kJobStepMs);
  }

  private cancel(id: number | undefined): void {
    if (this.job) clearInterval(this.job);
    this.send({ type: "ok", id });
    this.jobState("cancelled", 0.4);
  }

  private jobState(state: string, fraction: number): void {
    const file =
      state === "done" ? { path: `/files/${this.name}${++files}`, name: "box_home.png", bytes: 81234 } : null;
    this.send({
      type: "job",
      job: "job:1",
      stage: "light",
      fraction,
      secondsLeft: 1,
      estimatedError: 0.02,
      state,
      file,
      message: null,
    });
  }

  // A quick frame at once, and a finished one after a rest.
  private show(): void {
    this.grow({ flags: 0, samples: 0 });
    if (this.restTimer) clearTimeout(this.restTimer);
    this.restTimer = setTimeout(() => this.grow({ flags: kSettled, samples: 24, samplesInAll: 24 }), kRestMs);
  }

  // Sends the picture anew, as far as this.
  grow(growth: Growth): void {
    this.growth = growth;
    this.dirty = true;
    this.side = 1;
    this.timer ??= setTimeout(() => {
      this.timer = null;
      this.pump();
    }, 5);
  }

  private pump(): void {
    if (!this.dirty || this.unacknowledged >= 2 || this.line.readyState !== this.line.OPEN) return;
    // Both sides in turn, the left one first.
    const side = this.split ? this.side : 0;
    this.side = side === 1 ? 2 : 1;
    this.dirty = side === 1;
    this.frame(side);
    if (this.dirty) this.pump();
  }

  private frame(side: 0 | 1 | 2): void {
    const height = kFrameHeight;
    const width = Math.max(1, Math.round((height * this.viewport.width) / this.viewport.height));
    const falseColor = this.display.falseColor !== "off";
    const ev = this.display.exposure === "auto" ? 4 : this.display.exposure;
    const plan = side === 1 ? this.split?.left.plan : side === 2 ? this.split?.right.plan : undefined;
    const home = this.desk.plans.get(plan ?? "") ?? this.desk.home;
    const png = encodePng(
      draw(home, this.pose(), width, height, falseColor, ev - this.display.compensation),
      width,
      height,
    );
    const header = Buffer.alloc(64);
    header.set([1, 1, 64, 0]);
    header.writeUInt32LE(++this.frames, 4);
    header.writeUInt16LE(width, 8);
    header.writeUInt16LE(height, 10);
    const { flags, samples, samplesInAll = 0, relativeError = NaN } = this.growth;
    header.set([side, flags + (falseColor ? kFalseColour : 0)], 12);
    header.writeUInt16LE(90, 14);
    header.writeUInt32LE(this.camera, 16);
    header.writeUInt32LE(this.desk.revision, 20);
    header.writeUInt32LE(samples, 24);
    header.writeFloatLE(relativeError, 28);
    header.writeFloatLE(falseColor ? NaN : ev, 32);
    header.writeFloatLE(falseColor ? (this.display.low ?? 1) : NaN, 36);
    header.writeFloatLE(falseColor ? (this.display.high ?? 1000) : NaN, 40);
    header.writeFloatLE(20, 44);
    header.writeFloatLE(15, 48);
    header.writeFloatLE(NaN, 52);
    header.writeUInt32LE(samplesInAll, 56);
    ++this.unacknowledged;
    this.line.send(Buffer.concat([header, png]));
  }
}
