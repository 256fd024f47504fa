// The real program for the tests: `roomlight view` on a sample home, and a line to it that can be cut.
import assert from "node:assert/strict";
import { spawn, type ChildProcess } from "node:child_process";
import { existsSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { connect, createServer, type Server, type Socket } from "node:net";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";

const kProgram = resolve(process.env.ROOMLIGHT_PROGRAM ?? "../build/release/roomlight");
const kHome = resolve("../build/samples/room.sh3d");
const kStartMs = 180000;

export const kLampName = "Lamp of the test";

// An evening in winter: the lamps of the home, one more in the middle of the room, and the last daylight.
const kLighting = {
  scene: { suns: "off", sky: "off" },
  lamps: [{ name: kLampName, type: "point", position: [2.5, 1.7, 1.9], flux: "900 lm", temperature: "3000 K" }],
  daylight: { sky: "clear", latitude: 48.14, longitude: 11.58, time: "2026-11-20T16:00+01:00" },
  glazing: [{ material: "Glass", panes: 1 }],
};

export function noProgram(): string | false {
  if (!existsSync(kProgram))
    return `${kProgram} is missing: run scripts/build, or name the program by ROOMLIGHT_PROGRAM`;
  if (!existsSync(kHome)) return `${kHome} is missing: run scripts/make-samples`;
  return false;
}

export interface Program {
  readonly link: string;
  readonly port: number;
  end(): Promise<number | null>;
}

// Resolves with the link that the program prints; rejects with what it said if it ends before.
export function startProgram(port = 0, light: object = kLighting): Promise<Program> {
  const folder = mkdtempSync(join(tmpdir(), "roomlight-view-"));
  const lighting = join(folder, "evening.json");
  writeFileSync(lighting, JSON.stringify(light));
  const page = resolve("dist");
  const options = [
    "view",
    kHome,
    "--lighting",
    lighting,
    "--no-open",
    "--quiet",
    "--viewer",
    page,
    "--port",
    String(port),
  ];
  const child = spawn(kProgram, options, { stdio: ["ignore", "pipe", "pipe"] });
  return new Promise((done, failed) => {
    let said = "";
    const timer = setTimeout(() => {
      child.kill("SIGKILL");
      failed(new Error(`no link within ${kStartMs} ms: ${said}`));
    }, kStartMs);
    child.stderr.on("data", data => (said += String(data)));
    child.stdout.on("data", data => {
      said += String(data);
      const link = /http:\/\/\S+/.exec(said)?.[0];
      if (!link) return;
      clearTimeout(timer);
      done({ link, port: Number(new URL(link).port), end: () => ended(child, folder) });
    });
    child.on("error", failed);
    child.on("exit", code => {
      clearTimeout(timer);
      failed(new Error(`the program ended with ${code}: ${said}`));
    });
  });
}

function ended(child: ChildProcess, folder: string): Promise<number | null> {
  return new Promise(done => {
    const kill = setTimeout(() => child.kill("SIGKILL"), 20000);
    const gone = (code: number | null) => {
      clearTimeout(kill);
      rmSync(folder, { recursive: true, force: true });
      done(code);
    };
    if (child.exitCode !== null) gone(child.exitCode);
    else child.once("exit", gone);
    child.kill("SIGINT");
  });
}

export interface Line {
  readonly link: string;
  drop(): void; // cuts all connections; new ones are let through
  close(): Promise<void>;
}

// A request as the program takes it: to its own address, of a page from there. What is no request stays as it is.
function addressed(bytes: Buffer, host: string): Buffer {
  return bytes.subarray(0, 4).equals(Buffer.from("GET "))
    ? Buffer.from(bytes.toString("latin1").replaceAll(host, "127.0.0.1"), "latin1")
    : bytes;
}

// The program by way of another address of this machine, where the connection can be cut.
export async function lineTo(program: Program): Promise<Line> {
  const host = "127.0.0.2";
  const sockets = new Set<Socket>();
  const server: Server = createServer(near => {
    const far = connect(program.port, "127.0.0.1");
    for (const [a, b] of [
      [near, far],
      [far, near],
    ] as const) {
      sockets.add(a);
      a.on("data", (bytes: Buffer) => b.write(a === near ? addressed(bytes, host) : bytes));
      a.on("end", () => b.end());
      a.on("error", () => b.destroy());
      a.on("close", () => {
        sockets.delete(a);
        b.destroy();
      });
    }
  });
  await new Promise<void>((listening, failed) => server.once("error", failed).listen(program.port, host, listening));
  const drop = () => sockets.forEach(socket => socket.destroy());
  const link = program.link.replace("127.0.0.1", host);
  assert.notEqual(link, program.link);
  return {
    link,
    drop,
    close: () => {
      drop();
      return new Promise(closed => server.close(() => closed()));
    },
  };
}
