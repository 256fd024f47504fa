// The page: tool bar, picture, panel and status line; keys that count everywhere.
import { css, html, nothing } from "lit";
import { customElement, query } from "lit/decorators.js";
import type { Tab } from "../session.js";
import "./compare_tab.js";
import { SessionElement } from "./element.js";
import "./help.js";
import type { Help } from "./help.js";
import "./home_tab.js";
import type { HomeTab } from "./home_tab.js";
import { helpIcon, meterIcon, orbitIcon, redoIcon, saveIcon, undoIcon, walkIcon } from "./icons.js";
import "./light_tab.js";
import "./render_tab.js";
import "./stage.js";
import type { Stage } from "./stage.js";
import "./status.js";
import { controls } from "./styles.js";
import "./view_tab.js";

const kTabs: readonly (readonly [Tab, string])[] = [
  ["home", "Home"],
  ["light", "Daylight"],
  ["view", "Display"],
  ["compare", "Compare"],
  ["render", "Render"],
];

@customElement("rl-app")
export class App extends SessionElement {
  protected override readonly topics = ["model", "ui", "meter"] as const;
  static override styles = [
    controls,
    css`
      :host {
        display: grid;
        grid-template: auto minmax(0, 1fr) auto / minmax(0, 1fr) clamp(240px, 41vw, 340px);
        height: 100vh;
        height: 100dvh;
        background: var(--ground);
      }
      header {
        grid-column: 1 / -1;
        display: flex;
        align-items: center;
        gap: 6px;
        min-height: 44px;
        padding: 0 12px;
        background: var(--surface);
        border-bottom: 1px solid var(--line);
      }
      h1 {
        flex: 1;
        min-width: 0;
        margin: 0;
        overflow: hidden;
        font-size: 14px;
        font-weight: 600;
        text-overflow: ellipsis;
        white-space: nowrap;
      }
      header button {
        display: flex;
        align-items: center;
        gap: 6px;
        min-height: 34px;
        padding: 4px 8px;
        background: none;
      }
      header button:not([aria-pressed="true"]) {
        border-color: transparent;
      }
      header .gap {
        width: 1px;
        height: 20px;
        margin: 0 4px;
        background: var(--line);
      }
      rl-stage {
        grid-area: 2 / 1;
      }
      rl-status {
        grid-area: 3 / 1;
      }
      .panel {
        grid-area: 2 / 2 / 4;
        display: flex;
        flex-direction: column;
        min-height: 0;
        background: var(--surface);
        border-left: 1px solid var(--line);
      }
      [role="tablist"] {
        display: flex;
        flex: none;
        border-bottom: 1px solid var(--line);
      }
      [role="tab"] {
        flex: 1;
        min-width: 0;
        min-height: 40px;
        padding: 4px 2px;
        border: 0;
        border-bottom: 2px solid transparent;
        border-radius: 0;
        color: var(--muted);
        background: none;
      }
      [role="tab"][aria-selected="true"] {
        color: var(--text);
        border-bottom-color: var(--accent);
      }
      [role="tab"]:focus-visible {
        outline-offset: -2px;
      }
      [role="tabpanel"] {
        flex: 1;
        min-height: 0;
        overflow: auto;
        overscroll-behavior: contain;
        scrollbar-color: #565656 transparent;
        scrollbar-width: thin;
      }
      .notice {
        position: fixed;
        bottom: 44px;
        left: 16px;
        z-index: 5;
        max-width: min(520px, calc(100vw - 32px));
        padding: 9px 14px;
        border: 1px solid var(--control-line);
        border-radius: 6px;
        background: #262626;
        box-shadow: 0 4px 18px rgb(0 0 0 / 45%);
      }
      .notice.bad {
        border-color: var(--danger);
      }
      .fold {
        display: none;
      }
      @media (max-width: 760px) {
        header {
          gap: 2px;
          padding: 0 4px 0 12px;
        }
        header .word,
        header .gap {
          display: none;
        }
        header button {
          min-width: 40px;
          min-height: 40px;
          justify-content: center;
        }
        [role="tab"] {
          font-size: 12px;
        }
        .fold {
          display: block;
          flex: none;
          border: 0;
          background: none;
        }
        .mark {
          display: inline-block;
        }
        :host([folded]) .mark {
          transform: rotate(180deg);
        }
      }
      /* Upright: the panel lies under the picture, which keeps half of the height. */
      @media (max-width: 760px) and (min-height: 521px), (max-width: 760px) and (max-aspect-ratio: 1249/1000) {
        :host {
          grid-template: auto minmax(50vh, 1fr) auto minmax(0, max-content) / minmax(0, 1fr);
          grid-template: auto minmax(50dvh, 1fr) auto minmax(0, max-content) / minmax(0, 1fr);
        }
        .panel {
          grid-area: 4 / 1;
          border-top: 1px solid var(--line);
          border-left: 0;
          padding-bottom: env(safe-area-inset-bottom);
        }
        [role="tab"] {
          min-height: 44px;
        }
        [role="tabpanel"] {
          flex: 0 1 40vh;
          flex-basis: 40dvh;
        }
        .fold {
          width: 44px;
        }
        .notice {
          bottom: auto;
          top: 56px;
        }
      }
      /* Low: the panel stands beside the picture, as high as the window, and folds to a strip of its tabs. */
      @media (max-width: 760px) and (max-height: 520px) and (min-aspect-ratio: 5/4) {
        header {
          grid-column: 1;
          min-height: 36px;
        }
        header button {
          min-width: 34px;
          min-height: 34px;
        }
        rl-status {
          min-height: 22px;
        }
        .panel {
          grid-area: 1 / 2 / 4;
          padding-right: env(safe-area-inset-right);
        }
        [role="tab"] {
          flex: 1 0 auto;
          padding: 4px 0;
          font-size: 11px;
        }
        .fold {
          width: 30px;
          padding: 0;
        }
        .mark {
          transform: rotate(-90deg);
        }
        :host([folded]) {
          grid-template-columns: minmax(0, 1fr) auto;
        }
        :host([folded]) [role="tablist"] {
          flex: 1;
          flex-direction: column;
          min-height: 0;
          border-bottom: 0;
        }
        :host([folded]) [role="tab"] {
          flex: 0 1 auto;
          width: 36px;
          min-height: 0;
          padding: 8px 0;
          border-bottom: 0;
          border-right: 2px solid transparent;
          writing-mode: vertical-rl;
        }
        :host([folded]) [role="tab"][aria-selected="true"] {
          border-right-color: var(--accent);
        }
        :host([folded]) .mark {
          transform: rotate(90deg);
        }
        :host([folded]) .fold {
          order: -1;
          width: 36px;
          min-height: 40px;
        }
        .notice {
          bottom: 32px;
          max-width: calc(59vw - 32px);
        }
      }
      @media (prefers-reduced-motion: no-preference) {
        button,
        [role="tab"] {
          transition:
            background-color 120ms,
            border-color 120ms;
        }
      }
    `,
  ];

