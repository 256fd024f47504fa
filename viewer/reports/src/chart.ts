// What a plot shows: dots and lines between two axes, as plain data.
import type { Range } from "./axis.js";

export interface Dot {
  readonly x: number;
  readonly y: number;
  readonly text: string; // for who points at it
  readonly radius: number;
  readonly shape: "disc" | "ring" | "diamond" | "link"; // a link is an element of the page
  readonly colour?: string; // instead of the series'
  readonly label?: string; // beside it; of a link, in it
  readonly href?: string; // of a link
}

export interface Series {
  readonly name: string;
  readonly colour: string;
  readonly line: "none" | "solid" | "dashed";
  readonly dots: readonly Dot[];
}

export interface Axis {
  readonly title: string;
  readonly range: Range; // at first
  readonly isLogarithmic: boolean;
  readonly ticks?: readonly { readonly at: number; readonly text: string }[]; // instead of numbers
}

export interface Chart {
  readonly label: string; // its accessible name
  readonly x: Axis;
  readonly y: Axis;
  readonly series: readonly Series[];
  readonly bands?: readonly { readonly x: Range; readonly y: Range }[]; // behind all
}

// The dot that a place is nearest to, in pixels and no farther than `reach`; of two as near the later, which lies
// above.
export function nearestDot(
  dots: readonly Dot[],
  pixelOf: (dot: Dot) => readonly [number, number],
  at: readonly [number, number],
  reach: number,
): Dot | null {
  let nearest: Dot | null = null;
  let least = reach;
  for (const dot of dots) {
    const [x, y] = pixelOf(dot);
    const distance = Math.hypot(x - at[0], y - at[1]);
    if (distance <= least) [nearest, least] = [dot, distance];
  }
  return nearest;
}
