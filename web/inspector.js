// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt

import { askSwap, report } from "./dialogs.js";
import { el, figure, permit, setText } from "./dom.js";
import { ObjectView } from "./object_view.js";
import { componentOf, shortPort } from "./system_model.js";
import { markOf, milliseconds } from "./system_view.js";

/**
 * All about one component, or one connection.
 * @typedef {import("./connection.js").Connection} Connection
 * @typedef {import("./system_model.js").SystemModel} SystemModel
 * @typedef {import("./system_model.js").Component} Component
 * @typedef {import("./system_model.js").Port} Port
 * @typedef {import("./system_model.js").Wire} Wire
 * @typedef {import("./system_view.js").Choice} Choice
 * @typedef {{name: string, before: string, input: HTMLInputElement}} Value
 */

const LINES = 300;

/** A part of the page that shows what was chosen. It asks for nothing while it shows nothing. */
export class Inspector {
  /**
   * @param {HTMLElement} element
   * @param {Connection} connection
   * @param {SystemModel} system
   * @param {(choice: Choice) => void} choose  called when a person follows a connection
   */
  constructor(element, connection, system, choose) {
    this.element = element;
    this.connection = connection;
    this.system = system;
    this.choose = choose;
    /** @type {Choice} */
    this.choice = null;
    this.facts = el("dl", { class: "figures" });
    this.buttons = el("div", { class: "row" });
    this.values = el("div");
    this.portList = el("div", { class: "ports" });
    this.watched = el("div");
    this.log = el("ol", { class: "log" });
    /** @type {() => void} */
    this.endLog = () => {};
    /** @type {Set<string>} */
    this.lines = new Set();
    /** @type {Map<string, ObjectView>} */
    this.views = new Map();
    /** @type {Value[]} */
    this.edited = [];
    this.shape = "";
    system.addEventListener("figures", () => this.refresh());
    system.addEventListener("graph", () => this.showPorts());
    connection.addEventListener("hello", () => this.followLog());  // of another connection, perhaps of another run
    element.hidden = true;
  }

  /** @returns {HTMLElement} the button that chooses nothing */
  closing() {
    return el("button", { class: "plain close", "aria-label": "Close", click: () => this.choose(null) }, "×");
  }

  /** @param {Choice} choice */
  show(choice) {
    this.endLog();
    for (const view of this.views.values()) view.close();
    this.endLog = () => {};
    this.choice = choice;
    this.shape = "";
    this.element.hidden = choice === null;
    if (choice === null) return;
    if ("component" in choice) this.showComponent(choice.component);
    else this.showWire(choice.wire);
    this.refresh();
  }

  refresh() {
    const { choice } = this;
    if (choice === null || this.element.closest("[hidden]") !== null) return;
    if ("component" in choice) this.refreshComponent(choice.component);
    else this.refreshWire(choice.wire);
  }

  /** @param {Record<string, string>} facts */
  showFacts(facts) {
    const names = Object.keys(facts).join();
    if (this.facts.dataset.names !== names) {
      this.facts.replaceChildren(...Object.keys(facts).flatMap((name) => [el("dt", {}, name), el("dd")]));
      this.facts.dataset.names = names;
    }
    const cells = this.facts.querySelectorAll("dd");
    Object.values(facts).forEach((text, i) => setText(cells[i], text));
  }

  // ------------------------------------------------------------------------------------------------ a component

  /** @param {string} name */
  showComponent(name) {
    const component = this.system.components.get(name);
    const section = (/** @type {string} */ title, /** @type {boolean} */ open, /** @type {Node[]} */ ...content) =>
      el("details", { class: "card", open }, el("summary", {}, title), ...content);
    this.watched.replaceChildren();
    this.element.replaceChildren(
      this.closing(),
      el("section", { class: "card" }, el("h2", {}, name, " ", el("small", {}, component?.type ?? "")), this.facts, this.buttons),
      this.watched,
      section("Ports", true, this.portList),
      section("Parameters", true, this.values),
      section("Log", true, this.log),
    );
    this.values.replaceChildren();
    this.showPorts();
    this.readValues(name);
    this.followLog();
  }

  /** @param {string} name */
  refreshComponent(name) {
    const component = this.system.components.get(name);
    if (component === undefined) return this.showFacts({ State: "is not there any more" });
    const [mark] = markOf(component.state);
    /** @type {Record<string, string>} */
    const facts = {
      State: `${mark} ${component.state}`, Process: `${component.process} (${component.pid})`, Memory: `${figure(component.memory_mb, 1)} MB in its process`,
      "Log lines": `${figure(component.log_per_s, 1)}/s`, Restarts: String(component.restarts), Code: component.plugin, Build: component.build_id.slice(0, 12),
    };
    const laps = this.system.laps.get(name);
    if (laps !== undefined && laps.lap50 !== null) facts["Lap, p50 and p99"] = `${milliseconds(laps.lap50)}, ${milliseconds(laps.lap99)} of the processor`;
    if (component.alarms !== "") facts.Alarms = component.alarms;
    this.showFacts(facts);
    const shape = `${name} ${component.state} ${this.connection.steers} ${this.connection.takes.size}`;
    if (shape !== this.shape) this.showOrders(component);
    this.shape = shape;
    this.refreshRates();
  }

