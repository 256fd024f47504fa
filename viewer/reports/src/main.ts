// Draws the plots of a report: every element of class "plot" holds its data as JSON (report::plot of src/report), and
// words that stand for it until then.
import { curvesChart, isDashed, techniques, type Case } from "./curves.js";
import { draw, type Drawn } from "./draw.js";
import { element } from "./element.js";
import { errorsChart, type Errors } from "./errors.js";
import { axisName, frontChart, type Front } from "./front.js";

function showFront(host: HTMLElement, label: string, front: Front): void {
  const choice = (chosen: number) => {
    const options = front.axes.map((axis, i) => element("option", { value: String(i) }, axisName(axis)));
    const select = element("select", { onchange: redraw }, ...options);
    select.selectedIndex = chosen;
    return select;
  };
  const across = choice(Math.min(1, front.axes.length - 1));
  const up = choice(0);
  const button = (text: string, name: string, onclick: () => void) =>
    element("button", { type: "button", ariaLabel: name, title: name, onclick }, text);
  const place = element("div", { className: "chart" });
  let drawn: Drawn | null = null;
  function redraw(): void {
    drawn?.remove();
    drawn = draw(place, frontChart(label, front, across.selectedIndex, up.selectedIndex), 460, true);
  }
  host.replaceChildren(
    element(
      "div",
      { className: "controls" },
      element("label", {}, "across ", across),
      element("label", {}, "up ", up),
      button("+", "Zoom in", () => drawn?.zoom(1 / 1.5)),
      button("−", "Zoom out", () => drawn?.zoom(1.5)),
      button("all", "Show all", () => drawn?.all()),
    ),
    place,
  );
  redraw();
}

function showCurves(host: HTMLElement, _: string, { cases }: { cases: readonly Case[] }): void {
  const drawn: Drawn[] = [];
  const key = techniques(cases).map(({ name, colour }) => {
    const line = element("i");
    line.style.borderColor = colour;
    if (isDashed(name)) line.style.borderTopStyle = "dashed";
    const button = element("button", { type: "button", ariaPressed: "true", title: "Show or hide" }, line, name);
    button.onclick = () => {
      const isShown = button.ariaPressed !== "true";
      button.ariaPressed = String(isShown);
      drawn.forEach(chart => chart.show(name, isShown));
    };
    return button;
  });
  const places = cases.map(one => ({ one, place: element("div", { className: "chart" }) }));
  host.replaceChildren(
    element("div", { className: "key" }, ...key),
    element(
      "div",
      { className: "charts" },
      ...places.map(({ one, place }) => element("div", {}, element("h3", {}, one.title), place)),
    ),
  );
  for (const { one, place } of places) {
    const chart = curvesChart(one);
    if (chart) drawn.push(draw(place, chart, 300));
    else place.append(element("p", {}, "nothing measured"));
  }
}

function showErrors(host: HTMLElement, label: string, errors: Errors): void {
  const place = element("div", { className: "chart" });
  host.replaceChildren(place);
  draw(place, errorsChart(label, errors), 46 * errors.rows.length + 70);
}

const kKinds: Record<string, (host: HTMLElement, label: string, data: never) => void> = {
  front: showFront,
  curves: showCurves,
  errors: showErrors,
};

for (const host of document.querySelectorAll<HTMLElement>(".plot")) {
  const data = JSON.parse(host.querySelector("script")?.textContent ?? "null") as never;
  kKinds[host.dataset.plot ?? ""]?.(host, host.ariaLabel ?? "", data);
}
