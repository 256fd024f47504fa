// What can be changed of the selected thing.
import { css, html, nothing } from "lit";
import { customElement } from "lit/decorators.js";
import { hexFromLinear, linearFromHex } from "../color.js";
import { threeDigits } from "../numbers.js";
import type { EditFields, Paint, Thing } from "../protocol.js";
import { subtract, type Vec3 } from "../vector.js";
import { SessionElement } from "./element.js";
import "./slider.js";
import type { Slide } from "./slider.js";
import { controls } from "./styles.js";
import "./vector_field.js";

let changes = 0;

@customElement("rl-object-editor")
export class ObjectEditor extends SessionElement {
  static override styles = [
    controls,
    css`
      .paints {
        display: grid;
        gap: 6px;
        max-height: 190px;
        margin: 0;
        padding: 3px;
        overflow: auto;
        list-style: none;
      }
      .name {
        overflow: hidden;
        text-overflow: ellipsis;
        white-space: nowrap;
      }
    `,
  ];

  override render() {
    const { selection, model } = this.session;
    const thing = selection?.kind === "object" ? model?.things.get(selection.id) : undefined;
    if (!thing) return nothing;
    const size = subtract(thing.high, thing.low);
    const moved = thing.turn !== 0 || thing.move.some(m => m !== 0);
    return html`
      <div class="stack">
        <div class="row">
          <button aria-pressed=${thing.hidden} @click=${() => this.set(thing, { hidden: !thing.hidden })}>
            ${thing.hidden ? "Hidden" : "Hide"}
          </button>
          <span class="grow muted number">${[size[0], size[2], size[1]].map(threeDigits).join(" × ")} m</span>
          ${thing.movable && moved
            ? html`<button @click=${() => this.set(thing, this.moving({ move: [0, 0, 0], turn: 0 }))}>Put back</button>`
            : nothing}
        </div>
        ${thing.open === null ? nothing : this.door(thing, thing.open)} ${thing.movable ? this.place(thing) : nothing}
        ${thing.colors.length ? this.paints(thing) : nothing}
      </div>
    `;
  }

  private door(thing: Thing, open: number) {
    return html`<rl-slider
      label="Open"
      unit="%"
      min="0"
      max="100"
      step="1"
      .value=${open * 100}
      @slide=${(event: CustomEvent<Slide>) => this.slide(thing, event, value => ({ open: value / 100 }))}
    ></rl-slider>`;
  }

  private place(thing: Thing) {
    return html`
      <rl-vector
        label="Moved by, m"
        .value=${thing.move}
        @vector=${(event: CustomEvent<Vec3>) => this.set(thing, this.moving({ move: event.detail }))}
      ></rl-vector>
      <rl-slider
        label="Turned by"
        unit="°"
        min="-180"
        max="180"
        step="1"
        .value=${((((thing.turn + 180) % 360) + 360) % 360) - 180}
        @slide=${(event: CustomEvent<Slide>) => this.slide(thing, event, value => this.moving({ turn: value }))}
      ></rl-slider>
      <label class="row" title="With Shift held, a handle moves it alone as well">
        <input
          type="checkbox"
          .checked=${!this.session.movesAlone}
          @change=${(event: Event) => this.session.show({ movesAlone: !(event.target as HTMLInputElement).checked })}
        />
        Take along what stands on it
      </label>
    `;
  }

  private paints(thing: Thing) {
    return html`
      <h3>Colours</h3>
      <ul class="paints">
        ${thing.colors.map(paint => html`<li>${this.paint(thing, paint)}</li>`)}
      </ul>
    `;
  }

  private paint(thing: Thing, paint: Paint) {
    return html`<label class="row">
      <span class="grow name">${paint.label || paint.material || "Without a name"}</span>
      ${paint.textured ? html`<span class="muted" title="The colour multiplies the texture">texture</span>` : nothing}
      <input
        type="color"
        .value=${hexFromLinear(paint.color)}
        @input=${(event: Event) => this.recolor(thing, paint, (event.target as HTMLInputElement).value)}
        @change=${() => ++changes}
      />
    </label>`;
  }

  private recolor(thing: Thing, paint: Paint, hex: string): void {
    this.session.edit(thing.id, { color: linearFromHex(hex), material: paint.material }, `colour ${changes}`);
  }

  private moving(fields: EditFields): EditFields {
    return this.session.movesAlone ? { ...fields, alone: true } : fields;
  }

  private slide(thing: Thing, event: CustomEvent<Slide>, fields: (value: number) => EditFields): void {
    this.session.edit(thing.id, fields(event.detail.value), event.detail.gesture);
  }

  private set(thing: Thing, fields: EditFields): void {
    this.session.edit(thing.id, fields, `set ${++changes}`);
  }
}

declare global {
  interface HTMLElementTagNameMap {
    "rl-object-editor": ObjectEditor;
  }
}
