// The controls: lamps by room, daylight, scenes, picture, places.
import { html, nothing, type TemplateResult } from "lit";
import { clock, percent } from "../../src/numbers.js";
import type { App } from "./app.js";
import type { Layer } from "./document.js";
import { hoursOf, kLeastKelvin, kMostKelvin, kMostLevel, type Dial } from "./light_state.js";

const kKelvinStep = 50;

type Change = (change: Partial<Dial>) => void;

const number = (event: Event): number => Number((event.target as HTMLInputElement).value);
const checked = (event: Event): boolean => (event.target as HTMLInputElement).checked;

function toggle(label: string, on: boolean, change: (on: boolean) => void, text: string = label): TemplateResult {
  return html`<label class="toggle">
    <input
      type="checkbox"
      role="switch"
      aria-label=${label}
      .checked=${on}
      @change=${(e: Event) => change(checked(e))}
    /><span>${text}</span>
  </label>`;
}

function levelSlider(app: App, name: string, dial: Dial, change: Change): TemplateResult {
  return html`<div class="row">
    <input
      type="range"
      min="0"
      max=${kMostLevel * 100}
      step="1"
      aria-label=${app.say("level", name)}
      aria-valuetext=${percent(dial.level)}
      .value=${String(Math.round(dial.level * 100))}
      @input=${(e: Event) => change({ level: number(e) / 100, on: true })}
    /><output>${percent(dial.level)}</output>
  </div>`;
}

// Colours of files are of eight bits: 2700 K comes back as 2678.
const rounded = (kelvin: number): number => kKelvinStep * Math.round(kelvin / kKelvinStep);

function kelvinSlider(app: App, name: string, own: number, dial: Dial, change: Change): TemplateResult {
  const kelvin = dial.kelvin ?? rounded(own);
  return html`<div class="row">
    <input
      type="range"
      class="warmth"
      min=${kLeastKelvin}
      max=${kMostKelvin}
      step=${kKelvinStep}
      aria-label=${app.say("kelvin", name)}
      aria-valuetext="${Math.round(kelvin)} K"
      .value=${String(kelvin)}
      @input=${(e: Event) => change({ kelvin: number(e) })}
    /><output
      >${dial.kelvin === null
        ? html`${rounded(own)} K`
        : html`<button class="link" title=${app.say("ownKelvin")} @click=${() => change({ kelvin: null })}>
            ${Math.round(kelvin)} K
          </button>`}</output
    >
  </div>`;
}

function lamp(app: App, layer: Layer, i: number): TemplateResult {
  const dial = app.light.dials[i]!;
  const change: Change = c => app.setDials([i], c);
  return html`<li class=${dial.on ? "lit" : ""}>
    ${toggle(app.say("on", layer.name), dial.on, on => change({ on }), layer.name)}
    ${levelSlider(app, layer.name, dial, change)}
    ${layer.kelvin === undefined ? nothing : kelvinSlider(app, layer.name, layer.kelvin, dial, change)}
  </li>`;
}

// The lamps of a room as one.
function together(app: App, name: string, entries: readonly [Layer, number][]): TemplateResult {
  const dials = entries.map(([, i]) => app.light.dials[i]!);
  const change: Change = c =>
    app.setDials(
      entries.map(([, i]) => i),
      c,
    );
  const lit = dials.filter(dial => dial.on);
  const level = lit.reduce((sum, dial) => sum + dial.level, 0) / Math.max(1, lit.length);
  const kelvins = entries.map(([layer]) => layer.kelvin);
  const own = Math.round(kelvins.reduce<number>((sum, k) => sum + (k ?? 0), 0) / kelvins.length);
  const dial: Dial = { on: lit.length > 0, level: lit.length > 0 ? level : 1, kelvin: dials[0]!.kelvin };
  return html`<h3>${toggle(app.say("allInRoom", name), dial.on, on => change({ on }), name)}</h3>
    ${levelSlider(app, app.say("allInRoom", name), dial, change)}
    ${kelvins.includes(undefined) ? nothing : kelvinSlider(app, app.say("allInRoom", name), own, dial, change)}`;
}

function lamps(app: App): TemplateResult {
  const rooms = new Map<string, [Layer, number][]>();
  app.home.layers.forEach((layer, i) => {
    if (layer.kind === "lamp") rooms.set(layer.room, [...(rooms.get(layer.room) ?? []), [layer, i]]);
  });
  if (rooms.size === 0) return html`<p class="hint">${app.say("noLamps")}</p>`;
  return html`${[...rooms].map(([room, entries]) => {
    const name = room || app.say("otherRoom");
    return html`<div class="group">
      ${entries.length > 1 ? together(app, name, entries) : html`<h3>${name}</h3>`}
      <ul>
        ${entries.map(([layer, i]) => lamp(app, layer, i))}
      </ul>
    </div>`;
  })}`;
}

function daylight(app: App): TemplateResult {
  const hours = hoursOf(app.home);
  const has = (kind: Layer["kind"]) => app.home.layers.some(l => l.kind === kind);
  if (!has("sun") && !has("sky")) return html`${nothing}`;
  const { hour } = app.light;
  return html`<details open>
    <summary>${app.say("daylight")}</summary>
    ${(["sun", "sky"] as const)
      .filter(has)
      .map(
        kind =>
          html`<div class="daylight">
            ${toggle(
              app.say("on", app.say(kind)),
              app.light[kind].on,
              on => app.setDaylight(kind, { on }),
              app.say(kind),
            )}
            ${levelSlider(app, app.say(kind), app.light[kind], c => app.setDaylight(kind, c))}
          </div>`,
      )}
    ${hours.length < 2
      ? nothing
      : html`<div class="row">
          <span class="caption" aria-hidden="true">${app.say("hour")}</span>
          <input
            type="range"
            min=${hours[0]!}
            max=${hours.at(-1)!}
            step="0.05"
            list="hours"
            aria-label=${app.say("hour")}
            aria-valuetext=${clock(hour)}
            .value=${String(hour)}
            @input=${(e: Event) => app.setHour(number(e))}
          /><output>${clock(hour)}</output>
          <datalist id="hours">${hours.map(h => html`<option value=${h}></option>`)}</datalist>
        </div>`}
  </details>`;
}

