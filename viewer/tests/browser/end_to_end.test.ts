// The page and the real program together: a home is opened, walked through, changed and measured.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import type { Browser } from "playwright-core";
import type { Session } from "../../src/session.js";
import { kLampName, lineTo, noProgram, startProgram, type Program } from "./program.js";
import {
  choose,
  frameWith,
  kPhone,
  launch,
  meanColor,
  noBrowser,
  show,
  stageBox,
  tab,
  until,
  visit,
  type Visit,
} from "./support.js";

const skip = noBrowser() || noProgram();
let browser: Browser;
let program: Program;

if (!skip) {
  before(async () => {
    browser = await launch();
    program = await startProgram();
  });
  after(async () => {
    await browser.close();
    assert.equal(await program.end(), 0, "the program ends well with Ctrl-C");
  });
}

const kSlowMs = 180000;

// A frame of full size that shows the newest state and camera.
async function upToDate(visited: Visit): Promise<void> {
  const newest = await visited.page.evaluate(() => {
    const { session } = document.querySelector("rl-app") as unknown as { session: Session };
    session.eye.flush();
    return { revision: session.model?.revision ?? 0, camera: session.eye.newest };
  });
  await frameWith(
    visited,
    ({ revision, camera, whole }) =>
      whole === "true" && Number(revision) >= newest.revision && Number(camera) >= newest.camera,
    kSlowMs,
  );
}

// A picture for people.
const clean = (visited: Visit): Promise<void> =>
  frameWith(visited, ({ whole, samples }) => whole === "true" && Number(samples) >= 8, kSlowMs);

const position = (page: Visit["page"], axis: string) => page.getByRole("spinbutton", { name: `Position, m, ${axis}` });

// The reading of the meter there, lx; places as fractions of the stage.
async function luxAt(visited: Visit, x: number, y: number): Promise<number> {
  const box = await stageBox(visited);
  const held = async (px: number, py: number): Promise<number> => {
    let lux: number | null = null;
    const read = (): Promise<number | null> =>
      visited.page.evaluate(
        ([px, py]) => {
          const { session } = document.querySelector("rl-app") as unknown as { session: Session };
          const { reading } = session.meter;
          const here = reading && Math.hypot(reading.at[0] - px!, reading.at[1] - py!) < 2;
          return here ? (reading.hit?.illuminanceLux ?? null) : null;
        },
        [px, py],
      );
    await visited.page.mouse.move(box.x + px, box.y + py);
    await until("the meter reads", async () => (lux = await read()) !== null, kSlowMs);
    assert.ok(lux !== null);
    return lux;
  };
  await held(box.width / 2, 0.3 * box.height); // else an earlier reading of the place could pass for the new one
  return held(x * box.width, y * box.height);
}

test("the home opens with a picture", { skip }, async () => {
  const visited = await visit(browser, program.link);
  await frameWith(visited, () => true, kSlowMs);
  await upToDate(visited);
  const [red, green, blue] = await meanColor(visited, 0, 0, 1, 1);
  assert.ok(red > 20 && green > 20 && blue > 10, `${red}, ${green}, ${blue}`);
  await visited.page.getByText("Connected", { exact: true }).waitFor();
  await clean(visited);
  await visited.shot("view_desktop");
  await visited.end();
});

test("keys walk, and what is seen changes", { skip }, async () => {
  const visited = await visit(browser, program.link);
  await frameWith(visited, () => true, kSlowMs);
  await upToDate(visited);
  const before = await meanColor(visited, 0.4, 0.4, 0.6, 0.6);
  await visited.page.keyboard.down("q");
  await visited.page.keyboard.down("w");
  await visited.page.waitForTimeout(900);
  await visited.page.keyboard.up("w");
  await visited.page.keyboard.up("q");
  await upToDate(visited);
  const after = await meanColor(visited, 0.4, 0.4, 0.6, 0.6);
  assert.ok(Math.hypot(...after.map((v, i) => v - before[i]!)) > 3, `${before} and ${after}`);
  await visited.end();
});

