// What happens to the picture, in words for the status line.
import type { FrameHeader } from "./frame.js";
import { percent } from "./numbers.js";
import type { Progress } from "./protocol.js";

export interface PictureState {
  readonly frames: readonly FrameHeader[]; // the newest of each side that is shown
  readonly moving: boolean; // the eye or the home changed in frames of the last second
  readonly framesPerSecond: number | null; // null: too few came to tell
  readonly awaited: boolean; // an eye or a home was told that no frame shows yet
  readonly progress: Progress | null;
  readonly rendering: boolean; // a final picture, which the one on the stage waits for
}

const findingLight = ({ fraction }: Progress): string => `finding the light, ${percent(fraction)}`;

// Of two sides the one that has farther to go.
function leastReady(frames: readonly FrameHeader[]): FrameHeader {
  const readiness = ({ settled, refining, samples }: FrameHeader) => [+settled, +refining, samples] as const;
  return frames.reduce((least, frame) => {
    const a = readiness(least);
    const b = readiness(frame);
    const differs = a.findIndex((value, i) => value !== b[i]);
    return differs >= 0 && b[differs]! < a[differs]! ? frame : least;
  });
}

function refining({ refining: byPaths, samples, samplesInAll }: FrameHeader): string {
  if (samples === 0) return "refining";
  if (byPaths) return `refining, ${samples} ${samples === 1 ? "path" : "paths"} a pixel`;
  return `refining ${samples}${samplesInAll === null ? "" : ` of ${samplesInAll}`}`;
}

function atRest(frame: FrameHeader, rendering: boolean): string {
  const stage = frame.settled ? "finished" : rendering ? "paused for the final picture" : refining(frame);
  return frame.relativeError === null ? stage : `${stage}, ${percent(frame.relativeError)} error left`;
}

// Short phrases, the most important one first.
export function pictureWords(state: PictureState): string[] {
  const { frames, moving, framesPerSecond, progress } = state;
  if (frames.length === 0) return [progress ? findingLight(progress) : "waiting for the first picture"];
  const frame = leastReady(frames);
  const behind = frames.some(({ lightBehind }) => lightBehind) ? ["light follows"] : [];
  if (moving) {
    const rate = framesPerSecond === null ? 0 : Math.round(framesPerSecond);
    return [rate > 0 ? `moving, ${rate} ${rate === 1 ? "frame" : "frames"}/s` : "moving", ...behind];
  }
  if (progress) return [findingLight(progress)];
  // Paths are traced only once light has come.
  if (behind.length && !frame.settled && !frame.refining) return behind;
  if (state.awaited) return ["waiting for the next picture"];
  return [atRest(frame, state.rendering)];
}
