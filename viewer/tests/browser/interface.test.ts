// The page against a double of the server: everything that a user can do, in a real browser.
import assert from "node:assert/strict";
import { after, before, beforeEach, test } from "node:test";
import type { Browser } from "playwright-core";
import { project } from "../../src/camera.js";
import type { Thing } from "../../src/protocol.js";
import { Desk } from "../double/desk.js";
import { poseOf } from "../double/home.js";
import { startDouble, type Double } from "../double/server.js";
import {
  choose,
  frameWith,
  kDesktop,
  kPhone,
  launch,
  meanColor,
  noBrowser,
  settled,
  show,
  stageBox,
  tab,
  until,
  visit,
} from "./support.js";

const skip = noBrowser();
let browser: Browser;
let double: Double;

const desk = (): Desk => double.desk;
const lamp = (id: string) => desk().home.lamps.find(l => l.id === id)!;

if (!skip) {
  before(async () => {
    browser = await launch();
    double = await startDouble("dist");
  });
  beforeEach(() => Object.assign(desk(), new Desk()));
  after(async () => {
    await browser.close();
    await double.close();
  });
}

test("the page opens and shows the home", { skip }, async () => {
  const visited = await visit(browser, double.link);
  await settled(visited);
  assert.equal(await visited.page.title(), "Box home – roomlight");
  const [red, green, blue] = await meanColor(visited, 0.2, 0.2, 0.8, 0.8);
  assert.ok(red + green + blue > 60, "the picture is dark");
  await visited.page.getByText("Connected").waitFor();
  await visited.shot("interface_start");
  await visited.end();
});

test("keys walk on the level, and what is seen changes", { skip }, async () => {
  const visited = await visit(browser, double.link);
  await settled(visited);
  const before = await meanColor(visited, 0.4, 0.55, 0.6, 0.75);
  await visited.page.keyboard.down("w");
  await visited.page.waitForTimeout(700);
  await visited.page.keyboard.up("w");
  await frameWith(visited, ({ camera }) => Number(camera) > 5);
  const eye = double.lastCamera()!;
  assert.ok(Math.hypot(eye.position[0] - 5.6, eye.position[2] - 4.7) > 0.5, JSON.stringify(eye));
  assert.ok(Math.abs(eye.position[1] - 1.6) < 1e-9, "the height of the eye");
  const after = await meanColor(visited, 0.4, 0.55, 0.6, 0.75);
  assert.ok(Math.hypot(...after.map((v, i) => v - before[i]!)) > 5, `${before} and ${after}`);
  await visited.end();
});

test("dragging looks around, with Alt goes around, the wheel walks", { skip }, async () => {
  const visited = await visit(browser, double.link);
  await settled(visited);
  const { x, y, width, height } = await stageBox(visited);
  const drag = async () => {
    await visited.page.mouse.move(x + width / 2, y + height / 2);
    await visited.page.mouse.down();
    await visited.page.mouse.move(x + width / 2 + 120, y + height / 2, { steps: 4 });
    await visited.page.mouse.up();
    await visited.page.waitForTimeout(100);
  };
  const start = double.lastCamera()!;
  await drag();
  const looked = double.lastCamera()!;
  assert.deepEqual(looked.position, start.position);
  assert.notDeepEqual(looked.direction, start.direction);
  await visited.page.keyboard.down("Alt");
  await drag();
  await visited.page.keyboard.up("Alt");
  const circled = double.lastCamera()!;
  assert.notDeepEqual(circled.position, looked.position);
  await visited.page.mouse.wheel(0, -200);
  await until("the wheel walks", () => double.lastCamera()!.position[0] !== circled.position[0]);
  await visited.end();
});

test("search, choose and dim a lamp by keyboard alone; undo and redo", { skip }, async () => {
  const visited = await visit(browser, double.link);
  await settled(visited);
  const { keyboard } = visited.page;
  await keyboard.press("/");
  await keyboard.type("floor l");
  await keyboard.press("ArrowDown");
  await keyboard.press("Enter");
  await visited.page.getByRole("heading", { name: "Floor lamp" }).waitFor();
  const slider = visited.page.getByRole("slider", { name: "Dimming" });
  await slider.focus();
  // In quick succession, on a slow machine too.
  await Promise.all([1, 2, 3, 4, 5].map(() => keyboard.press("ArrowLeft")));
  await until("the lamp is dimmed", () => Math.abs(lamp("lamp:1").dim - 0.95) < 1e-9);
  assert.equal(desk().done.length, 1, "steps in quick succession are one step of undo");
  await keyboard.press("Control+z");
  await until("undone", () => lamp("lamp:1").dim === 1);
  await until("the slider shows it", async () => (await slider.inputValue()) === "100");
  await keyboard.press("Control+Shift+z");
  await until("done again", () => Math.abs(lamp("lamp:1").dim - 0.95) < 1e-9);
  await visited.end();
});

