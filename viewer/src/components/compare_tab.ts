// The technique of the picture, two pictures side by side, and plans of light to come back to.
import { css, html, nothing } from "lit";
import { customElement, query } from "lit/decorators.js";
import type { Side, Split } from "../protocol.js";
import { SessionElement } from "./element.js";
import { controls } from "./styles.js";

const kFirstPlan = "start"; // the home as it was opened; it stays
const kEdited = ""; // stands for the plan that is edited

@customElement("rl-compare-tab")
export class CompareTab extends SessionElement {
  static override styles = [
    controls,
    css`
      fieldset {
        margin: 0;
        padding: 0;
        border: 0;
      }
      ul {
        display: grid;
        gap: 6px;
        margin: 0;
        padding: 0;
        list-style: none;
      }
      .name {
        overflow: hidden;
        text-overflow: ellipsis;
      }
    `,
  ];

  @query("#plan") private planField!: HTMLInputElement;

  override render() {
    const { model, technique, split } = this.session;
    if (!model) return nothing;
    const about = model.welcome.techniques.find(({ name }) => name === technique)?.about;
    return html`
      <section class="section" aria-label="Technique">
        <label class="field">
          <span>Technique</span>
          ${this.techniqueSelect(technique, "Technique", name => this.session.setTechnique(name))}
        </label>
        ${about ? html`<p class="muted">${about}</p>` : nothing}
      </section>
      <section class="section" aria-label="Split view">
        <label class="check">
          <input
            type="checkbox"
            .checked=${split !== null}
            @change=${(event: Event) =>
              this.session.setSplit((event.target as HTMLInputElement).checked ? this.firstSplit() : null)}
          />
          Split view
        </label>
        ${split
          ? html`<div class="two">${this.side(split, "left", "Left")}${this.side(split, "right", "Right")}</div>
              <p class="muted">Drag the divider in the picture, or focus it and use the arrow keys.</p>`
          : nothing}
      </section>
      <section class="section" aria-label="Light plans">
        <h2>Light plans</h2>
        <p class="muted">A plan keeps the lamps and the sun as they are now, to compare with or to come back to.</p>
        <form
          class="row"
          @submit=${(event: Event) => {
            event.preventDefault();
            this.keep();
          }}
        >
          <input id="plan" class="grow" maxlength="60" placeholder="Evening" aria-label="Name of the plan" />
          <button>Keep</button>
        </form>
        <ul>
          ${model.plans.map(
            plan =>
              html`<li class="row">
                <span class="grow name">${plan}</span>
                <button aria-label=${`Apply ${plan}`} @click=${() => this.session.plan("apply", plan)}>Apply</button>
                <button
                  class="plain"
                  ?hidden=${plan === kFirstPlan}
                  aria-label=${`Drop ${plan}`}
                  title="Drop"
                  @click=${() => this.session.plan("drop", plan)}
                >
                  ✕
                </button>
              </li>`,
          )}
        </ul>
      </section>
    `;
  }

  // Two light plans where there are some, for those are what a designer compares; else two techniques.
  private firstSplit(): Split {
    const { model, technique } = this.session;
    const [plan] = model?.plans ?? [];
    if (plan !== undefined) return { left: { technique, plan }, right: { technique } };
    const other = model?.welcome.techniques.find(({ name }) => name !== technique)?.name ?? technique;
    return { left: { technique }, right: { technique: other } };
  }

  private techniqueSelect(chosen: string, label: string, choose: (name: string) => void) {
    return html`<select
      aria-label=${label}
      @change=${(event: Event) => choose((event.target as HTMLSelectElement).value)}
    >
      ${this.session.model?.welcome.techniques.map(
        ({ name, about }) => html`<option value=${name} title=${about} ?selected=${name === chosen}>${name}</option>`,
      )}
    </select>`;
  }

  private side(split: Split, which: "left" | "right", title: string) {
    const side = split[which];
    const set = (change: Side) => {
      const next: { technique?: string; plan?: string } = { ...side, ...change };
      if (next.plan === kEdited) delete next.plan;
      this.session.setSplit({ ...split, [which]: next });
    };
    return html`<fieldset class="field">
      <legend class="muted">${title}</legend>
      ${this.techniqueSelect(side.technique ?? this.session.technique, `${title}: technique`, technique =>
        set({ technique }),
      )}
      <select
        aria-label=${`${title}: plan`}
        @change=${(event: Event) => set({ plan: (event.target as HTMLSelectElement).value })}
      >
        <option value=${kEdited} ?selected=${side.plan === undefined}>As it is now</option>
        ${this.session.model?.plans.map(
          plan => html`<option value=${plan} ?selected=${plan === side.plan}>${plan}</option>`,
        )}
      </select>
    </fieldset>`;
  }

  private keep(): void {
    const name = this.planField.value.trim();
    if (!name) {
      this.planField.focus();
      return;
    }
    this.session.plan("keep", name);
    this.planField.value = "";
  }
}

declare global {
  interface HTMLElementTagNameMap {
    "rl-compare-tab": CompareTab;
  }
}
