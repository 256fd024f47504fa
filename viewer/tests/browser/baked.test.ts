// The page of `roomlight bake`: what it shows is what the layers of light say, and everything can be reached.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import type { Browser, BrowserContextOptions } from "playwright-core";
import { falseColour, placeOnScale, roundSteps } from "../../baked/src/false_colour.js";
import { exposureFromEv100, toned } from "../../baked/src/tone.js";
import { luminance } from "../../baked/src/white_balance.js";
import type { Vec3 } from "../../src/vector.js";
import { bakedHome, kAlbedo, kEv100, kLampLux, kSkyLux, kStraightLux, kSunLux } from "../double/baked_home.js";
import {
  launchWithoutWebGl,
  launchWithWebGl,
  noBakedPage,
  serveFolder,
  slide,
  visitHome,
  writeLinkingPage,
  writePage,
  type BakedVisit,
} from "./baked_support.js";
import { kPhone, until } from "./support.js";
import { countTextureBytes, textureBytes } from "./texture_bytes.js";

const skip = noBakedPage();
// Small, as the processor draws.
const kDesktop: BrowserContextOptions = { viewport: { width: 960, height: 540 }, reducedMotion: "reduce" };
const kWall = [300, 200] as const; // a place of the picture with nothing but wall
let browser: Browser;
let home = "";

if (!skip) {
  before(async () => {
    browser = await launchWithWebGl();
    home = writePage("home", bakedHome());
  });
  after(() => browser.close());
}

// What a matt wall of the test's albedo shows under an illuminance.
function shown(lux: Vec3): Vec3 {
  const exposure = exposureFromEv100(kEv100);
  return toned(lux.map(c => (c * kAlbedo * exposure) / Math.PI) as unknown as Vec3, "agx");
}
const sum = (...terms: readonly (readonly [Vec3, number])[]): Vec3 =>
  [0, 1, 2].map(c => terms.reduce((s, [lux, by]) => s + lux[c]! * by, 0)) as unknown as Vec3;

async function shows(visit: BakedVisit, expected: Vec3, what: string): Promise<void> {
  await visit.settled();
  const seen = await visit.color(...kWall);
  seen.forEach((c, i) =>
    assert.ok(Math.abs(c - expected[i]!) < 0.01 * expected[i]! + 0.002, `${what}: ${seen} is not ${expected}`),
  );
}

async function opened(link = home, options = kDesktop): Promise<BakedVisit> {
  const visit = await visitHome(browser, link, options);
  await visit.settled();
  return visit;
}

for (const vertexLit of [false, true]) {
  test(
    `walls have their albedo times illuminance, lit ${vertexLit ? "at vertices" : "by pixels"}`,
    { skip },
    async () => {
      const visit = await opened(writePage(`lit-${vertexLit}`, bakedHome({ vertexLit })));
      const { page } = visit;
      const [pendant, strip] = kLampLux as [Vec3, Vec3];
      await page.getByLabel("Automatic exposure").uncheck();
      await shows(visit, shown(pendant), "as baked");
      await slide(page, "Pendant: brightness", 50);
      await shows(visit, shown(sum([pendant, 0.5])), "dimmed to half");
      await page.getByLabel("Strip: on").check();
      await shows(visit, shown(sum([pendant, 0.5], [strip, 1])), "with a second lamp");
      await page.getByLabel("Pendant: on", { exact: true }).uncheck();
      await shows(visit, shown(strip), "the second alone");
      await visit.end();
    },
  );
}

test("a device with little memory shows the same light", { skip }, async () => {
  const visit = await visitHome(browser, home, kDesktop, async page => {
    await page.addInitScript(() => Object.defineProperty(navigator, "deviceMemory", { value: 0.001 }));
    await countTextureBytes(page);
  });
  const { page } = visit;
  await visit.settled();
  const bytes = await textureBytes(page);
  const [pendant, strip] = kLampLux as [Vec3, Vec3];
  await page.getByLabel("Automatic exposure").uncheck();
  await shows(visit, shown(pendant), "as baked");
  await page.getByLabel("Strip: on").check();
  await shows(visit, shown(sum([pendant, 1], [strip, 1])), "with a second lamp");
  await slide(page, "Pendant: brightness", 50);
  await shows(visit, shown(sum([pendant, 0.5], [strip, 1])), "the first one dimmed");
  await page.getByLabel("Pendant: on", { exact: true }).uncheck();
  await shows(visit, shown(strip), "the second alone");
  await page.getByRole("button", { name: "Everything on" }).click();
  await shows(
    visit,
    shown(sum(...kLampLux.map(l => [l, 1] as const), [kSunLux[0]!, 1], [kSkyLux[0]!, 1])),
    "everything",
  );
  const layer = 4 * 6 * 32 ** 2;
  assert.ok((await textureBytes(page)) < bytes + 1.5 * layer, "one layer is there at a time");
  await visit.end();
});

