// A study's error over time: a plot a case, a curve a technique.
import { logarithmicRange } from "./axis.js";
import type { Chart, Dot, Series } from "./chart.js";

// As src/study/plots.cpp writes it; mse: beyond the reference's noise.
export interface Case {
  readonly title: string;
  readonly curves: readonly {
    readonly name: string;
    readonly colour: string;
    readonly settled: number; // which point
    readonly points: readonly (readonly [samples: number, seconds: number, mse: number])[];
  }[];
  readonly others: readonly { readonly name: string; readonly seconds: number; readonly mse: number }[];
}

// What logarithmic axes show at least; errors go no farther below the largest than four decades.
const kLeastSeconds = 1e-3;
const kLeastMse = 1e-6;
const kMostSpan = 1e4;

export const isDashed = (technique: string): boolean => technique.includes(",");

// Those of all cases, for one key.
export function techniques(cases: readonly Case[]): { name: string; colour: string }[] {
  const found = new Map<string, string>();
  for (const { curves } of cases) {
    for (const { name, colour, points } of curves) if (points.length > 0) found.set(name, colour);
  }
  return [...found].map(([name, colour]) => ({ name, colour }));
}

// null: nothing was measured.
export function curvesChart({ title, curves, others }: Case): Chart | null {
  const all = [
    ...curves.flatMap(({ points }) => points.map(([, seconds, mse]) => ({ seconds, mse }))),
    ...others.map(({ seconds, mse }) => ({ seconds, mse })),
  ];
  if (all.length === 0) return null;
  const seconds = all.map(p => Math.max(p.seconds, kLeastSeconds));
  const errors = all.map(p => Math.max(p.mse, kLeastMse));
  const most = Math.max(...errors);
  const rangeY = logarithmicRange(Math.max(Math.min(...errors), most / kMostSpan), most);
  const told = (s: number, mse: number) => `${s.toFixed(2)} s, mse beyond noise ${mse.toFixed(5)}`;
  const place = (s: number, mse: number) => ({ x: Math.max(s, kLeastSeconds), y: Math.max(mse, rangeY[0]) });
  const series = curves
    .filter(({ points }) => points.length > 0)
    .map(
      ({ name, colour, settled, points }): Series => ({
        name,
        colour,
        line: isDashed(name) ? "dashed" : "solid",
        dots: points.map(
          ([samples, s, mse], i): Dot => ({
            ...place(s, mse),
            text: `${name}: ${samples} samples, ${told(s, mse)}`,
            radius: i === settled ? 5 : 3,
            shape: i === settled ? "disc" : "ring",
          }),
        ),
      }),
    );
  const diamonds = others.map(
    ({ name, seconds: s, mse }): Dot => ({
      ...place(s, mse),
      text: `${name}: ${told(s, mse)}`,
      radius: 6,
      shape: "diamond",
      label: name,
    }),
  );
  if (diamonds.length > 0) series.push({ name: "", colour: "#111", line: "none", dots: diamonds });
  return {
    label: `Error over time, ${title}`,
    x: { title: "seconds", range: logarithmicRange(Math.min(...seconds), Math.max(...seconds)), isLogarithmic: true },
    y: { title: "mse", range: rangeY, isLogarithmic: true },
    series,
  };
}
