// How the picture is shown: exposure, white balance, tone curve, false colours.
import { html, nothing } from "lit";
import { customElement } from "lit/decorators.js";
import type { Display } from "../protocol.js";
import { SessionElement } from "./element.js";
import "./slider.js";
import type { Slide } from "./slider.js";
import { controls } from "./styles.js";

const kCurves: Readonly<Record<string, string>> = {
  neutral: "Neutral",
  agx: "AgX",
  filmic: "Filmic",
  clip: "None (clip)",
};
const kFalse: readonly (readonly [Display["falseColor"], string])[] = [
  ["off", "Picture"],
  ["illuminance", "Illuminance"],
  ["luminance", "Luminance"],
];
const kFirstEv = 7; // where the exposure that the camera found is not known
const kDaylightK = 6500;

@customElement("rl-view-tab")
export class ViewTab extends SessionElement {
  static override styles = controls;

  override render() {
    const { display } = this.session;
    if (!display) return nothing;
    return html`
      <section class="section" aria-label="What is shown">
        <div class="segments" role="radiogroup" aria-label="What is shown">
          ${kFalse.map(
            ([kind, name]) =>
              html`<button
                role="radio"
                aria-checked=${display.falseColor === kind}
                @click=${() => this.set({ falseColor: kind, low: null, high: null })}
              >
                ${name}
              </button>`,
          )}
        </div>
        ${display.falseColor === "off" ? nothing : this.range(display)}
      </section>
      ${display.falseColor === "off" ? this.exposure(display) : nothing}
    `;
  }

  private range(display: Display) {
    const unit = display.falseColor === "illuminance" ? "lx" : "cd/m²";
    const [low, high] = this.session.lastFrame?.scale ?? [display.low, display.high];
    const automatic = display.low === null && display.high === null;
    return html`
      <label class="check">
        <input
          type="checkbox"
          .checked=${automatic}
          @change=${(event: Event) =>
            this.set(
              (event.target as HTMLInputElement).checked
                ? { low: null, high: null }
                : { low: rounded(low ?? 1), high: rounded(high ?? 1000) },
            )}
        />
        Scale from the picture
      </label>
      ${automatic
        ? nothing
        : html`<div class="two">
            ${(["low", "high"] as const).map(
              end =>
                html`<label class="field">
                  <span>${end === "low" ? "From" : "To"}, ${unit}</span>
                  <input
                    class="number"
                    type="number"
                    min="0"
                    step="any"
                    .value=${String(display[end] ?? "")}
                    @change=${(event: Event) => this.setEnd(display, end, event.target as HTMLInputElement)}
                  />
                </label>`,
            )}
          </div>`}
      <p class="muted">
        ${display.falseColor === "illuminance"
          ? "Light that falls on each surface."
          : "Light that comes from each place to the eye."}
        The scale is logarithmic.
      </p>
    `;
  }

  private exposure(display: Display) {
    const automatic = display.exposure === "auto";
    const shown = this.session.lastFrame?.ev100 ?? kFirstEv;
    return html`
      <section class="section" aria-label="Exposure">
        <label class="check">
          <input
            type="checkbox"
            .checked=${automatic}
            @change=${(event: Event) =>
              this.set(
                (event.target as HTMLInputElement).checked
                  ? { exposure: "auto", compensation: 0 }
                  : { exposure: Math.round(shown * 10) / 10, compensation: 0 },
              )}
          />
          Automatic exposure
        </label>
        ${automatic
          ? html`<rl-slider
              label="Brighter or darker"
              unit="EV"
              min="-4"
              max="4"
              least="-10"
              most="10"
              step="0.1"
              .value=${display.compensation}
              @slide=${(event: CustomEvent<Slide>) => this.set({ compensation: event.detail.value })}
            ></rl-slider>`
          : html`<rl-slider
              label="Exposure (EV100)"
              unit="EV"
              min="-4"
              max="16"
              least="-10"
              most="25"
              step="0.1"
              .value=${display.exposure as number}
              @slide=${(event: CustomEvent<Slide>) => this.set({ exposure: event.detail.value })}
            ></rl-slider>`}
      </section>
      <section class="section" aria-label="Colour">
        <label class="field">
          <span>Tone curve</span>
          <select @change=${(event: Event) => this.set({ curve: (event.target as HTMLSelectElement).value })}>
            ${this.session.model?.welcome.curves.map(
              curve =>
                html`<option value=${curve} ?selected=${curve === display.curve}>${kCurves[curve] ?? curve}</option>`,
            )}
          </select>
        </label>
        ${this.whiteBalance(display)}
      </section>
    `;
  }

  private whiteBalance({ whiteBalance }: Display) {
    const kind = typeof whiteBalance === "number" ? "kelvin" : whiteBalance;
    const choose = (value: string) =>
      this.set({ whiteBalance: value === "kelvin" ? this.whiteNow() : (value as "auto" | "none") });
    return html`
      <label class="field">
        <span>White balance</span>
        <select @change=${(event: Event) => choose((event.target as HTMLSelectElement).value)}>
          ${[
            ["auto", "Automatic, as the eye adapts"],
            ["none", "None: daylight (D65) is white"],
            ["kelvin", "By temperature"],
          ].map(([value, name]) => html`<option value=${value!} ?selected=${value === kind}>${name}</option>`)}
        </select>
      </label>
      ${typeof whiteBalance === "number"
        ? html`<rl-slider
            label="What is white"
            unit="K"
            min="1700"
            max="12000"
            least="1667"
            most="25000"
            step="50"
            precision="1"
            logarithmic
            .value=${whiteBalance}
            @slide=${(event: CustomEvent<Slide>) => this.set({ whiteBalance: event.detail.value })}
          ></rl-slider>`
        : nothing}
    `;
  }

  private whiteNow(): number {
    return Math.round((this.session.lastFrame?.whiteK ?? kDaylightK) / 50) * 50;
  }

  private setEnd(display: Display, end: "low" | "high", field: HTMLInputElement): void {
    const value = field.valueAsNumber;
    const next = { low: display.low, high: display.high, [end]: value };
    if (value > 0 && (next.low === null || next.high === null || next.low < next.high)) this.set({ [end]: value });
    else field.value = String(display[end] ?? "");
  }

  private set(change: Partial<Display>): void {
    this.session.setDisplay(change);
  }
}

// To two digits, for a scale that is easy to read.
const rounded = (value: number): number => Number(value.toPrecision(2));

declare global {
  interface HTMLElementTagNameMap {
    "rl-view-tab": ViewTab;
  }
}