  @query("rl-stage") private stage!: Stage;
  @query("rl-help") private help!: Help;
  @query("rl-home-tab") private homeTab!: HomeTab | null;
  private readonly onKey = (event: KeyboardEvent) => this.key(event);

  override connectedCallback(): void {
    super.connectedCallback();
    window.addEventListener("keydown", this.onKey);
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    window.removeEventListener("keydown", this.onKey);
  }

  override render() {
    const { session } = this;
    this.toggleAttribute("folded", !session.sheetOpen);
    return html`
      ${this.bar()}
      <rl-stage .session=${session}></rl-stage>
      <aside class="panel" aria-label="Panel">
        <div role="tablist" aria-label="Panel" @keydown=${this.tabKey}>
          ${kTabs.map(
            ([tab, name]) =>
              html`<button
                role="tab"
                id=${`tab-${tab}`}
                aria-selected=${tab === session.tab}
                aria-controls="sheet"
                tabindex=${tab === session.tab ? 0 : -1}
                @click=${() => session.show({ tab, sheetOpen: true })}
              >
                ${name}
              </button>`,
          )}
          <button
            class="fold"
            aria-label=${session.sheetOpen ? "Fold the panel" : "Unfold the panel"}
            aria-expanded=${session.sheetOpen}
            @click=${() => session.show({ sheetOpen: !session.sheetOpen })}
          >
            <span class="mark" aria-hidden="true">▾</span>
          </button>
        </div>
        <div role="tabpanel" id="sheet" aria-labelledby=${`tab-${session.tab}`} ?hidden=${!session.sheetOpen}>
          ${this.tab()}
        </div>
      </aside>
      <rl-status .session=${session}></rl-status>
      ${session.notice
        ? html`<div class="notice ${session.notice.bad ? "bad" : ""}" role=${session.notice.bad ? "alert" : "status"}>
            ${session.notice.text}
          </div>`
        : nothing}
      <rl-help></rl-help>
    `;
  }