test("daylight goes from one baked hour to the next", { skip }, async () => {
  const visit = await opened();
  const { page } = visit;
  await page.getByLabel("Automatic exposure").uncheck();
  await page.getByLabel("Pendant: on", { exact: true }).uncheck();
  await page.getByLabel("Sun: on").check();
  await page.getByLabel("Sky: on").check();
  await shows(visit, shown(sum([kSunLux[0]!, 1], [kSkyLux[0]!, 1])), "at 12:00");
  await slide(page, "Time of day", 16.5);
  const parts = [0, 1].flatMap(i => [
    [kSunLux[i]!, i === 0 ? 0.25 : 0.75] as const,
    [kSkyLux[i]!, i === 0 ? 0.25 : 0.75] as const,
  ]);
  await shows(visit, shown(sum(...parts)), "at 16:30");
  await page.getByText("16:30").waitFor();
  await visit.end();
});

test("what is bright keeps its colour where light is balanced far from white", { skip }, async () => {
  const whiteGains: Vec3 = [0.6, 1.2, 4.4]; // of a home lit by 2700 K
  const file = bakedHome({ display: { ev100: kEv100, tone: "neutral", whiteGains } });
  const ev = kEv100 - 4;
  const visit = await opened(`${writePage("warm", file)}#eye=2,1.6,4,0,0,60&ev=${ev}`);
  await visit.page.getByLabel("Strip: on").check();
  await visit.page.getByLabel("Pendant: on", { exact: true }).uncheck();
  const exposed = kLampLux[1]!.map((c, i) => (c * kAlbedo * exposureFromEv100(ev) * whiteGains[i]!) / Math.PI);
  await shows(visit, toned(exposed as unknown as Vec3, "neutral"), "beyond white");
  await visit.end();
});

test("white balance follows the light that is on", { skip }, async () => {
  const light = kLampLux.map(lux => lux.map(c => c / luminance(lux)) as unknown as Vec3);
  const shownAs: readonly Vec3[] = [
    [1, 1, 1],
    [1.2, 0.97, 0.71],
  ];
  const whites = light.map((of, i) => ({ light: of, shown: shownAs[i]! }));
  const file = bakedHome({ display: { ev100: kEv100, tone: "agx", whiteGains: [1, 1, 1], whites } });
  const visit = await opened(`${writePage("whites", file)}#eye=2,1.6,4,0,0,60&ev=${kEv100}`);
  const [pendant, strip] = kLampLux as [Vec3, Vec3];
  const as = (i: number, lux: Vec3) => shown(shownAs[i]!.map(c => c * luminance(lux)) as unknown as Vec3);
  await shows(visit, as(0, pendant), "the first is white");
  await visit.page.getByLabel("Strip: on").check();
  await visit.page.getByLabel("Pendant: on", { exact: true }).uncheck();
  await shows(visit, as(1, strip), "the second keeps some of its warmth");
  await visit.end();
});

// A box of sky around the eye had corners beside it then, where its faces came before the walls.
test("walls are before the sky where the eye looks along a diagonal", { skip }, async () => {
  for (const yaw of [45, -45]) {
    const visit = await opened(`${home}#eye=2,1.6,2.5,${yaw},0,60&ev=${kEv100}`);
    await shows(visit, shown(kLampLux[0]!), `turned by ${yaw} degrees`);
    await visit.end();
  }
});

test("a mirror of a floor shows the walls", { skip }, async () => {
  const visit = await opened(`${writePage("mirror", bakedHome({ glossy: true }))}#eye=2,1.6,4,0,-40,60&ev=${kEv100}`);
  const seen = await visit.color(320, 400);
  const wall = shown(kLampLux[0]!.map(c => 0.9 * c) as unknown as Vec3);
  seen.forEach((c, i) => assert.ok(Math.abs(c - wall[i]!) < 0.02, `${seen} is not ${wall}`));
  await visit.shot("baked-mirror");
  await visit.end();
});

