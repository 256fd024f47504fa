import assert from "node:assert/strict";
import { test } from "node:test";
import { decadeTicks, linearRange, logarithmicRange, number, zoomed } from "../../reports/src/axis.js";
import { nearestDot, type Dot } from "../../reports/src/chart.js";
import { curvesChart, isDashed, techniques, type Case } from "../../reports/src/curves.js";
import { errorsChart } from "../../reports/src/errors.js";
import { frontChart, type Front } from "../../reports/src/front.js";
import { near } from "./near.js";

test("logarithmic axes go by thirds of a decade and have ticks at 1, 2 and 5", () => {
  const [low, high] = logarithmicRange(1, 90);
  near(low, 1, 1e-9);
  near(high, 100, 1e-9);
  assert.deepEqual(decadeTicks(low, high), [1, 2, 5, 10, 20, 50, 100]);
  assert.deepEqual(decadeTicks(0.0001, 1), [0.0001, 0.001, 0.01, 0.1, 1]);
  const [least, most] = logarithmicRange(10, 10);
  near(Math.log10(most) - Math.log10(least), 0.5, 1e-9);
});

test("linear axes leave a margin, and have a length whatever they show", () => {
  assert.deepEqual(linearRange([0, 20, 5, NaN]), [-1, 21]);
  assert.deepEqual(linearRange([3]), [2.95, 3.05]);
  assert.deepEqual(linearRange([]), [0, 1]);
});

test("zooming keeps what is pointed at", () => {
  assert.deepEqual(zoomed([0, 10], 0.5), [2.5, 7.5]);
  assert.deepEqual(zoomed([0, 10], 2, 10), [-10, 10]);
});

test("numbers on axes are short", () => {
  assert.deepEqual(
    [0.1 + 0.2, -0, 1234567, 1e-7].map(v => number(v)),
    ["0.3", "0", "1234570", "1e-7"],
  );
});

const kFront: Front = {
  axes: [
    { title: "miss", unit: "%" },
    { title: "cost", unit: "EUR" },
    { title: "lamps", unit: "" },
  ],
  points: [{ v: [1, 200, 4], design: 2 }, { v: [2.00009, 150, 3] }, { v: [5, 100, 2], design: 1 }],
};

test("a front is dots of two objectives; the proposed are links to their sections", () => {
  const { x, y, series } = frontChart("The front", kFront, 1, 0);
  assert.deepEqual([x.title, y.title], ["cost (EUR)", "miss (%)"]);
  assert.deepEqual(x.range, [95, 205]);
  const [others, proposed] = series;
  assert.deepEqual(
    others!.dots.map(({ x, y, shape, text }) => [x, y, shape, text]),
    [[150, 2.00009, "disc", "miss 2 %, cost 150 EUR, lamps 3"]],
  );
  assert.deepEqual(
    proposed!.dots.map(({ x, y, shape, label, href }) => [x, y, shape, label, href]),
    [
      [100, 5, "link", "1", "#design1"],
      [200, 1, "link", "2", "#design2"],
    ],
  );
  assert.equal(proposed!.dots[0]!.text, "Design 1: miss 5 %, cost 100 EUR, lamps 2");
  assert.equal(frontChart("", kFront, 2, 1).x.title, "lamps");
});

const kCase: Case = {
  title: "Room, day",
  curves: [
    {
      name: "cone",
      colour: "#0072b2",
      settled: 1,
      points: [
        [1, 0.5, 0.02],
        [2, 1, 0.01],
        [4, 2, 0],
      ],
    },
    { name: "lpv, 256", colour: "#d55e00", settled: 0, points: [[1, 0, 0.04]] },
    { name: "vxgi", colour: "#e69f00", settled: 0, points: [] },
  ],
  others: [{ name: "offline", seconds: 412, mse: 0.003 }],
};

test("a case is a curve a technique with points, and a diamond for every other renderer", () => {
  const { label, x, y, series } = curvesChart(kCase)!;
  assert.equal(label, "Error over time, Room, day");
  assert.deepEqual(
    series.map(s => [s.name, s.colour, s.line]),
    [
      ["cone", "#0072b2", "solid"],
      ["lpv, 256", "#d55e00", "dashed"],
      ["", "#111", "none"],
    ],
  );
  const [cone, lpv, others] = series;
  assert.deepEqual(
    cone!.dots.map(d => [d.shape, d.radius]),
    [
      ["ring", 3],
      ["disc", 5],
      ["ring", 3],
    ],
  );
  assert.equal(cone!.dots[0]!.text, "cone: 1 samples, 0.50 s, mse beyond noise 0.02000");
  assert.deepEqual(others!.dots[0]!.label, "offline");
  assert.equal(others!.dots[0]!.text, "offline: 412.00 s, mse beyond noise 0.00300");
  assert.equal(lpv!.dots[0]!.x, 1e-3, "time that a logarithm has");
  assert.ok(y.range[0] > 2e-6 && y.range[1] < 0.05, "four decades below the largest error at most");
  assert.equal(cone!.dots[2]!.y, y.range[0], "stands at the foot");
  assert.ok(x.isLogarithmic && y.isLogarithmic && x.range[1] >= 412);
});

test("where nothing was measured there is no chart", () => {
  assert.equal(curvesChart({ title: "Room", curves: kCase.curves.slice(2), others: [] }), null);
});

test("the key names every technique once that has a curve anywhere", () => {
  const second = { ...kCase, curves: [{ ...kCase.curves[0]!, name: "vxgi" }] };
  assert.deepEqual(
    techniques([kCase, second]).map(t => t.name),
    ["cone", "lpv, 256", "vxgi"],
  );
  assert.deepEqual(["cone", "lpv, 256"].map(isDashed), [false, true]);
});

test("errors stand in rows from the top, none beyond the end of the axis", () => {
  const values = [
    { text: "a", error: -0.5, met: true },
    { text: "b", error: 40, met: false },
  ];
  const chart = errorsChart("Errors", {
    rows: [
      { name: "path", allowed: 1, values },
      { name: "cone", allowed: 30, values: [] },
    ],
  });
  assert.deepEqual(chart.y.ticks, [
    { at: 1, text: "path" },
    { at: 0, text: "cone" },
  ]);
  const [first, second] = chart.series[0]!.dots;
  assert.deepEqual([first!.x, second!.x], [-0.5, 12]);
  assert.ok(first!.y > 0.65 && second!.y < 1.35);
  assert.notEqual(first!.colour, second!.colour);
  assert.deepEqual(
    chart.bands!.map(b => b.x),
    [
      [-1, 1],
      [-12, 12],
    ],
  );
});

test("the nearest dot within reach is told, of two as near the upper", () => {
  const dot = (x: number, y: number, text: string): Dot => ({ x, y, text, radius: 3, shape: "disc" });
  const dots = [dot(0, 0, "a"), dot(10, 0, "b"), dot(10, 0, "c")];
  const at = (x: number, y: number) => nearestDot(dots, d => [d.x, d.y], [x, y], 6)?.text;
  assert.deepEqual([at(1, 1), at(9, 0), at(5.5, 20)], ["a", "c", undefined]);
});
