// The sheet of keys and gestures.
import { css, html, LitElement } from "lit";
import { customElement, query } from "lit/decorators.js";
import { controls } from "./styles.js";

const kKeys: readonly (readonly [string, readonly (readonly [string, string])[]])[] = [
  [
    "Walk and look",
    [
      ["W A S D, arrows up and down", "walk; with Shift three times as fast"],
      ["Q E, arrows left and right", "turn"],
      ["Page up, Page down", "raise and lower the eye"],
      ["Drag", "look around"],
      ["Wheel", "forward and back"],
      ["Right drag or Alt drag", "go around what is selected or was clicked"],
      ["Middle drag", "shift"],
      ["O", "dragging looks around or goes around"],
      ["F", "go where what is selected is seen well"],
    ],
  ],
  [
    "On a touch screen",
    [
      ["One finger", "look around"],
      ["Two fingers", "walk, as if pulling the floor"],
      ["Spread, pinch", "forward and back"],
      ["Tap", "select, or read the light while the meter is on"],
    ],
  ],
  [
    "Change and measure",
    [
      ["Click", "select a lamp or a thing"],
      ["Drag arrow, disc, ring", "move along an axis, on the level, turn; with Shift without what stands on it"],
      ["M", "light meter"],
      ["Ctrl+Z, Ctrl+Shift+Z", "undo, redo"],
      ["Ctrl+S", "save as a lighting file"],
      ["/", "search"],
      ["Esc", "select nothing"],
    ],
  ],
];

@customElement("rl-help")
export class Help extends LitElement {
  static override styles = [
    controls,
    css`
      dialog {
        width: min(860px, calc(100vw - 32px));
        max-height: calc(100vh - 32px);
        padding: 20px 24px 24px;
        border: 1px solid var(--line);
        border-radius: 10px;
        color: var(--text);
        background: var(--surface);
        overflow: auto;
      }
      dialog::backdrop {
        background: rgb(0 0 0 / 60%);
      }
      .columns {
        display: grid;
        grid-template-columns: repeat(auto-fit, minmax(230px, 1fr));
        gap: 20px 28px;
        margin-top: 14px;
      }
      dl {
        display: grid;
        gap: 8px;
        margin: 8px 0 0;
      }
      dt {
        font-weight: 600;
      }
      dd {
        margin: 0;
        color: var(--muted);
      }
    `,
  ];

  @query("dialog") private dialog!: HTMLDialogElement;

  open(): void {
    if (!this.dialog.open) this.dialog.showModal();
  }

  override render() {
    return html`<dialog aria-label="Keys and gestures">
      <div class="row">
        <h2 class="grow">Keys and gestures</h2>
        <button @click=${() => this.dialog.close()}>Close</button>
      </div>
      <div class="columns">
        ${kKeys.map(
          ([title, keys]) =>
            html`<section>
              <h3>${title}</h3>
              <dl>
                ${keys.map(
                  ([key, does]) =>
                    html`<div>
                      <dt>${key}</dt>
                      <dd>${does}</dd>
                    </div>`,
                )}
              </dl>
            </section>`,
        )}
      </div>
    </dialog>`;
  }
}

declare global {
  interface HTMLElementTagNameMap {
    "rl-help": Help;
  }
}