  /** @param {Component} component */
  showOrders(component) {
    const { connection, system } = this;
    const { name, process, state } = component;
    const order = (/** @type {string} */ command, /** @type {string} */ word, /** @type {string} */ done) => async () => {
      await report(connection.ask(command, word), done);
      system.poll();
    };
    const paused = state.startsWith("SUSPENDED");
    const pausing = paused ? el("button", { click: order("resume", name, `${name} goes on.`) }, "Resume") : el("button", { click: order("suspend", name, `${name} is paused between two laps.`) }, "Suspend");
    const swapping = el("button", { click: () => askSwap(connection, system, system.components.get(name) ?? component) }, "Swap code …");
    const restarting = el("button", { title: `Ends process ${process} and starts it again, with all that runs in it`, click: order("restart", name, `Process ${process} works again.`) }, "Restart process");
    permit(pausing, connection.refusal(paused ? "resume" : "suspend"));
    permit(swapping, connection.refusal("swap"));
    permit(restarting, connection.refusal("restart"));
    this.buttons.replaceChildren(...(connection.steers ? [pausing, swapping, restarting] : []));
  }

  // ------------------------------------------------------------------------------------------------ its ports

  showPorts() {
    const { choice } = this;
    if (choice === null || !("component" in choice)) return;
    const ports = this.system.portsThat((port) => componentOf(port.port) === choice.component);
    this.portList.replaceChildren(...ports.map((port) => this.portRow(port)));
    this.refreshRates();
  }

  /** @param {Port} port */
  portRow(port) {
    const look = el("button", { class: "small look", title: "Look at the objects that pass", "aria-label": `Look at ${port.port}`, click: () => this.watch(port.port) }, "look");
    const ends = port.connected_to.map((other) => {
      const wire = this.system.wires.find((each) => (each.from === port.port && each.to === other) || (each.to === port.port && each.from === other));
      return el("button", { class: "plain link", click: () => wire !== undefined && this.choose({ wire }) }, other);
    });
    const type = port.reply ? `${port.type} → ${port.reply}` : port.type;
    const looks = port.pattern === "Query" ? null : look;
    return el(
      "div", { class: "port-row", title: port.text },
      el("span", { class: `pattern ${port.pattern}` }, `${port.pattern}${port.role}`), el("strong", {}, shortPort(port.port)), looks,
      el("span", { class: "small type" }, type), el("span", { class: "small rate", "data-rate": port.port }),
      el("div", { class: "ends" }, ...(ends.length > 0 ? ends : [el("span", { class: port.required ? "bad" : "small" }, port.required ? "must be connected" : "not connected")])),
    );
  }

  refreshRates() {
    for (const cell of /** @type {NodeListOf<HTMLElement>} */ (this.portList.querySelectorAll("[data-rate]"))) {
      const port = cell.dataset.rate ?? "";
      const flows = this.system.wires.filter((wire) => wire.from === port || wire.to === port).map((wire) => this.system.flowOf(wire));
      const rate = Math.max(0, ...flows.map((flow) => flow?.rate ?? 0));
      setText(cell, rate > 0 ? `${figure(rate, rate < 10 ? 1 : 0)}/s` : "");
    }
  }

  /** @param {string} port */
  watch(port) {
    if (this.views.has(port)) return;
    const view = new ObjectView(this.connection, port);
    this.views.set(port, view);
    view.addEventListener("closed", () => this.views.delete(port));
    this.watched.append(view.element);
    view.element.scrollIntoView({ block: "nearest" });
  }

  // ------------------------------------------------------------------------------------------------ its parameters

  /** @param {string} name */
  async readValues(name) {
    const { ok, records, error } = await this.connection.ask("get", name);
    if (this.choice === null || !("component" in this.choice) || this.choice.component !== name) return;
    if (!ok) return this.values.replaceChildren(el("p", { class: "bad" }, error));
    this.edited = [];
    const rows = records.map((row) => this.valueRow(row));
    const set = el("button", { class: "primary", click: () => this.setValues(name) }, "Set");
    permit(set, this.connection.refusal("set"));
    const reset = el("button", { click: () => this.readValues(name) }, "Read again");
    this.values.replaceChildren(...(rows.length > 0 ? rows : [el("p", { class: "small" }, "It has none.")]), el("div", { class: "row" }, ...(this.edited.length > 0 && this.connection.steers ? [set, reset] : [])));
    this.values.oninput = () => setText(set, this.changed().length > 1 ? `Set ${this.changed().length} values at once` : "Set");
    this.values.onkeydown = (event) => {
      if (event.key === "Enter" && /** @type {HTMLElement} */ (event.target).matches("input")) this.setValues(name);
    };
  }

