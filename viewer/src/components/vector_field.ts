// Three numbers in metres: a place or a shift.
import { css, html, LitElement } from "lit";
import { customElement, property } from "lit/decorators.js";
import { roundTo } from "../numbers.js";
import type { Vec3 } from "../vector.js";
import { controls } from "./styles.js";

@customElement("rl-vector")
export class VectorField extends LitElement {
  static override styles = [
    controls,
    css`
      .three {
        display: grid;
        grid-template-columns: repeat(3, 1fr);
        gap: 6px;
        margin-top: 4px;
      }
      label {
        display: flex;
        align-items: center;
        gap: 5px;
      }
      .x {
        color: #ff7a6b;
      }
      .y {
        color: #86d97a;
      }
      .z {
        color: #7db3ff;
      }
    `,
  ];

  @property() label = "";
  @property({ attribute: false }) value: Vec3 = [0, 0, 0];
  @property({ type: Boolean }) disabled = false;

  override render() {
    return html`
      <span>${this.label}</span>
      <div class="three" role="group" aria-label=${this.label}>
        ${(["x", "y", "z"] as const).map(
          (axis, i) => html`
            <label>
              <span class=${axis} aria-hidden="true">${axis}</span>
              <input
                class="number"
                type="number"
                step="0.05"
                aria-label=${`${this.label}, ${axis}`}
                .value=${String(roundTo(this.value[i]!, 0.001))}
                ?disabled=${this.disabled}
                @change=${(event: Event) => this.typed(i, event.target as HTMLInputElement)}
              />
            </label>
          `,
        )}
      </div>
    `;
  }

  private typed(index: number, field: HTMLInputElement): void {
    const value = field.valueAsNumber;
    if (!Number.isFinite(value)) {
      field.value = String(roundTo(this.value[index]!, 0.001));
      return;
    }
    const next = this.value.map((old, i) => (i === index ? value : old)) as unknown as Vec3;
    this.dispatchEvent(new CustomEvent<Vec3>("vector", { detail: next }));
  }
}

declare global {
  interface HTMLElementTagNameMap {
    "rl-vector": VectorField;
  }
}