test("a mirror does not show what is before the wall that it faces", { skip }, async () => {
  const file = bakedHome({ glossy: true, shelf: true });
  const visit = await opened(`${writePage("shelf", file)}#eye=2,1.6,4,0,-25,60&ev=${kEv100}`);
  const seen = await visit.color(320, 270);
  // The middle of the room does not see the foot of the wall: the mean of what arrives stands in for it.
  const mean = shown(kLampLux[0]!.map(c => (0.9 / kAlbedo) * c) as unknown as Vec3);
  seen.forEach((c, i) => assert.ok(Math.abs(c - mean[i]!) < 0.03, `${seen} is not ${mean}`));
  await visit.shot("baked-shelf");
  await visit.end();
});

test("coloured glass colours what is behind it", { skip }, async () => {
  const passes: Vec3 = [0.9, 0.3, 0.15];
  const link = writePage("glass", bakedHome({ glassShelf: passes }));
  const visit = await opened(`${link}#eye=2,2.2,1.3,0,-89.9,60&ev=${kEv100}`);
  const seen = await visit.color(320, 270); // the floor below
  const expected = shown(kLampLux[0]!.map((c, i) => c * passes[i]!) as unknown as Vec3);
  seen.forEach((c, i) => assert.ok(Math.abs(c - expected[i]!) < 0.015, `${seen} is not ${expected}`));
  await visit.end();
});

test("a normal map turned to the bright wall has more light", { skip }, async () => {
  const floor = async (towards: number) => {
    const file = bakedHome({ brightWall: true, floorNormal: [0, towards, 0.8] });
    const visit = await opened(`${writePage(`bumpy${towards}`, file)}#eye=2,1.6,4,0,-60,60&ev=${kEv100}`);
    const [red] = await visit.color(320, 300);
    await visit.end();
    return red;
  };
  const [even, to, from] = [await floor(0), await floor(-0.6), await floor(0.6)];
  const [expected] = shown(kLampLux[0]!);
  assert.ok(Math.abs(even - expected) < 0.01, `as layers tell where it is even: ${even}, ${expected}`);
  // Away from it are four walls that are alike.
  assert.ok(to > even + 0.03 && from < even - 0.008, `${from} < ${even} < ${to}`);
});

test("a normal map turned to where light comes from has more of it", { skip }, async () => {
  const turns: readonly [Vec3, readonly [number, number], number][] = [
    [[0.6, 0, 0.8], [1, 0], 0.8 + 0.6],
    [[0.6, 0, 0.8], [-0.5, 0], 0.8 - 0.3],
    [[0, 0.6, 0.8], [0, 1], 0.8 - 0.6], // towards z; light comes from the other side
    [[0, -0.6, 0.8], [0, 0.5], 0.8 + 0.3],
  ];
  for (const [i, [floorNormal, floorLean, times]] of turns.entries()) {
    const link = writePage(`lean${i}`, bakedHome({ floorNormal, floorLean }));
    const visit = await opened(`${link}#eye=2,1.6,4,0,-60,60&ev=${kEv100}`);
    const [red] = await visit.color(320, 300);
    const [expected] = shown(sum([kLampLux[0]!, times]));
    assert.ok(Math.abs(red - expected) < 0.01, `${floorNormal}, ${floorLean}: ${red}, ${expected}`);
    await visit.end();
  }
});

test("a patch of sun ends sharply, and the meter tells it", { skip }, async () => {
  const link = writePage("sun-patch", bakedHome({ sunPatch: true, lamps: false }));
  // The middle of the floor from above, x to the right.
  const visit = await opened(`${link}#eye=2,1.6,2.5,0,-89.9,60&ev=${kEv100}&sun=1.100`);
  const { page } = visit;
  await visit.shot("baked-sun-patch");
  const bounced = kSunLux[0]!;
  const places = [
    [-80, sum([bounced, 1], [kStraightLux, 1]), /93\d\s*lx/],
    [80, bounced, /38\d\s*lx/],
  ] as const;
  await page.getByLabel("Light meter").check();
  for (const [x, lux, told] of places) {
    const seen = await visit.color(320 + x, 270);
    shown(lux).forEach((c, i) => assert.ok(Math.abs(c - seen[i]!) < 0.015, `${x}: ${seen} is not ${shown(lux)}`));
    await page.mouse.move(320 + x, 270);
    await page.getByText(told).waitFor();
  }
  await visit.end();
});

