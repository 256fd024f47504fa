// Daylight: the date and the hour.
import { css, html } from "lit";
import { customElement } from "lit/decorators.js";
import { clock } from "../numbers.js";
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
    if (!sun) {
      return html`<p class="section muted">
        This home has no daylight by date. Start roomlight view with a lighting file that has "daylight".
      </p>`;
    }
    const year = sun.date.slice(0, 4);
    const below = sun.altitude < 0;
    return html`
      <section class="section" aria-label="Daylight">
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
        <p class="muted number">
          ${below
            ? `The sun is ${Math.abs(sun.altitude).toFixed(0)}° below the horizon`
            : `Sun ${sun.altitude.toFixed(0)}° high`}
          in the ${kPoints[Math.round((((sun.azimuth % 360) + 360) % 360) / 45) % 8]}; sky ${sun.sky}.
          UTC${sun.utcOffset < 0 ? "−" : "+"}${Math.abs(sun.utcOffset)},
          ${Math.abs(sun.latitude).toFixed(1)}°${sun.latitude < 0 ? "S" : "N"}
          ${Math.abs(sun.longitude).toFixed(1)}°${sun.longitude < 0 ? "W" : "E"}.
        </p>
      </section>
    `;
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
