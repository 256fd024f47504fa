// What the light of a baked home costs the chip, and whether a long walk takes memory:
//   node frames_baked.js FOLDER WIDTHxHEIGHT [MINUTES]
// FOLDER is one by `roomlight bake -o FOLDER`. Its page, and plain three.js with the same geometry unlit, turn on the
// spot in one browser, as many pixels each. To stdout, as JSON: milliseconds a frame, of the browser and of the chip by
// timer queries, draw calls and sizes of both, the heap in MiB after each minute of a walk, and tasks above 50 ms a
// minute. WebGL is SwiftShader's, or by ROOMLIGHT_ANGLE the graphics card's (baked_support.ts).
import { readFileSync, readdirSync } from "node:fs";
import { createServer } from "node:http";
import type { AddressInfo } from "node:net";
import { join, normalize } from "node:path";
import type { Page } from "playwright-core";
import { kAngle, launchWithWebGl } from "./baked_support.js";
import { chipMs, chipTime, timeChip } from "./chip_time.js";

const kTurnS = 8;
const kWarmS = 6; // until the page has found how many pixels it draws
const kThree = "node_modules/three";

const [, , folder, size, minutesText] = process.argv;
const [width, height] = (size ?? "").split("x").map(Number);
if (!folder || !width || !height) throw new Error("usage: frames_baked FOLDER WIDTHxHEIGHT [MINUTES]");
const glb = readdirSync(folder).find(file => file.endsWith(".glb"));
if (!glb) throw new Error(`${folder}: no .glb`);

const kPlain = `<!doctype html><style>body{margin:0}</style><canvas id="view"></canvas>
<script type="importmap">{"imports":{
  "three": "/three/build/three.module.js", "three/addons/": "/three/examples/jsm/"
}}</script>
<script type="module">
import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { MeshoptDecoder } from "three/addons/libs/meshopt_decoder.module.js";
const loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder);
const gltf = await loader.loadAsync("/home/${glb}");
const { cameras, camera } = gltf.parser.json.extensions.ROOMLIGHT_light_layers;
const unlit = new Map();
gltf.scene.traverse(mesh => {
  if (!mesh.isMesh) return;
  const m = mesh.material;
  if (!unlit.has(m)) unlit.set(m, new THREE.MeshBasicMaterial({ map: m.map, color: m.color, side: m.side,
    transparent: m.transparent, opacity: m.opacity, alphaTest: m.alphaTest, vertexColors: m.vertexColors }));
  mesh.material = unlit.get(m);
});
const renderer = new THREE.WebGLRenderer({ canvas: document.getElementById("view"), antialias: true });
window.turn = async (width, height, seconds) => {
  renderer.setSize(width, height, false);
  const { position, yFovDeg } = cameras[camera];
  const eye = new THREE.PerspectiveCamera(yFovDeg, width / height, 0.05, 500);
  eye.position.set(...position);
  eye.rotation.order = "YXZ";
  const frames = [];
  const start = performance.now();
  await new Promise(done => {
    const draw = now => {
      frames.push(now);
      eye.rotation.y = ((now - start) / 1000) * (Math.PI / 2);
      renderer.render(gltf.scene, eye);
      if (now - start < seconds * 1000) requestAnimationFrame(draw); else done();
    };
    requestAnimationFrame(draw);
  });
  document.getElementById("view").dataset.calls = String(renderer.info.render.calls);
  return (frames.at(-1) - frames[0]) / (frames.length - 1);
};
document.documentElement.dataset.ready = "true";
</script>`;

const server = createServer((request, response) => {
  const path = normalize(new URL(request.url ?? "/", "http://x").pathname);
  const send = (type: string, file: string) =>
    response.writeHead(200, { "content-type": type }).end(readFileSync(file));
  try {
    if (path === "/plain") response.writeHead(200, { "content-type": "text/html" }).end(kPlain);
    else if (path.startsWith("/three/")) send("text/javascript", join(kThree, path.slice("/three/".length)));
    else if (path === "/home/") send("text/html", join(folder, "index.html"));
    else if (path === `/home/${glb}`) send("model/gltf-binary", join(folder, glb));
    else response.writeHead(404).end();
  } catch {
    response.writeHead(404).end();
  }
});
await new Promise<void>(ready => server.listen(0, "127.0.0.1", ready));
const origin = `http://127.0.0.1:${(server.address() as AddressInfo).port}`;

