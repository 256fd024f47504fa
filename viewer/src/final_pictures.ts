// Renders that were asked for, and the finished pictures: the server gives each away once, so they are kept here to look at and download.
import type { Job } from "./protocol.js";

export class FinalPictures {
  jobs: readonly Job[] = []; // the newest first
  readonly addresses = new Map<Job["job"], string>(); // of finished pictures, within this page

  constructor(
    private readonly token: string,
    private readonly changed: () => void,
    private readonly failed: (message: string) => void,
  ) {}

  get busy(): boolean {
    return this.jobs.some((job) => job.state === "running");
  }

  update(job: Job): void {
    this.jobs = [job, ...this.jobs.filter((other) => other.job !== job.job)];
    if (job.file) void this.fetch(job.job, job.file.path);
    this.changed();
  }

  // A server that was started afresh knows nothing of them.
  forgetRunning(): void {
    this.jobs = this.jobs.filter((job) => job.state !== "running");
    this.changed();
  }

  private async fetch(job: Job["job"], path: string): Promise<void> {
    try {
      const response = await fetch(`${path}?token=${encodeURIComponent(this.token)}`);
      if (!response.ok) throw new Error(`the server answered ${response.status}`);
      this.addresses.set(job, URL.createObjectURL(await response.blob()));
    } catch (error) {
      this.failed(`The picture could not be fetched: ${error instanceof Error ? error.message : "unknown"}. Render it again.`);
    }
    this.changed();
  }
}
