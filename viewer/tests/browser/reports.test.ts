// Plots of reports in Chromium, from a file, as the program writes them.
import assert from "node:assert/strict";
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { resolve } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import type { Browser, Page } from "playwright-core";
import { kPhone, launch, noBrowser, until, visit, type Visit } from "./support.js";

const kScript = "dist-reports/index.html";
const skip = noBrowser() || (existsSync(kScript) ? false : `${kScript} is missing: npm run build-reports`);
let browser: Browser;

if (!skip) {
  before(async () => {
    browser = await launch();
  });
  after(() => browser.close());
}

const kFront = {
  axes: [
    { title: "misses its goals by", unit: "%" },
    { title: "cost", unit: "EUR" },
    { title: "power", unit: "W" },
  ],
  points: Array.from({ length: 80 }, (_, i) => {
    const v = [40 * Math.exp(-i / 20), 60 + 12 * i, 20 + ((i * 37) % 50)];
    const design = [10, 30, 60].indexOf(i) + 1;
    return design > 0 ? { v, design } : { v };
  }),
};

const curve = (name: string, colour: string, startS: number, bias: number) => ({
  name,
  colour,
  settled: 3,
  points: Array.from({ length: 6 }, (_, i) => [2 ** i, startS * 1.7 ** i, bias + 0.04 / 4 ** i]),
});
const study = (title: string) => ({
  title,
  curves: [
    curve("cone", "#0072b2", 0.4, 0.0034),
    curve("lpv, 256", "#d55e00", 0.2, 0.009),
    curve("path", "#777777", 3, 1e-7),
  ],
  others: [{ name: "offline </script>", seconds: 41, mse: 0.0009 }],
});
const kStudy = { cases: [study("Kitchen, day"), study("Bath, night"), { title: "Cellar", curves: [], others: [] }] };
const kErrors = {
  rows: ["path", "hybrid", "cone"].map((name, row) => ({
    name,
    allowed: [1, 3, 10][row],
    values: Array.from({ length: 60 }, (_, i) => {
      const error = Math.sin(i * 7.3) * [0.9, 2.8, 13][row]!;
      return { text: `case ${i}, middle: ${error.toFixed(2)} %`, error, met: Math.abs(error) < 11 };
    }),
  })),
};

// As report::plot of src/report writes it.
const plot = (kind: string, label: string, data: unknown) =>
  `<div class="plot" data-plot="${kind}" role="group" aria-label="${label}"><p class="soft">Words for it</p>` +
  `<script type="application/json">${JSON.stringify(data).replaceAll("<", "\\u003c")}</script></div>`;

function writeReport(name: string, plots: string, script = readFileSync(kScript, "utf8")): string {
  mkdirSync("build/report-pages", { recursive: true });
  const path = resolve(`build/report-pages/${name}.html`);
  writeFileSync(
    path,
    `<!doctype html><html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">` +
      `<title>Report</title><style>body{margin:0;font:15px/1.5 Helvetica,Arial,"Liberation Sans",sans-serif}` +
      `main{max-width:1180px;margin:0 auto;padding:20px}</style><main>${plots}` +
      `${[1, 2, 3].map(i => `<h2 id="design${i}">Design ${i}</h2>`).join("")}</main>${script}</html>`,
  );
  return pathToFileURL(path).href;
}
const kBoth = plot("front", "The front", kFront) + plot("curves", "Error over time", kStudy);

// The pixels of a canvas that are of a colour: how many, and their middle in CSS pixels.
const pixels = (
  page: Page,
  which: number,
  colour: readonly number[],
): Promise<{ count: number; x: number; y: number }> =>
  page
    .locator("canvas")
    .nth(which)
    .evaluate((element, wanted) => {
      const canvas = element as HTMLCanvasElement;
      const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d", { willReadFrequently: true })!;
      copy.drawImage(canvas, 0, 0);
      const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
      const sum = { count: 0, x: 0, y: 0 };
      for (let i = 0; i < data.length; i += 4) {
        if (data[i + 3]! < 200 || wanted.some((c, k) => Math.abs(data[i + k]! - c) > 6)) continue;
        ++sum.count;
        sum.x += (i / 4) % canvas.width;
        sum.y += Math.floor(i / 4 / canvas.width);
      }
      const scale = canvas.clientWidth / canvas.width / sum.count;
      return { count: sum.count, x: sum.x * scale, y: sum.y * scale };
    }, colour);
const countPixels = async (page: Page, which: number, colour: readonly number[]): Promise<number> =>
  (await pixels(page, which, colour)).count;

const kBlue = [0, 114, 178];
const kBlack = [17, 17, 17];
const kGrey = [123, 141, 166];

async function pointAt(visited: Visit, which: number, x: number, y: number): Promise<void> {
  const box = await visited.page.locator(".u-over").nth(which).boundingBox();
  assert.ok(box);
  await visited.page.mouse.move(box.x + x - 3, box.y + y);
  await visited.page.mouse.move(box.x + x, box.y + y);
}