  /** @param {Record<string, any>} row */
  valueRow(row) {
    const param = `${row.component}.${row.param}`;
    const input = el("input", { type: "text", value: String(row.value), disabled: row.fixed === true || !this.connection.may("set"), spellcheck: "false", "aria-label": param });
    if (row.fixed !== true) input.title = this.connection.refusal("set");
    if (row.fixed !== true) this.edited.push({ name: param, before: String(row.value), input });
    return el("label", { class: "value", title: `${row.text}${row.fixed === true ? " (fixed while it runs)" : ""}` }, el("span", {}, row.param), input, el("span", { class: "unit" }, row.unit));
  }

  changed() {
    return this.edited.filter(({ before, input }) => input.value !== before);
  }

  /** @param {string} name */
  async setValues(name) {
    const changed = this.changed();
    if (changed.length === 0) return;
    const ok = await report(this.connection.ask("set", ...changed.flatMap((value) => [value.name, value.input.value])), `Set ${changed.map((value) => value.name).join(", ")}.`);
    if (ok) await this.readValues(name);
  }

  // ------------------------------------------------------------------------------------------------ its log

  /** Shows the last lines of the component, and those that come. All lines are followed, and a line may come twice. */
  async followLog() {
    if (this.choice === null || !("component" in this.choice)) return;
    const name = this.choice.component;
    this.endLog();
    this.log.replaceChildren();
    this.lines.clear();
    const take = (/** @type {Record<string, any>} */ record) => {
      const key = `${record.time} ${record.text}`;
      if (record.who !== name || this.lines.has(key)) return;
      this.lines.add(key);
      this.addLine(record);
    };
    const { records } = await this.connection.ask("log", name);
    if (this.choice === null || !("component" in this.choice) || this.choice.component !== name) return;
    records.forEach(take);
    this.endLog();
    this.endLog = this.connection.stream("log", ["--follow"], take);
  }

  /** @param {Record<string, any>} record */
  addLine(record) {
    const atEnd = this.log.scrollTop + this.log.clientHeight >= this.log.scrollHeight - 4;
    this.log.append(el("li", { class: record.level }, `${figure(Number(record.time), 1)} `, el("b", {}, record.level === "info" ? "" : `${record.level} `), record.text));
    if (this.log.childElementCount > LINES) this.log.firstElementChild?.remove();
    if (atEnd) this.log.scrollTop = this.log.scrollHeight;
  }

  // ------------------------------------------------------------------------------------------------ a connection

  /** @param {Wire} wire */
  showWire(wire) {
    const { from, to } = wire;
    this.watched.replaceChildren();
    this.buttons.replaceChildren();
    const disconnecting = el("button", { id: "disconnect", click: () => this.disconnect(wire) }, "Disconnect");
    permit(disconnecting, this.connection.refusal("disconnect"));
    if (this.connection.steers) this.buttons.append(disconnecting);
    if (wire.pattern !== "Query") this.buttons.append(el("button", { click: () => this.watch(to) }, "Look at the objects"));
    const link = (/** @type {string} */ port) => el("button", { class: "plain link", click: () => this.choose({ component: componentOf(port) }) }, port);
    this.element.replaceChildren(this.closing(), el("section", { class: "card" }, el("h2", {}, "Connection"), el("p", {}, link(from), " → ", link(to)), this.facts, this.buttons), this.watched);
  }

  /** @param {Wire} wire */
  refreshWire(wire) {
    const flow = this.system.flowOf(wire);
    const { from, to, ...policy } = wire;
    this.showFacts({
      Rate: `${figure(flow?.rate, 1)}/s`, Carried: String(flow?.total ?? "–"), "Lost or replaced": String(flow?.lost ?? "–"), Queued: String(flow?.queued ?? "–"),
      ...(flow === undefined || flow.age50 === null ? {} : { "Age on arrival, p50 and p99": `${milliseconds(flow.age50)}, ${milliseconds(flow.age99)}` }),
      ...Object.fromEntries(Object.entries(policy).map(([name, value]) => [name.replace(/_/g, " "), String(value)])),
    });
  }

  /** @param {Wire} wire */
  async disconnect(wire) {
    const ok = await report(this.connection.ask("disconnect", wire.from, wire.to), `${wire.from} → ${wire.to} is removed.`);
    if (!ok) return;
    await this.system.refresh();
    const again = el("button", { id: "connect-again", class: "primary" }, "Connect again");
    again.addEventListener("click", async () => {
      if (!(await report(this.connection.ask("connect", wire.from, wire.to, ...policyOf(wire)), `${wire.from} → ${wire.to} is connected.`))) return;
      await this.system.refresh();
      this.show({ wire });
    });
    this.choice = null;
    this.element.replaceChildren(this.closing(), el("section", { class: "card" }, el("h2", {}, "Removed"), el("p", {}, `${wire.from} → ${wire.to}`), again));
  }
}

/**
 * @param {Wire} wire
 * @returns {string[]} the attributes with which the connection was made
 */
export function policyOf(wire) {
  const known = ["queue", "overflow", "interval", "deadline", "confirm"];
  return Object.entries(wire).filter(([name]) => known.includes(name)).map(([name, value]) => `${name}=${value}`);
}