test("a lamp is moved by its handle, and the picture follows", { skip }, async () => {
  const visited = await visit(browser, double.link);
  await settled(visited);
  await choose(visited, "Lamps", "Floor lamp");
  await visited.page.keyboard.press("f");
  await settled(visited);
  await visited.page.waitForTimeout(400);
  const { x, y, width, height } = await stageBox(visited);
  const before = await meanColor(visited, 0.3, 0.3, 0.7, 0.7);
  // The lamp that was gone to is in the middle; its disc moves it on the level.
  await visited.page.mouse.move(x + width / 2, y + height / 2);
  await visited.page.mouse.down();
  await visited.page.mouse.move(x + width / 2 + 90, y + height / 2 + 1, { steps: 5 });
  await visited.shot("interface_move");
  await visited.page.mouse.up();
  await until(
    "the lamp has moved",
    () => Math.hypot(lamp("lamp:1").position[0] - 0.6, lamp("lamp:1").position[2] - 0.6) > 0.1,
  );
  assert.ok(Math.abs(lamp("lamp:1").position[1] - 1.5) < 1e-6, "its height stays");
  assert.equal(desk().done.length, 1, "one pull is one step of undo");
  const revision = desk().revision;
  await frameWith(visited, data => Number(data.revision) >= revision);
  const after = await meanColor(visited, 0.3, 0.3, 0.7, 0.7);
  assert.ok(Math.hypot(...after.map((v, i) => v - before[i]!)) > 2, `${before} and ${after}`);
  await visited.page.getByRole("button", { name: "Undo" }).click();
  await until("it is back", () => lamp("lamp:1").position[0] === 0.6);
  await visited.end();
});

test(
  "choosing a lamp leaves the eye where it is; Show goes to where it is seen whole, out of its shade",
  { skip },
  async () => {
    const low = [2.65, 1.9, 2.15] as const;
    const high = [3.35, 2.3, 2.85] as const;
    const shade: Thing = { ...desk().home.objects[0]!, id: "object:9", name: "Shade", low, high };
    desk().home.objects.push(shade);
    Object.assign(lamp("lamp:0"), { object: shade.id });
    const visited = await visit(browser, double.link);
    await settled(visited);
    const start = double.lastCamera()!;
    const stays = async (what: string) => {
      await visited.page.waitForTimeout(300);
      const { position, direction } = double.lastCamera()!;
      assert.deepEqual([position, direction], [start.position, start.direction], what);
    };
    await choose(visited, "Lamps", "Pendant");
    await visited.page.getByRole("heading", { name: "Pendant" }).waitFor();
    await stays("a lamp of the list");
    await choose(visited, "Objects", "Armchair");
    await visited.page.getByRole("heading", { name: "Armchair" }).waitFor();
    await stays("a thing of the list");
    const { x, y, width, height } = await stageBox(visited);
    await visited.page.mouse.click(x + 0.45 * width, y + 0.6 * height);
    await visited.page.getByRole("heading", { name: "Table" }).waitFor();
    await stays("a thing in the picture");
    await choose(visited, "Lamps", "Pendant");
    await show(visited);
    await until("it goes there", () => double.lastCamera()!.position[0] !== start.position[0]);
    await settled(visited);
    await visited.shot("interface_lamp_shown");
    const eye = double.lastCamera()!;
    const away = Math.hypot(eye.position[0] - 3, eye.position[1] - 2.1, eye.position[2] - 2.5);
    assert.ok(away > 1.5 && away < 2.5, `${away} m`);
    assert.ok(Math.abs(eye.position[1] - 1.6) < 1e-6, "at the height of an eye");
    const pose = poseOf(eye, { width, height });
    for (const cornerX of [low[0], high[0]])
      for (const cornerY of [low[1], high[1]])
        for (const cornerZ of [low[2], high[2]]) {
          const at = project(pose, { width, height }, [cornerX, cornerY, cornerZ]);
          assert.ok(at && at.x > 0 && at.x < width && at.y > 0 && at.y < height, JSON.stringify(at));
        }
    await visited.end();
  },
);

