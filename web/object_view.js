// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt

import { el, figure, setText } from "./dom.js";

/**
 * The newest object of a port, as a table of its fields with their units.
 * @typedef {import("./layout.js").Type} Type
 * @typedef {import("./layout.js").Field} Field
 * @typedef {import("./connection.js").Connection} Connection
 */

const RATE = 8;
const SHOWN = 24;  // numbers of a list

/**
 * @param {any} value
 * @returns {string} a number with as many digits as eyes can use
 */
function numberText(value) {
  if (typeof value !== "number") return String(value);
  return Number.isInteger(value) ? String(value) : String(Number(value.toPrecision(5)));
}

/**
 * Returns what a table shows of a value: rows of path, text and unit.
 * @param {Type} type
 * @param {any} value
 * @param {string} path
 * @param {string} unit
 * @returns {{path: string, text: string, unit: string, plots: boolean}[]}
 */
export function rowsOf(type, value, path = "", unit = "") {
  switch (type.kind) {
    case "basic":
      return [{ path, text: numberText(value), unit, plots: type.basic !== "string" }];
    case "enum":
      return [{ path, text: value, unit, plots: false }];
    case "struct":
      if (type.name === "TimeValue") return [{ path: `${path}.ns`, text: (value.ns * 1e-9).toFixed(3), unit: "s", plots: false }];
      return type.fields.flatMap((field) => rowsOf(field.type, value[field.name], path === "" ? field.name : `${path}.${field.name}`, field.unit));
    default:
      return listRows(type.of, value, path, unit);
  }
}

/**
 * @param {Type} of
 * @param {ArrayLike<any>} values
 * @param {string} path
 * @param {string} unit
 */
function listRows(of, values, path, unit) {
  const length = values.length;
  if (of.kind === "struct" && of.name !== "TimeValue") {
    const rows = Array.from({ length: Math.min(length, 3) }, (_, i) => rowsOf(of, values[i], `${path}[${i}]`, unit)).flat();
    return length > 3 ? [...rows, { path, text: `… ${length} in all`, unit: "", plots: false }] : rows;
  }
  if (length > 0 && Array.from(values).every((value) => value === 0)) return [{ path, text: `${length} × 0`, unit, plots: false }];
  const texts = Array.from({ length: Math.min(length, SHOWN) }, (_, i) => (of.kind === "struct" ? (values[i].ns * 1e-9).toFixed(3) : numberText(values[i])));
  return [{ path, text: `[${length}] ${texts.join(" ")}${length > SHOWN ? " …" : ""}`, unit, plots: false }];
}

/** A table that shows one port until it is closed. A row with a number can be plotted: event `plot` with port and path. */
export class ObjectView extends EventTarget {
  /**
   * @param {Connection} connection
   * @param {string} port
   */
  constructor(connection, port) {
    super();
    this.connection = connection;
    this.port = port;
    this.state = el("span", { class: "small" }, "waits for an object");
    this.body = el("tbody");
    this.element = el(
      "section", { class: "card object" },
      el("h3", {}, port, " ", el("button", { class: "plain", "aria-label": `Look no more at ${port}`, click: () => this.close() }, "×")),
      this.state,
      el("table", {}, this.body),
    );
    this.paths = "";
    /** @type {HTMLElement[]} */
    this.cells = [];
    this.count = 0;
    this.since = performance.now();
    this.end = connection.look(port, RATE, (object, passage) => this.take(object, passage), (error) => setText(this.state, error === "" ? "waits for an object" : error));
  }

  close() {
    this.end();
    this.element.remove();
    this.dispatchEvent(new Event("closed"));
  }

  /**
   * @param {any} object
   * @param {import("./connection.js").Passage} passage
   */
  take(object, passage) {
    const type = this.connection.typeOf(passage.type);
    if (type === null) return;
    const rows = rowsOf(type, object);
    const paths = rows.map((row) => row.path).join();
    if (paths !== this.paths) this.build(rows);
    this.paths = paths;
    rows.forEach((row, i) => setText(this.cells[i], row.text));
    const age = Math.max(0, passage.passed - passage.created) * 1000;
    setText(this.state, `${passage.type} ${object.seq}, ${passage.bytes} bytes, ${figure(age, 2)} ms old as it passed${passage.lost > 0 ? `, ${passage.lost} not seen` : ""}`);
  }

  /** @param {ReturnType<typeof rowsOf>} rows */
  build(rows) {
    this.cells = rows.map(() => el("td"));
    this.body.replaceChildren(...rows.map((row, i) => el(
      "tr", { class: /^(creation_time|origin|seq|mission|cause)/.test(row.path) ? "header" : "" },
      el("th", { scope: "row", draggable: row.plots, dragstart: (event) => event.dataTransfer.setData("text/plain", `${this.port}|${row.path}`) }, row.path),
      this.cells[i],
      el("td", { class: "unit" }, row.unit),
      el("td", {}, row.plots ? el("button", { class: "small look", "aria-label": `Plot ${row.path}`, click: () => this.plot(row.path) }, "plot") : null),
    )));
  }

  /** @param {string} path */
  plot(path) {
    dispatchEvent(new CustomEvent("plot", { detail: { port: this.port, path } }));
  }
}
