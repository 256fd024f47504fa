import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { Connection, Refused, retryDelayMs, tokenOf, type Link, type Listener } from "../../src/connection.js";
import { ConnectionLost } from "../../src/edits.js";
import { Desk } from "../double/desk.js";

class Socket {
  static readonly OPEN = 1;
  static all: Socket[] = [];
  readyState = 1;
  sent: string[] = [];
  onmessage: (event: { data: unknown }) => void = () => {};
  onclose: (event: { reason: string }) => void = () => {};
  constructor(readonly url: URL) {
    Socket.all.push(this);
  }
  send(data: string): void {
    this.sent.push(data);
  }
  say(message: object): void {
    this.onmessage({ data: JSON.stringify(message) });
  }
  close(): void {
    this.readyState = 3;
    this.onclose({ reason: "" });
  }
}

// Timers that run when the test says so.
class Clock {
  private nowMs = 0;
  private next = 1;
  private timers = new Map<number, { atMs: number; run: () => void }>();
  setTimeout = (run: () => void, delayMs: number): number => {
    this.timers.set(this.next, { atMs: this.nowMs + delayMs, run });
    return this.next++;
  };
  clearTimeout = (id: number): void => void this.timers.delete(id);
  tick(ms: number): void {
    this.nowMs += ms;
    for (const [id, { atMs, run }] of [...this.timers]) {
      if (atMs <= this.nowMs && this.timers.delete(id)) run();
    }
  }
}

let clock = new Clock();
let links: Link[] = [];
let troubles: string[] = [];
let status = 403;
const listener: Listener = {
  linked: link => void links.push(link),
  welcome: () => {},
  message: () => {},
  frame: () => {},
  trouble: message => void troubles.push(message),
};

function opened(): { connection: Connection; socket: Socket } {
  const connection = new Connection(new URL("http://127.0.0.1:9/"), "abc", listener);
  connection.open();
  return { connection, socket: Socket.all.at(-1)! };
}

function greeted() {
  const both = opened();
  both.socket.say(new Desk().welcome("w1"));
  return both;
}

beforeEach(() => {
  clock = new Clock();
  Socket.all = [];
  links = [];
  troubles = [];
  Object.assign(globalThis, { window: clock, WebSocket: Socket, fetch: () => Promise.resolve({ status }) });
});

test("the token stands behind the # of the link, or in its query", () => {
  assert.equal(tokenOf({ hash: "#abc", search: "" }), "abc");
  assert.equal(tokenOf({ hash: "#token=abc", search: "" }), "abc");
  assert.equal(tokenOf({ hash: "", search: "?token=abc" }), "abc");
  assert.equal(tokenOf({ hash: "", search: "" }), "");
});

test("the delay grows from half a second to fifteen, and no further", () => {
  assert.equal(retryDelayMs(0, 1), 500);
  assert.equal(retryDelayMs(3, 1), 4000);
  assert.equal(retryDelayMs(40, 1), 15000);
  assert.equal(retryDelayMs(0, 0), 375);
});

test("the token goes to the server, and later the name of the window", () => {
  const { socket } = greeted();
  assert.equal(String(socket.url), "ws://127.0.0.1:9/live?token=abc");
  socket.close();
  clock.tick(500);
  assert.equal(String(Socket.all[1]!.url), "ws://127.0.0.1:9/live?token=abc&window=w1");
});

test("a connection that was greeted stays", () => {
  const { connection } = greeted();
  clock.tick(60000);
  assert.ok(connection.isOpen);
  assert.equal(links.at(-1)?.state, "open");
});

test("a connection without a welcome is given up and tried again", async () => {
  status = 426;
  opened();
  clock.tick(15000);
  await new Promise(resolve => setImmediate(resolve));
  assert.equal(links.at(-1)?.state, "lost");
  clock.tick(500);
  assert.equal(Socket.all.length, 2);
});

test("a wrong token is not tried again", async () => {
  status = 403;
  opened().socket.close();
  await new Promise(resolve => setImmediate(resolve));
  assert.equal(links.at(-1)?.state, "refused");
  clock.tick(60000);
  assert.equal(Socket.all.length, 1);
});

test("answers go to who asked; errors reject", async () => {
  const { connection, socket } = greeted();
  const first = connection.request({ type: "save" });
  const second = connection.request({ type: "undo" });
  const [save, undo] = socket.sent.map(text => JSON.parse(text) as { id: number; type: string });
  assert.deepEqual([save!.type, undo!.type], ["save", "undo"]);
  socket.say({ type: "error", id: undo!.id, code: "notPossible", field: null, message: "There is nothing to undo." });
  socket.say({ type: "saved", id: save!.id, name: "a.json", text: "{}" });
  assert.equal((await first).type, "saved");
  await assert.rejects(second, error => error instanceof Refused && error.message === "There is nothing to undo.");
});

test("what waits for an answer is told when the line is lost", async () => {
  const { connection, socket } = greeted();
  const asked = connection.request({ type: "save" });
  socket.close();
  await assert.rejects(asked, ConnectionLost);
  await assert.rejects(connection.request({ type: "save" }), ConnectionLost);
});

test("what is no message is told, and the line lives", () => {
  const { connection, socket } = greeted();
  socket.onmessage({ data: "{" });
  socket.onmessage({ data: new ArrayBuffer(3) });
  assert.equal(troubles.length, 2);
  assert.ok(connection.isOpen);
});
