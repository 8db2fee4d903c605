// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt

import { Causes } from "./causes.js";
import { byId, el, figure, setText, svg } from "./dom.js";
import { Plots } from "./plots.js";
import { componentOf, isSource, shortPort } from "./system_model.js";

/**
 * All over time: what happened, plots, and the way from a sensor to the wheels.
 * @typedef {import("./connection.js").Connection} Connection
 * @typedef {import("./system_model.js").SystemModel} SystemModel
 * @typedef {{time: number, until?: number, lane: "alarms" | "missions" | "log", kind: string, who: string, text: string}} Happening
 *   times by the run's clock [s]
 */

const LANES = /** @type {const} */ (["alarms", "missions", "log"]);
const MARGIN = 74;
const LANE = 26;
/** @type {Record<string, number>} pixels of a mark that lasts; what is worse is higher, whatever its colour */
const HIGH = { warning: 10, error: 16 };
const DOT = "M-3,0a3,3 0 1,0 6,0a3,3 0 1,0 -6,0z";
/** @type {Record<string, string>} a triangle and a cross for what lasts no time */
const SHAPES = { warning: "M-6,5h12l-6,-11z", error: "M-6,-4l2,-2l4,4l4,-4l2,2l-4,4l4,4l-2,2l-4,-4l-4,4l-2,-2l4,-4z" };
const LINES = 2000;
const LISTED = 250;

/**
 * @param {Record<string, any>} row  of `missions`
 * @returns {Happening}
 */
function missionOf(row) {
  const failed = String(row.last).startsWith("failed");
  return { time: row.began, until: row.last_time, lane: "missions", kind: failed ? "warning" : "info", who: `mission ${row.mission}`, text: row.last };
}

export class TimeView {
  /**
   * @param {Connection} connection
   * @param {SystemModel} system
   */
  constructor(connection, system) {
    this.connection = connection;
    this.system = system;
    this.plots = new Plots(connection, system);
    this.isShown = false;
    /** @type {Happening[]} */
    this.log = [];
    /** @type {Happening[]} */
    this.missions = [];
    /** @type {() => void} */
    this.endLog = () => {};
    /** When the run's clock showed 0, by that of the browser [s]: no later than whatever has just happened says. */
    this.zero = Infinity;
    this.causes = new Causes();
    /** @type {(() => void)[]} */
    this.traces = [];
    this.drawing = /** @type {SVGSVGElement} */ (/** @type {unknown} */ (byId("timeline")));
    connection.addEventListener("hello", () => this.begin());
    connection.addEventListener("gone", () => this.endLog());
    system.addEventListener("figures", () => this.refresh());
    byId("happening-filter").addEventListener("input", () => this.list());
    byId("timeline-window").addEventListener("change", () => this.refresh());
    byId("trace").addEventListener("click", () => this.trace(this.traces.length === 0));
  }

  /** @param {boolean} on */
  show(on) {
    this.isShown = on;
    this.plots.show(on);
    if (on) this.refresh();
  }

  async begin() {
    this.endLog();
    this.log = [];
    this.zero = Infinity;
    this.endLog = this.connection.stream("log", ["--follow"], (record) => this.take(record));
    const { records } = await this.connection.ask("log");
    for (const record of records) this.take(record);
    if (this.traces.length > 0) this.trace(true);
  }

  /** @param {Record<string, any>} record  of the log */
  take(record) {
    const time = Number(record.time);
    this.zero = Math.min(this.zero, Date.now() / 1000 - time);
    if (this.log.some((line) => line.time === time && line.text === record.text)) return;  // a line may come twice
    this.log.push({ time, lane: "log", kind: record.level, who: record.who, text: record.text });
    if (this.log.length > LINES) this.log.splice(0, LINES / 10);
  }

  /** @returns {Happening[]} */
  get alarms() {
    return this.system.alarms.map((alarm) => ({ time: alarm.time, until: alarm.active ? Infinity : alarm.time, lane: "alarms", kind: alarm.active ? "error" : "warning", who: `${alarm.kind} ${alarm.source}`, text: alarm.text }));
  }

  async refresh() {
    if (!this.isShown || this.connection.hello === null) return;
    const { ok, records } = await this.connection.ask("missions");
    if (ok) this.missions = records.map(missionOf);
    this.zero = Math.min(this.zero, Date.now() / 1000 - Math.max(0, ...this.missions.map(({ time, until }) => until ?? time)));
    this.paint();
    this.list();
    this.showCauses();
  }

  /** @returns {Happening[]} in the order of time */
  get happenings() {
    return [...this.log, ...this.missions, ...this.alarms].sort((a, b) => a.time - b.time);
  }

  // ------------------------------------------------------------------------------------------------ the time line

  /** @returns {number} the run's clock [s], as far as it is known */
  get now() {
    const latest = Math.max(0, ...this.happenings.map(({ time, until }) => (until !== undefined && Number.isFinite(until) ? until : time)));
    if (this.system.pace !== null) return Math.max(latest, this.system.pace.time);
    return Number.isFinite(this.zero) ? Math.max(latest, Date.now() / 1000 - this.zero) : latest;
  }