  private bar() {
    const { session } = this;
    const { model, navigation, meter } = session;
    const undo = model?.undo ?? null;
    const redo = model?.redo ?? null;
    const walking = navigation === "walk";
    return html`<header>
      <h1>${model?.welcome.home ?? "roomlight"}</h1>
      <button
        aria-label="Undo"
        title=${undo === null ? "Nothing to undo" : `Undo: ${undo} (Ctrl+Z)`}
        ?disabled=${undo === null}
        @click=${() => session.undo()}
      >
        ${undoIcon}
      </button>
      <button
        aria-label="Redo"
        title=${redo === null ? "Nothing to redo" : `Redo: ${redo} (Ctrl+Shift+Z)`}
        ?disabled=${redo === null}
        @click=${() => session.redo()}
      >
        ${redoIcon}
      </button>
      <span class="gap"></span>
      <button
        aria-label=${walking
          ? "Dragging looks around; change to going around"
          : "Dragging goes around; change to looking around"}
        title="What dragging does (O)"
        @click=${() => this.toggleNavigation()}
      >
        ${walking ? walkIcon : orbitIcon}<span class="word">${walking ? "Walk" : "Orbit"}</span>
      </button>
      <button
        aria-label="Light meter"
        title="Light meter (M)"
        aria-pressed=${meter.on}
        @click=${() => this.toggleMeter()}
      >
        ${meterIcon}<span class="word">Meter</span>
      </button>
      <span class="gap"></span>
      <button
        aria-label="Save as lighting file"
        title="Save as lighting file (Ctrl+S)"
        ?disabled=${!model}
        @click=${() => void session.save()}
      >
        ${saveIcon}<span class="word">Save</span>
      </button>
      <button aria-label="Keys and gestures" title="Keys and gestures (?)" @click=${() => this.help.open()}>
        ${helpIcon}
      </button>
    </header>`;
  }

  private tab() {
    const { session } = this;
    switch (session.tab) {
      case "home":
        return html`<rl-home-tab .session=${session}></rl-home-tab>`;
      case "light":
        return html`<rl-light-tab .session=${session}></rl-light-tab>`;
      case "view":
        return html`<rl-view-tab .session=${session}></rl-view-tab>`;
      case "compare":
        return html`<rl-compare-tab .session=${session}></rl-compare-tab>`;
      case "render":
        return html`<rl-render-tab .session=${session}></rl-render-tab>`;
    }
  }

  private toggleNavigation(): void {
    this.session.show({ navigation: this.session.navigation === "walk" ? "orbit" : "walk" });
  }

  private toggleMeter(): void {
    const { meter } = this.session;
    meter.turn(!meter.on);
    if (meter.on) this.stage.measureMiddle();
  }

  private tabKey(event: KeyboardEvent): void {
    const by = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
    if (by === 0) return;
    event.preventDefault();
    const at = kTabs.findIndex(([tab]) => tab === this.session.tab);
    const [tab] = kTabs[(at + by + kTabs.length) % kTabs.length]!;
    this.session.show({ tab, sheetOpen: true });
    this.renderRoot.querySelector<HTMLElement>(`#tab-${tab}`)?.focus();
  }

  private async search(): Promise<void> {
    this.session.show({ tab: "home", sheetOpen: true });
    await this.updateComplete;
    await this.homeTab?.updateComplete;
    this.homeTab?.focusSearch();
  }

  private key(event: KeyboardEvent): void {
    const target = event.composedPath()[0];
    const typing =
      target instanceof HTMLSelectElement ||
      (target instanceof HTMLInputElement && !["range", "checkbox", "color"].includes(target.type));
    if (this.shortcut(event, typing)) event.preventDefault();
  }

  // True if the key was one of ours.
  private shortcut(event: KeyboardEvent, typing: boolean): boolean {
    const { session } = this;
    if (event.defaultPrevented || this.renderRoot.querySelector("rl-help")?.shadowRoot?.querySelector("dialog[open]"))
      return false;
    const key = event.key.toLowerCase();
    if ((event.ctrlKey || event.metaKey) && !event.altKey) {
      if (key === "s") void session.save();
      else if (typing) return false;
      else if (key === "z" && !event.shiftKey) session.undo();
      else if (key === "y" || key === "z") session.redo();
      else return false;
      return true;
    }
    if (typing) return false;
    if (this.stage.keyDown(event)) return true;
    if (event.repeat || event.altKey) return false;
    if (key === "m") this.toggleMeter();
    else if (key === "o") this.toggleNavigation();
    else if (key === "f" && session.selection) session.showSelected();
    else if (key === "?") this.help.open();
    else if (key === "/") void this.search();
    else if (key === "escape" && session.selection) session.select(null);
    else return false;
    return true;
  }
}

declare global {
  interface HTMLElementTagNameMap {
    "rl-app": App;
  }
}
