// Final pictures: what to make, how far it is, and the finished ones to look at and download.
import { css, html, nothing } from "lit";
import { customElement, state } from "lit/decorators.js";
import { bytes, duration } from "../numbers.js";
import type { Job, RenderRequest } from "../protocol.js";
import { SessionElement } from "./element.js";
import { controls } from "./styles.js";

type Kind = RenderRequest["kind"];

const kSizes: Readonly<Record<Kind, readonly (readonly [number, number])[]>> = {
  picture: [
    [1280, 720],
    [1920, 1080],
    [2560, 1440],
    [3840, 2160],
  ],
  panorama: [
    [2048, 1024],
    [4096, 2048],
    [6144, 3072],
  ],
};
const kFormats = ["png", "jpg", "exr"] as const;
const kTimes: readonly (readonly [number, string])[] = [
  [0, "Until it is done"],
  [30, "30 s at most"],
  [120, "2 min at most"],
  [600, "10 min at most"],
];

@customElement("rl-render-tab")
export class RenderTab extends SessionElement {
  protected override readonly topics = ["model", "jobs"] as const;
  static override styles = [
    controls,
    css`
      progress {
        width: 100%;
        height: 8px;
        accent-color: var(--accent);
      }
      img {
        display: block;
        width: 100%;
        border-radius: 5px;
        background: var(--ground);
      }
      a {
        color: var(--accent);
      }
      .bad {
        color: var(--danger);
      }
    `,
  ];

  @state() private kind: Kind = "picture";
  @state() private size = 1;
  @state() private quality = "";
  @state() private format: (typeof kFormats)[number] = "png";
  @state() private seconds = 0;

  override render() {
    const { model, pictures } = this.session;
    if (!model) return nothing;
    const { qualities } = model.welcome;
    const quality = this.chosenQuality();
    return html`
      <section class="section" aria-label="A final picture">
        <div class="segments" role="radiogroup" aria-label="Kind of picture">
          ${(["picture", "panorama"] as const).map(
            kind =>
              html`<button role="radio" aria-checked=${kind === this.kind} @click=${() => this.choose(kind)}>
                ${kind === "picture" ? "Picture" : "Panorama"}
              </button>`,
          )}
        </div>
        <div class="two">
          ${this.select(
            "Size",
            this.sizes().map(([w, h], i) => [String(i), `${w} × ${h}`]),
            String(this.size),
            v => (this.size = Number(v)),
          )}
          ${this.select(
            "File",
            kFormats.map(f => [f, f.toUpperCase()]),
            this.format,
            v => (this.format = v as typeof this.format),
          )}
          ${this.select(
            "Quality",
            qualities.map(({ name }) => [name, name]),
            quality,
            v => (this.quality = v),
          )}
          ${this.select(
            "Time",
            kTimes.map(([s, name]) => [String(s), name]),
            String(this.seconds),
            v => (this.seconds = Number(v)),
          )}
        </div>
        <p class="muted">${qualities.find(({ name }) => name === quality)?.about ?? ""}</p>
        <button class="main" ?disabled=${pictures.busy} @click=${this.start}>Render</button>
      </section>
      <div aria-live="polite">${pictures.jobs.map(job => this.job(job))}</div>
    `;
  }

  private sizes(): readonly (readonly [number, number])[] {
    const limits = this.session.model?.welcome.limits;
    return kSizes[this.kind].filter(([w, h]) => !limits || (w <= limits.renderWidth && h <= limits.renderHeight));
  }

  // The last one asked for; at first good, where there is one.
  private chosenQuality(): string {
    const names = this.session.model?.welcome.qualities.map(({ name }) => name) ?? [];
    return names.find(name => name === this.quality) ?? names.find(name => name === "good") ?? names[0] ?? "";
  }

  private choose(kind: Kind): void {
    this.kind = kind;
    this.size = 1;
  }

  private select(
    label: string,
    options: readonly (readonly string[])[],
    chosen: string,
    choose: (value: string) => void,
  ) {
    return html`<label class="field">
      <span>${label}</span>
      <select @change=${(event: Event) => choose((event.target as HTMLSelectElement).value)}>
        ${options.map(([value, name]) => html`<option value=${value!} ?selected=${value === chosen}>${name}</option>`)}
      </select>
    </label>`;
  }

  private start(): void {
    const [width, height] = this.sizes()[this.size] ?? this.sizes()[0] ?? [1280, 720];
    const quality = this.chosenQuality();
    void this.session.render({
      kind: this.kind,
      width,
      height,
      format: this.format,
      technique: this.session.technique,
      ...(quality ? { quality } : {}),
      ...(this.seconds ? { seconds: this.seconds } : {}),
    });
  }

  private job(job: Job) {
    const error = job.estimatedError === null ? "" : ` · error about ${(100 * job.estimatedError).toFixed(1)}\u202f%`;
    if (job.state === "running") {
      const left = job.secondsLeft === null ? "" : ` · ${duration(job.secondsLeft)} left`;
      return html`<section class="section" aria-label="Rendering">
        <progress max="1" .value=${job.fraction} aria-label="How far the picture is"></progress>
        <div class="row">
          <span class="grow muted number">${job.stage}${left}${error}</span>
          <button @click=${() => this.session.cancel(job.job)}>Cancel</button>
        </div>
      </section>`;
    }
    const { file } = job;
    return html`<section class="section" aria-label="A finished picture">
      ${job.state === "failed" ? html`<p class="bad">${job.message ?? "The picture could not be made."}</p>` : nothing}
      ${job.state === "cancelled"
        ? html`<p class="muted">Cancelled${file ? ": this is the best picture so far." : "."}</p>`
        : nothing}
      ${file
        ? this.file(this.session.pictures.addresses.get(job.job), file.name, `${bytes(file.bytes)}${error}`)
        : nothing}
    </section>`;
  }

  private file(address: string | undefined, name: string, detail: string) {
    if (address === undefined) return html`<p class="muted">${name} is on its way.</p>`;
    return html`
      ${name.endsWith(".exr") ? nothing : html`<img src=${address} alt=${`The rendered picture ${name}`} />`}
      <div class="row">
        <a class="grow" href=${address} download=${name}>Download ${name}</a><span class="muted number">${detail}</span>
      </div>
    `;
  }
}

declare global {
  interface HTMLElementTagNameMap {
    "rl-render-tab": RenderTab;
  }
}
