// The picture, what is drawn over it, and the hands on it.
import { css, html, nothing } from "lit";
import { customElement, query } from "lit/decorators.js";
import { classMap } from "lit/directives/class-map.js";
import type { FrameHeader } from "../frame.js";
import { Input } from "../input.js";
import { overlapBoxes, overlapWords } from "../overlaps.js";
import { drawOverlay } from "../overlay.js";
import { Picture } from "../picture.js";
import { clamp } from "../vector.js";
import { SessionElement } from "./element.js";
import "./legend.js";
import "./meter.js";
import { controls } from "./styles.js";

const kDividerStep = 0.02; // of the width, by arrow keys
const kLabel =
  "The picture. W, A, S, D or arrows walk, drag to look around, click to select; question mark for all keys.";

@customElement("rl-stage")
export class Stage extends SessionElement {
  protected override readonly topics = ["model", "ui", "meter", "link"] as const;
  static override styles = [
    controls,
    css`
      :host {
        display: block;
        position: relative;
        overflow: hidden;
        background: #101010;
        contain: strict;
      }
      canvas {
        position: absolute;
        inset: 0;
        width: 100%;
        height: 100%;
      }
      #hands {
        position: absolute;
        inset: 0;
        cursor: grab;
        touch-action: none;
        user-select: none;
        -webkit-user-select: none;
      }
      #hands:active {
        cursor: grabbing;
      }
      #hands.handle {
        cursor: move;
      }
      #hands.meter {
        cursor: crosshair;
      }
      #hands:focus-visible {
        outline-offset: -3px;
      }
      #hands.pointed {
        outline: none; /* who points at the picture knows where the focus is */
      }
      .divider {
        position: absolute;
        top: 0;
        bottom: 0;
        left: -12px;
        width: 24px;
        cursor: ew-resize;
        touch-action: none;
      }
      .divider::before {
        content: "";
        position: absolute;
        top: 0;
        bottom: 0;
        left: 11px;
        width: 2px;
        background: #fff;
        box-shadow: 0 0 0 1px rgb(0 0 0 / 45%);
      }
      .divider::after {
        content: "↔";
        position: absolute;
        top: calc(50% - 15px);
        left: -3px;
        width: 30px;
        height: 30px;
        border-radius: 50%;
        color: #111;
        background: #fff;
        box-shadow: 0 0 0 1px rgb(0 0 0 / 45%);
        line-height: 29px;
        text-align: center;
      }
      .divider:focus-visible {
        outline-offset: -2px;
      }
      .side {
        position: absolute;
        bottom: 12px;
        max-width: 44%;
        padding: 3px 8px;
        border-radius: 5px;
        background: rgb(20 20 20 / 78%);
        pointer-events: none;
        overflow: hidden;
        text-overflow: ellipsis;
        white-space: nowrap;
      }
      .side.left {
        left: 12px;
      }
      .side.right {
        right: 12px;
      }
      .overlaps {
        position: absolute;
        top: 26px;
        left: 50%;
        max-width: calc(100% - 24px);
        margin: 0;
        padding: 3px 10px;
        border-radius: 5px;
        transform: translateX(-50%);
        color: var(--danger);
        background: rgb(20 20 20 / 78%);
        pointer-events: none;
        overflow: hidden;
        text-overflow: ellipsis;
        white-space: nowrap;
      }
      .overlaps[hidden] {
        display: none;
      }
      .finding {
        position: absolute;
        top: 0;
        right: 0;
        left: 0;
        display: grid;
        gap: 2px;
        pointer-events: none;
      }
      .finding progress {
        width: 100%;
        height: 3px;
        border: 0;
        appearance: none;
        -webkit-appearance: none;
        background: none;
      }
      .finding progress::-webkit-progress-bar {
        background: none;
      }
      .finding progress::-webkit-progress-value {
        background: var(--accent);
      }
      .finding span {
        justify-self: center;
        padding: 2px 10px;
        border-radius: 0 0 5px 5px;
        background: rgb(20 20 20 / 78%);
      }
      .empty {
        position: absolute;
        inset: 0;
        display: grid;
        place-content: center;
        padding: 24px;
        color: var(--muted);
        text-align: center;
        pointer-events: none;
      }
    `,
  ];

  @query("#picture") private pictureCanvas!: HTMLCanvasElement;
  @query("#overlay") private overlayCanvas!: HTMLCanvasElement;
  @query("#hands") private hands!: HTMLElement;
  private picture: Picture | null = null;
  private input: Input | null = null;
  private shown: FrameHeader | null = null; // what the canvas shows
  private overlayScheduled = false;
  private readonly sizes = new ResizeObserver(() => this.resized());

