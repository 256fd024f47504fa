// What can be changed of the selected lamp.
import { css, html, nothing } from "lit";
import { customElement } from "lit/decorators.js";
import { blackBody, brightest, hexFromLinear, linearFromHex } from "../color.js";
import { anglesOf, directionOf } from "../camera.js";
import { withUnit } from "../numbers.js";
import type { EditFields, Lamp } from "../protocol.js";
import { kRadPerDegree, type Vec3 } from "../vector.js";
import { SessionElement } from "./element.js";
import "./slider.js";
import type { Slide } from "./slider.js";
import { controls } from "./styles.js";
import "./vector_field.js";

const kWarmestK = 1800;
const kCoolestK = 7000;
const kUsualK = 2700;
const kKinds: Readonly<Record<string, string>> = {
  point: "Bulb",
  spot: "Spot",
  area: "Panel",
  photometric: "Luminaire from a file",
  glow: "Shining part",
};

let changes = 0;

export const lampColor = (lamp: Lamp): string =>
  hexFromLinear(lamp.color ? brightest(lamp.color) : blackBody(lamp.temperatureK ?? 6500));

// Degrees below the horizon, and around from -z counter-clockwise.
const tiltOf = (direction: Vec3): number => -Math.asin(Math.max(-1, Math.min(1, direction[1]))) / kRadPerDegree;
const turnOf = (direction: Vec3): number => anglesOf(direction).yawRad / kRadPerDegree;

@customElement("rl-lamp-editor")
export class LampEditor extends SessionElement {
  static override styles = [
    controls,
    css`
      .kelvin {
        --track: linear-gradient(90deg, #ff8512, #ffb46b 25%, #ffd9b3 50%, #fff1e6 75%, #f3f2ff);
      }
      .swatch {
        width: 18px;
        height: 18px;
      }
    `,
  ];

  override render() {
    const { selection, model } = this.session;
    const lamp = selection?.kind === "lamp" ? model?.lamps.get(selection.id) : undefined;
    if (!lamp) return nothing;
    return html`
      <div class="stack">
        <div class="row">
          <button role="switch" aria-checked=${lamp.on} @click=${() => this.set(lamp, { on: !lamp.on })}>
            ${lamp.on ? "On" : "Off"}
          </button>
          <span class="grow muted">${kKinds[lamp.kind] ?? lamp.kind}</span>
          <span class="swatch" .style=${`background:${lampColor(lamp)}`}></span>
        </div>
        ${this.brightness(lamp)} ${this.color(lamp)} ${this.place(lamp)}
      </div>
    `;
  }

  private brightness(lamp: Lamp) {
    const { fluxLm } = lamp;
    return html`
      <rl-slider
        label="Dimming"
        unit="%"
        min="0"
        max="100"
        step="1"
        .value=${lamp.dim * 100}
        ?disabled=${!lamp.on}
        @slide=${(event: CustomEvent<Slide>) => this.slide(lamp, event, value => ({ dim: value / 100 }))}
      ></rl-slider>
      ${fluxLm === null
        ? html`<p class="muted">Its luminous flux is not known.</p>`
        : html`
            <rl-slider
              label="Full output"
              unit="lm"
              min="10"
              max="20000"
              least="0"
              most="1000000"
              step="1"
              logarithmic
              .value=${fluxLm}
              ?disabled=${!lamp.on}
              @slide=${(event: CustomEvent<Slide>) => this.slide(lamp, event, value => ({ fluxLm: value }))}
            ></rl-slider>
            ${lamp.fluxAssumed
              ? html`<p class="muted">No file says how much light it gives: this is assumed.</p>`
              : nothing}
            <p class="muted number">Gives ${lamp.on ? withUnit(fluxLm * lamp.dim, "lm") : "no light"} now.</p>
          `}
    `;
  }

  private color(lamp: Lamp) {
    const white = lamp.color === null;
    return html`
      <div class="segments" role="radiogroup" aria-label="Colour of the light">
        <button role="radio" aria-checked=${white} @click=${() => white || this.set(lamp, { temperatureK: kUsualK })}>
          White
        </button>
        <button
          role="radio"
          aria-checked=${!white}
          @click=${() => white && this.set(lamp, { color: blackBody(lamp.temperatureK ?? kUsualK) })}
        >
          Colour
        </button>
      </div>
      ${white
        ? html`<rl-slider
            class="kelvin"
            label="Colour temperature"
            unit="K"
            min=${kWarmestK}
            max=${kCoolestK}
            least="1000"
            most="40000"
            step="50"
            precision="1"
            .value=${lamp.temperatureK ?? 6500}
            @slide=${(event: CustomEvent<Slide>) => this.slide(lamp, event, value => ({ temperatureK: value }))}
          ></rl-slider>`
        : html`<label class="row">
            <span class="grow">Colour of the light</span>
            <input
              type="color"
              .value=${lampColor(lamp)}
              @input=${(event: Event) =>
                this.set(lamp, { color: linearFromHex((event.target as HTMLInputElement).value) }, "colour")}
              @change=${() => ++changes}
            />
          </label>`}
    `;
  }

  private place(lamp: Lamp) {
    const { direction } = lamp;
    return html`
      <rl-vector
        label="Position, m"
        .value=${lamp.position}
        ?disabled=${!lamp.movable}
        @vector=${(event: CustomEvent<Vec3>) => this.set(lamp, { position: event.detail })}
      ></rl-vector>
      ${lamp.movable ? nothing : html`<p class="muted">It moves with what it is a part of.</p>`}
      ${direction
        ? html`
            <rl-slider
              label="Aimed down by"
              unit="°"
              min="-90"
              max="90"
              step="1"
              .value=${tiltOf(direction)}
              @slide=${(event: CustomEvent<Slide>) => this.aim(lamp, event, turnOf(direction), event.detail.value)}
            ></rl-slider>
            <rl-slider
              label="Turned by"
              unit="°"
              min="-180"
              max="180"
              step="1"
              .value=${turnOf(direction)}
              ?disabled=${Math.abs(tiltOf(direction)) > 89.5}
              @slide=${(event: CustomEvent<Slide>) => this.aim(lamp, event, event.detail.value, tiltOf(direction))}
            ></rl-slider>
          `
        : nothing}
    `;
  }

  private aim(lamp: Lamp, event: CustomEvent<Slide>, turnDegrees: number, tiltDegrees: number): void {
    // A hair off straight down, so that the turn is not lost.
    const tilt = Math.max(-89.9, Math.min(89.9, tiltDegrees));
    this.slide(lamp, event, () => ({ direction: directionOf(turnDegrees * kRadPerDegree, -tilt * kRadPerDegree) }));
  }

  private slide(lamp: Lamp, event: CustomEvent<Slide>, fields: (value: number) => EditFields): void {
    this.session.edit(lamp.id, fields(event.detail.value), event.detail.gesture);
  }

  private set(lamp: Lamp, fields: EditFields, gesture = ""): void {
    this.session.edit(lamp.id, fields, gesture ? `${gesture} ${changes}` : `set ${++changes}`);
  }
}

declare global {
  interface HTMLElementTagNameMap {
    "rl-lamp-editor": LampEditor;
  }
}
