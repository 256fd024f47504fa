// Opens the home that is in the page, or says in one line why not.
import { WebGLRenderer } from "three";
import { App } from "./app.js";
import { BadFile } from "./bad_file.js";
import { headsetSupported } from "./headset.js";
import { readHome } from "./load.js";
import { homeBytes } from "./source.js";
import { faultKey, languageOf, speaker } from "./strings.js";

const language = languageOf(navigator.language);
const say = speaker(language);

function element<K extends keyof HTMLElementTagNameMap>(name: K, id: string): HTMLElementTagNameMap[K] {
  const made = document.createElement(name);
  made.id = id;
  document.body.append(made);
  return made;
}

const line = element("p", "line");
line.setAttribute("role", "status");

function stop(text: string, detail = ""): void {
  document.documentElement.dataset.stopped = "true";
  line.hidden = false;
  line.textContent = detail === "" ? text : `${text} (${detail})`;
}

function makeRenderer(canvas: HTMLCanvasElement, antialias: boolean): WebGLRenderer | null {
  const context = canvas.getContext("webgl2", { antialias, alpha: false, powerPreference: "high-performance" });
  if (!context) {
    stop(say("noWebGl"));
    return null;
  }
  const halfFloat = ["EXT_color_buffer_float", "EXT_color_buffer_half_float"].map(name => context.getExtension(name));
  if (!halfFloat.some(extension => extension)) {
    stop(say("noFloat"));
    return null;
  }
  return new WebGLRenderer({ canvas, context });
}

async function open(): Promise<void> {
  document.documentElement.lang = language;
  line.textContent = say("loading");
  const loaded = await readHome(
    await homeBytes(share => (line.textContent = `${say("loading")} ${Math.round(100 * share)} %`)),
  );
  const canvas = element("canvas", "view");
  canvas.tabIndex = 0;
  const renderer = makeRenderer(canvas, await headsetSupported());
  if (!renderer) return;
  const { width, height } = loaded.document.extensions.ROOMLIGHT_light_layers.atlas;
  if (Math.max(width, height) > renderer.capabilities.maxTextureSize) {
    stop(say("tooLarge"), `${width} × ${height}`);
    return;
  }
  const app = new App(renderer, loaded, element("div", "controls"), language);
  // Everything on the GPU is gone then; a new start is the surest way back.
  canvas.addEventListener("webglcontextlost", event => {
    event.preventDefault();
    app.putLink();
    stop(say("contextLost"));
  });
  canvas.addEventListener("webglcontextrestored", () => location.reload());
  line.hidden = true;
  await app.start();
}

open().catch((error: unknown) => {
  if (error instanceof BadFile) stop(say(faultKey(error.fault)), error.message);
  else {
    console.error(error);
    stop(say("failed"));
  }
});
