// What lies over the picture: messages, legend, the reading of the meter, the stick for thumbs.
import { html, nothing, type TemplateResult } from "lit";
import { withUnit } from "../../src/numbers.js";
import type { App } from "./app.js";
import { cssColour, placeOnScale, roundSteps, type Scale } from "./false_colour.js";

const kStops = 24;

function legend(app: App, scale: Scale): TemplateResult {
  const stops = Array.from({ length: kStops + 1 }, (_, i) => cssColour(i / kStops)).join(", ");
  const steps = roundSteps(scale.low, scale.high);
  const shown = steps.length > 10 ? steps.filter((_, i) => i % 2 === 0) : steps;
  return html`<figure id="legend">
    <figcaption>${app.say("legend")}</figcaption>
    <div class="ramp" style="background: linear-gradient(to right, ${stops})"></div>
    <div class="ticks">
      ${shown.map(
        value =>
          html`<span style="left: ${(100 * placeOnScale(scale, value)).toFixed(1)}%"
            >${Number(value.toPrecision(2))}</span
          >`,
      )}
    </div>
  </figure>`;
}

function reading(app: App): TemplateResult {
  const { reading: read } = app;
  if (!read) return html`<div id="reading" class="hint" role="status">${app.say("meterHint")}</div>`;
  const [x, y] = read.at;
  return html`<div id="reading" role="status" style="left: ${x + 14}px; top: ${y + 14}px">
    ${withUnit(read.lux, "lx")}
  </div>`;
}

function stick(app: App): TemplateResult {
  const drag = (event: PointerEvent) => {
    const base = event.currentTarget as HTMLElement;
    if (event.type === "pointerdown") base.setPointerCapture(event.pointerId);
    if (!base.hasPointerCapture(event.pointerId)) return;
    const box = base.getBoundingClientRect();
    const half = box.width / 2;
    const x = (event.clientX - box.left - half) / half;
    const y = (event.clientY - box.top - half) / half;
    const size = Math.max(1, Math.hypot(x, y));
    app.setStick(-y / size, x / size);
  };
  const release = () => app.setStick(0, 0);
  const [forward, right] = app.controls.stick;
  return html`<div
    id="stick"
    role="img"
    aria-label=${app.say("stick")}
    @pointerdown=${drag}
    @pointermove=${drag}
    @pointerup=${release}
    @pointercancel=${release}
  >
    <span style="transform: translate(${(right * 28).toFixed(0)}px, ${(-forward * 28).toFixed(0)}px)"></span>
  </div>`;
}

export const overlay = (app: App): TemplateResult => html`
  <button
    id="menu"
    aria-expanded=${app.panelOpen}
    aria-controls="panel"
    aria-label=${app.say(app.panelOpen ? "closePanel" : "openPanel")}
    @click=${() => app.togglePanel()}
  >
    ${app.panelOpen ? "×" : "☰"}
  </button>
  ${app.loadedShare < 1
    ? html`<div id="loading" role="status">
        ${app.say("loadingLight")} <progress max="1" .value=${app.loadedShare}></progress>
      </div>`
    : nothing}
  <div id="message" role="status" ?hidden=${app.message === ""}>${app.message}</div>
  ${app.stage.scale ? legend(app, app.stage.scale) : nothing} ${app.metering ? reading(app) : nothing} ${stick(app)}
`;