  paint() {
    const width = this.drawing.getBoundingClientRect().width;
    const length = Number(/** @type {HTMLSelectElement} */ (byId("timeline-window")).value);
    const end = this.now;
    const begin = end - length;
    const x = (/** @type {number} */ time) => MARGIN + ((Math.min(time, end) - begin) / length) * (width - MARGIN - 12);
    const shown = this.happenings.filter(({ time, until }) => (until ?? time) >= begin);
    this.drawing.replaceChildren(...this.raster(begin, end, length, x, width), ...shown.map((each) => this.mark(each, Math.max(MARGIN, x(each.time)), x(each.until ?? each.time))));
  }

  /**
   * @param {number} begin
   * @param {number} end
   * @param {number} length
   * @param {(time: number) => number} x
   * @param {number} width
   * @returns {SVGElement[]}
   */
  raster(begin, end, length, x, width) {
    const step = [5, 10, 30, 60, 300, 600].find((each) => length / each <= 12) ?? 3600;
    const parts = LANES.map((lane, i) => {
      const label = svg("text", { x: 4, y: LANE * (i + 0.65) });
      label.textContent = lane;
      return svg("g", {}, svg("line", { x1: MARGIN, x2: width - 12, y1: LANE * (i + 0.5), y2: LANE * (i + 0.5) }), label);
    });
    for (let time = Math.ceil(Math.max(0, begin) / step) * step; time <= end; time += step) {
      const label = svg("text", { x: x(time), y: LANE * 3 + 14, class: "tick" });
      label.textContent = `${time} s`;
      parts.push(svg("g", {}, svg("line", { x1: x(time), x2: x(time), y1: 0, y2: LANE * 3 }), label));
    }
    return parts;
  }

  /**
   * @param {Happening} happening
   * @param {number} from
   * @param {number} to
   */
  mark({ lane, kind, who, text, time }, from, to) {
    const y = LANE * (LANES.indexOf(lane) + 0.5);
    const tip = svg("title");
    tip.textContent = `${figure(time, 1)} s  ${who}: ${text}`;
    const high = HIGH[kind] ?? 6;
    const bar = to - from > 3 ? svg("rect", { x: from, y: y - high / 2, width: to - from - 1, height: high, rx: 3 }, tip) : svg("path", { d: SHAPES[kind] ?? DOT, transform: `translate(${from},${y})` }, tip);
    bar.setAttribute("class", `mark ${lane} ${kind}`);
    return bar;
  }

  list() {
    const words = /** @type {HTMLInputElement} */ (byId("happening-filter")).value.toLowerCase().split(/\s+/).filter((word) => word !== "");
    const fits = this.happenings.filter((each) => words.every((word) => `${each.lane} ${each.kind} ${each.who} ${each.text}`.toLowerCase().includes(word)));
    const newest = fits.slice(-LISTED).reverse();
    const list = byId("happenings");
    const key = `${fits.length} ${newest[0]?.time} ${newest[0]?.until} ${words.join()}`;
    if (list.dataset.key === key) return;
    list.dataset.key = key;
    list.replaceChildren(...newest.map((each) => el("li", { class: each.kind }, `${figure(each.time, 1)} `, el("b", {}, each.kind === "info" ? "" : `${each.kind} `), el("span", { class: "who" }, each.who), ` ${each.text}`)));
  }

  // ------------------------------------------------------------------------------------------------ sensor to wheels

  /** @param {boolean} on */
  trace(on) {
    for (const end of this.traces) end();
    this.traces = [];
    if (on) {
      this.causes = new Causes();
      const isWheels = (/** @type {import("./system_model.js").Port} */ port) => shortPort(port.port) === "MotionCommandSend" && port.role === "Server";
      const sources = this.system.portsThat((port) => port.pattern !== "Query" && isSource(port) && port.connected_to.length > 0);
      this.traces = [
        ...sources.map(({ port }) => this.connection.look(port, 0, (object) => this.causes.add(object))),
        ...this.system.portsThat(isWheels).map(({ port }) => this.connection.look(port, 0, (object, { passed }) => this.arrive(object, passed))),
      ];
    }
    byId("trace").setAttribute("aria-pressed", String(on));
    setText(byId("trace"), on ? "Follow no more" : "Follow causes");
  }

  /**
   * Follows a command a moment later, when its causes have come over their own looks.
   * @param {any} object
   * @param {number} passed  [s]
   */
  arrive(object, passed) {
    setTimeout(() => {
      const steps = this.causes.arrive(object, passed);
      if (steps.length > 1) this.latest = steps;
    }, 250);
  }

  showCauses() {
    byId("causes").hidden = this.traces.length === 0;
    if (this.traces.length === 0) return;
    const ms = (/** @type {number} */ value) => `${figure(value * 1000, 1)} ms`;
    byId("ways").replaceChildren(...this.causes.summary().map(({ way, count, p50, p99 }) => el("tr", {}, el("td", {}, way), el("td", {}, ms(p50)), el("td", {}, ms(p99)), el("td", {}, String(count)))));
    if (this.latest !== undefined) setText(byId("latest-way"), `Latest: ${this.latest.map(({ name, age }) => `${componentOf(name)} ${ms(age)}`).join(" → ")} → wheels`);
  }
}