test("a lamp that is moved changes the measured light, and undo brings it back", { skip }, async () => {
  const visited = await visit(browser, program.link);
  await frameWith(visited, () => true, kSlowMs);
  await choose(visited, "Lamps", kLampName);
  await show(visited);
  await upToDate(visited);
  await visited.page.keyboard.press("m");
  const place = [0.6, 0.67] as const; // on the wall beside where the lamp comes to hang
  const before = await luxAt(visited, ...place);
  const picture = await meanColor(visited, 0, 0, 1, 1);
  const start = Number(await position(visited.page, "x").inputValue());
  await position(visited.page, "x").fill(String(start + 1.2));
  await visited.page.keyboard.press("Enter");
  await until("the move is done", () => visited.page.getByRole("button", { name: "Undo" }).isEnabled(), kSlowMs);
  await upToDate(visited);
  const moved = await luxAt(visited, ...place);
  assert.ok(Math.abs(moved / before - 1) > 0.05, `${before} lx and ${moved} lx`);
  const after = await meanColor(visited, 0, 0, 1, 1);
  assert.ok(Math.hypot(...after.map((v, i) => v - picture[i]!)) > 0.5, `${picture} and ${after}`);
  await clean(visited);
  await visited.shot("view_moved");
  await visited.page.getByRole("button", { name: "Undo" }).click();
  await until(
    "the number is back",
    async () => Number(await position(visited.page, "x").inputValue()) === start,
    kSlowMs,
  );
  await upToDate(visited);
  const back = await luxAt(visited, ...place);
  assert.ok(Math.abs(back / before - 1) < 0.05, `${before} lx and then ${back} lx`);
  await visited.end();
});

test("a lamp that is switched off darkens the picture", { skip }, async () => {
  const visited = await visit(browser, program.link);
  await frameWith(visited, () => true, kSlowMs);
  await tab(visited, "Display");
  await upToDate(visited);
  await visited.page.getByLabel("Automatic exposure").uncheck();
  await choose(visited, "Lamps", kLampName);
  await upToDate(visited);
  const before = await meanColor(visited, 0, 0, 1, 1);
  await visited.page.getByRole("switch", { name: "On" }).click();
  await visited.page.getByRole("switch", { name: "Off" }).waitFor();
  await until("darker", async () => (await meanColor(visited, 0, 0, 1, 1))[1] < 0.97 * before[1], kSlowMs);
  await visited.page.keyboard.press("Control+z");
  await visited.page.getByRole("switch", { name: "On" }).waitFor();
  await until("as before", async () => (await meanColor(visited, 0, 0, 1, 1))[1] > 0.98 * before[1], kSlowMs);
  await visited.end();
});

test("a thing that is moved leaves its place in the picture", { skip }, async () => {
  const visited = await visit(browser, program.link);
  await frameWith(visited, () => true, kSlowMs);
  const name = await visited.page.evaluate(() => {
    const { session } = document.querySelector("rl-app") as unknown as { session: Session };
    const sizes = [...(session.model?.things.values() ?? [])].filter(({ movable }) => movable);
    const largest = sizes.sort((a, b) => b.high[0] - b.low[0] - (a.high[0] - a.low[0]))[0];
    if (!largest) throw new Error("no thing of this home can be moved");
    return largest.name;
  });
  await choose(visited, "Objects", name);
  await show(visited);
  await upToDate(visited);
  const before = await meanColor(visited, 0.4, 0.4, 0.6, 0.6);
  await visited.page.getByRole("spinbutton", { name: "Moved by, m, y" }).fill("1");
  await visited.page.keyboard.press("Enter");
  const moved = async () => Math.hypot(...(await meanColor(visited, 0.4, 0.4, 0.6, 0.6)).map((v, i) => v - before[i]!));
  await until("another picture", async () => (await moved()) > 3, kSlowMs);
  await visited.page.getByRole("button", { name: "Put back" }).click();
  await until("the first picture", async () => (await moved()) < 2, kSlowMs);
  await visited.end();
});

test("a door opens into the room, and undo shuts it", { skip }, async () => {
  const visited = await visit(browser, program.link);
  await frameWith(visited, () => true, kSlowMs);
  const door = () =>
    visited.page.evaluate(() => {
      const { session } = document.querySelector("rl-app") as unknown as { session: Session };
      const thing = [...(session.model?.things.values() ?? [])].find(
        ({ name, open }) => name === "Door" && open !== null,
      );
      if (!thing) throw new Error("no door of this home opens");
      return { open: thing.open, width: thing.high[0] - thing.low[0] };
    });
  const shut = await door();
  await choose(visited, "Objects", "Door");
  await show(visited);
  await upToDate(visited);
  const before = await meanColor(visited, 0.3, 0.3, 0.7, 0.7);
  await visited.page.getByRole("spinbutton", { name: "Open, %" }).fill("100");
  await visited.page.keyboard.press("Enter");
  const changed = async () =>
    Math.hypot(...(await meanColor(visited, 0.3, 0.3, 0.7, 0.7)).map((v, i) => v - before[i]!));
  await until("another picture", async () => (await changed()) > 2, kSlowMs);
  const wide = await door();
  assert.equal(wide.open, 1);
  assert.ok(wide.width > shut.width + 0.3, `${shut.width} m and ${wide.width} m`);
  await visited.page.getByRole("button", { name: "Undo" }).click();
  await until("the first picture", async () => (await changed()) < 1.5, kSlowMs);
  assert.deepEqual(await door(), shut);
  await visited.end();
});