test("automatic exposure follows the light, and stays when it is locked", { skip }, async () => {
  const visit = await opened();
  const { page } = visit;
  const ev100 = async () => Number(await page.locator("#view").getAttribute("data-ev100"));
  assert.ok(Math.abs((await ev100()) - kEv100) < 0.02, "as the home says at first");
  await slide(page, "Pendant: brightness", 25);
  await visit.settled();
  assert.ok(Math.abs((await ev100()) - (kEv100 - 2)) < 0.05, `two stops less: ${await ev100()}`);
  await page.getByLabel("Automatic exposure").uncheck();
  await slide(page, "Pendant: brightness", 100);
  await visit.settled();
  assert.ok(Math.abs((await ev100()) - (kEv100 - 2)) < 0.05);
  await visit.end();
});

test("false colours, their legend and the meter say how many lux there are", { skip }, async () => {
  const visit = await opened();
  const { page } = visit;
  await page.getByLabel("Illuminance in false colours").check();
  await page.getByText("Illuminance, lux").waitFor();
  await visit.settled();
  // The scale ends at round steps around 180 lx, a factor of 3 at least apart.
  const scale = { high: 200, low: roundSteps(200 / 6, 200 / 3).at(-1)! };
  const expected = falseColour(placeOnScale(scale, 180));
  const seen = await visit.color(...kWall);
  seen.forEach((c, i) => assert.ok(Math.abs(c - expected[i]!) < 0.02, `${seen} is not ${expected}`));
  await page.getByLabel("Light meter").check();
  await page.mouse.move(...kWall);
  await page.getByText(/180\s*lx/).waitFor();
  await slide(page, "Pendant: brightness", 150);
  await page.mouse.move(kWall[0] + 9, kWall[1]);
  await page.getByText(/270\s*lx/).waitFor();
  await visit.shot("baked-false-colours");
  await visit.end();
});

test("the lamps of a room are dimmed together", { skip }, async () => {
  const visit = await opened();
  const { page } = visit;
  await page.getByLabel("Automatic exposure").uncheck();
  await slide(page, "All of Kitchen: brightness", 50);
  const [pendant, strip] = kLampLux as [Vec3, Vec3];
  await shows(visit, shown(sum([pendant, 0.5], [strip, 0.5])), "both at half");
  assert.equal(await page.getByLabel("Strip: brightness").inputValue(), "50");
  await page.getByLabel("All of Kitchen", { exact: true }).uncheck();
  await visit.settled();
  assert.ok(!(await page.getByLabel("Pendant: on", { exact: true }).isChecked()));
  await visit.end();
});

test("what is set is in the link, and comes back with it", { skip }, async () => {
  const visit = await opened();
  const { page } = visit;
  await slide(page, "Pendant: brightness", 40);
  await page.getByLabel("Strip: on").check();
  await page.locator("#view").focus();
  await page.keyboard.down("KeyW");
  await page.waitForTimeout(1500);
  await page.keyboard.up("KeyW");
  await page.waitForFunction(() => location.hash.includes("d=0:1.40_1:1.100"));
  await visit.settled();
  await page.waitForTimeout(600);
  const link = page.url();
  await visit.end();
  const again = await opened(link);
  assert.equal(await again.page.getByLabel("Pendant: brightness").inputValue(), "40");
  assert.ok(await again.page.getByLabel("Strip: on").isChecked());
  const eye = /eye=([^&]+)/.exec(link)![1]!.split(",").map(Number);
  assert.ok(eye[2]! < 3.6, `it walked ahead: ${eye}`);
  await again.end();
});

test("scenes: everything on, evening, own ones that last", { skip }, async () => {
  const context = await browser.newContext({ ...kDesktop, locale: "en-GB" });
  const page = await context.newPage();
  await page.goto(home);
  const halved = async () => (await page.getByLabel("Pendant: brightness").inputValue()) === "50";
  await page.getByRole("button", { name: "Everything on" }).click();
  await until("on", () => page.getByLabel("Strip: on").isChecked());
  await page.getByRole("button", { name: "Evening" }).click();
  await until("half", halved);
  assert.ok(!(await page.getByLabel("Sun: on").isChecked()));
  await page.getByLabel("Name of the scene").fill("Reading");
  await page.keyboard.press("Enter");
  await page.getByRole("button", { name: "Reading", exact: true }).waitFor();
  await page.reload();
  await page.getByRole("button", { name: "As baked" }).click();
  await page.getByRole("button", { name: "Reading", exact: true }).click();
  await until("half", halved);
  await page.evaluate(() => {
    Storage.prototype.setItem = () => {
      throw new DOMException("full", "QuotaExceededError");
    };
  });
  await page.getByRole("button", { name: "Delete Reading" }).click();
  await page.getByText(/does not keep scenes/).waitFor();
  await context.close();
});

