// The front of an optimisation: every design by two of its objectives.
import { linearRange, number } from "./axis.js";
import type { Axis, Chart, Dot } from "./chart.js";

// As src/optimise/report_html.cpp writes it.
export interface Front {
  readonly axes: readonly { readonly title: string; readonly unit: string }[];
  readonly points: readonly { readonly v: readonly number[]; readonly design?: number }[]; // design: of the proposed
}

export const axisName = ({ title, unit }: Front["axes"][number]): string => (unit ? `${title} (${unit})` : title);

export function pointText(front: Front, { v, design }: Front["points"][number]): string {
  const values = front.axes.map(({ title, unit }, i) => `${title} ${number(v[i]!, 4)}${unit ? ` ${unit}` : ""}`);
  return (design === undefined ? "" : `Design ${design}: `) + values.join(", ");
}

// `across` and `up`: objectives by number.
export function frontChart(label: string, front: Front, across: number, up: number): Chart {
  const axis = (i: number): Axis => ({
    title: axisName(front.axes[i]!),
    range: linearRange(front.points.map(({ v }) => v[i]!)),
    isLogarithmic: false,
  });
  const dot = (point: Front["points"][number]): Dot => {
    const base = { x: point.v[across]!, y: point.v[up]!, text: pointText(front, point) };
    if (point.design === undefined) return { ...base, radius: 3.2, shape: "disc" };
    return { ...base, radius: 10, shape: "link", label: String(point.design), href: `#design${point.design}` };
  };
  const proposed = front.points.filter(({ design }) => design !== undefined).sort((a, b) => a.design! - b.design!);
  const others = front.points.filter(({ design }) => design === undefined);
  return {
    label,
    x: axis(across),
    y: axis(up),
    series: [
      { name: "designs", colour: "#7b8da6", line: "none", dots: others.map(dot) },
      { name: "proposed", colour: "#e69f00", line: "none", dots: proposed.map(dot) },
    ],
  };
}
