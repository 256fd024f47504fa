// A real browser for the tests: Debian's Chromium, with whatever the console says kept for the end.
import assert from "node:assert/strict";
import { existsSync, mkdirSync } from "node:fs";
import { chromium, type Browser, type BrowserContextOptions, type Locator, type Page } from "playwright-core";

export const kBrowser = process.env.ROOMLIGHT_CHROMIUM ?? "/usr/bin/chromium";
export const kShots = process.env.ROOMLIGHT_SHOTS ?? "build/shots";

// Why the tests that need a browser cannot run; false if they can.
export function noBrowser(): string | false {
  return existsSync(kBrowser)
    ? false
    : `${kBrowser} is missing: install Debian's chromium, or name one by ROOMLIGHT_CHROMIUM`;
}

export const kDesktop: BrowserContextOptions = { viewport: { width: 1280, height: 720 }, reducedMotion: "reduce" };
export const kPhone: BrowserContextOptions = {
  viewport: { width: 390, height: 844 },
  deviceScaleFactor: 2,
  hasTouch: true,
  isMobile: true,
  reducedMotion: "reduce",
};

export function launch(): Promise<Browser> {
  mkdirSync(kShots, { recursive: true });
  return chromium.launch({ executablePath: kBrowser, args: ["--no-sandbox", "--disable-gpu", "--lang=en-GB"] });
}

export interface Visit {
  readonly page: Page;
  readonly stage: Locator;
  readonly complaints: string[]; // errors and warnings of the console, errors of scripts, requests to elsewhere
  shot(name: string): Promise<void>;
  end(): Promise<void>; // fails if there were complaints
}

export async function visit(browser: Browser, link: string, options: BrowserContextOptions = kDesktop): Promise<Visit> {
  const context = await browser.newContext({ acceptDownloads: true, locale: "en-GB", ...options });
  const page = await context.newPage();
  page.setDefaultTimeout(60000);
  const complaints: string[] = [];
  page.on("console", message => {
    if (["error", "warning"].includes(message.type())) complaints.push(`${message.type()}: ${message.text()}`);
  });
  page.on("pageerror", error => complaints.push(`script: ${error.message}`));
  page.on("request", request => {
    const { origin, protocol } = new URL(request.url());
    if (protocol !== "blob:" && origin !== new URL(link).origin) complaints.push(`request to ${origin}`);
  });
  await page.goto(link);
  return {
    page,
    stage: page.locator("rl-stage"),
    complaints,
    shot: async name => void (await page.screenshot({ path: `${kShots}/${name}.png` })),
    end: async () => {
      await context.close();
      assert.deepEqual(complaints, []);
    },
  };
}

// Waits until the page shows a frame that fits.
export async function frameWith(
  visited: Visit,
  fits: (data: DOMStringMap) => boolean,
  timeoutMs = 60000,
): Promise<void> {
  const end = Date.now() + timeoutMs;
  for (;;) {
    const data = await visited.stage.evaluate(stage => ({ ...(stage as HTMLElement).dataset }));
    if (data.frame !== undefined && fits(data)) return;
    assert.ok(Date.now() < end, `no such frame within ${timeoutMs} ms; the last: ${JSON.stringify(data)}`);
    await visited.page.waitForTimeout(50);
  }
}

export const settled = (visited: Visit): Promise<void> => frameWith(visited, ({ settled: done }) => done === "true");

// Mean of the red, green and blue of a part of the picture, 0 to 255; places as fractions of it.
export function meanColor(
  visited: Visit,
  left: number,
  top: number,
  right: number,
  bottom: number,
): Promise<[number, number, number]> {
  return visited.page.locator("rl-stage #picture").evaluate(
    (canvas, [l, t, r, b]) => {
      const { width, height } = canvas as HTMLCanvasElement;
      const x = Math.floor(l! * width);
      const y = Math.floor(t! * height);
      const w = Math.max(1, Math.floor(r! * width) - x);
      const h = Math.max(1, Math.floor(b! * height) - y);
      const copy = new OffscreenCanvas(w, h).getContext("2d", { willReadFrequently: true })!;
      copy.drawImage(canvas as HTMLCanvasElement, x, y, w, h, 0, 0, w, h);
      const { data } = copy.getImageData(0, 0, w, h);
      const sum = [0, 0, 0];
      for (let i = 0; i < data.length; i += 4) for (let c = 0; c < 3; ++c) sum[c]! += data[i + c]!;
      return sum.map(s => s / (w * h)) as [number, number, number];
    },
    [left, top, right, bottom],
  );
}

export async function stageBox(visited: Visit): Promise<{ x: number; y: number; width: number; height: number }> {
  const box = await visited.stage.boundingBox();
  assert.ok(box);
  return box;
}

export const tab = (visited: Visit, name: string): Promise<void> => visited.page.getByRole("tab", { name }).click();

// Chooses from the list of the home by name.
export async function choose(visited: Visit, kind: string, name: string): Promise<void> {
  await tab(visited, "Home");
  await visited.page.getByRole("radio", { name: kind, exact: true }).click();
  await visited.page.getByRole("option", { name }).first().click();
}

// Goes to where the chosen lamp or thing is seen well.
export const show = (visited: Visit): Promise<void> =>
  visited.page.getByRole("button", { name: "Show", exact: true }).click();

// Polls until a value is as wanted.
export async function until(what: string, holds: () => boolean | Promise<boolean>, timeoutMs = 15000): Promise<void> {
  const end = Date.now() + timeoutMs;
  while (!(await holds())) {
    assert.ok(Date.now() < end, `not within ${timeoutMs} ms: ${what}`);
    await new Promise(resolve => setTimeout(resolve, 40));
  }
}
