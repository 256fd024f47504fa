// One line: how the connection stands, and what the picture shows.
import { css, html, nothing } from "lit";
import { customElement } from "lit/decorators.js";
import { pictureWords } from "../picture_words.js";
import { SessionElement } from "./element.js";
import { controls } from "./styles.js";

const kIntervalMs = 250; // between redraws while frames come

@customElement("rl-status")
export class Status extends SessionElement {
  protected override readonly topics = ["link", "ui"] as const;
  static override styles = [
    controls,
    css`
      :host {
        display: flex;
        flex: none;
        gap: 16px;
        align-items: center;
        justify-content: space-between;
        min-height: 28px;
        padding: 2px 12px;
        color: var(--muted);
        background: var(--surface);
        border-top: 1px solid var(--line);
        white-space: nowrap;
        overflow: hidden;
      }
      .dot {
        display: inline-block;
        width: 8px;
        height: 8px;
        margin-right: 7px;
        border-radius: 50%;
        background: var(--good);
      }
      .dot.wait {
        background: var(--accent);
      }
      .dot.bad {
        background: var(--danger);
      }
      .link {
        min-width: 0;
        overflow: hidden;
        text-overflow: ellipsis;
      }
      :host([data-link="open"]) .link {
        flex: none;
      }
      .picture {
        overflow: hidden;
        text-overflow: ellipsis;
      }
      button {
        min-height: 22px;
        margin-left: 8px;
        padding: 0 8px;
      }
      :host([data-link="lost"]),
      :host([data-link="refused"]) {
        white-space: normal;
        color: var(--text);
      }
    `,
  ];

  private timer = 0;

  override connectedCallback(): void {
    super.connectedCallback();
    this.timer = window.setInterval(() => this.requestUpdate(), kIntervalMs);
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    window.clearInterval(this.timer);
  }

  override render() {
    this.dataset.link = this.session.link.state;
    const { link } = this.session;
    const seconds = link.state === "lost" ? Math.max(0, Math.ceil((link.retryAtMs - Date.now()) / 1000)) : 0;
    return html`
      <span class="link">
        <span role="status">${this.link()}</span>
        ${link.state === "lost"
          ? html`Trying again in ${seconds} s.<button @click=${() => this.session.reconnect()}>Now</button>`
          : nothing}
      </span>
      <span class="picture number">${this.picture()}</span>
    `;
  }

  private link() {
    const { link } = this.session;
    switch (link.state) {
      case "opening":
        return html`<span class="dot wait"></span>Connecting…`;
      case "open":
        return html`<span class="dot"></span>Connected`;
      case "lost":
      case "refused":
        return html`<span class="dot bad"></span>${link.reason}`;
    }
  }

  private picture() {
    const { lastFrame: frame, link } = this.session;
    if (link.state !== "open") return nothing;
    const parts = pictureWords(this.session.pictureState());
    if (frame && frame.ev100 !== null) parts.push(`EV ${frame.ev100.toFixed(1)}`);
    if (frame) parts.push(`${frame.width} × ${frame.height}`);
    return parts.join(" · ");
  }
}

declare global {
  interface HTMLElementTagNameMap {
    "rl-status": Status;
  }
}
