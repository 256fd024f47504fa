// The false-colour scale beside the picture.
import { css, html, nothing, svg } from "lit";
import { customElement } from "lit/decorators.js";
import { scaleTicks } from "../color.js";
import { threeDigits } from "../numbers.js";
import { SessionElement } from "./element.js";
import { controls } from "./styles.js";

const kHeight = 220; // of the bar, CSS pixels
const kTop = 26;

@customElement("rl-legend")
export class Legend extends SessionElement {
  protected override readonly topics = ["frame", "ui"] as const;
  static override styles = [
    controls,
    css`
      :host {
        position: absolute;
        top: 12px;
        left: 12px;
        pointer-events: none;
      }
      svg {
        display: block;
        border-radius: 6px;
        background: rgb(20 20 20 / 78%);
      }
      text {
        fill: var(--text);
        font-size: 12px;
        font-variant-numeric: tabular-nums;
      }
    `,
  ];

  override render() {
    const { display, lastFrame, model } = this.session;
    const scale = lastFrame?.scale;
    const colors = model?.welcome.legend ?? [];
    if (!display || display.falseColor === "off" || !scale || colors.length < 2) return nothing;
    const unit = display.falseColor === "illuminance" ? "lx" : "cd/m²";
    const [low, high] = scale;
    const y = (at: number) => kTop + kHeight * (1 - at);
    return html`
      <svg
        width="76"
        height=${kHeight + kTop + 12}
        role="img"
        aria-label=${`False colours from ${threeDigits(low)} to ${threeDigits(high)} ${unit}, logarithmic`}
      >
        <defs>
          <linearGradient id="scale" x1="0" y1="1" x2="0" y2="0">
            ${colors.map((color, i) => svg`<stop offset=${i / (colors.length - 1)} stop-color=${color}></stop>`)}
          </linearGradient>
        </defs>
        <text x="10" y="17">${unit}</text>
        <rect x="10" y=${kTop} width="16" height=${kHeight} fill="url(#scale)"></rect>
        ${scaleTicks(low, high).map(
          ({ value, at }) => svg`
            <line x1="26" x2="31" y1=${y(at)} y2=${y(at)} stroke="#ececec"></line>
            <text x="35" y=${y(at) + 4}>${threeDigits(value)}</text>`,
        )}
      </svg>
    `;
  }
}

declare global {
  interface HTMLElementTagNameMap {
    "rl-legend": Legend;
  }
}