  override render() {
    const { split, dividerAt, meter, progress } = this.session;
    return html`
      <canvas id="picture" ?hidden=${this.shown === null}></canvas>
      <canvas id="overlay"></canvas>
      <div
        id="hands"
        tabindex="0"
        class=${classMap({ meter: meter.on })}
        @pointerdown=${() => this.hands.classList.add("pointed")}
        @blur=${() => this.hands.classList.remove("pointed")}
        role="application"
        aria-label=${kLabel}
      ></div>
      ${split
        ? html`${this.sideLabel("left")}${this.sideLabel("right")}
            <div
              class="divider"
              role="separator"
              tabindex="0"
              aria-orientation="vertical"
              aria-label="Divider between the two pictures"
              aria-valuemin="0"
              aria-valuemax="100"
              aria-valuenow=${Math.round(dividerAt * 100)}
              .style=${`margin-left:${dividerAt * 100}%`}
              @pointerdown=${(event: PointerEvent) =>
                (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId)}
              @pointermove=${this.dividerMoved}
              @keydown=${this.dividerKey}
            ></div>`
        : nothing}
      ${this.overlapNote()}
      <rl-legend .session=${this.session}></rl-legend>
      <rl-meter .session=${this.session}></rl-meter>
      ${progress
        ? html`<div class="finding">
            <progress max="1" .value=${progress.fraction} aria-label=${progress.stage}></progress
            ><span>${progress.stage}</span>
          </div>`
        : nothing}
      ${this.shown
        ? nothing
        : html`<p class="empty">
            ${this.session.link.state === "refused" ? this.session.link.reason : "The first picture is on its way."}
          </p>`}
    `;
  }

  // Keys that move the eye; true if this was one.
  keyDown(event: KeyboardEvent): boolean {
    const onStage = event.composedPath().includes(this.hands) || event.target === document.body;
    return this.input?.keyDown(event, onStage) ?? false;
  }

  // Reads the light in the middle of the picture, for whoever has no pointer.
  measureMiddle(): void {
    const { width, height } = this.session.eye.viewport;
    this.session.meter.hold(width / 2, height / 2);
  }

  protected override firstUpdated(): void {
    const { session } = this;
    this.picture = new Picture(
      this.pictureCanvas,
      frame => session.acknowledge(frame),
      header => this.frameDrawn(header),
      message => session.trouble(message),
    );
    session.onFrame = (header, bytes) => void this.picture?.accept(header, bytes);
    session.onNewLine = () => this.picture?.forget();
    this.input = new Input(this.hands, session, () => this.scheduleOverlay());
    this.sizes.observe(this);
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.sizes.disconnect();
    this.input?.dispose();
    this.session.onFrame = null;
    this.session.onNewLine = null;
  }

  protected override updated(): void {
    this.picture?.setDivider(this.session.dividerAt);
    this.scheduleOverlay();
  }

  private overlapNote() {
    const { model } = this.session;
    const words = model && overlapWords(model);
    return html`<p class="overlaps" role="status" ?hidden=${!words}>${words ?? ""}</p>`;
  }

  private sideLabel(which: "left" | "right") {
    const side = this.session.split?.[which];
    return html`<span class="side ${which}"
      >${side?.technique ?? this.session.technique} · ${side?.plan ?? "as it is now"}</span
    >`;
  }

  private resized(): void {
    const width = Math.round(this.clientWidth);
    const height = Math.round(this.clientHeight);
    if (width < 16 || height < 16) return;
    const pixelRatio = Math.min(2, window.devicePixelRatio || 1);
    this.picture?.resize(Math.round(width * pixelRatio), Math.round(height * pixelRatio));
    this.overlayCanvas.width = Math.round(width * pixelRatio);
    this.overlayCanvas.height = Math.round(height * pixelRatio);
    this.session.setViewport({ width, height });
    this.scheduleOverlay();
  }

  private frameDrawn(header: FrameHeader): void {
    const first = this.shown === null;
    this.shown = header;
    // For tests and the curious: which frame this is.
    const { number, camera, revision, samples, settled, quick, lightBehind } = header;
    Object.assign(this.dataset, { frame: number, camera, revision, samples, settled, whole: !quick && !lightBehind });
    if (first) this.requestUpdate();
    this.drawOverlay();
  }

  private scheduleOverlay(): void {
    if (this.overlayScheduled) return;
    this.overlayScheduled = true;
    requestAnimationFrame(() => {
      this.overlayScheduled = false;
      this.drawOverlay();
    });
  }

  // By the camera of the frame that is shown, so that lines and picture never part.
  private drawOverlay(): void {
    const { session, input } = this;
    const { model, selection } = session;
    if (!input || !model) return;
    const pose = session.eye.poseOf(this.shown?.camera ?? 0);
    const room = selection?.kind === "room" ? (model.welcome.rooms[Number(selection.id)] ?? null) : null;
    this.hands.classList.toggle("handle", input.active !== null);
    drawOverlay(this.overlayCanvas, {
      pose,
      viewport: session.eye.viewport,
      box: selection && !room ? session.boxOf(selection) : null,
      warnings: overlapBoxes(model),
      room,
      gizmo: input.gizmo(pose),
      active: input.active,
      cross: session.meter.reading?.at ?? null,
    });
  }

  private dividerMoved(event: PointerEvent): void {
    if (!(event.currentTarget as HTMLElement).hasPointerCapture(event.pointerId)) return;
    const box = this.getBoundingClientRect();
    this.session.show({ dividerAt: clamp((event.clientX - box.left) / box.width, 0.02, 0.98) });
  }

  private dividerKey(event: KeyboardEvent): void {
    const step = event.key === "ArrowLeft" ? -kDividerStep : event.key === "ArrowRight" ? kDividerStep : 0;
    if (step === 0) return;
    event.preventDefault();
    event.stopPropagation();
    this.session.show({ dividerAt: clamp(this.session.dividerAt + step, 0.02, 0.98) });
  }
}

declare global {
  interface HTMLElementTagNameMap {
    "rl-stage": Stage;
  }
}
