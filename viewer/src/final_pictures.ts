// Renders that were asked for, and the finished pictures: the server gives each away once, so they are kept here to
// look at and download.
import type { Job } from "./protocol.js";

const kMostKept = 16; // each may hold a file of many megabytes

export class FinalPictures {
  jobs: readonly Job[] = []; // the newest first
  readonly addresses = new Map<Job["job"], string>(); // of finished pictures, within this page
  private readonly fetched = new Set<string>(); // paths: after a break the server tells again of what it still has

  constructor(
    private readonly token: string,
    private readonly changed: () => void,
    private readonly failed: (message: string) => void,
  ) {}

  get busy(): boolean {
    return this.jobs.some(job => job.state === "running");
  }

  update(job: Job): void {
    const jobs = [job, ...this.jobs.filter(other => other.job !== job.job)];
    this.jobs = jobs.slice(0, kMostKept);
    for (const old of jobs.slice(kMostKept)) this.release(old.job);
    if (job.file && !this.fetched.has(job.file.path)) void this.fetch(job.job, job.file.path);
    this.changed();
  }

  // A server that was started afresh knows nothing of them.
  forgetRunning(): void {
    this.jobs = this.jobs.filter(job => job.state !== "running");
    this.changed();
  }

  private async fetch(job: Job["job"], path: string): Promise<void> {
    this.fetched.add(path);
    try {
      const response = await fetch(`${path}?token=${encodeURIComponent(this.token)}`);
      if (!response.ok) throw new Error(`the server answered ${response.status}`);
      const picture = await response.blob();
      this.release(job);
      if (this.jobs.some(other => other.job === job)) this.addresses.set(job, URL.createObjectURL(picture));
    } catch (error) {
      this.fetched.delete(path);
      this.failed(
        `The picture could not be fetched: ${error instanceof Error ? error.message : "unknown"}. ` +
          `Reload the page to try again, or render it again.`,
      );
    }
    this.changed();
  }

  private release(job: Job["job"]): void {
    const address = this.addresses.get(job);
    if (address !== undefined) URL.revokeObjectURL(address);
    this.addresses.delete(job);
  }
}
