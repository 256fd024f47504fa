// A double of `roomlight view` for tests of the page: speaks docs/reference/view-protocol.md about a home of boxes. Its
// frames are PNG, which browsers tell from JPEG by themselves.
import { randomBytes } from "node:crypto";
import { readFile } from "node:fs/promises";
import { createServer, type IncomingMessage, type Server, type ServerResponse } from "node:http";
import type { AddressInfo, Socket } from "node:net";
import { extname, join } from "node:path";
import { WebSocketServer } from "ws";
import { Desk } from "./desk.js";
import { encodePng } from "./png.js";
import type { Display } from "../../src/protocol.js";
import { Window, type Camera, type Growth } from "./window.js";

const kTypes: Readonly<Record<string, string>> = {
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript; charset=utf-8",
  ".css": "text/css; charset=utf-8",
  ".svg": "image/svg+xml",
};
export const kPolicy =
  "default-src 'self'; script-src 'self'; style-src 'self'; img-src 'self' blob:; connect-src 'self'; " +
  "object-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

export interface Double {
  readonly link: string;
  readonly port: number;
  readonly token: string;
  readonly desk: Desk;
  dropAll(): void; // cuts every connection
  sendAll(data: string | Buffer): void; // whatever it is
  growAll(growth: Growth): void; // every window gets its picture anew, as far as this
  lastCamera(): Camera | null; // that the window which was opened last has told
  lastDisplay(): Display | null;
  close(): Promise<void>;
}

async function page(folder: string, path: string, response: ServerResponse): Promise<void> {
  const name = path === "/" ? "/index.html" : path;
  if (name.includes("..")) {
    response.writeHead(404).end();
    return;
  }
  try {
    const data = await readFile(join(folder, name));
    response.writeHead(200, {
      "content-type": kTypes[extname(name)] ?? "application/octet-stream",
      "content-security-policy": kPolicy,
    });
    response.end(data);
  } catch {
    response.writeHead(404).end();
  }
}

export async function startDouble(folder: string, port = 0, token = randomBytes(16).toString("hex")): Promise<Double> {
  const desk = new Desk();
  const windows = new Set<Window>();
  const given = new Set<string>(); // files are given away once
  const sockets = new Set<Socket>();
  const allowed = (request: IncomingMessage) =>
    new URL(request.url ?? "/", "http://here").searchParams.get("token") === token;
  const server: Server = createServer((request, response) => {
    const { pathname } = new URL(request.url ?? "/", "http://here");
    if (pathname === "/live") response.writeHead(allowed(request) ? 426 : 403).end();
    else if (pathname.startsWith("/files/")) {
      if (allowed(request) && given.has(pathname)) response.writeHead(404).end();
      else if (allowed(request) && given.add(pathname))
        response.writeHead(200, { "content-type": "image/png" }).end(encodePng(new Uint8Array(12).fill(160), 2, 2));
      else response.writeHead(403).end();
    } else void page(folder, pathname, response);
  });
  const live = new WebSocketServer({ noServer: true, maxPayload: 65536 });
  server.on("upgrade", (request, socket, head) => {
    if (!allowed(request)) {
      socket.end("HTTP/1.1 403 Forbidden\r\nConnection: close\r\nContent-Length: 0\r\n\r\n");
      return;
    }
    live.handleUpgrade(request, socket, head, line => {
      const window = new Window(desk, line, change => windows.forEach(w => w.tell(change)));
      windows.add(window);
      line.on("close", () => {
        window.close();
        windows.delete(window);
      });
    });
  });
  server.on("connection", socket => {
    sockets.add(socket);
    socket.on("close", () => sockets.delete(socket));
  });
  await new Promise<void>(resolve => server.listen(port, "127.0.0.1", resolve));
  const bound = (server.address() as AddressInfo).port;
  const dropAll = () => sockets.forEach(socket => socket.destroy());
  return {
    link: `http://127.0.0.1:${bound}/#${token}`,
    port: bound,
    token,
    desk,
    dropAll,
    sendAll: data => windows.forEach(window => window.sendRaw(data)),
    growAll: growth => windows.forEach(window => window.grow(growth)),
    lastCamera: () => [...windows].at(-1)?.eye ?? null,
    lastDisplay: () => [...windows].at(-1)?.display ?? null,
    close: async () => {
      dropAll();
      live.close();
      await new Promise<void>(resolve => server.close(() => resolve()));
    },
  };
}
