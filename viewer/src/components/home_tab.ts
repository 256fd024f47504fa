// What the home holds: rooms, cameras, lamps and things to search and choose from, and the editor of what is chosen.
import { css, html, nothing, type PropertyValues } from "lit";
import { customElement, query, state } from "lit/decorators.js";
import { repeat } from "lit/directives/repeat.js";
import { withUnit } from "../numbers.js";
import type { Lamp, Room } from "../protocol.js";
import type { Selection } from "../session.js";
import { SessionElement } from "./element.js";
import { lampColor } from "./lamp_editor.js";
import "./object_editor.js";
import { controls } from "./styles.js";

type Kind = Selection["kind"];

interface Entry {
  readonly kind: Kind;
  readonly id: string;
  readonly name: string;
  readonly detail: string;
  readonly swatch: string | null;
}

const kKinds: readonly (readonly [Kind, string])[] = [
  ["room", "Rooms"],
  ["camera", "Cameras"],
  ["lamp", "Lamps"],
  ["object", "Objects"],
];

// Shoelace formula, m².
function floorArea({ floor }: Room): number {
  const twice = floor.reduce((sum, [x, z], i) => {
    const [nextX, nextZ] = floor[(i + 1) % floor.length]!;
    return sum + x * nextZ - nextX * z;
  }, 0);
  return Math.abs(twice) / 2;
}

function lampDetail(lamp: Lamp): string {
  if (!lamp.on) return "off";
  if (lamp.fluxLm === null) return `${Math.round(lamp.dim * 100)}\u202f%`;
  return withUnit(lamp.fluxLm * lamp.dim, "lm");
}

@customElement("rl-home-tab")
export class HomeTab extends SessionElement {
  static override styles = [
    controls,
    css`
      :host {
        display: flex;
        flex-direction: column;
        height: 100%;
      }
      .editor {
        flex: 0 1 auto;
        max-height: 66%;
        overflow: auto;
        scrollbar-width: thin;
        scrollbar-color: #565656 transparent;
      }
      .list {
        flex: 1;
        min-height: 0;
        overflow: auto;
        scrollbar-width: thin;
        scrollbar-color: #565656 transparent;
      }
      .editor h2 {
        overflow: hidden;
        text-overflow: ellipsis;
      }
      .head {
        position: sticky;
        top: 0;
        z-index: 2;
        background: var(--surface);
      }
      [role="listbox"] {
        padding: 6px 8px 16px;
      }
      h3 {
        padding: 10px 8px 4px;
      }
      [role="option"] {
        display: flex;
        align-items: center;
        gap: 8px;
        width: 100%;
        min-height: 32px;
        padding: 4px 8px;
        border-radius: 5px;
        cursor: pointer;
      }
      [role="option"]:hover {
        background: var(--raised);
      }
      [role="option"]:focus-visible {
        outline-offset: -2px;
      }
      [role="option"][aria-selected="true"] {
        background: #3b3322;
        color: #ffd894;
      }
      .name {
        flex: 1;
        overflow: hidden;
        text-overflow: ellipsis;
        white-space: nowrap;
      }
      .none {
        padding: 16px 8px;
      }
      @media (max-width: 760px) {
        .editor {
          max-height: none;
        }
        .editor ~ .list {
          display: none; /* the sheet is too low for both: the cross leads back to the list */
        }
      }
      @media (pointer: coarse) {
        [role="option"] {
          min-height: 44px;
        }
      }
    `,
  ];

  @state() private kind: Kind = "lamp";
  @state() private search = "";
  @query("#search") private searchField!: HTMLInputElement;
  private followed: Selection | null = null;

  focusSearch(): void {
    this.searchField.focus();
    this.searchField.select();
  }

  override render() {
    const { model } = this.session;
    if (!model) return nothing;
    const wanted = this.search.trim().toLocaleLowerCase();
    const kinds = wanted ? kKinds : kKinds.filter(([kind]) => kind === this.kind);
    const groups = kinds
      .map(([kind, title]) => ({
        title,
        entries: this.entries(kind).filter(e => e.name.toLocaleLowerCase().includes(wanted)),
      }))
      .filter(({ entries }) => entries.length > 0);
    return html`
      ${this.editor()}
      <div class="list">
        <div class="section head">
          <input
            id="search"
            type="search"
            placeholder="Search the home"
            aria-label="Search rooms, cameras, lamps and objects"
            .value=${this.search}
            @input=${(event: Event) => (this.search = (event.target as HTMLInputElement).value)}
            @keydown=${this.searchKey}
          />
          <div class="segments" role="radiogroup" aria-label="What the list shows" ?hidden=${wanted !== ""}>
            ${kKinds.map(
              ([kind, title]) =>
                html`<button role="radio" aria-checked=${kind === this.kind} @click=${() => (this.kind = kind)}>
                  ${title}
                </button>`,
            )}
          </div>
        </div>
        <div role="listbox" aria-label=${wanted ? "What was found" : (kinds[0]?.[1] ?? "")} @keydown=${this.listKey}>
          ${groups.map(
            ({ title, entries }) => html`
              ${wanted ? html`<h3 role="presentation">${title}</h3>` : nothing}
              ${repeat(
                entries,
                entry => entry.kind + entry.id,
                entry => this.option(entry, entry === groups[0]?.entries[0]),
              )}
            `,
          )}
          ${groups.length
            ? nothing
            : html`<p class="muted none">${wanted ? "Nothing has that name." : "The home has none."}</p>`}
        </div>
      </div>
    `;
  }

