// A chart on the page, by uPlot: axes, grid, zoom by a dragged box (double click: all of it again), what a dot is.
import uPlot from "uplot";
import { decadeTicks, number, zoomed, type Range } from "./axis.js";
import { nearestDot, type Axis, type Chart, type Dot, type Series } from "./chart.js";
import { element } from "./element.js";

const kReach = 12; // pixels within which a dot is pointed at
const kLeastDrag = 6; // pixels of a box that is meant
const kOver = 6; // pixels of a dot that may lie outside
const kInk = "#1d2530";
const kFont = '12px "Helvetica Neue", Helvetica, Arial, "Liberation Sans", sans-serif';

export interface Drawn {
  zoom(factor: number): void;
  all(): void;
  show(name: string, shown: boolean): void;
  remove(): void;
}

export function draw(host: HTMLElement, chart: Chart, height: number, zoomsByWheel = false): Drawn {
  const shown = new Set(chart.series);
  let [x, y] = [chart.x.range, chart.y.range];
  const tip = element("div", { className: "tip", hidden: true });

  const tell = (dot: Dot | null) => {
    tip.hidden = dot === null;
    if (!dot) return;
    tip.textContent = dot.text;
    const [left, top] = [plot.valToPos(dot.x, "x"), plot.valToPos(dot.y, "y")];
    const isRight = left > plot.over.clientWidth / 2;
    tip.style.left = `${plot.over.offsetLeft + left + (isRight ? -14 - tip.offsetWidth : 14)}px`;
    tip.style.top = `${plot.over.offsetTop + Math.max(top - tip.offsetHeight - 6, 2)}px`;
  };
  const links = linksOf(chart, tell);

  const plot = new uPlot(
    {
      mode: 2,
      width: host.clientWidth,
      height,
      legend: { show: false },
      cursor: {
        x: false,
        y: false,
        points: { show: false },
        dataIdx: () => null as unknown as number,
        drag: { x: true, y: true, setScale: false, dist: kLeastDrag },
        bind: { dblclick: () => () => (all(), null) },
      },
      scales: {
        x: { time: false, distr: chart.x.isLogarithmic ? 3 : 1, range: () => [...x] },
        y: { distr: chart.y.isLogarithmic ? 3 : 1, range: () => [...y] },
      },
      axes: [axisOptions(chart.x, "x"), axisOptions(chart.y, "y")],
      series: [
        {},
        ...chart.series.map(({ colour }) => ({
          stroke: colour,
          auto: false,
          facets: [
            { scale: "x", auto: false },
            { scale: "y", auto: false },
          ],
          paths: () => null,
          points: { show: false },
        })),
      ],
      hooks: {
        drawClear: [u => drawBands(u, chart)],
        drawSeries: [(u, i) => drawSeries(u, chart.series[i - 1]!)],
        draw: [u => links.forEach(({ dot, link }) => placeLink(u, dot, link))],
        setSelect: [
          u => {
            const { left, top, width, height: tall } = u.select;
            u.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
            if (Math.min(width, tall) < kLeastDrag) return;
            set(
              [u.posToVal(left, "x"), u.posToVal(left + width, "x")],
              [u.posToVal(top + tall, "y"), u.posToVal(top, "y")],
            );
          },
        ],
      },
    },
    [null, ...chart.series.map(({ dots }) => [dots.map(d => d.x), dots.map(d => d.y)])] as unknown as uPlot.AlignedData,
    host,
  );

  function set(newX: Range, newY: Range): void {
    [x, y] = [newX, newY];
    tell(null);
    plot.batch(() => {
      plot.setScale("x", { min: x[0], max: x[1] });
      plot.setScale("y", { min: y[0], max: y[1] });
    });
  }
  const all = () => set(chart.x.range, chart.y.range);

  plot.ctx.canvas.setAttribute("role", "img");
  plot.ctx.canvas.setAttribute("aria-label", chart.label);
  plot.over.append(...links.map(({ link }) => link));
  host.append(tip);

  const placeOf = (event: MouseEvent) => {
    const { left, top } = plot.over.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top] as const;
  };
  plot.over.addEventListener("mousemove", event => {
    const dots = [...shown].flatMap(series => series.dots);
    tell(nearestDot(dots, d => [plot.valToPos(d.x, "x"), plot.valToPos(d.y, "y")], placeOf(event), kReach));
  });
  plot.over.addEventListener("mouseleave", () => tell(null));
  const zoomBy = (factor: number, atX?: number, atY?: number) => set(zoomed(x, factor, atX), zoomed(y, factor, atY));
  if (zoomsByWheel)
    plot.over.addEventListener(
      "wheel",
      event => {
        event.preventDefault();
        const [left, top] = placeOf(event);
        zoomBy(event.deltaY > 0 ? 1.2 : 1 / 1.2, plot.posToVal(left, "x"), plot.posToVal(top, "y"));
      },
      { passive: false },
    );
  const resized = new ResizeObserver(() => {
    if (host.clientWidth > 0 && host.clientWidth !== plot.width) plot.setSize({ width: host.clientWidth, height });
  });
  resized.observe(host);

  return {
    zoom: zoomBy,
    all,
    show: (name, isShown) =>
      chart.series.forEach((series, i) => {
        if (series.name !== name) return;
        if (isShown) shown.add(series);
        else shown.delete(series);
        plot.setSeries(i + 1, { show: isShown });
      }),
    remove: () => {
      resized.disconnect();
      plot.destroy();
      tip.remove();
    },
  };
}

