// Daylight: the date and the hour.
import { css, html, nothing } from "lit";
import { customElement } from "lit/decorators.js";
import { clock } from "../numbers.js";
import type { Sun } from "../protocol.js";
import { SessionElement } from "./element.js";
import "./slider.js";
import type { Slide } from "./slider.js";
import { controls } from "./styles.js";

const kSeasons: readonly (readonly [string, string])[] = [
  ["03-20", "Spring"],
  ["06-21", "Summer"],
  ["09-22", "Autumn"],
  ["12-21", "Winter"],
];
const kPoints = ["N", "NE", "E", "SE", "S", "SW", "W", "NW"];

const kPlaces: Readonly<Record<Sun["placeFrom"], string>> = {
  lighting: "The place is the lighting file's",
  home: "The place is the home file's",
  assumed: "No file says where the home stands. Assumed, with north along −z",
};

let changes = 0;

@customElement("rl-light-tab")
export class LightTab extends SessionElement {
  static override styles = [
    controls,
    css`
      .time {
        width: 132px !important;
        min-height: 28px !important;
      }
      .day {
        --track: linear-gradient(90deg, #23262e 15%, #6d5a3c 26%, #f3dfae 50%, #6d5a3c 76%, #23262e 85%);
      }
    `,
  ];

  override render() {
    const { model } = this.session;
    const sun = model?.sun;
    if (!sun) return html`<p class="section muted">This home has no daylight by date.</p>`;
    const year = sun.date.slice(0, 4);
    return html`
      <section class="section" aria-label="Daylight">
        <div class="row">
          <button role="switch" aria-label="Daylight by date" aria-checked=${sun.on} @click=${() => this.toggle(sun)}>
            ${sun.on ? "On" : "Off"}
          </button>
          <span class="grow muted">${sun.on ? "By date and time" : "A date or a time switches it on"}</span>
        </div>
        <label class="field">
          <span>Date</span>
          <input
            type="date"
            .value=${sun.date}
            @change=${(event: Event) => this.setDate((event.target as HTMLInputElement).value)}
          />
        </label>
        <div class="segments" role="group" aria-label="Beginning of a season">
          ${kSeasons.map(
            ([day, name]) =>
              html`<button aria-pressed=${sun.date.endsWith(day)} @click=${() => this.setDate(`${year}-${day}`)}>
                ${name}
              </button>`,
          )}
        </div>
        <rl-slider
          class="day"
          label="Time of day"
          unit="h"
          min="0"
          max="24"
          step="0.05"
          .value=${sun.hour}
          .valueText=${clock(sun.hour)}
          @slide=${(event: CustomEvent<Slide>) =>
            this.session.edit("sun", { hour: event.detail.value }, event.detail.gesture)}
          bare
          ><input
            class="time"
            type="time"
            aria-label="Time of day"
            .value=${clock(Math.min(sun.hour, 23.99))}
            @change=${(event: Event) => this.setTime((event.target as HTMLInputElement).value)}
        /></rl-slider>
        ${sun.on ? this.position(sun) : nothing}
        <p class="muted number">
          ${kPlaces[sun.placeFrom]}: ${Math.abs(sun.latitude).toFixed(1)}°${sun.latitude < 0 ? "S" : "N"}
          ${Math.abs(sun.longitude).toFixed(1)}°${sun.longitude < 0 ? "W" : "E"},
          UTC${sun.utcOffset < 0 ? "−" : "+"}${Math.abs(sun.utcOffset)}.
        </p>
      </section>
    `;
  }

  private position({ altitude, azimuth, sky }: Sun) {
    return html`<p class="muted number">
      ${altitude < 0
        ? `The sun is ${Math.abs(altitude).toFixed(0)}° below the horizon`
        : `Sun ${altitude.toFixed(0)}° high`}
      in the ${kPoints[Math.round((((azimuth % 360) + 360) % 360) / 45) % 8]}; sky ${sky}.
    </p>`;
  }

  private toggle(sun: Sun): void {
    this.session.edit("sun", { on: !sun.on }, `daylight ${++changes}`);
  }

  private setTime(time: string): void {
    const [hours, minutes] = time.split(":").map(Number);
    if (hours === undefined || minutes === undefined || !Number.isFinite(hours + minutes)) return;
    this.session.edit("sun", { hour: hours + minutes / 60 }, `time ${++changes}`);
  }

  private setDate(date: string): void {
    if (/^\d{4}-\d{2}-\d{2}$/.test(date)) this.session.edit("sun", { date }, `date ${++changes}`);
  }
}

declare global {
  interface HTMLElementTagNameMap {
    "rl-light-tab": LightTab;
  }
}