test("the status line tells what happens to the picture", { skip }, async () => {
  const visited = await visit(browser, double.link);
  await settled(visited);
  const said = () => visited.page.locator("rl-status .picture").innerText();
  const says = (what: string) =>
    until(`"${what}"`, async () => (await said()).replaceAll("\u202f", " ").startsWith(what));
  await says("finished · EV 4.0");
  double.growAll({ flags: 0, samples: 8, samplesInAll: 24 });
  await says("refining 8 of 24 · ");
  await visited.shot("interface_status");
  double.growAll({ flags: 16, samples: 90, relativeError: 0.031 });
  await says("refining, 90 paths a pixel, 3.1 % error left");
  double.growAll({ flags: 4, samples: 0 });
  await says("light follows");
  await visited.page.locator("rl-stage #hands").focus();
  await visited.page.keyboard.down("q");
  const heard = new Set<string>();
  for (let i = 0; i < 30; ++i) {
    heard.add(await said());
    await visited.page.waitForTimeout(50);
  }
  await visited.page.keyboard.up("q");
  for (let i = 0; i < 30; ++i) {
    heard.add(await said());
    await visited.page.waitForTimeout(50);
  }
  const all = [...heard].join("\n");
  assert.match(all, /^moving, [1-9]\d* frames?\/s · /m);
  assert.doesNotMatch(all, /\b0 frames/);
  await says("finished");
  double.growAll({ flags: 2, samples: 64, relativeError: 0.002 });
  await says("finished, 0.2 % error left");
  await visited.end();
});

test("a click selects a thing, which can be moved, turned, hidden and coloured", { skip }, async () => {
  const visited = await visit(browser, double.link);
  await settled(visited);
  const { x, y, width, height } = await stageBox(visited);
  await visited.page.mouse.click(x + 0.45 * width, y + 0.6 * height);
  await visited.page.getByRole("heading", { name: "Table" }).waitFor();
  const table = () => desk().home.objects[0]!;
  await visited.page.getByRole("spinbutton", { name: "Moved by, m, x" }).fill("0.5");
  await visited.page.keyboard.press("Enter");
  await until("moved", () => table().move[0] === 0.5 && Math.abs(table().low[0] - 2.7) < 1e-9);
  await visited.page.getByRole("spinbutton", { name: "Turned by, °" }).fill("30");
  await visited.page.keyboard.press("Enter");
  await until("turned", () => table().turn === 30);
  await visited.page.getByLabel("Table wood").fill("#ff0000");
  await until("coloured", () => table().colors[0]!.color[0] === 1 && table().colors[0]!.color[1] === 0);
  await visited.page.getByRole("button", { name: "Hide" }).click();
  await until("hidden", () => table().hidden);
  await visited.page.keyboard.press("Escape");
  assert.equal(await visited.page.getByRole("heading", { name: "Table" }).count(), 0);
  await visited.end();
});

test("what stands on a thing goes along with it, unless it is moved alone", { skip }, async () => {
  const [low, high] = [[2.9, 0.75, 2.4] as const, [3.1, 1, 2.6] as const];
  desk().home.objects.push({ ...desk().home.objects[0]!, id: "object:9", name: "Vase", low, high });
  const visited = await visit(browser, double.link);
  await settled(visited);
  await choose(visited, "Objects", "Table");
  const x = visited.page.getByRole("spinbutton", { name: "Moved by, m, x" });
  const moves = () => ["object:0", "object:9"].map(id => desk().home.objects.find(o => o.id === id)!.move[0]);
  const movedTo = async (value: string) => {
    await x.fill(value);
    await visited.page.keyboard.press("Enter");
  };
  await movedTo("0.5");
  await until("the vase goes along", () => String(moves()) === "0.5,0.5");
  assert.equal(desk().done.length, 1, "one step of undo");
  await visited.page.getByLabel("Take along what stands on it").uncheck();
  await movedTo("0.3");
  await until("the table goes alone", () => String(moves()) === "0.3,0.5");
  await visited.page.getByLabel("Take along what stands on it").check();
  await visited.page.keyboard.press("Control+z");
  await until("undone", () => String(moves()) === "0.5,0.5");
  // By its disc, with Shift.
  const box = await stageBox(visited);
  const table = desk().home.objects[0]!;
  const middle = [0, 1, 2].map(i => (table.low[i]! + table.high[i]!) / 2) as [number, number, number];
  const at = project(poseOf(double.lastCamera()!, box), box, middle)!;
  const pull = async (byPx: number) => {
    await visited.page.mouse.move(box.x + at.x, box.y + at.y);
    await visited.page.mouse.down();
    await visited.page.mouse.move(box.x + at.x + byPx, box.y + at.y, { steps: 3 });
    await visited.page.mouse.up();
  };
  await visited.page.keyboard.down("Shift");
  await pull(60);
  await visited.page.keyboard.up("Shift");
  await until("pulled alone", () => moves()[0] !== 0.5);
  assert.equal(moves()[1], 0.5);
  await visited.end();
});

