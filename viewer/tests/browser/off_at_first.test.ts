// What is off when a home is opened can be switched on: lamps by day, daylight where there are only lamps.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, beforeEach, test } from "node:test";
import type { Browser } from "playwright-core";
import type { Session } from "../../src/session.js";
import { Desk } from "../double/desk.js";
import { startDouble, type Double } from "../double/server.js";
import { noProgram, startProgram } from "./program.js";
import { choose, frameWith, launch, meanColor, noBrowser, settled, tab, until, visit, type Visit } from "./support.js";

const skip = noBrowser();
const skipProgram = skip || noProgram();
const kSlowMs = 180000;
const kDay = {
  scene: { lamps: "off", suns: "off", sky: "off", emission: "off" },
  daylight: { sky: "overcast", latitude: 48.14, longitude: 11.58, time: "2026-12-20T16:00+01:00" },
};
const kLampsOnly = {
  scene: { suns: "off", sky: "off", lamps: "off", emission: "off" },
  lamps: [{ name: "Desk", type: "point", position: [2.5, 1.7, 1.9], flux: "40 lm" }],
};
let browser: Browser;
let double: Double;

if (!skip) {
  before(async () => {
    browser = await launch();
    double = await startDouble("dist");
  });
  beforeEach(() => Object.assign(double.desk, new Desk()));
  after(async () => {
    await browser.close();
    await double.close();
  });
}

const daylight = ({ page }: Visit) => page.getByRole("switch", { name: "Daylight by date" });
const timeOfDay = ({ page }: Visit) => page.locator('input[type="time"]');
const isOn = async (visited: Visit) => (await daylight(visited).getAttribute("aria-checked")) === "true";

test("daylight that is off says what is assumed, and an hour switches it on", { skip }, async () => {
  const { home } = double.desk;
  home.sun = { ...home.sun, on: false, placeFrom: "assumed" };
  const visited = await visit(browser, double.link);
  await settled(visited);
  await tab(visited, "Daylight");
  assert.equal(await isOn(visited), false);
  await visited.page.getByText("No file says where the home stands").waitFor();
  await timeOfDay(visited).fill("15:30");
  await until("daylight is on", () => double.desk.home.sun.on && double.desk.home.sun.hour === 15.5);
  await until("the page shows it", () => isOn(visited));
  await daylight(visited).click();
  await until("daylight is off", () => !double.desk.home.sun.on);
  await visited.page.keyboard.press("Control+z");
  await until("undone", () => double.desk.home.sun.on);
  await visited.end();
});

test("a lamp whose flux is assumed says so until it is set", { skip }, async () => {
  const { home } = double.desk;
  home.lamps = home.lamps.map(lamp => ({ ...lamp, on: false, fluxAssumed: true }));
  const visited = await visit(browser, double.link);
  await settled(visited);
  await choose(visited, "Lamps", "Floor lamp");
  const assumed = visited.page.getByText("this is assumed");
  await assumed.waitFor();
  await visited.page.getByRole("switch", { name: "Off" }).click();
  await until("it is on", () => double.desk.home.lamps[1]!.on);
  await visited.page.getByRole("spinbutton", { name: "Full output, lm" }).fill("600");
  await visited.page.keyboard.press("Enter");
  await assumed.waitFor({ state: "detached" });
  await visited.end();
});

// With an exposure by hand, so that light shows; once a whole frame shows the newest state.
async function brightness(visited: Visit): Promise<number> {
  const newest = await visited.page.evaluate(() => {
    const { session } = document.querySelector("rl-app") as unknown as { session: Session };
    session.setDisplay({ exposure: 5 });
    return session.model?.revision ?? 0;
  });
  await frameWith(
    visited,
    ({ revision, whole, samples }) => whole === "true" && Number(revision) >= newest && Number(samples) >= 4,
    kSlowMs,
  );
  await visited.page.waitForTimeout(1000); // frames of the exposure before
  const [red, green, blue] = await meanColor(visited, 0, 0, 1, 1);
  return (red + green + blue) / 3;
}

async function saved({ page }: Visit): Promise<Record<string, unknown>> {
  const downloading = page.waitForEvent("download");
  await page.keyboard.press("Control+s");
  return JSON.parse(await readFile(await (await downloading).path(), "utf8")) as Record<string, unknown>;
}

const undoable = ({ page }: Visit) => page.getByRole("button", { name: "Undo" }).isEnabled();

test("by day the lamps of the home are there, off, and can be switched on", { skip: skipProgram }, async () => {
  const program = await startProgram(0, kDay);
  try {
    const visited = await visit(browser, program.link);
    await frameWith(visited, () => true, kSlowMs);
    const dark = await brightness(visited);
    await tab(visited, "Home");
    await visited.page.getByRole("radio", { name: "Lamps", exact: true }).click();
    const lamps = visited.page.getByRole("option");
    assert.ok((await lamps.count()) > 0, "the lamps are listed");
    assert.match(await lamps.first().innerText(), /off/);
    await lamps.first().click();
    await visited.page.getByRole("switch", { name: "Off" }).click();
    await until("it is switched on", () => undoable(visited), kSlowMs);
    assert.ok((await brightness(visited)) > dark + 3, "it gives light");
    assert.ok(!JSON.stringify(await saved(visited)).includes('"emission":"off"'), "it is saved");
    await visited.page.getByRole("button", { name: "Undo" }).click();
    await until("undone", async () => !(await undoable(visited)), kSlowMs);
    assert.ok(Math.abs((await brightness(visited)) - dark) < 2, "dark again");
    await visited.end();
  } finally {
    assert.equal(await program.end(), 0);
  }
});

test("a lighting file of lamps alone leaves a sun to move", { skip: skipProgram }, async () => {
  const program = await startProgram(0, kLampsOnly);
  try {
    const visited = await visit(browser, program.link);
    await frameWith(visited, () => true, kSlowMs);
    const dark = await brightness(visited);
    await tab(visited, "Daylight");
    assert.equal(await isOn(visited), false);
    await timeOfDay(visited).fill("13:00");
    await until("it is switched on", () => undoable(visited), kSlowMs);
    assert.equal(await isOn(visited), true);
    assert.ok((await brightness(visited)) > dark + 3, "it gives light");
    assert.ok("daylight" in (await saved(visited)), "it is saved");
    await daylight(visited).click();
    await until("it is off", async () => !(await isOn(visited)), kSlowMs);
    assert.ok(Math.abs((await brightness(visited)) - dark) < 2, "dark again");
    await visited.end();
  } finally {
    assert.equal(await program.end(), 0);
  }
});
