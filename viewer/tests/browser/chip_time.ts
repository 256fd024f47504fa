// What a graphics chip takes for the frames of a page, by timer queries: told by `window.chipTime`.
import type { Page } from "playwright-core";

export interface ChipTime {
  readonly renderer: string; // what draws
  readonly frames: number;
  readonly sumNs: number;
}

// In the page, before its own scripts: a query about all that is drawn on canvas #view for one frame of the browser.
function timeFrames(): void {
  const kTimeElapsed = 0x88bf;
  const kMostPending = 8;
  const told = { renderer: "", frames: 0, sumNs: 0 };
  (window as unknown as { chipTime: object }).chipTime = told;
  let context: WebGL2RenderingContext | null = null;
  let pixels: WebGLBuffer | null = null;
  let drew = false;
  const pending: WebGLQuery[] = [];
  const canvas = HTMLCanvasElement.prototype as unknown as { getContext(...args: unknown[]): unknown };
  const getContext = canvas.getContext;
  canvas.getContext = function (this: HTMLCanvasElement, ...args) {
    const made = getContext.apply(this, args);
    if (this.id === "view" && made instanceof WebGL2RenderingContext && !context) {
      const shown = made.getExtension("WEBGL_debug_renderer_info");
      if (shown) told.renderer = String(made.getParameter(shown.UNMASKED_RENDERER_WEBGL));
      pixels = made.createBuffer();
      if (made.getExtension("EXT_disjoint_timer_query_webgl2")) context = made;
    }
    return made;
  };
  const gl = WebGL2RenderingContext.prototype;
  const { drawElements } = gl;
  gl.drawElements = function (...args) {
    drew = true;
    drawElements.apply(this, args);
  };
  const collect = (c: WebGL2RenderingContext) => {
    while (pending.length > 0 && c.getQueryParameter(pending[0]!, c.QUERY_RESULT_AVAILABLE)) {
      told.sumNs += Number(c.getQueryParameter(pending[0]!, c.QUERY_RESULT));
      ++told.frames;
      c.deleteQuery(pending.shift()!);
    }
  };
  // The pixels of an antialiased canvas are made when they are read: that belongs to the frame.
  const resolve = (c: WebGL2RenderingContext) => {
    if (!c.getContextAttributes()?.antialias) return;
    c.bindBuffer(c.PIXEL_PACK_BUFFER, pixels);
    c.bufferData(c.PIXEL_PACK_BUFFER, 4, c.STREAM_READ);
    c.readPixels(0, 0, 1, 1, c.RGBA, c.UNSIGNED_BYTE, 0);
    c.bindBuffer(c.PIXEL_PACK_BUFFER, null);
  };
  const request = window.requestAnimationFrame.bind(window);
  window.requestAnimationFrame = callback => {
    const frame = (now: number): void => {
      if (context) collect(context);
      // Without a limit the browser draws ahead of the chip for seconds; with one at a time the chip idles.
      if (pending.length >= kMostPending) return void request(frame);
      const query = context?.createQuery();
      if (!context || !query) return callback(now);
      drew = false;
      context.beginQuery(kTimeElapsed, query);
      callback(now);
      if (drew) resolve(context);
      context.endQuery(kTimeElapsed);
      if (drew) pending.push(query);
      else context.deleteQuery(query);
    };
    return request(frame);
  };
}

export async function timeChip(page: Page): Promise<void> {
  await page.addInitScript(timeFrames);
}

export const chipTime = (page: Page): Promise<ChipTime> =>
  page.evaluate(() => ({ ...(window as unknown as { chipTime: ChipTime }).chipTime }));

// Of a frame between two such; null where the chip cannot tell.
export const chipMs = (from: ChipTime, to: ChipTime): number | null =>
  to.frames > from.frames ? (to.sumNs - from.sumNs) / (to.frames - from.frames) / 1e6 : null;