const unlimited = kAngle === "swiftshader" ? [] : ["--disable-frame-rate-limit", "--disable-gpu-vsync"];
const browser = await launchWithWebGl("--js-flags=--expose-gc", "--enable-precise-memory-info", ...unlimited);

async function opened(link: string): Promise<Page> {
  const page = await (await browser.newContext({ viewport: { width: width!, height: height! } })).newPage();
  page.setDefaultTimeout(120_000);
  await timeChip(page);
  await page.goto(link);
  return page;
}

// Mean of the times between frames while a key is held.
const framesOf = (page: Page, seconds: number): Promise<number> =>
  page.evaluate(
    s =>
      new Promise<number>(done => {
        const view = document.getElementById("view")!;
        const drawn = () => Number(view.dataset.frames);
        const first = drawn();
        const start = performance.now();
        setTimeout(() => done((performance.now() - start) / (drawn() - first)), s * 1000);
      }),
    seconds,
  );

const sizeOf = (page: Page) =>
  page.locator("#view").evaluate(v => {
    const { width, height } = v as HTMLCanvasElement;
    return { width, height };
  });
const callsOf = (page: Page) => page.locator("#view").evaluate(v => Number((v as HTMLElement).dataset.calls));

const page = await opened(`${origin}/home/`);
const view = page.locator("#view");
await page.waitForFunction(() => document.getElementById("view")?.dataset.settled === "true", null, {
  timeout: 120_000,
});
const panel = page.getByLabel("Close controls", { exact: true });
if (await panel.isVisible()) await panel.click();
await view.focus();
await page.keyboard.down("KeyQ");
await page.waitForTimeout(kWarmS * 1000);
const before = await chipTime(page);
const ms = await framesOf(page, kTurnS);
const after = await chipTime(page);
await page.keyboard.up("KeyQ");
const drawn = await sizeOf(page);
const calls = await callsOf(page);

// Walks to and fro and turns, dims lamps on the way.
const heapMiB: number[] = [];
let longTasks = 0;
const minutes = Number(minutesText ?? 0);
if (minutes > 0) {
  await page.evaluate(() => {
    const counted = window as unknown as { longTasks: number };
    counted.longTasks = 0;
    new PerformanceObserver(list => (counted.longTasks += list.getEntries().length)).observe({ type: "longtask" });
  });
  for (let minute = 0; minute < minutes; ++minute) {
    for (let step = 0; step < 15; ++step) {
      for (const key of [step % 2 ? "KeyW" : "KeyS", "KeyE"]) {
        await view.focus();
        await page.keyboard.down(key);
        await page.waitForTimeout(1500);
        await page.keyboard.up(key);
      }
      // The controls are closed, and hear what happens all the same.
      const dials = page.locator("#panel input[type=range]");
      if ((await dials.count()) > 0)
        await dials.nth(step % Math.min(3, await dials.count())).evaluate(
          (input, to) => {
            (input as HTMLInputElement).value = String(to);
            input.dispatchEvent(new Event("input", { bubbles: true }));
          },
          20 + 5 * step,
        );
      await page.waitForTimeout(1000);
    }
    heapMiB.push(
      await page.evaluate(() => {
        (globalThis as unknown as { gc(): void }).gc();
        return (performance as unknown as { memory: { usedJSHeapSize: number } }).memory.usedJSHeapSize / 2 ** 20;
      }),
    );
  }
  longTasks = await page.evaluate(() => (window as unknown as { longTasks: number }).longTasks);
}
await page.context().close();

const plain = await opened(`${origin}/plain`);
await plain.waitForFunction(() => document.documentElement.dataset.ready === "true");
const turn = (seconds: number) =>
  plain.evaluate(
    given => (window as unknown as { turn(w: number, h: number, s: number): Promise<number> }).turn(...given),
    [drawn.width, drawn.height, seconds] as [number, number, number],
  );
await turn(kWarmS);
const plainBefore = await chipTime(plain);
const plainMs = await turn(kTurnS);
const plainAfter = await chipTime(plain);
const plainCalls = await callsOf(plain);
await browser.close();
server.close();
process.stdout.write(
  JSON.stringify({
    renderer: after.renderer,
    page: { ms, chipMs: chipMs(before, after), calls, ...drawn },
    plain: { ms: plainMs, chipMs: chipMs(plainBefore, plainAfter), calls: plainCalls, ...drawn },
    heapMiB: heapMiB.map(h => Number(h.toFixed(1))),
    longTasksAMinute: minutes > 0 ? longTasks / minutes : null,
  }),
);