test("a click on the floor goes there, walls hold, rooms and cameras are gone to", { skip }, async () => {
  const visit = await opened();
  const { page } = visit;
  const eye = async (): Promise<number[]> => {
    await visit.settled();
    await page.waitForTimeout(500);
    return /eye=([^&]+)/.exec(page.url())![1]!.split(",").map(Number);
  };
  await page.mouse.click(320, 490);
  const near = await eye();
  assert.ok(near[2]! < 3.8 && near[1] === 1.6, String(near));
  await page.locator("#view").focus();
  await page.keyboard.down("ShiftLeft");
  await page.keyboard.down("KeyD");
  await page.waitForTimeout(2500);
  await page.keyboard.up("KeyD");
  await page.keyboard.up("ShiftLeft");
  const wall = await eye();
  assert.ok(Math.abs(wall[0]! - 3.8) < 0.05, `held by the wall: ${wall}`);
  await page.getByRole("button", { name: "Kitchen", exact: true }).click();
  assert.deepEqual((await eye()).slice(0, 3), [2, 1.6, 2.5]);
  await page.getByRole("button", { name: "Door", exact: true }).click();
  assert.deepEqual((await eye()).slice(0, 3), [2, 1.6, 4]);
  await page.locator("#plan").click({ position: { x: 144, y: 60 } });
  assert.ok((await eye())[2]! < 2.2);
  await visit.end();
});

test("the picture can be saved", { skip }, async () => {
  const visit = await opened();
  const download = visit.page.waitForEvent("download");
  await visit.page.getByRole("button", { name: "Save picture" }).click();
  const file = await download;
  assert.equal(file.suggestedFilename(), "roomlight.png");
  const png = await readFile(await file.path());
  assert.ok(png.length > 1000 && png.readUInt32BE(16) === 640 && png.readUInt32BE(20) === 540);
  await visit.end();
});

test("files that are missing, cut, damaged or foreign are one line each", { skip }, async () => {
  const whole = bakedHome();
  const broken = whole.slice();
  const stream = Buffer.from(whole).indexOf(Buffer.from([0x78, 0x9c]));
  broken.fill(0x55, stream + 4, stream + 24);
  for (const [name, file, line] of [
    ["missing", null, /^There is no home in this page/],
    ["cut", whole.subarray(0, whole.length / 2), /^The file of this home is cut off.*\(\d+ of \d+ bytes\)$/],
    ["foreign", new TextEncoder().encode("PK not a glb"), /^This file is not a home/],
    ["damaged", broken, /^The file of this home is damaged/],
  ] as const) {
    const visit = await visitHome(browser, writePage(name, file));
    assert.match(await visit.stopped(), line);
    await visit.end();
  }
});

test("a folder on a server works like the single file", { skip }, async () => {
  const folder = await serveFolder(bakedHome());
  const visit = await opened(folder.link);
  await shows(visit, shown(kLampLux[0]!), "as baked");
  assert.ok(Number(await visit.page.locator("#view").getAttribute("data-calls")) < 10);
  await visit.end();
  await folder.end();
});

test("a folder that no server gives out says so", { skip }, async () => {
  const visit = await visitHome(browser, writeLinkingPage("unserved"));
  assert.match(await visit.stopped(), /wants a web server/);
  await visit.end();
});

test("without WebGL one line says so", { skip }, async () => {
  const plain = await launchWithoutWebGl();
  const visit = await visitHome(plain, home);
  assert.match(await visit.stopped(), /WebGL 2/);
  await plain.close();
});

test("a lost graphics context comes back with everything as it was", { skip }, async () => {
  const visit = await opened();
  const { page } = visit;
  await slide(page, "Pendant: brightness", 60);
  await visit.settled();
  await page.evaluate(() => {
    const canvas = document.getElementById("view") as HTMLCanvasElement;
    const loss = canvas.getContext("webgl2")!.getExtension("WEBGL_lose_context")!;
    loss.loseContext();
    setTimeout(() => loss.restoreContext(), 800);
  });
  assert.match(await visit.stopped(), /comes back/);
  await page.waitForFunction(() => document.documentElement.dataset.stopped === undefined);
  await visit.settled();
  assert.equal(await page.getByLabel("Pendant: brightness").inputValue(), "60");
  await page.context().close();
});