test("a front is drawn, told, zoomed, and leads to its designs", { skip }, async () => {
  const visited = await visit(browser, writeReport("both", kBoth));
  const { page } = visited;
  assert.equal(await page.locator("canvas").count(), 3, "none of a case without points");
  assert.ok((await countPixels(page, 0, kGrey)) > 500, "dots of the front");
  await visited.shot("report-front");
  await page.getByRole("img", { name: "The front" }).waitFor();
  assert.equal(await page.getByText("Words for it").count(), 0);

  // Its tooltip has all numbers of a design.
  const links = page.locator(".proposal");
  await links.nth(1).hover();
  const tip = page.locator(".tip:visible");
  assert.match((await tip.textContent())!, /^Design 2: misses its goals by [\d.]+ %, cost 420 EUR, power 30 W$/);
  await visited.shot("report-front-tip");
  await links.nth(1).click();
  assert.equal(new URL(page.url()).hash, "#design2");

  // By keys alone.
  await links.nth(2).focus();
  assert.match((await tip.textContent())!, /^Design 3: /);
  await page.keyboard.press("Enter");
  assert.equal(new URL(page.url()).hash, "#design3");
  await page.evaluate(() => scrollTo(0, 0));

  const across = () => links.nth(0).evaluate(link => parseFloat((link as HTMLElement).style.left));
  const before = await across();
  await page.getByRole("button", { name: "Zoom in" }).click();
  await until("a design leaves the middle", async () => Math.abs((await across()) - before) > 20);
  await page.getByRole("button", { name: "Show all" }).click();
  await until("all again", async () => Math.abs((await across()) - before) < 0.5);
  await pointAt(visited, 0, 300, 200);
  await page.mouse.wheel(0, -300);
  await until("the wheel zooms", async () => Math.abs((await across()) - before) > 5);
  await page.getByRole("button", { name: "Show all" }).click();
  await until("all again", async () => Math.abs((await across()) - before) < 0.5);

  // A dragged box, and a double click.
  await pointAt(visited, 0, 60, 30);
  await page.mouse.down();
  await pointAt(visited, 0, 500, 300);
  await visited.shot("report-front-box");
  await page.mouse.up();
  await until("the box fills the plot", async () => Math.abs((await across()) - before) > 20);
  await visited.shot("report-front-zoomed");
  await page
    .locator(".u-over")
    .first()
    .dblclick({ position: { x: 30, y: 20 } });
  await until("all again", async () => Math.abs((await across()) - before) < 0.5);

  await page.getByLabel("up").selectOption("power (W)");
  await until("another axis", async () => (await countPixels(page, 0, kGrey)) > 500);
  await visited.shot("report-front-power");
  await visited.end();
});

test("curves are drawn, told, hidden and shown again", { skip }, async () => {
  const visited = await visit(browser, writeReport("both", kBoth));
  const { page } = visited;
  await page.getByRole("heading", { name: "Kitchen, day" }).scrollIntoViewIfNeeded();
  const drawn = await countPixels(page, 1, kBlue);
  assert.ok(drawn > 300);
  await page.locator('[data-plot="curves"]').screenshot({ path: "build/shots/report-curves.png" });
  const diamond = await pixels(page, 1, kBlack);
  await page.locator("canvas").nth(1).hover({ position: diamond, force: true });
  const told = await page.locator(".tip:visible").textContent();
  assert.equal(told, "offline </script>: 41.00 s, mse beyond noise 0.00090");
  const key = page.getByRole("button", { name: "cone" });
  await key.click();
  assert.equal(await key.getAttribute("aria-pressed"), "false");
  await until("no curve", async () => (await countPixels(page, 1, kBlue)) === 0);
  assert.equal(await countPixels(page, 2, kBlue), 0, "in no plot");
  for (const name of ["lpv, 256", "path"]) await page.getByRole("button", { name }).click();
  await key.click();
  await until("the curve again", async () => (await countPixels(page, 1, kBlue)) >= drawn);
  assert.equal(await page.getByText("nothing measured").count(), 1);
  await visited.end();
});

test("errors stand in rows before what is allowed", { skip }, async () => {
  const visited = await visit(browser, writeReport("errors", plot("errors", "Error of every value", kErrors)));
  assert.ok((await countPixels(visited.page, 0, [228, 242, 234])) > 2000, "bands");
  await visited.shot("report-errors");
  await visited.end();
});

test("plots fit the window of a phone, and one that gets wider", { skip }, async () => {
  const visited = await visit(browser, writeReport("both", kBoth), kPhone);
  const widths = () =>
    visited.page.evaluate(() => [document.documentElement.scrollWidth, document.querySelector("canvas")!.clientWidth]);
  const [page, canvas] = await widths();
  assert.equal(page, 390);
  assert.ok(canvas! <= 350);
  await visited.shot("report-phone");
  await visited.page.setViewportSize({ width: 800, height: 600 });
  await until("a wider plot", async () => (await widths())[1]! > 700);
  await visited.end();
});

test("without what draws them plots are words", { skip }, async () => {
  const visited = await visit(browser, writeReport("words", kBoth, ""));
  assert.equal(await visited.page.locator("canvas").count(), 0);
  assert.equal(await visited.page.getByText("Words for it").count(), 2);
  await visited.end();
});
