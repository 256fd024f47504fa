// Pictures of a baked home for measuring: node shoot_baked.js PAGE WIDTHxHEIGHT < [{"hash": "#..", "file": ".png"}, ..]
// Writes the pictures, and to stdout what they cost: [{"calls", "textureBytes", ..}, ..].
import { writeFileSync } from "node:fs";
import { text } from "node:stream/consumers";
import { pathToFileURL } from "node:url";
import { launchWithWebGl, visitHome } from "./baked_support.js";
import { countTextureBytes, textureBytes } from "./texture_bytes.js";

interface Shot {
  readonly hash: string;
  readonly file: string;
}

const kLongestMs = 1800000; // a large house takes minutes without a graphics card
const [, , path, size] = process.argv;
const [width, height] = (size ?? "").split("x").map(Number);
if (!path || !width || !height) throw new Error("usage: shoot_baked PAGE WIDTHxHEIGHT < shots.json");
const shots = JSON.parse(await text(process.stdin)) as Shot[];
const browser = await launchWithWebGl();
const costs = [];
const viewport = { width, height };
const link = pathToFileURL(path).href;
const visit = await visitHome(
  browser,
  link + (shots[0]?.hash ?? ""),
  { viewport, reducedMotion: "reduce" },
  countTextureBytes,
);
const { page } = visit;
const panel = page.getByLabel("Close controls", { exact: true });
await page.locator("#view").waitFor();
if (await panel.isVisible()) await panel.click();
await page.addStyleTag({ content: "body > :not(#view) { visibility: hidden !important; }" });
for (const { hash, file } of shots) {
  await page.evaluate(to => void (location.hash = to), hash);
  await visit.settled(kLongestMs);
  const view = await page.locator("#view").boundingBox();
  if (view?.width !== width || view.height !== height)
    throw new Error(`the picture is ${view?.width}x${view?.height} instead of ${size}`);
  writeFileSync(file, await page.screenshot());
  const told = await page.locator("#view").evaluate(v => ({ ...(v as HTMLElement).dataset }));
  costs.push({ ...told, textureBytes: await textureBytes(page) });
}
await visit.end();
await browser.close();
process.stdout.write(JSON.stringify(costs));
