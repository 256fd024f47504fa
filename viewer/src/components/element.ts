// What all components of the page share: the session, and drawing anew when one of their topics changes.
import { LitElement, type PropertyValues } from "lit";
import { property } from "lit/decorators.js";
import type { Session, Topic } from "../session.js";

export class SessionElement extends LitElement {
  @property({ attribute: false }) session!: Session;
  protected readonly topics: readonly Topic[] = ["model", "ui"];
  private stops: (() => void)[] = [];

  override connectedCallback(): void {
    super.connectedCallback();
    this.listen();
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.stops.splice(0).forEach(stop => stop());
  }

  protected override willUpdate(changed: PropertyValues): void {
    if (changed.has("session")) this.listen();
  }

  private listen(): void {
    this.stops.splice(0).forEach(stop => stop());
    if (!this.session || !this.isConnected) return;
    for (const topic of this.topics) this.stops.push(this.session.on(topic, () => this.requestUpdate()));
  }
}
