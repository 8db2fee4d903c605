// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt

import { byId, el, notify, setText } from "./dom.js";
import { numbersOf, valueAt } from "./layout.js";

/**
 * Plots of numbers in objects, each a drawing of dygraphs with up to two axes.
 * @typedef {import("./connection.js").Connection} Connection
 * @typedef {import("./system_model.js").SystemModel} SystemModel
 * @typedef {{port: string, path: string, unit: string, name: string, points: [number, number][]}} Series  points: [s], value
 * @typedef {{element: HTMLElement, drawing: HTMLElement, legend: HTMLElement, series: Series[], graph: any, stale: boolean}} Panel
 */

const REDRAW = 120;  // [ms]
const KEPT = 20000;
/** Told apart by brightness as well, for colour-blind eyes. */
const COLOURS = ["#0b5cad", "#d1720c", "#009e73", "#a3195b", "#6b4fa0", "#8a7400"];

/**
 * Merges series into the rows that dygraphs wants: time, then a value or null of each.
 * @param {Series[]} series
 * @param {number} since  [s]
 * @returns {(Date | number | null)[][]}
 */
export function mergedRows(series, since) {
  /** @type {Map<number, (Date | number | null)[]>} */
  const rows = new Map();
  series.forEach(({ points }, i) => {
    for (const [time, value] of points) {
      if (time < since) continue;
      let row = rows.get(time);
      if (row === undefined) rows.set(time, (row = [new Date(time * 1000), ...series.map(() => null)]));
      row[i + 1] = value;
    }
  });
  return [...rows].sort((a, b) => a[0] - b[0]).map(([, row]) => row);
}

/**
 * @param {Series[]} series
 * @returns {string} a table of all points, with a head
 */