  private editor() {
    const { selection, model } = this.session;
    if (!selection || selection.kind === "room" || selection.kind === "camera") return nothing;
    const lamp = model?.lamps.get(selection.id);
    const body = lamp?.object ? model?.things.get(lamp.object) : undefined;
    const name = this.entries(selection.kind).find(({ id }) => id === selection.id)?.name;
    if (name === undefined) return nothing;
    return html`
      <section class="section editor" aria-label=${name}>
        <div class="row">
          <h2 class="grow">${name}</h2>
          <button title="Go where it is seen well (F)" @click=${() => this.session.showSelected()}>Show</button>
          <button
            class="plain"
            aria-label="Select nothing"
            title="Select nothing (Esc)"
            @click=${() => this.session.select(null)}
          >
            ✕
          </button>
        </div>
        ${selection.kind === "lamp"
          ? html`<rl-lamp-editor .session=${this.session}></rl-lamp-editor>`
          : html`<rl-object-editor .session=${this.session}></rl-object-editor>`}
        ${body
          ? html`<button @click=${() => this.session.select({ kind: "object", id: body.id })}>
              Part of ${body.name}
            </button>`
          : nothing}
        ${this.partsOf(selection)}
      </section>
    `;
  }

  // Lamps of the selected thing.
  private partsOf({ kind, id }: Selection) {
    if (kind !== "object") return nothing;
    const lamps = [...(this.session.model?.lamps.values() ?? [])].filter(lamp => lamp.object === id);
    return lamps.map(
      lamp =>
        html`<button @click=${() => this.session.select({ kind: "lamp", id: lamp.id })}>
          Its light: ${lamp.name}
        </button>`,
    );
  }

  private entries(kind: Kind): Entry[] {
    const { model } = this.session;
    if (!model) return [];
    const entry = (id: string, name: string, detail: string, swatch: string | null = null): Entry => ({
      kind,
      id,
      name: name || "Without a name",
      detail,
      swatch,
    });
    switch (kind) {
      case "room":
        return model.welcome.rooms.map((room, i) => entry(String(i), room.name, withUnit(floorArea(room), "m²")));
      case "camera":
        return model.welcome.cameras.map((camera, i) => entry(String(i), camera.name, ""));
      case "lamp":
        return [...model.lamps.values()].map(lamp =>
          entry(lamp.id, lamp.name, lampDetail(lamp), lamp.on ? lampColor(lamp) : "#333333"),
        );
      case "object":
        return [...model.things.values()].map(thing => entry(thing.id, thing.name, thing.hidden ? "hidden" : ""));
    }
  }

  private option(entry: Entry, first: boolean) {
    const { selection } = this.session;
    const selected = selection?.kind === entry.kind && selection.id === entry.id;
    const choose = () => {
      this.session.select({ kind: entry.kind, id: entry.id });
      // Rooms and cameras are places to go to; lamps and things leave the eye where it is.
      if (entry.kind === "room" || entry.kind === "camera") this.session.showSelected();
    };
    return html`<div
      role="option"
      aria-selected=${selected}
      tabindex=${selected || first ? 0 : -1}
      @click=${choose}
      @keydown=${(event: KeyboardEvent) => {
        if (event.key !== "Enter" && event.key !== " ") return;
        event.preventDefault();
        choose();
      }}
    >
      ${entry.swatch ? html`<span class="swatch" .style=${`background:${entry.swatch}`}></span>` : nothing}
      <span class="name">${entry.name}</span>
      <span class="muted number">${entry.detail}</span>
    </div>`;
  }

  private options(): HTMLElement[] {
    return [...this.renderRoot.querySelectorAll<HTMLElement>('[role="option"]')];
  }

  private searchKey(event: KeyboardEvent): void {
    if (event.key === "Escape" && this.search) {
      event.stopPropagation();
      this.search = "";
    } else if (event.key === "ArrowDown" || event.key === "Enter") {
      const [first] = this.options();
      event.preventDefault();
      if (event.key === "Enter") first?.click();
      else first?.focus();
    }
  }

  private listKey(event: KeyboardEvent): void {
    const options = this.options();
    const at = options.indexOf(event.target as HTMLElement);
    const to = { ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: options.length - 1 }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    if (to < 0) this.searchField.focus();
    else options[Math.min(to, options.length - 1)]?.focus();
  }

  protected override willUpdate(changed: PropertyValues): void {
    super.willUpdate(changed);
    // The list shows the kind of what was picked in the picture.
    const { selection } = this.session;
    if (selection && selection !== this.followed) this.kind = selection.kind;
  }

  protected override updated(): void {
    const { selection } = this.session;
    if (selection !== this.followed)
      this.renderRoot.querySelector('[aria-selected="true"]')?.scrollIntoView({ block: "nearest" });
    this.followed = selection;
  }
}

declare global {
  interface HTMLElementTagNameMap {
    "rl-home-tab": HomeTab;
  }
}