test("a thing that runs into another is outlined and named", { skip }, async () => {
  const visited = await visit(browser, double.link);
  await settled(visited);
  await choose(visited, "Objects", "Table");
  const reddish = () =>
    visited.page.locator("rl-stage #overlay").evaluate(canvas => {
      const { width, height } = canvas as HTMLCanvasElement;
      const copy = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true })!;
      copy.drawImage(canvas as HTMLCanvasElement, 0, 0);
      const { data } = copy.getImageData(0, 0, width, height);
      let count = 0;
      for (let i = 0; i < data.length; i += 4)
        count += data[i] === 0xff && data[i + 1] === 0x8f && data[i + 2] === 0x80 ? 1 : 0;
      return count;
    });
  const words = visited.page.locator("rl-stage .overlaps");
  assert.equal(await words.isVisible(), false);
  assert.equal(await reddish(), 0);
  await visited.page.getByRole("spinbutton", { name: "Moved by, m, x" }).fill("1.2");
  await visited.page.getByRole("spinbutton", { name: "Moved by, m, z" }).fill("0.6");
  await visited.page.keyboard.press("Enter");
  await until("named", async () => (await words.textContent()) === "Table runs into Armchair");
  assert.ok(await words.isVisible());
  await until("outlined", async () => (await reddish()) > 50);
  await visited.shot("interface_overlap");
  await visited.page.keyboard.press("Escape");
  await until("outlined without a selection", async () => (await reddish()) > 50);
  for (let i = 0; i < 2; ++i) await visited.page.keyboard.press("Control+z");
  await until("over", async () => !(await words.isVisible()) && (await reddish()) === 0);
  await visited.end();
});

test("the light meter follows the pointer", { skip }, async () => {
  const visited = await visit(browser, double.link);
  await settled(visited);
  const { x, y, width, height } = await stageBox(visited);
  await visited.page.keyboard.press("m");
  const lux = visited.page.locator("rl-meter #lux");
  const readings = new Set<string>();
  for (const at of [0.3, 0.45, 0.8]) {
    await visited.page.mouse.move(x + at * width, y + 0.6 * height);
    await visited.page.waitForTimeout(250);
    readings.add((await lux.textContent()) ?? "");
  }
  assert.equal(readings.size, 3, [...readings].join(", "));
  assert.match([...readings][0]!, /^[\d.]+\u202flx$/);
  await visited.shot("interface_meter");
  const still = await lux.textContent();
  await visited.page.keyboard.press("PageDown", { delay: 300 });
  await until("the reading follows the eye", async () => (await lux.textContent()) !== still);
  await visited.page.keyboard.press("m");
  assert.equal(await lux.count(), 0);
  await visited.end();
});

test("daylight: date and time of day are set, one drag is one step of undo", { skip }, async () => {
  const visited = await visit(browser, double.link);
  await settled(visited);
  await tab(visited, "Daylight");
  await visited.page.getByRole("button", { name: "Winter" }).click();
  await until("winter", () => desk().home.sun.date === "2026-12-21");
  const slider = await visited.page.getByRole("slider", { name: "Time of day" }).boundingBox();
  assert.ok(slider);
  await visited.page.mouse.move(slider.x + slider.width / 2, slider.y + slider.height / 2);
  await visited.page.mouse.down();
  await visited.page.mouse.move(slider.x + 0.8 * slider.width, slider.y + slider.height / 2, { steps: 8 });
  await visited.page.mouse.up();
  await until("evening", () => desk().home.sun.hour > 17);
  await visited.page.waitForTimeout(200);
  assert.equal(desk().done.length, 2);
  await visited.end();
});