test("a phone: stick, drag, and controls on a sheet", { skip }, async () => {
  const visit = await opened(home, kPhone);
  const { page } = visit;
  assert.ok(await page.locator("#panel").isHidden());
  await visit.shot("baked-phone");
  const position = async () => {
    await page.waitForTimeout(600);
    return /eye=([^&]+)/.exec(page.url())?.[1]?.split(",").map(Number) ?? [2, 1.6, 4, 0];
  };
  const touch = await page.context().newCDPSession(page);
  const finger = (type: string, x?: number, y?: number) =>
    touch.send("Input.dispatchTouchEvent", {
      type: type as "touchStart",
      touchPoints: x === undefined || y === undefined ? [] : [{ x, y }],
    });
  const stick = (await page.locator("#stick").boundingBox())!;
  const [x, y] = [stick.x + stick.width / 2, stick.y + stick.height / 2];
  await finger("touchStart", x, y);
  await finger("touchMove", x, y - 40);
  const before = await visit.frames();
  await page.waitForTimeout(1500);
  while ((await visit.frames()) < before + 8) await page.waitForTimeout(50); // a busy processor draws few
  await finger("touchEnd");
  const walked = await position();
  assert.ok(walked[2]! < 3.6, `the stick walks ahead: ${walked}`);
  await finger("touchStart", 200, 300);
  for (let step = 1; step <= 5; ++step) await finger("touchMove", 200 + 20 * step, 300);
  await finger("touchEnd");
  const turned = await position();
  assert.ok(turned[3]! > 15, `dragging looks around: ${turned}`);
  await page.getByRole("button", { name: "Open controls" }).tap();
  await page.getByLabel("Strip: on").tap();
  assert.ok(await page.getByLabel("Strip: on").isChecked());
  await visit.shot("baked-phone-controls");
  await visit.end();
});

test("everything is reached by keyboard, and the focus is seen", { skip }, async () => {
  const visit = await opened();
  const { page } = visit;
  const focused = () =>
    page.evaluate(
      () => document.activeElement?.getAttribute("aria-label") ?? document.activeElement?.textContent?.trim() ?? "",
    );
  const seen = new Set<string>();
  for (let i = 0; i < 60; ++i) {
    await page.keyboard.press("Tab");
    seen.add(await focused());
  }
  for (const name of [
    "Close controls",
    "Pendant: brightness",
    "Strip: on",
    "Time of day",
    "Automatic exposure",
    "Save picture",
  ])
    assert.ok(seen.has(name), `${name} among ${[...seen].join(", ")}`);
  assert.ok([...seen].some(name => name.startsWith("View of the home")));
  await page.getByLabel("Strip: on").focus();
  await page.keyboard.press("Space");
  assert.ok(await page.getByLabel("Strip: on").isChecked());
  const slider = page.getByLabel("Pendant: brightness");
  await slider.focus();
  await page.keyboard.press("ArrowLeft");
  assert.equal(await slider.inputValue(), "99");
  assert.notEqual(await slider.evaluate(e => getComputedStyle(e).outlineStyle), "none");
  await page.locator("#view").focus();
  await page.keyboard.press("KeyF");
  await page.getByText("Illuminance, lux").waitFor();
  await page.keyboard.press("KeyM");
  await page.locator("#reading", { hasText: /\d\s*lx/ }).waitFor(); // of the middle of the picture
  await page.keyboard.down("PageDown");
  await page.waitForTimeout(500);
  await page.keyboard.up("PageDown");
  await page.waitForFunction(() => Number(/eye=([^&]+)/.exec(location.hash)?.[1]?.split(",")[4]) < -5);
  await visit.end();
});

test("German browsers are spoken to in German, and the language can be changed", { skip }, async () => {
  const visit = await opened(home, { ...kDesktop, locale: "de-DE" });
  const { page } = visit;
  await page.getByText("Tageslicht").waitFor();
  assert.equal(await page.locator("html").getAttribute("lang"), "de");
  await page.getByLabel("Sprache").selectOption("en");
  await page.getByText("Daylight").waitFor();
  await visit.shot("baked-controls");
  await visit.end();
});
