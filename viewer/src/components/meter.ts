// What the light meter reads, beside the place where it was held.
import { css, html, nothing } from "lit";
import { customElement } from "lit/decorators.js";
import type { Reading } from "../light_meter.js";
import { exposureValue, withUnit } from "../numbers.js";
import { SessionElement } from "./element.js";
import { controls } from "./styles.js";

const kGapPx = 18;
const kWidthPx = 206;
const kHeightPx = 94;

@customElement("rl-meter")
export class Meter extends SessionElement {
  protected override readonly topics = ["meter", "ui"] as const;
  static override styles = [
    controls,
    css`
      :host {
        position: absolute;
        inset: 0;
        overflow: hidden;
        pointer-events: none;
      }
      .chip {
        position: absolute;
        top: 0;
        left: 0;
        width: ${kWidthPx}px;
        padding: 8px 10px;
        border-radius: 6px;
        background: rgb(20 20 20 / 86%);
      }
      dl {
        display: grid;
        grid-template-columns: auto 1fr;
        gap: 1px 10px;
        margin: 0;
      }
      dt {
        color: var(--muted);
      }
      dd {
        margin: 0;
        text-align: right;
        white-space: nowrap;
      }
      .lux {
        font-size: 15px;
        font-weight: 600;
        line-height: 18px;
      }
    `,
  ];

  override render() {
    const { meter, eye } = this.session;
    if (!meter.reading) return nothing;
    const [x, y] = meter.reading.at;
    const { width, height } = eye.viewport;
    const left = x + kGapPx + kWidthPx > width ? Math.max(0, x - kGapPx - kWidthPx) : x + kGapPx;
    const top = Math.max(0, y + kGapPx + kHeightPx > height ? y - kGapPx - kHeightPx : y + kGapPx);
    return html`<div
      class="chip number"
      role="status"
      .style=${`transform:translate(${Math.round(left)}px,${Math.round(top)}px)`}
    >
      ${this.reading(meter.reading)}
    </div>`;
  }

  private reading({ hit }: Reading) {
    if (!hit) return html`<span class="muted">Only sky there</span>`;
    const spread = hit.standardErrorLux ? `± ${withUnit(hit.standardErrorLux, "lx")} · ` : "";
    return html`<dl>
      <dt>Incident</dt>
      <dd class="lux" id="lux">${withUnit(hit.illuminanceLux, "lx")}</dd>
      <dt></dt>
      <dd class="muted">${spread}EV ${exposureValue(hit.incidentEv100)}</dd>
      <dt>Reflected</dt>
      <dd class="lux" id="luminance">${withUnit(hit.luminanceCdM2, "cd/m²")}</dd>
      <dt></dt>
      <dd class="muted">EV ${exposureValue(hit.reflectedEv100)}</dd>
    </dl>`;
  }
}

declare global {
  interface HTMLElementTagNameMap {
    "rl-meter": Meter;
  }
}