test("false colours come with a scale, whose ends can be set", { skip }, async () => {
  const visited = await visit(browser, double.link);
  await settled(visited);
  await tab(visited, "Display");
  await visited.page.getByRole("radio", { name: "Illuminance" }).click();
  await visited.page.getByRole("img", { name: /False colours from 1 to 1000 lx/ }).waitFor();
  await visited.page.getByLabel("Scale from the picture").uncheck();
  await visited.page.getByLabel("To, lx").fill("500");
  await visited.page.keyboard.press("Enter");
  await visited.page.getByRole("img", { name: /False colours from 1 to 500 lx/ }).waitFor();
  await visited.shot("interface_false_colour");
  await visited.end();
});

test("exposure, tone curve and white balance are told to the server", { skip }, async () => {
  const visited = await visit(browser, double.link);
  await settled(visited);
  await tab(visited, "Display");
  const before = await meanColor(visited, 0.3, 0.3, 0.7, 0.7);
  await visited.page.getByRole("spinbutton", { name: /Exposure/ }).fill("2");
  await visited.page.keyboard.press("Enter");
  await until("a brighter picture", async () => (await meanColor(visited, 0.3, 0.3, 0.7, 0.7))[0] > before[0] + 20);
  await visited.page.getByLabel("Tone curve").selectOption("agx");
  await visited.page.getByLabel("White balance").selectOption("kelvin");
  await until(
    "told",
    () => double.lastDisplay()?.curve === "agx" && typeof double.lastDisplay()?.whiteBalance === "number",
  );
  await visited.end();
});

test("a plan is kept, and compared with by a split view with a divider", { skip }, async () => {
  const visited = await visit(browser, double.link);
  await settled(visited);
  await tab(visited, "Compare");
  await visited.page.getByLabel("Name of the plan").fill("Evening");
  await visited.page.getByRole("button", { name: "Keep" }).click();
  await visited.page.getByRole("button", { name: "Apply Evening" }).waitFor();
  await choose(visited, "Lamps", "Pendant");
  await visited.page.getByRole("switch").click();
  await until("off", () => !lamp("lamp:0").on);
  await choose(visited, "Cameras", "From the door");
  await tab(visited, "Compare");
  await visited.page.getByLabel("Split view", { exact: true }).last().check();
  await visited.page.getByText("hybrid · Evening").waitFor();
  const brightness = async (left: number, right: number) => (await meanColor(visited, left, 0.3, right, 0.9))[0];
  await until(
    "the kept plan is brighter",
    async () => (await brightness(0.1, 0.45)) > (await brightness(0.55, 0.9)) + 8,
  );
  await visited.shot("interface_split");
  const divider = visited.page.getByRole("separator");
  await divider.focus();
  for (let i = 0; i < 3; ++i) await visited.page.keyboard.press("ArrowLeft");
  assert.equal(await divider.getAttribute("aria-valuenow"), "44");
  await visited.end();
});

test("a final picture is rendered, watched and offered to download", { skip }, async () => {
  const visited = await visit(browser, double.link);
  await settled(visited);
  await tab(visited, "Render");
  await visited.page.getByRole("radio", { name: "Panorama" }).click();
  await visited.page.getByRole("button", { name: "Render", exact: true }).click();
  await visited.page.getByRole("progressbar").waitFor();
  const link = visited.page.getByRole("link", { name: "Download box_home.png" });
  await link.waitFor();
  const downloading = visited.page.waitForEvent("download");
  await link.click();
  assert.equal((await downloading).suggestedFilename(), "box_home.png");
  await visited.page.getByRole("button", { name: "Render", exact: true }).click();
  await visited.page.getByRole("button", { name: "Cancel" }).click();
  await visited.page.getByText("Cancelled.").waitFor();
  await visited.end();
});

test("the lighting is saved as a file", { skip }, async () => {
  const visited = await visit(browser, double.link);
  await settled(visited);
  const downloading = visited.page.waitForEvent("download");
  await visited.page.keyboard.press("Control+s");
  assert.equal((await downloading).suggestedFilename(), "box_home.json");
  await visited.page.getByText("Moved things are not in it").waitFor();
  await visited.end();
});

