// A slider with a field for the number. Tells of each change as "slide", with the name of the gesture that it belongs
// to.
import { css, html, LitElement } from "lit";
import { customElement, property } from "lit/decorators.js";
import { roundTo } from "../numbers.js";
import { clamp } from "../vector.js";
import { controls } from "./styles.js";

export interface Slide {
  readonly value: number;
  readonly gesture: string;
}

const kPauseMs = 1200; // steps by keys with less between them are one gesture
const kPositions = 1000; // of a logarithmic slider

let gestures = 0;

@customElement("rl-slider")
export class Slider extends LitElement {
  static override styles = [
    controls,
    css`
      .head {
        display: flex;
        align-items: center;
        justify-content: space-between;
        gap: 8px;
      }
      .value {
        display: flex;
        align-items: center;
        gap: 4px;
      }
      .value input {
        width: var(--number-width, 72px) !important;
        text-align: right;
        min-height: 26px !important;
        padding: 2px 4px !important;
      }
      .unit {
        min-width: 26px;
        color: var(--muted);
      }
    `,
  ];

  @property() label = "";
  @property() unit = "";
  @property({ type: Number }) value = 0;
  @property({ type: Number }) min = 0;
  @property({ type: Number }) max = 1;
  @property({ type: Number }) step = 0.01;
  @property({ type: Number }) least?: number; // that may be typed, where it is not min
  @property({ type: Number }) most?: number; // and not max
  @property({ type: Number }) precision?: number; // of the number that is shown, where it is not step
  @property({ type: Boolean }) logarithmic = false;
  @property({ type: Boolean }) disabled = false;
  @property({ type: Boolean }) bare = false; // without the field; the slot may hold another one
  @property() valueText = ""; // said instead of the number
  private gesture = "";
  private lastMs = 0;

  override render() {
    const { min, max, step } = this.sliderRange();
    return html`
      <div class="head">
        <label for="range">${this.label}</label>
        <span class="value">
          <slot></slot>
          <input
            ?hidden=${this.bare}
            id="number"
            class="number"
            type="number"
            aria-label=${this.label + (this.unit ? `, ${this.unit}` : "")}
            min=${this.least ?? this.min}
            max=${this.most ?? this.max}
            step="any"
            .value=${this.shown()}
            ?disabled=${this.disabled}
            @change=${this.typed}
          />
          <span class="unit" ?hidden=${this.bare}>${this.unit}</span>
        </span>
      </div>
      <input
        id="range"
        type="range"
        min=${min}
        max=${max}
        step=${step}
        .value=${String(this.positionOf(this.value))}
        aria-valuetext=${this.valueText || `${this.shown()} ${this.unit}`}
        ?disabled=${this.disabled}
        @input=${this.slid}
        @change=${this.released}
      />
    `;
  }

  private shown(): string {
    return String(roundTo(this.value, this.precision ?? this.step));
  }

  private sliderRange(): { min: number; max: number; step: number } {
    return this.logarithmic ? { min: 0, max: kPositions, step: 1 } : { min: this.min, max: this.max, step: this.step };
  }

  private positionOf(value: number): number {
    if (!this.logarithmic) return value;
    return (kPositions * Math.log(clamp(value, this.min, this.max) / this.min)) / Math.log(this.max / this.min);
  }

  private slid(event: Event): void {
    const position = Number((event.target as HTMLInputElement).value);
    const value = this.logarithmic ? this.min * (this.max / this.min) ** (position / kPositions) : position;
    this.tell(roundTo(value, this.step));
  }

  private typed(event: Event): void {
    const field = event.target as HTMLInputElement;
    const value = field.valueAsNumber;
    if (Number.isFinite(value)) this.tell(clamp(value, this.least ?? this.min, this.most ?? this.max));
    this.gesture = "";
    // Shows what holds, where it was out of range or no number.
    field.value = this.shown();
  }

  private released(): void {
    this.lastMs = performance.now();
  }

  private tell(value: number): void {
    const now = performance.now();
    if (!this.gesture || (this.lastMs > 0 && now - this.lastMs > kPauseMs)) this.gesture = `slide ${++gestures}`;
    this.lastMs = 0;
    this.value = value;
    this.dispatchEvent(new CustomEvent<Slide>("slide", { detail: { value, gesture: this.gesture } }));
  }
}

declare global {
  interface HTMLElementTagNameMap {
    "rl-slider": Slider;
  }
}