test("false colours and a split view are shown", { skip }, async () => {
  const visited = await visit(browser, program.link);
  await frameWith(visited, () => true, kSlowMs);
  await tab(visited, "Display");
  await visited.page.getByRole("radio", { name: "Illuminance" }).click();
  await visited.page.getByRole("img", { name: /False colours from .* lx/ }).waitFor({ timeout: kSlowMs });
  await clean(visited);
  await visited.shot("view_false_colour");
  await visited.page.getByRole("radio", { name: "Picture" }).click();
  await tab(visited, "Compare");
  await visited.page.getByLabel("Split view", { exact: true }).last().check();
  await visited.page.getByRole("separator").waitFor();
  await upToDate(visited);
  await visited.end();
});

test("a final picture is rendered and downloaded", { skip }, async () => {
  const visited = await visit(browser, program.link);
  await frameWith(visited, () => true, kSlowMs);
  await tab(visited, "Render");
  await visited.page.getByLabel("Size").selectOption({ label: "1280 × 720" });
  await visited.page.getByLabel("Quality").selectOption("draft");
  await visited.page.getByRole("button", { name: "Render", exact: true }).click();
  await visited.page.getByRole("progressbar", { name: "How far the picture is" }).waitFor();
  const link = visited.page.getByRole("link", { name: /Download .*\.png/ });
  await link.waitFor({ timeout: kSlowMs });
  const downloading = visited.page.waitForEvent("download");
  await link.click();
  const file = await readFile(await (await downloading).path());
  assert.equal(file.subarray(1, 4).toString("latin1"), "PNG");
  assert.deepEqual([file.readUInt32BE(16), file.readUInt32BE(20)], [1280, 720]);
  await visited.end();
});

test("the lighting is saved as a file", { skip }, async () => {
  const visited = await visit(browser, program.link);
  await frameWith(visited, () => true, kSlowMs);
  await choose(visited, "Lamps", kLampName);
  await visited.page.getByRole("spinbutton", { name: "Dimming, %" }).fill("40");
  await visited.page.keyboard.press("Enter");
  await until("the lamp is dimmed", () => visited.page.getByRole("button", { name: "Undo" }).isEnabled(), kSlowMs);
  const downloading = visited.page.waitForEvent("download");
  await visited.page.keyboard.press("Control+s");
  const saved = JSON.parse(await readFile(await (await downloading).path(), "utf8")) as Record<string, unknown>;
  assert.ok("daylight" in saved, "what the file had");
  assert.ok(JSON.stringify(saved).includes('"dimming":0.4'), "what was changed");
  await visited.end();
});

test("a connection that was cut is taken up again, the eye where it was", { skip }, async () => {
  const line = await lineTo(program);
  try {
    const visited = await visit(browser, line.link);
    await frameWith(visited, () => true, kSlowMs);
    await visited.page.keyboard.down("q");
    await visited.page.waitForTimeout(500);
    await visited.page.keyboard.up("q");
    await upToDate(visited);
    const before = await meanColor(visited, 0.2, 0.2, 0.8, 0.8);
    line.drop();
    await visited.page.getByText("Trying again").waitFor();
    await visited.page.getByText("Connected", { exact: true }).waitFor({ timeout: kSlowMs });
    await upToDate(visited);
    const after = await meanColor(visited, 0.2, 0.2, 0.8, 0.8);
    assert.ok(Math.hypot(...after.map((v, i) => v - before[i]!)) < 8, `${before} and ${after}`);
    await visited.end();
  } finally {
    await line.close();
  }
});

test("a wrong token is refused", { skip }, async () => {
  const visited = await visit(browser, program.link.replace(/#.*/, "#00000000000000000000000000000000"));
  await visited.page.getByText("its token is not that of the running program").first().waitFor();
  assert.equal(await visited.stage.getAttribute("data-frame"), null);
  // The browser may complain of refused requests, and of nothing else.
  assert.deepEqual(
    visited.complaints.filter(line => !line.includes("403")),
    [],
  );
  visited.complaints.length = 0;
  await visited.end();
});

test("it works on a phone", { skip }, async () => {
  const visited = await visit(browser, program.link, kPhone);
  await frameWith(visited, () => true, kSlowMs);
  await upToDate(visited);
  assert.equal(await visited.page.evaluate(() => document.documentElement.scrollWidth), 390);
  const { x, y, width, height } = await stageBox(visited);
  await visited.page.touchscreen.tap(x + width / 2, y + 0.7 * height);
  await visited.page.getByRole("button", { name: "Select nothing" }).waitFor();
  await clean(visited);
  await visited.shot("view_phone");
  await visited.end();
});
