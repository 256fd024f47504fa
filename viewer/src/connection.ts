// The line to the server: opened with the token of the link, taken up again when it is lost, requests paired with their
// answers.
import { ConnectionLost } from "./edits.js";
import { decodeFrame, type FrameHeader } from "./frame.js";
import {
  decodeMessage,
  type Notice,
  type Request,
  type ServerError,
  type ServerMessage,
  type Welcome,
} from "./protocol.js";
import { BadMessage } from "./schema.js";

export type Link =
  | { readonly state: "opening" }
  | { readonly state: "open" }
  | { readonly state: "lost"; readonly retryAtMs: number; readonly reason: string }
  | { readonly state: "refused"; readonly reason: string };

export interface Listener {
  linked(link: Link): void;
  welcome(welcome: Welcome): void;
  message(message: ServerMessage): void;
  frame(header: FrameHeader, picture: Uint8Array): void;
  trouble(message: string): void; // what should not happen: messages that do not follow the protocol
}

// An answer of type error.
export class Refused extends Error {
  constructor(readonly answer: ServerError) {
    super(answer.message);
  }
}

const kFirstDelayMs = 500;
const kLongestDelayMs = 15000;
const kGreetingMs = 15000; // a connection without a welcome after so long is given up
const kMaxPending = 256;
const kNameKey = "roomlight window"; // in the storage of this tab

// The name that this tab's window had before the page was loaded again; "" where the browser keeps none.
function keptName(): string {
  try {
    return window.sessionStorage.getItem(kNameKey) ?? "";
  } catch {
    return "";
  }
}

function keepName(name: string): void {
  try {
    window.sessionStorage.setItem(kNameKey, name);
  } catch {
    // A page that is loaded again gets a new window, then.
  }
}

// From the fragment of the link, or its query.
export function tokenOf(place: { hash: string; search: string }): string {
  const fragment = place.hash.replace(/^#/, "");
  const named = new URLSearchParams(fragment).get("token");
  return named ?? (fragment || (new URLSearchParams(place.search).get("token") ?? ""));
}

// Waits before the attempts to connect: doubled each time, with a random quarter so that several windows do not come at
// once.
export function retryDelayMs(attempt: number, random: number): number {
  const delay = Math.min(kLongestDelayMs, kFirstDelayMs * 2 ** Math.min(attempt, 10));
  return delay * (0.75 + 0.25 * random);
}

interface Pending {
  resolve(message: ServerMessage): void;
  reject(reason: unknown): void;
}

export class Connection {
  private socket: WebSocket | null = null;
  private pending = new Map<number, Pending>();
  private nextId = 1;
  private attempt = 0;
  private retryTimer = 0;
  private greetingTimer = 0;
  private windowName = keptName();
  private greeted = false;

  constructor(
    private readonly origin: URL, // the page's own
    private readonly token: string,
    private readonly listener: Listener,
  ) {}

  open(): void {
    window.clearTimeout(this.retryTimer);
    if (this.socket) return;
    if (!this.token) {
      this.listener.linked({
        state: "refused",
        reason: "This link has no token. Open the link that roomlight view printed.",
      });
      return;
    }
    this.listener.linked({ state: "opening" });
    const url = new URL("live", this.origin);
    url.protocol = url.protocol === "https:" ? "wss:" : "ws:";
    url.searchParams.set("token", this.token);
    if (this.windowName) url.searchParams.set("window", this.windowName);
    const socket = new WebSocket(url);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    this.greeted = false;
    this.greetingTimer = window.setTimeout(() => socket.close(), kGreetingMs);
    socket.onmessage = (event: MessageEvent<unknown>) => this.receive(event.data);
    socket.onclose = event => {
      window.clearTimeout(this.greetingTimer);
      this.closed(event);
    };
  }

  get isOpen(): boolean {
    return this.greeted && this.socket?.readyState === WebSocket.OPEN;
  }

  // Nothing is kept for later: without a connection the notice is dropped.
  notify(notice: Notice): void {
    if (this.isOpen) this.socket?.send(JSON.stringify(notice));
  }

  request(request: Request): Promise<ServerMessage> {
    if (!this.isOpen || this.pending.size >= kMaxPending)
      return Promise.reject(new ConnectionLost("There is no connection to roomlight."));
    const id = this.nextId;
    this.nextId = id >= 2 ** 32 - 1 ? 1 : id + 1;
    return new Promise((resolve, reject) => {
      this.pending.set(id, { resolve, reject });
      this.socket?.send(JSON.stringify({ ...request, id }));
    });
  }

  private receive(data: unknown): void {
    try {
      if (data instanceof ArrayBuffer) {
        const { header, picture } = decodeFrame(data);
        this.listener.frame(header, picture);
      } else if (typeof data === "string") {
        this.dispatch(decodeMessage(data));
      }
    } catch (error) {
      if (!(error instanceof BadMessage)) throw error;
      this.listener.trouble(
        `The server sent something that this page does not understand (${error.message}). Reload the page.`,
      );
    }
  }

  private dispatch(message: ServerMessage): void {
    if (message.type === "welcome") {
      this.windowName = message.window;
      keepName(message.window);
      this.attempt = 0;
      window.clearTimeout(this.greetingTimer);
      this.greeted = true;
      this.listener.linked({ state: "open" });
      this.listener.welcome(message);
      return;
    }
    if ("id" in message && message.id !== null) {
      const waiting = this.pending.get(message.id);
      this.pending.delete(message.id);
      if (message.type === "error") waiting?.reject(new Refused(message));
      else waiting?.resolve(message);
      if (waiting) return;
    }
    this.listener.message(message);
  }

  private closed(event: CloseEvent): void {
    const wasGreeted = this.greeted;
    this.socket = null;
    this.greeted = false;
    const waiting = [...this.pending.values()];
    this.pending.clear();
    for (const { reject } of waiting) reject(new ConnectionLost("The connection was lost before the answer came."));
    if (wasGreeted) this.retryLater(event.reason || "The connection was lost.");
    else void this.explain();
  }

  private retryLater(reason: string): void {
    const delay = retryDelayMs(this.attempt++, Math.random());
    this.listener.linked({ state: "lost", retryAtMs: Date.now() + delay, reason });
    window.clearTimeout(this.retryTimer);
    this.retryTimer = window.setTimeout(() => this.open(), delay);
  }

  // Browsers do not tell why an upgrade was refused. A plain request of the same address does: 403 for a token that is
  // not the server's.
  private async explain(): Promise<void> {
    const url = new URL("live", this.origin);
    url.searchParams.set("token", this.token);
    let status = 0;
    try {
      status = (await fetch(url, { cache: "no-store" })).status;
    } catch {
      // No server there at all.
    }
    if (status === 403) {
      const reason =
        "roomlight refuses this link: its token is not that of the running program. " +
        "Open the link that roomlight view printed.";
      this.listener.linked({ state: "refused", reason });
    } else if (status === 503) {
      this.retryLater("Too many windows are open on this home. Close one of them.");
    } else {
      this.retryLater(
        status === 0 ? "roomlight does not answer. Is the program running?" : "The connection could not be made.",
      );
    }
  }
}
