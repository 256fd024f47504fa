// The page of a baked home in Chromium, from a file, with WebGL reckoned by the processor.
import assert from "node:assert/strict";
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import type { AddressInfo } from "node:net";
import { resolve } from "node:path";
import { deflateSync } from "node:zlib";
import { pathToFileURL } from "node:url";
import { chromium, type Browser, type BrowserContextOptions, type Page } from "playwright-core";
import type { Vec3 } from "../../src/vector.js";
import { textOf } from "../double/page_text.js";
import { kBrowser, kShots, noBrowser } from "./support.js";

const kPage = "dist-baked/index.html";
const kMarker = "<!--roomlight-home-->";
// What a processor in place of a graphics card makes Chromium remark on.
const kRemarks = /GPU stall due to ReadPixels|software WebGL|swiftshader/i;

export const noBakedPage = (): string | false =>
  noBrowser() || (existsSync(kPage) ? false : `${kPage} is missing: npm run build-baked`);

// WebGL by the processor (SwiftShader), or by the graphics card if ROOMLIGHT_ANGLE names an interface to it: vulkan,
// gl-egl, metal or d3d11.
export const kAngle = process.env.ROOMLIGHT_ANGLE ?? "swiftshader";

export function launchWithWebGl(...more: string[]): Promise<Browser> {
  mkdirSync(kShots, { recursive: true });
  const software = "--enable-unsafe-swiftshader";
  const card = kAngle !== "swiftshader";
  const kind = card ? ["--enable-gpu", "--ignore-gpu-blocklist"] : [software];
  return chromium.launch({
    executablePath: kBrowser,
    ignoreDefaultArgs: card ? [software] : [],
    args: ["--no-sandbox", "--use-gl=angle", `--use-angle=${kAngle}`, ...kind, "--lang=en-GB", ...more],
  });
}

export const launchWithoutWebGl = (): Promise<Browser> =>
  chromium.launch({ executablePath: kBrowser, args: ["--no-sandbox", "--disable-gpu", "--disable-3d-apis"] });

// The page with a home in it, as the program writes it.
export function writePage(name: string, file: Uint8Array | null): string {
  mkdirSync("build/baked-pages", { recursive: true });
  const path = resolve(`build/baked-pages/${name}.html`);
  const page = readFileSync(kPage, "utf8");
  assert.ok(page.includes(kMarker));
  const packed = file ? textOf(deflateSync(file)) : "";
  const data = file
    ? `<script type="application/octet-stream" id="roomlight-home" data-bytes="${file.length}">${packed}</script>`
    : "";
  writeFileSync(
    path,
    page.replace(kMarker, () => data),
  );
  return pathToFileURL(path).href;
}

const linking = () => readFileSync(kPage, "utf8").replace(kMarker, '<link id="roomlight-home" href="home-0.glb">');

// The page of a folder, opened without a server.
export function writeLinkingPage(name: string): string {
  const path = resolve(`build/baked-pages/${name}.html`);
  writeFileSync(path, linking());
  return pathToFileURL(path).href;
}

// A folder with the page and the file beside it, as a web server gives it out.
export async function serveFolder(file: Uint8Array): Promise<{ link: string; end(): Promise<void> }> {
  const page = linking();
  const server = createServer((request, response) => {
    if (request.url === "/") response.writeHead(200, { "content-type": "text/html" }).end(page);
    else if (request.url === "/home-0.glb") response.writeHead(200, { "content-length": file.length }).end(file);
    else response.writeHead(404).end();
  });
  await new Promise<void>(ready => server.listen(0, "127.0.0.1", ready));
  const { port } = server.address() as AddressInfo;
  const end = () => new Promise<void>(done => void server.close(() => done()));
  return { link: `http://127.0.0.1:${port}/`, end };
}

export interface BakedVisit {
  readonly page: Page;
  settled(timeoutMs?: number): Promise<void>;
  frames(): Promise<number>; // drawn so far
  stopped(): Promise<string>; // the one line that says why
  shot(name: string): Promise<void>;
  color(x: number, y: number): Promise<Vec3>; // mean of 8 x 8 pixels about a place, 0 to 1
  end(): Promise<void>;
}

export async function visitHome(
  browser: Browser,
  link: string,
  options: BrowserContextOptions = {},
  before: (page: Page) => Promise<void> = async () => {},
): Promise<BakedVisit> {
  const context = await browser.newContext({ acceptDownloads: true, locale: "en-GB", ...options });
  const page = await context.newPage();
  await before(page);
  page.setDefaultTimeout(30000);
  const complaints: string[] = [];
  page.on("console", message => {
    if (["error", "warning"].includes(message.type()) && !kRemarks.test(message.text()))
      complaints.push(`${message.type()}: ${message.text()}`);
  });
  page.on("pageerror", error => complaints.push(`script: ${error.message}`));
  page.on("request", request => {
    const own = /^(file|blob|data):/.test(request.url()) || new URL(request.url()).origin === new URL(link).origin;
    if (!own) complaints.push(`request to ${request.url()}`);
  });
  await page.goto(link);
  const stopped = () => page.waitForFunction(() => document.documentElement.dataset.stopped === "true");
  return {
    page,
    settled: async (timeout = 180000) => {
      // What has just been set shows in the frame after next.
      await page.evaluate(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done))));
      await page.waitForFunction(() => document.getElementById("view")?.dataset.settled === "true", null, { timeout });
    },
    frames: () => page.locator("#view").evaluate(view => Number((view as HTMLElement).dataset.frames)),
    stopped: async () => {
      await stopped();
      return (await page.locator("#line").textContent()) ?? "";
    },
    shot: async name => void (await page.screenshot({ path: `${kShots}/${name}.png` })),
    color: async (x, y) => {
      const clip = { x: x - 4, y: y - 4, width: 8, height: 8 };
      const png = (await page.screenshot({ clip })).toString("base64");
      return page.evaluate(async data => {
        const image = new Image();
        image.src = `data:image/png;base64,${data}`;
        await image.decode();
        const canvas = new OffscreenCanvas(image.width, image.height).getContext("2d")!;
        canvas.drawImage(image, 0, 0);
        const pixels = canvas.getImageData(0, 0, image.width, image.height).data;
        const sum: [number, number, number] = [0, 0, 0];
        for (let i = 0; i < pixels.length; ++i) if (i % 4 < 3) sum[i % 4]! += pixels[i]!;
        const count = (pixels.length / 4) * 255;
        return [sum[0] / count, sum[1] / count, sum[2] / count] as const;
      }, png);
    },
    end: async () => {
      await context.close();
      assert.deepEqual(complaints, []);
    },
  };
}

// A slider is set by its label.
export const slide = (page: Page, label: string, value: number): Promise<void> =>
  page.getByLabel(label, { exact: true }).evaluate((input, to) => {
    (input as HTMLInputElement).value = String(to);
    input.dispatchEvent(new Event("input", { bubbles: true }));
  }, value);