export function csvOf(series) {
  const quoted = (/** @type {string} */ text) => (/[",\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text);
  const head = ["time [s]", ...series.map(({ name, unit }) => quoted(unit === "" ? name : `${name} [${unit}]`))];
  const rows = mergedRows(series, -Infinity).map(([time, ...values]) => [/** @type {Date} */ (time).getTime() / 1000, ...values.map((value) => value ?? "")].join());
  return [head.join(), ...rows, ""].join("\n");
}

export class Plots {
  /**
   * @param {Connection} connection
   * @param {SystemModel} system
   */
  constructor(connection, system) {
    this.connection = connection;
    this.system = system;
    /** @type {Panel[]} */
    this.panels = [];
    /** @type {Map<string, () => void>} looks by port */
    this.looks = new Map();
    this.isShown = false;
    this.isPaused = false;
    /** @type {any} */
    this.Dygraph = null;
    system.addEventListener("graph", () => this.offerPorts());
    addEventListener("plot", (event) => this.add(/** @type {CustomEvent} */ (event).detail));
    this.listen();
    setInterval(() => this.redraw(), REDRAW);
  }

  listen() {
    byId("plot-port").addEventListener("change", () => this.offerFields());
    byId("plot-add").addEventListener("click", () => this.add({ port: this.input("plot-port").value, path: this.input("plot-field").value }));
    byId("plot-csv").addEventListener("click", () => this.save());
    byId("plot-pause").addEventListener("click", () => {
      this.isPaused = !this.isPaused;
      byId("plot-pause").setAttribute("aria-pressed", String(this.isPaused));
    });
    byId("plots").addEventListener("dragover", (event) => event.preventDefault());
    byId("plots").addEventListener("drop", (event) => this.drop(event));
  }

  /** @param {string} id */
  input(id) {
    return /** @type {HTMLInputElement | HTMLSelectElement} */ (byId(id));
  }

  /** @param {boolean} on */
  async show(on) {
    this.isShown = on;
    if (!on || this.Dygraph !== null) return;
    await import(String("/lib/dygraph.min.js"));
    this.Dygraph = /** @type {any} */ (globalThis).Dygraph;
    const { PLUGINS, Plugins } = this.Dygraph;
    this.Dygraph.PLUGINS = PLUGINS.filter((/** @type {any} */ plugin) => plugin !== Plugins.Legend);  // it writes styles and HTML
  }

  offerPorts() {
    const select = this.input("plot-port");
    const chosen = select.value;
    const ports = this.system.portsThat((port) => port.pattern !== "Query" && !port.disabled);
    select.replaceChildren(...ports.map(({ port }) => el("option", { selected: port === chosen }, port)));
    this.offerFields();
  }

  offerFields() {
    const type = this.connection.typeOf(this.system.ports.get(this.input("plot-port").value)?.type ?? "");
    const numbers = type === null ? [] : numbersOf(type).filter(({ path }) => !/^(creation_time|seq|mission|cause)/.test(path) && !path.endsWith(".ns"));
    this.input("plot-field").replaceChildren(...numbers.map(({ path }) => el("option", {}, path)));
  }

  /**
   * Plots a field: with others of its unit, unless a panel is named.
   * @param {{port: string, path: string, panel?: Panel}} wanted
   */
  add({ port, path, panel }) {
    const name = `${port} ${path}`;
    if (port === "" || path === "" || this.panels.some((each) => each.series.some((series) => series.name === name))) return;
    const type = this.connection.typeOf(this.system.ports.get(port)?.type ?? "");
    const unit = (type === null ? undefined : numbersOf(type).find((number) => number.path === path.replace(/\[\d+\]/g, "[0]") || number.path === path))?.unit ?? "";
    const target = panel ?? this.panels.find((each) => each.series[0].unit === unit && each.series.length < COLOURS.length) ?? this.open();
    target.series.push({ port, path, unit, name, points: [] });
    target.graph?.destroy();
    target.graph = null;
    this.describe(target);
    this.follow();
    if (!this.isShown) notify(`${name} is plotted: see Time.`);
  }

  /** @returns {Panel} */
  open() {
    const drawing = el("div", { class: "drawing" });
    const legend = el("div", { class: "legend row" });
    const element = el("section", { class: "card panel" }, legend, drawing);
    const panel = { element, drawing, legend, series: [], graph: null, stale: false };
    this.panels.push(panel);
    byId("plots").append(element);
    byId("plot-none").hidden = true;
    return panel;
  }

  /** @param {Panel} panel */
  describe(panel) {
    panel.legend.replaceChildren(...panel.series.map((series, i) => {
      const swatch = el("i", { class: "swatch line" });
      swatch.style.borderTopColor = COLOURS[i % COLOURS.length];
      const value = el("b", { "data-value": series.name });
      return el("span", {}, swatch, ` ${series.name} `, value, ` ${series.unit} `, el("button", { class: "plain", "aria-label": `Plot ${series.name} no more`, click: () => this.remove(panel, series) }, "×"));
    }));
  }

  /**
   * @param {Panel} panel
   * @param {Series} series
   */
  remove(panel, series) {
    panel.series = panel.series.filter((each) => each !== series);
    panel.graph?.destroy();
    panel.graph = null;
    if (panel.series.length === 0) {
      panel.element.remove();
      this.panels = this.panels.filter((each) => each !== panel);
    }
    byId("plot-none").hidden = this.panels.length > 0;
    this.describe(panel);
    this.follow();
  }

  /** Looks at the ports that are plotted, and at no others. */
  follow() {
    const wanted = new Set(this.panels.flatMap((panel) => panel.series.map((series) => series.port)));
    for (const [port, end] of this.looks) {
      if (wanted.has(port)) continue;
      end();
      this.looks.delete(port);
    }
    for (const port of wanted) if (!this.looks.has(port)) this.looks.set(port, this.connection.look(port, 50, (object, passage) => this.take(port, object, passage.passed)));
  }

  /**
   * @param {string} port
   * @param {any} object
   * @param {number} time  [s]
   */
  take(port, object, time) {
    if (this.isPaused) return;
    for (const panel of this.panels) {
      for (const series of panel.series) {
        if (series.port !== port) continue;
        const value = Number(valueAt(object, series.path));
        if (!Number.isFinite(value)) continue;
        series.points.push([time, value]);
        if (series.points.length > KEPT) series.points.splice(0, KEPT / 10);
        panel.stale = true;
      }
    }
  }

  redraw() {
    if (!this.isShown || this.Dygraph === null || document.hidden) return;
    for (const panel of this.panels) {
      if (!panel.stale || (this.isPaused && panel.graph !== null)) continue;
      panel.stale = false;
      this.draw(panel);
    }
  }

  /** @param {Panel} panel */
  draw(panel) {
    const newest = Math.max(...panel.series.map(({ points }) => points.at(-1)?.[0] ?? -Infinity));
    const rows = mergedRows(panel.series, newest - Number(this.input("plot-window").value));
    for (const series of panel.series) {
      const shown = panel.legend.querySelector(`[data-value="${CSS.escape(series.name)}"]`);
      const value = series.points.at(-1)?.[1];
      if (shown !== null && value !== undefined) setText(shown, String(Number(value.toPrecision(4))));
    }
    if (panel.graph !== null) return panel.graph.updateOptions({ file: rows });
    if (rows.length === 0) return;
    const names = panel.series.map((_series, i) => `y${i}`);
    const others = Object.fromEntries(panel.series.map((series, i) => [names[i], series.unit === panel.series[0].unit ? {} : { axis: "y2" }]));
    const ink = getComputedStyle(document.body).getPropertyValue("--muted");
    const grid = getComputedStyle(document.body).getPropertyValue("--line");
    panel.graph = new this.Dygraph(panel.drawing, rows, {
      labels: ["time", ...names], series: others, colors: COLOURS, connectSeparatedPoints: true, legend: "never", strokeWidth: 1.6,
      axisLineColor: ink, gridLineColor: grid, axisLabelFontSize: 12, highlightCircleSize: 4,
      highlightCallback: (/** @type {Event} */ _event, /** @type {number} */ _x, /** @type {{name: string, yval: number}[]} */ points) => this.read(panel, points),
    });
  }

  /**
   * Shows the values under the pointer.
   * @param {Panel} panel
   * @param {{name: string, yval: number}[]} points
   */
  read(panel, points) {
    for (const { name, yval } of points) {
      const series = panel.series[Number(name.slice(1))];
      const shown = series === undefined ? null : panel.legend.querySelector(`[data-value="${CSS.escape(series.name)}"]`);
      if (shown !== null) setText(shown, String(Number(yval.toPrecision(4))));
    }
  }

  /** @param {DragEvent} event */
  drop(event) {
    event.preventDefault();
    const [port, path] = (event.dataTransfer?.getData("text/plain") ?? "").split("|");
    const panel = this.panels.find(({ element }) => element.contains(/** @type {Node} */ (event.target)));
    if (path !== undefined && this.system.ports.has(port)) this.add({ port, path, panel });
  }

  /** Hands the points of all plots to the browser as a file. */
  save() {
    const series = this.panels.flatMap((panel) => panel.series);
    if (series.length === 0) return notify("Nothing is plotted.");
    const link = el("a", { download: `${this.system.graph?.name ?? "orca"}.csv` });
    link.href = URL.createObjectURL(new Blob([csvOf(series)], { type: "text/csv" }));
    link.click();
    URL.revokeObjectURL(link.href);
  }
}
