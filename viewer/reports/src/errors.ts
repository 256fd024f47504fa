// A validation's errors: a row a technique, a dot a value, what is allowed behind them.
import type { Chart, Dot } from "./chart.js";

// As src/validate/report.cpp writes it.
export interface Errors {
  readonly rows: readonly {
    readonly name: string;
    readonly allowed: number; // per cent
    readonly values: readonly { readonly text: string; readonly error: number; readonly met: boolean }[];
  }[];
}

const kMost = 12; // per cent; what is farther off stands at the end
const kLanes = 7; // dots of a row, above each other

export function errorsChart(label: string, { rows }: Errors): Chart {
  const yOf = (row: number) => rows.length - 1 - row;
  const percent = (value: number) => `${value > 0 ? "+" : ""}${value} %`;
  return {
    label,
    x: {
      title: "error",
      range: [-kMost - 0.5, kMost + 0.5],
      isLogarithmic: false,
      ticks: [-10, -5, 0, 5, 10].map(at => ({ at, text: percent(at) })),
    },
    y: {
      title: "",
      range: [-0.5, rows.length - 0.5],
      isLogarithmic: false,
      ticks: rows.map(({ name }, row) => ({ at: yOf(row), text: name })),
    },
    series: rows.map(({ name, values }, row) => ({
      name,
      colour: "#0a6b3d",
      line: "none" as const,
      dots: values.map(
        ({ text, error, met }, i): Dot => ({
          x: Math.min(Math.max(error, -kMost), kMost),
          y: yOf(row) + ((i % kLanes) - (kLanes - 1) / 2) * 0.09,
          text,
          radius: 3,
          shape: "disc",
          colour: met ? "#0a6b3d99" : "#b0002099",
        }),
      ),
    })),
    bands: rows.map(({ allowed }, row) => {
      const most = Math.min(allowed, kMost);
      return { x: [-most, most], y: [yOf(row) - 0.35, yOf(row) + 0.35] };
    }),
  };
}