test("a lost connection is taken up again, with what the window showed", { skip }, async () => {
  const visited = await visit(browser, double.link);
  await settled(visited);
  await tab(visited, "Display");
  await visited.page.getByRole("radio", { name: "Luminance", exact: true }).click();
  await frameWith(visited, ({ frame }) => Number(frame) > 1);
  double.dropAll();
  await visited.page.getByText("Trying again").waitFor();
  await visited.shot("interface_lost");
  await visited.page.getByText("Connected", { exact: true }).waitFor();
  await until("told again", () => double.lastDisplay()?.falseColor === "luminance");
  await settled(visited);
  await choose(visited, "Lamps", "Spot");
  await visited.page.getByRole("switch").click();
  await until("edits go on", () => !lamp("lamp:2").on);
  await visited.end();
});

test("a wrong token is refused, in words", { skip }, async () => {
  const visited = await visit(browser, double.link.replace(/#.*/, "#wrong"));
  await visited.page.getByText("its token is not that of the running program").first().waitFor();
  // Refused requests are all that the browser may complain of.
  assert.ok(
    visited.complaints.length > 0 && visited.complaints.every(line => /403/.test(line)),
    visited.complaints.join("\n"),
  );
  visited.complaints.length = 0;
  await visited.shot("interface_refused");
  await visited.end();
});

test("messages that make no sense are told and do no harm", { skip }, async () => {
  const visited = await visit(browser, double.link);
  await settled(visited);
  double.sendAll('{"type": "state", "revision": "new"}');
  await visited.page.getByText("revision: Invalid type: Expected number").waitFor();
  double.sendAll(Buffer.alloc(80));
  await visited.page.getByText("unknown kind 0").waitFor();
  await choose(visited, "Lamps", "Spot");
  await visited.page.getByRole("switch").click();
  await until("edits go on", () => !lamp("lamp:2").on);
  await visited.end();
});

test("two windows show each other's edits", { skip }, async () => {
  const first = await visit(browser, double.link);
  const second = await visit(browser, double.link);
  await settled(first);
  await settled(second);
  await choose(first, "Lamps", "Pendant");
  await first.page.getByRole("spinbutton", { name: "Dimming, %" }).fill("40");
  await first.page.keyboard.press("Enter");
  await tab(second, "Home");
  await second.page.getByRole("option", { name: "Pendant 320" }).waitFor();
  await first.end();
  await second.end();
});

test("the page fits a phone, and fingers look, walk and select", { skip }, async () => {
  const visited = await visit(browser, double.link, kPhone);
  await settled(visited);
  const width = await visited.page.evaluate(() => document.documentElement.scrollWidth);
  assert.equal(width, 390);
  const { x, y, width: w, height: h } = await stageBox(visited);
  assert.ok(w === 390 && h > 300, `${w} x ${h}`);
  await visited.page.touchscreen.tap(x + 0.4 * w, y + 0.6 * h);
  await visited.page.getByRole("heading", { name: "Table" }).waitFor();
  await visited.shot("interface_phone");
  await visited.page.getByRole("button", { name: "Fold the panel" }).click();
  await until("the picture grows", async () => (await stageBox(visited)).height > h + 200);
  const before = double.lastCamera()!;
  await fingers(
    visited.page,
    [
      [x + 100, y + 200],
      [x + 200, y + 200],
    ],
    [
      [x + 60, y + 200],
      [x + 240, y + 200],
    ],
  );
  await until("spread fingers walk", () => double.lastCamera()!.position[0] !== before.position[0]);
  await settled(visited);
  await visited.shot("interface_phone_folded");
  await visited.end();
});

// Puts fingers on the screen and moves them.
async function fingers(page: import("playwright-core").Page, from: number[][], to: number[][]): Promise<void> {
  const session = await page.context().newCDPSession(page);
  const points = (t: number) =>
    from.map(([x, y], i) => ({ x: x! + t * (to[i]![0]! - x!), y: y! + t * (to[i]![1]! - y!), id: i }));
  await session.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: points(0) });
  for (let step = 1; step <= 5; ++step)
    await session.send("Input.dispatchTouchEvent", { type: "touchMove", touchPoints: points(step / 5) });
  await session.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
}

