// Edits on their way to the server: one at a time, the newest values of a gesture merged while they wait.
import { edited, type Model } from "./model.js";
import type { EditFields, Target } from "./protocol.js";

export interface Edit {
  readonly target: Target;
  readonly gesture: string;
  readonly fields: EditFields;
}

interface Queued {
  edit: Edit;
  sent: boolean;
}

// The connection went away before an answer came.
export class ConnectionLost extends Error {}

export class EditQueue {
  private queued: Queued[] = [];
  private waiting: (() => void)[] = [];

  // send resolves once the server has done the edit, and rejects if it would not; done is told of each, with what went
  // wrong or null.
  constructor(
    private readonly send: (edit: Edit) => Promise<unknown>,
    private readonly done: (edit: Edit, failure: unknown) => void,
  ) {}

  push(edit: Edit): void {
    const last = this.queued.at(-1);
    // Colours of two materials are two edits: a message sets one.
    const mergeable =
      last &&
      !last.sent &&
      last.edit.target === edit.target &&
      last.edit.gesture === edit.gesture &&
      last.edit.fields.material === edit.fields.material;
    if (mergeable) last.edit = { ...edit, fields: mergedFields(last.edit.fields, edit.fields) };
    else this.queued.push({ edit, sent: false });
    this.pump();
  }

  // What the server has not answered yet, on top of what it has said.
  overlay(model: Model): Model {
    return this.queued.reduce((next, { edit }) => edited(next, edit.target, edit.fields), model);
  }

  // Resolves when nothing waits any more.
  empty(): Promise<void> {
    return this.queued.length === 0 ? Promise.resolve() : new Promise(resolve => this.waiting.push(resolve));
  }

  // There is a connection again. What was under way is sent once more; values are absolute, so that does no harm.
  resume(): void {
    this.pump();
  }

  private pump(): void {
    const next = this.queued[0];
    if (!next || next.sent) return;
    next.sent = true;
    this.send(next.edit).then(
      () => this.finish(next, null),
      (failure: unknown) => {
        if (failure instanceof ConnectionLost) next.sent = false;
        else this.finish(next, failure);
      },
    );
  }

  private finish(entry: Queued, failure: unknown): void {
    this.queued.shift();
    this.done(entry.edit, failure);
    if (this.queued.length === 0) this.waiting.splice(0).forEach(resolve => resolve());
    this.pump();
  }
}

// A temperature and a colour shut each other out; a thing moves alone as the last move says.
function mergedFields(before: EditFields, after: EditFields): EditFields {
  const merged = { ...before, ...after };
  if (after.color) delete merged.temperatureK;
  if (after.temperatureK !== undefined) delete merged.color;
  if ((after.move || after.turn !== undefined) && !after.alone) delete merged.alone;
  return merged;
}
