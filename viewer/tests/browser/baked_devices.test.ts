// The page of a baked home with devices that only an emulator has: a headset (WebXR) and a gamepad.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import type { XRDevice } from "iwer";
import type { Browser, Page } from "playwright-core";
import { exposureFromEv100, toned } from "../../baked/src/tone.js";
import { bakedHome, kAlbedo, kEv100, kLampLux } from "../double/baked_home.js";
import { launchWithWebGl, noBakedPage, visitHome, writePage } from "./baked_support.js";

const skip = noBakedPage();
const kOptions = { viewport: { width: 960, height: 540 }, reducedMotion: "reduce" } as const;
let browser: Browser;
let home = "";

if (!skip) {
  before(async () => {
    browser = await launchWithWebGl();
    home = writePage("devices", bakedHome());
  });
  after(() => browser.close());
}

interface Emulated {
  headset: XRDevice;
  IWER: typeof import("iwer");
}

// What the page finds in place of a headset that it is the first to ask for.
async function wear(page: Page): Promise<void> {
  await page.addInitScript({ content: await readFile("node_modules/iwer/build/iwer.min.js", "utf8") });
  await page.addInitScript(() => {
    const emulated = window as unknown as Emulated;
    const { XRDevice, metaQuest3 } = emulated.IWER;
    emulated.headset = new XRDevice(metaQuest3, { stereoEnabled: true });
    emulated.headset.installRuntime({ forceInstall: true });
  });
}

const eyeOf = (page: Page) => /eye=([^&]+)/.exec(page.url())![1]!.split(",").map(Number);

test("a headset shows both eyes the lit room, and its trigger goes to a place on the floor", { skip }, async () => {
  const visit = await visitHome(browser, home, kOptions, wear);
  const { page } = visit;
  await visit.settled();
  await page.getByLabel("Automatic exposure").uncheck();
  await page.getByRole("button", { name: "Enter VR" }).click();
  await page.waitForFunction(() => (window as unknown as Emulated).headset.activeSession !== undefined);
  await page.waitForTimeout(1500); // some frames
  // The far wall is level with both eyes.
  const exposure = exposureFromEv100(kEv100);
  const expected = toned(
    kLampLux[0]!.map(c => (c * kAlbedo * exposure) / Math.PI) as unknown as (typeof kLampLux)[0],
    "agx",
  );
  await visit.shot("baked-headset");
  const [panelPx, heightPx] = [320, kOptions.viewport.height];
  for (const share of [0.25, 0.75]) {
    const seen = await visit.color(share * (kOptions.viewport.width - panelPx), 0.5 * heightPx);
    seen.forEach((c, i) => assert.ok(Math.abs(c - expected[i]!) < 0.015, `eye ${share}: ${seen} is not ${expected}`));
  }
  // The right hand points ahead and down by 45 degrees: from a height of 1.2 m the ray meets the floor 1.2 m ahead.
  await page.evaluate(() => {
    const hands = (window as unknown as Emulated).headset.controllers;
    for (const hand of [hands.left!, hands.right!]) {
      hand.position.set(0, 1.2, 0);
      hand.quaternion.set(-Math.sin(Math.PI / 8), 0, 0, Math.cos(Math.PI / 8));
    }
  });
  await page.waitForTimeout(800);
  for (const value of [1, 0]) {
    await page.evaluate(
      v => (window as unknown as Emulated).headset.controllers.right!.updateButtonValue("trigger", v),
      value,
    );
    await page.waitForTimeout(500);
  }
  await visit.shot("baked-headset-gone");
  await page.evaluate(() => (window as unknown as Emulated).headset.activeSession!.end());
  await visit.settled();
  const { width: canvasPx } = (await page.locator("#view").boundingBox())!;
  assert.equal(
    await page.locator("#view").evaluate(v => (v as HTMLCanvasElement).width),
    canvasPx,
    "as many pixels as before",
  );
  await page.getByLabel("Pendant: on", { exact: true }).uncheck();
  await page.waitForTimeout(800);
  const [x, y, z] = eyeOf(page);
  assert.ok(Math.abs(x! - 2) < 0.1 && Math.abs(y! - 1.6) < 0.1, `${[x, y, z]}`);
  assert.ok(Math.abs(z! - 2.8) < 0.2, `1.2 m nearer to the wall than 4 m: ${z}`);
  await visit.end();
});

test("a headset that does not start is one line", { skip }, async () => {
  const visit = await visitHome(browser, home, kOptions, async page => {
    await wear(page);
    await page.addInitScript(() => {
      navigator.xr!.requestSession = () => Promise.reject(new Error("busy"));
    });
  });
  await visit.settled();
  await visit.page.getByRole("button", { name: "Enter VR" }).click();
  await visit.page.getByText("The headset did not start.").waitFor();
  await visit.end();
});

test("a gamepad walks, turns and runs", { skip }, async () => {
  const visit = await visitHome(browser, home, kOptions, async page => {
    await page.addInitScript(() => {
      const pad = { connected: true, axes: [0, 0, 0, 0], buttons: [{ pressed: false }] };
      Object.assign(window, { pad });
      navigator.getGamepads = () => [null, pad as unknown as Gamepad, null, null];
    });
  });
  const { page } = visit;
  await visit.settled();
  // For so many frames at least: a busy processor draws few.
  const hold = async (axes: readonly number[], ms: number, least: number) => {
    const before = await visit.frames();
    await page.evaluate(a => void ((window as unknown as { pad: { axes: readonly number[] } }).pad.axes = a), axes);
    await page.waitForTimeout(ms);
    while ((await visit.frames()) < before + least) await page.waitForTimeout(50);
    await page.evaluate(() => void ((window as unknown as { pad: { axes: number[] } }).pad.axes = [0, 0, 0, 0]));
    await visit.settled();
    await page.waitForTimeout(600);
  };
  await hold([0, 0.1, 0, 0], 1000, 0); // within the dead zone
  assert.deepEqual(eyeOf(page).slice(0, 3), [2, 1.6, 4]);
  await hold([0, -1, 0, 0], 1200, 6);
  const walked = eyeOf(page);
  assert.ok(walked[2]! < 3.7 && Math.abs(walked[0]! - 2) < 0.05, `ahead: ${walked}`);
  await hold([0, 0, 1, 0], 800, 6);
  const turned = eyeOf(page);
  assert.ok(turned[3]! < -15, `to the right: ${turned}`);
  await visit.end();
});
