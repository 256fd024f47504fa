// The double's state: the home, its history and its plans.
import { edited, modelFrom, type Model } from "../../src/model.js";
import type { EditFields, Lamp, Overlap, Sun, Thing, Welcome } from "../../src/protocol.js";
import { add, subtract } from "../../src/vector.js";
import { firstHome, kRoom, type Home } from "./home.js";

interface Step {
  what: string;
  gesture: string;
  before: Home;
}

export class Desk {
  home: Home = firstHome();
  revision = 1;
  plans = new Map<string, Home>();
  undone: Step[] = [];
  done: Step[] = [];

  edit(target: string, fields: EditFields, gesture: string, by: string): boolean {
    const known = [...this.home.lamps, ...this.home.objects].find(({ id }) => id === target);
    if (!known && target !== "sun") return false;
    const last = this.done.at(-1);
    const name = `${by} ${gesture}`;
    if (!gesture || last?.gesture !== name)
      this.done.push({ what: `change ${known?.name ?? "the sun"}`, gesture: name, before: this.home });
    this.undone = [];
    this.replace(fromModel(this.moved(target, fields)));
    return true;
  }

  // With what stands on it.
  private moved(target: string, fields: EditFields): Model {
    const model = this.model();
    const thing = model.things.get(target);
    const next = edited(model, target, fields);
    if (!thing || !fields.move || fields.alone) return next;
    const by = subtract(fields.move, thing.move);
    return loadOf(thing, this.home.objects).reduce(
      (all, carried) => edited(all, carried.id, { move: add(carried.move, by) }),
      next,
    );
  }

  step(back: boolean): boolean {
    const from = back ? this.done : this.undone;
    const step = from.pop();
    if (!step) return false;
    (back ? this.undone : this.done).push({ ...step, before: this.home });
    this.replace(step.before);
    return true;
  }

  replace(home: Home): void {
    this.home = home;
    ++this.revision;
  }

  private model(): Model {
    return modelFrom(this.welcome("here"));
  }

  state(): object {
    const { lamps, objects, sun } = this.home;
    return {
      type: "state",
      revision: this.revision,
      lamps,
      objects,
      overlaps: overlapsOf(objects),
      sun,
      plans: [...this.plans.keys()],
      undo: this.done.at(-1)?.what ?? null,
      redo: this.undone.at(-1)?.what ?? null,
      by: "here",
    };
  }

  welcome(window: string): Welcome {
    return {
      type: "welcome",
      protocol: 1,
      version: "0.1.0",
      home: "Box home",
      window,
      bounds: [
        [0, 0, 0],
        [6, 2.6, 5],
      ],
      rooms: [kRoom],
      cameras: [
        { name: "From the door", position: [5.6, 1.6, 4.7], direction: [-0.7, -0.2, -0.7], verticalFov: 60 },
        { name: "At the shelf", position: [3, 1.5, 4], direction: [-1, -0.1, 0], verticalFov: 50 },
      ],
      camera: { position: [5.6, 1.6, 4.7], direction: [-0.7, -0.2, -0.7], up: [0, 1, 0], verticalFov: 60 },
      techniques: [
        { name: "hybrid", about: "Exact rays that read light from voxels." },
        { name: "path", about: "Path tracing: slow, exact." },
      ],
      technique: "hybrid",
      plans: [...this.plans.keys()],
      qualities: [
        { name: "draft", about: "In a second." },
        { name: "good", about: "For most pictures." },
      ],
      curves: ["neutral", "agx", "filmic", "clip"],
      display: {
        exposure: 4,
        compensation: 0,
        curve: "neutral",
        whiteBalance: "auto",
        falseColor: "off",
        low: null,
        high: null,
      },
      split: null,
      legend: Array.from(
        { length: 17 },
        (_, i) =>
          `#00${Math.round((255 * i) / 16)
            .toString(16)
            .padStart(2, "0")}00`,
      ),
      limits: {
        frameWidth: 1920,
        frameHeight: 1080,
        renderWidth: 7680,
        renderHeight: 4320,
        messageBytes: 65536,
        messagesPerSecond: 240,
      },
      revision: this.revision,
      lamps: this.home.lamps,
      objects: this.home.objects,
      overlaps: overlapsOf(this.home.objects),
      sun: this.home.sun,
      undo: this.done.at(-1)?.what ?? null,
      redo: this.undone.at(-1)?.what ?? null,
    };
  }
}

function loadOf(thing: Thing, all: readonly Thing[]): Thing[] {
  const stands = ({ low, high }: Thing) => {
    const [x, z] = [(low[0] + high[0]) / 2, (low[2] + high[2]) / 2];
    const isOver = x > thing.low[0] && x < thing.high[0] && z > thing.low[2] && z < thing.high[2];
    return isOver && Math.abs(low[1] - thing.high[1]) < 0.02;
  };
  return all.filter(stands).flatMap(other => [other, ...loadOf(other, all)]);
}

// Boxes that were moved into others.
function overlapsOf(all: readonly Thing[]): Overlap[] {
  const meet = (a: Thing, b: Thing) =>
    a.low.every((low, i) => Math.min(a.high[i]!, b.high[i]!) - Math.max(low, b.low[i]!) > 0.01);
  const moved = all.filter(({ move }) => move.some(m => m !== 0));
  return moved.flatMap(thing =>
    all.filter(other => other !== thing && meet(thing, other)).map(other => ({ object: thing.id, into: other.id })),
  );
}

function fromModel({ lamps, things, sun }: Model): Home {
  return { lamps: [...lamps.values()] as Lamp[], objects: [...things.values()] as Thing[], sun: sun as Sun };
}