function scenes(app: App): TemplateResult {
  const save = (event: SubmitEvent) => {
    event.preventDefault();
    const form = event.target as HTMLFormElement;
    const field = form.elements.namedItem("name") as HTMLInputElement;
    if (field.value.trim() !== "" && app.saveScene(field.value.trim())) form.reset();
  };
  return html`<details open>
    <summary>${app.say("scenes")}</summary>
    <div class="buttons">
      <button @click=${() => app.useLight(app.fileLight)}>${app.say("asBaked")}</button>
      <button @click=${() => app.useScene("everythingOn")}>${app.say("everythingOn")}</button>
      <button @click=${() => app.useScene("evening")}>${app.say("evening")}</button>
      ${app.scenes.map(
        scene =>
          html`<span class="pair">
            <button @click=${() => app.useStored(scene)}>${scene.name}</button>
            <button class="icon" aria-label=${app.say("deleteScene", scene.name)} @click=${() => app.forget(scene)}>
              ×
            </button>
          </span>`,
      )}
    </div>
    <form class="row" @submit=${save}>
      <input
        name="name"
        type="text"
        maxlength="40"
        autocomplete="off"
        placeholder=${app.say("sceneName")}
        aria-label=${app.say("sceneName")}
      />
      <button>${app.say("saveScene")}</button>
    </form>
  </details>`;
}

function picture(app: App): TemplateResult {
  return html`<details open>
    <summary>${app.say("picture")}</summary>
    ${toggle(app.say("autoExposure"), app.automatic, on => app.setAutomatic(on))}
    <div class="row">
      <span class="caption" aria-hidden="true">${app.say("exposure")}</span>
      <input
        type="range"
        min="-4"
        max="16"
        step="0.1"
        aria-label=${app.say("exposure")}
        .value=${app.ev100.toFixed(1)}
        @input=${(e: Event) => app.setEv100(number(e))}
      /><output>${app.ev100.toFixed(1)}</output>
    </div>
    ${toggle(app.say("falseColours"), app.falseColours, on => app.setFalseColours(on))}
    ${toggle(app.say("meter"), app.metering, on => app.setMetering(on))}
    ${toggle(app.say("throughWalls"), app.mover.throughWalls, on => app.setThroughWalls(on))}
    <div class="row">
      <span class="caption" aria-hidden="true">${app.say("fov")}</span>
      <input
        type="range"
        min="25"
        max="100"
        step="1"
        aria-label=${app.say("fov")}
        .value=${String(Math.round(app.mover.eye.fovDeg))}
        @input=${(e: Event) => app.setFov(number(e))}
      /><output>${Math.round(app.mover.eye.fovDeg)}°</output>
    </div>
  </details>`;
}

function places(app: App): TemplateResult {
  const { rooms, cameras } = app.home;
  return html`<details open>
    <summary>${app.say("places")}</summary>
    ${rooms.length === 0
      ? nothing
      : html`<canvas
            id="plan"
            role="img"
            aria-label=${app.say("map")}
            title=${app.say("map")}
            @click=${(e: MouseEvent) => app.clickPlan(e)}
          ></canvas>
          <h3>${app.say("rooms")}</h3>
          <div class="buttons">
            ${rooms.map(room => html`<button @click=${() => app.goToRoom(room)}>${room.name}</button>`)}
          </div>`}
    ${cameras.length === 0
      ? nothing
      : html`<h3>${app.say("cameras")}</h3>
          <div class="buttons">
            ${cameras.map(
              (camera, i) =>
                html`<button @click=${() => app.goToCamera(camera)}>
                  ${camera.name || app.say("camera", i + 1)}
                </button>`,
            )}
          </div>`}
  </details>`;
}

function rest(app: App): TemplateResult {
  return html`<div class="buttons">
      <button @click=${() => app.savePicture()}>${app.say("screenshot")}</button>
      <button @click=${() => app.copyLink()}>${app.say("copyLink")}</button>
      ${document.fullscreenEnabled
        ? html`<button @click=${() => app.toggleFullscreen()}>${app.say("fullscreen")}</button>`
        : nothing}
      ${app.canEnterVr ? html`<button @click=${() => app.enterVr()}>${app.say("enterVr")}</button>` : nothing}
    </div>
    <details>
      <summary>${app.say("help")}</summary>
      ${(["help1", "help2", "help3", "help4"] as const).map(key => html`<p class="hint">${app.say(key)}</p>`)}
    </details>
    <label class="row"
      ><span>${app.say("language")}</span>
      <select @change=${(e: Event) => app.setLanguage((e.target as HTMLSelectElement).value === "de" ? "de" : "en")}>
        <option value="en" ?selected=${app.language === "en"}>English</option>
        <option value="de" ?selected=${app.language === "de"}>Deutsch</option>
      </select></label
    >`;
}

export const panel = (app: App): TemplateResult =>
  html`<aside id="panel" aria-label=${app.say("panel")} ?hidden=${!app.panelOpen}>
    <h2>${document.title}</h2>
    <details open>
      <summary>${app.say("lamps")}</summary>
      ${lamps(app)}
    </details>
    ${daylight(app)} ${scenes(app)} ${picture(app)} ${places(app)} ${rest(app)}
  </aside>`;