function axisOptions({ title, isLogarithmic, ticks }: Axis, scale: "x" | "y"): uPlot.Axis {
  const own = ticks && new Map(ticks.map(({ at, text }) => [at, text]));
  const options: uPlot.Axis = {
    scale,
    stroke: kInk,
    font: kFont,
    labelFont: kFont,
    grid: { stroke: "#e4e7eb", width: 1 },
    ticks: { stroke: "#c4cad2", width: 1, size: 5 },
    values: (_, splits) => splits.map(value => own?.get(value) ?? number(value)),
  };
  options.size = scale === "x" ? 28 : ticks ? 76 : 62;
  if (title) [options.label, options.labelSize] = [title, 22];
  if (own) options.splits = () => [...own.keys()];
  else if (isLogarithmic) options.splits = (_, __, least, most) => decadeTicks(least, most);
  // uPlot thins out ticks of logarithmic axes; these are few.
  if (isLogarithmic) options.filter = (_, splits) => splits;
  return options;
}

function linksOf(chart: Chart, tell: (dot: Dot | null) => void): { dot: Dot; link: HTMLAnchorElement }[] {
  const dots = chart.series.flatMap(({ dots }) => dots).filter(({ shape }) => shape === "link");
  return dots.map(dot => {
    const link = element("a", { className: "proposal", href: dot.href ?? "", textContent: dot.label ?? "" });
    link.setAttribute("aria-label", dot.text);
    link.draggable = false;
    link.addEventListener("focus", () => tell(dot));
    link.addEventListener("blur", () => tell(null));
    return { dot, link };
  });
}

function placeLink(u: uPlot, dot: Dot, link: HTMLElement): void {
  const [left, top] = [u.valToPos(dot.x, "x"), u.valToPos(dot.y, "y")];
  link.hidden = left < 0 || top < 0 || left > u.over.clientWidth || top > u.over.clientHeight;
  link.style.left = `${left}px`;
  link.style.top = `${top}px`;
}

function drawBands(u: uPlot, { bands = [] }: Chart): void {
  u.ctx.save();
  u.ctx.fillStyle = "#e4f2ea";
  for (const { x, y } of bands) {
    const [left, right] = x.map(value => u.valToPos(value, "x", true)) as [number, number];
    const [bottom, top] = y.map(value => u.valToPos(value, "y", true)) as [number, number];
    u.ctx.fillRect(left, top, right - left, bottom - top);
  }
  u.ctx.restore();
}

function drawSeries(u: uPlot, { colour, line, dots }: Series): void {
  const { ctx, bbox } = u;
  const scale = uPlot.pxRatio;
  const places = dots.map(d => [u.valToPos(d.x, "x", true), u.valToPos(d.y, "y", true)] as const);
  ctx.save();
  ctx.beginPath();
  const over = kOver * scale;
  ctx.rect(bbox.left - over, bbox.top - over, bbox.width + 2 * over, bbox.height + 2 * over);
  ctx.clip();
  ctx.lineWidth = 2 * scale;
  ctx.lineJoin = "round";
  ctx.strokeStyle = colour;
  if (line !== "none") {
    ctx.setLineDash(line === "dashed" ? [6 * scale, 4 * scale] : []);
    ctx.beginPath();
    places.forEach(([x, y]) => ctx.lineTo(x, y));
    ctx.stroke();
    ctx.setLineDash([]);
  }
  dots.forEach((dot, i) => drawDot(u, dot, places[i]!, dot.colour ?? colour));
  ctx.restore();
}

function drawDot({ ctx, bbox }: uPlot, dot: Dot, [x, y]: readonly [number, number], colour: string): void {
  if (dot.shape === "link") return;
  const radius = dot.radius * uPlot.pxRatio;
  ctx.beginPath();
  if (dot.shape === "diamond") {
    ctx.moveTo(x, y - radius);
    for (const [right, down] of [
      [1, 0],
      [0, 1],
      [-1, 0],
    ] as const)
      ctx.lineTo(x + right * radius, y + down * radius);
    ctx.closePath();
  } else {
    ctx.arc(x, y, radius, 0, 2 * Math.PI);
  }
  ctx.fillStyle = dot.shape === "ring" ? "#fff" : colour;
  ctx.fill();
  if (dot.shape === "ring") ctx.stroke();
  if (dot.label === undefined) return;
  ctx.font = kFont.replace("12px", `${12 * uPlot.pxRatio}px`);
  ctx.fillStyle = kInk;
  ctx.textBaseline = "middle";
  const isRight = x > bbox.left + 0.75 * bbox.width;
  ctx.textAlign = isRight ? "right" : "left";
  ctx.fillText(dot.label, x + (isRight ? -1.5 : 1.5) * radius, y);
}