for (const [width, height] of [
  [640, 400],
  [360, 640],
] as const) {
  test(`${width}x${height}: half of the window is picture, and all controls can be reached`, { skip }, async () => {
    const phone = height > width;
    const visited = await visit(browser, double.link, {
      ...(phone ? kPhone : kDesktop),
      viewport: { width, height },
    });
    const { page } = visited;
    await settled(visited);
    const name = (what: string) => `interface_${width}x${height}_${what}`;
    const share = async () => {
      const box = await stageBox(visited);
      return (box.width * box.height) / (width * height);
    };
    assert.ok((await share()) >= 0.5, `${await share()} of the window`);
    await choose(visited, "Lamps", "Spot");
    await show(visited);
    await settled(visited);
    await visited.shot(name("lamp"));
    for (const what of ["Home", "Daylight", "Display", "Compare", "Render"]) {
      await tab(visited, what);
      assert.deepEqual(await beyondReach(page), [], what);
      assert.ok((await share()) >= 0.5, `${what}: ${await share()} of the window`);
      await visited.shot(name(what.toLowerCase()));
    }
    await page.getByRole("button", { name: "Fold the panel" }).click();
    await until("the picture grows", async () => (await share()) > 0.7);
    await settled(visited);
    assert.deepEqual(await beyondReach(page), [], "folded");
    await visited.shot(name("folded"));
    await tab(visited, "Display");
    await until("it is unfolded", async () => (await share()) < 0.7);
    await visited.end();
  });
}

// Controls that no scrolling brings into the window, that lie under others, and buttons whose words do not fit.
function beyondReach(page: import("playwright-core").Page): Promise<string[]> {
  return page.evaluate(() => {
    const found: string[] = [];
    const walk = (root: Document | ShadowRoot) => {
      for (const element of root.querySelectorAll<HTMLElement>("*")) {
        if (element.shadowRoot) walk(element.shadowRoot);
        if (!element.matches("button, input, select, a, [role=option]") || !element.checkVisibility()) continue;
        element.scrollIntoView({ block: "nearest" });
        const { left, right, top, bottom, width, height } = element.getBoundingClientRect();
        const inside = left >= -0.5 && right <= innerWidth + 0.5 && top >= -0.5 && bottom <= innerHeight + 0.5;
        // What is seen at its middle must be itself, not something that lies over it.
        let over: Element | null = document.elementFromPoint(left + width / 2, top + height / 2);
        while (over?.shadowRoot) {
          const deeper: Element | null = over.shadowRoot.elementFromPoint(left + width / 2, top + height / 2);
          if (!deeper || deeper === over) break;
          over = deeper;
        }
        const met =
          over !== null &&
          (element.contains(over) || over.contains(element) || element.closest("label")?.contains(over));
        const cut = element.matches("button") && element.scrollWidth > element.clientWidth;
        if (!inside || !met || cut)
          found.push(`${element.outerHTML.slice(0, 120)} at ${left}, ${top} to ${right}, ${bottom}`);
      }
    };
    walk(document);
    return found;
  });
}

test("everything that can be worked has a name and can be reached by keys", { skip }, async () => {
  const visited = await visit(browser, double.link);
  await settled(visited);
  await choose(visited, "Lamps", "Pendant");
  for (const name of ["Home", "Daylight", "Display", "Compare", "Render"]) {
    await tab(visited, name);
    const nameless = await visited.page.evaluate(() => {
      const found: string[] = [];
      const walk = (root: Document | ShadowRoot) => {
        for (const element of root.querySelectorAll<HTMLElement>("*")) {
          if (element.shadowRoot) walk(element.shadowRoot);
          if (!element.matches("button, input, select, a, [tabindex]") || element.closest("[hidden]")) continue;
          const labels = (element as HTMLInputElement).labels;
          const said =
            element.getAttribute("aria-label") || element.textContent?.trim() || labels?.[0]?.textContent?.trim();
          if (!said) found.push(element.outerHTML);
        }
      };
      walk(document);
      return found;
    });
    assert.deepEqual(nameless, [], name);
  }
  await visited.page.keyboard.press("?");
  await visited.page.getByRole("dialog", { name: "Keys and gestures" }).waitFor();
  await visited.page.keyboard.press("Escape");
  assert.equal(await visited.page.getByRole("dialog").count(), 0);
  await visited.end();
});
