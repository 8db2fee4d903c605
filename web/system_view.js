// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt

import { byId, figure, notify, setText, svg } from "./dom.js";
import { componentOf } from "./system_model.js";
import { along, curve, detour, drawnName, frameOf, misfit, planOf, portPlace, ROW } from "./system_layout.js";

/**
 * The drawing of the graph, live: what runs where, how it is, and what its connections carry.
 * @typedef {import("./system_model.js").SystemModel} SystemModel
 * @typedef {import("./system_model.js").Wire} Wire
 * @typedef {import("./system_model.js").Flow} Flow
 * @typedef {import("./system_model.js").Component} Component
 * @typedef {import("./system_layout.js").Plan} Plan
 * @typedef {import("./system_layout.js").Box} Box
 * @typedef {import("./system_layout.js").Point} Point
 * @typedef {import("./system_layout.js").Places} Places
 * @typedef {{wire: Wire, line: SVGPathElement, hit: SVGPathElement, label: SVGTextElement}} DrawnWire
 * @typedef {{box: Box, group: SVGGElement, state: SVGTextElement, lap: SVGTextElement}} DrawnBox
 * @typedef {{component: string} | {wire: Wire} | null} Choice
 */

const n = (/** @type {number} */ value) => value.toFixed(1);
const BELOW = 32;  // pixels that the legend takes
const FEW = 30;  // components up to which ports without a connection are shown at first
/** @type {Record<string, string>} a mark and a class for each state; a mark says the same without colours */
const MARKS = { WORK: "● good", WORK_DONE: "✓ good", IDLE: "○ calm", INIT: "◌ calm", CONNECT: "◌ calm", UNLOADED: "– calm", SUSPENDED: "‖ waiting", WORK_FAILED: "× bad", EXIT: "■ bad" };

/**
 * @param {string} state  as in `ps`
 * @returns {[string, string]} a mark and a class
 */
export function markOf(state) {
  const [mark, kind] = (MARKS[state.split(" ")[0]] ?? "? waiting").split(" ");
  return [mark, kind];
}

/** @param {number | null | undefined} value  [ms] @returns {string} with three digits */
export function milliseconds(value) {
  if (value === null || value === undefined) return "–";
  return `${figure(value, value < 1 ? 2 : value < 10 ? 1 : 0)} ms`;
}

/**
 * @param {Wire} wire
 * @param {Flow | undefined} flow
 * @returns {{text: string, loses: boolean}} what a connection carries; a queue of one that keeps the newest loses nothing
 */
export function flowText(wire, flow) {
  if (flow === undefined) return { text: "", loses: false };
  const keepsNewest = wire.queue === "1" && wire.overflow === "drop_oldest";
  const loses = flow.lossRate > 0 && !keepsNewest;
  const rate = flow.rate >= 0.5 ? `${figure(flow.rate, 0)}/s` : flow.rate > 0 ? `${figure(flow.rate, 1)}/s` : "";
  const queued = flow.queued > 1 ? ` ${flow.queued} wait` : "";
  const age = flow.age99 !== null && flow.rate > 0 ? ` ${milliseconds(flow.age99)}` : "";
  return { text: `${rate}${age}${queued}${loses ? ` lost ${figure(flow.lossRate, 0)}/s` : ""}`, loses };
}

/** Events: `chosen` when a person chose something, in `choice`. */
export class SystemView extends EventTarget {
  /**
   * @param {import("./connection.js").Connection} connection
   * @param {SystemModel} system
   */
  constructor(connection, system) {
    super();
    this.connection = connection;
    this.system = system;
    /** @type {Choice} */
    this.choice = null;
    /** @type {Plan} */
    this.plan = { boxes: [], groups: [], links: [] };
    /** @type {Places} */
    this.places = {};
    /** @type {Record<string, [number, number]>} where hands have put components [pixels] */
    this.byHand = {};
    this.isWarned = false;
    /** @type {Map<string, DrawnBox>} */
    this.boxes = new Map();
    /** @type {DrawnWire[]} */
    this.wires = [];
    this.drawing = /** @type {SVGSVGElement} */ (/** @type {unknown} */ (byId("graph")));
    this.sheet = svg("g");
    this.drawing.append(this.sheet);
    this.worker = new Worker(new URL("layout_worker.js", import.meta.url), { type: "module" });
    this.number = 0;
    /** @type {import("./system_layout.js").Rectangle[]} */
    this.rectangles = [];
    this.lanes = { forward: 0, back: 0 };
    this.zoomed = { x: 0, y: 0, scale: 1 };
    this.isShown = false;
    this.isFitted = false;
    /** Whether a person has moved the sheet. */
    this.isTouched = false;
    /** @type {{kind: "sheet" | "box" | "wire", name: string, at: Point, moved: boolean} | null} */
    this.drag = null;
    this.rubber = svg("path", { class: "rubber" });
    this.worker.addEventListener("message", (event) => this.takePlaces(event.data));
    connection.addEventListener("hello", () => this.readByHand());
    system.addEventListener("graph", () => this.rebuild());
    system.addEventListener("figures", () => this.refresh());
    this.listen();
  }

  /** @param {boolean} on */
  show(on) {
    this.isShown = on;
    if (!on) return;
    this.refresh();
    if (!this.isFitted) this.fit();
  }

  // ------------------------------------------------------------------------------------------------ places

  get allPorts() {
    const box = /** @type {HTMLInputElement} */ (byId("all-ports"));
    if (box.dataset.touched === undefined) box.checked = this.system.components.size <= FEW;
    return box.checked;
  }

  /** The name under which this browser keeps what cannot be kept beside the graph. */
  get ownLayout() {
    return `layout of ${this.connection.hello?.system}`;
  }

  /** Reads where hands have put components: beside the graph, and over that in this browser. */
  async readByHand() {
    const { ok, text, error } = await this.connection.layout();
    if (!ok) this.warn(error);
    this.byHand = { ...(ok ? JSON.parse(text) : {}), ...JSON.parse(localStorage.getItem(this.ownLayout) ?? "{}") };
    this.rebuild();
  }

  /** Keeps where hands have put components: beside the graph if this page may, and if that can be written, otherwise in this browser. */
  async keepByHand() {
    const layout = JSON.stringify(this.byHand);
    const { ok, error } = this.connection.may("file --keep") ? await this.connection.layout(layout) : { ok: false, error: "" };
    if (ok) return localStorage.removeItem(this.ownLayout);
    localStorage.setItem(this.ownLayout, layout);
    if (error !== "") this.warn(error);
  }

  /** @param {string} error */
  warn(error) {
    if (!this.isWarned) notify(`Only this browser remembers where components stand: ${error}`, "refused");
    this.isWarned = true;
  }

  rebuild() {
    this.plan = planOf([...this.system.components.values()], [...this.system.ports.values()], this.system.wires, this.allPorts);
    this.number += 1;
    this.worker.postMessage({ number: this.number, plan: this.plan });
  }

  /** @param {{number: number, places: Places, error: string}} result */
  takePlaces({ number, places, error }) {
    if (number !== this.number) return;
    if (error !== "") notify(`The graph cannot be laid out: ${error}`, "refused");
    this.places = { ...places };
    for (const [name, [x, y]] of Object.entries(this.byHand)) if (name in places) this.places[name] = { x, y };
    this.paint();
    if (!this.isFitted && this.isShown) this.fit();
  }

  // ------------------------------------------------------------------------------------------------ the drawing

  paint() {
    this.boxes.clear();
    const frames = this.plan.groups.map((group) => this.frame(group));
    frames.sort((a) => (a.classList.contains("machine") ? -1 : 1));
    const boxes = this.plan.boxes.filter((box) => box.name in this.places).map((box) => this.box(box));
    this.rectangles = [...this.boxes.values()].map(({ box }) => this.rectangleOf(box));
    this.lanes = { forward: 0, back: 0 };
    this.wires = this.system.wires.flatMap((wire) => this.wire(wire) ?? []);
    const lines = svg("g", { class: "wires" }, ...this.wires.flatMap(({ hit, line }) => [hit, line]));
    const labels = svg("g", { class: "flows" }, ...this.wires.map(({ label }) => label));
    this.sheet.replaceChildren(...frames, lines, ...boxes, labels, this.rubber);
    this.refresh();
    this.markChoice();
  }

  /** @param {import("./system_layout.js").Group} group */
  frame(group) {
    const { x, y, width, height } = frameOf(this.plan, this.places, group);
    const title = svg("text", { x: x + 10, y: y + 16 });
    title.textContent = `${group.kind} ${group.name}`;
    return svg("g", { class: `frame ${group.kind}` }, svg("rect", { x, y, width, height, rx: 8 }), title);
  }

  /** @param {Box} box */
  rectangleOf({ name, width, height }) {
    const { x, y } = this.places[name];
    return { x: x - width / 2, y: y - height / 2, width, height };
  }

  /** @param {Box} box */
  box(box) {
    const component = this.system.components.get(box.name);
    const { x, y } = this.places[box.name];
    const [left, top] = [x - box.width / 2, y - box.height / 2];
    const text = (/** @type {number} */ dx, /** @type {number} */ dy, /** @type {string} */ content, /** @type {string} */ kind) => {
      const made = svg("text", { x: left + dx, y: top + dy, class: kind });
      made.textContent = content;
      return made;
    };
    const state = text(box.width - 9, 16, "", "state");
    const lap = text(box.width - 9, box.height + 11, "", "lap");
    const group = svg(
      "g", { class: "box", tabindex: 0, role: "button", "data-component": box.name },
      svg("rect", { x: left, y: top, width: box.width, height: box.height, rx: 6 }),
      text(9, 16, box.name, "name"), text(9, 31, component?.type ?? "", "type"), state, lap,
      ...[...box.inputs, ...box.outputs].map((port) => this.port(box, port)),
    );
    this.boxes.set(box.name, { box, group, state, lap });
    return group;
  }

  /**
   * @param {Box} box
   * @param {string} name
   */
  port(box, name) {
    const port = this.system.ports.get(name);
    const { x, y } = portPlace(box, this.places[box.name], name) ?? { x: 0, y: 0 };
    const isInput = box.inputs.includes(name);
    const label = svg("text", { x: x + (isInput ? 9 : -9), y: y + 4, class: isInput ? "in" : "out" });
    label.textContent = port === undefined ? name : drawnName(port);
    const tip = svg("title");
    tip.textContent = `${name}\n${port?.pattern} ${port?.role} of ${port?.type}${port?.reply ? ` → ${port.reply}` : ""}\n${port?.text}`;
    const free = port?.connected_to.length === 0 ? (port.required ? "missing" : "free") : "";
    const shape = { Push: `M${x - 4.5},${y}a4.5,4.5 0 1,0 9,0a4.5,4.5 0 1,0 -9,0z`, Send: `M${x - 4},${y - 5}l9,5l-9,5z`, Query: `M${x - 5.5},${y}l5.5,-5.5l5.5,5.5l-5.5,5.5z` };
    return svg(
      "g", { class: `port ${free}`, "data-port": name },
      svg("rect", { x: isInput ? x - 8 : x - 60, y: y - ROW / 2, width: 68, height: ROW, class: "grip" }),
      svg("path", { d: shape[port?.pattern ?? "Push"] }), label, tip,
    );
  }

  /**
   * @param {Wire} wire
   * @returns {DrawnWire | null}
   */
  wire(wire) {
    const ends = this.ends(wire);
    if (ends === null) return null;
    const { path: d, middle } = this.way(ends);
    const line = svg("path", { d, class: `wire ${wire.pattern}`, "marker-end": "url(#arrow)" });
    const tip = svg("title");
    tip.textContent = `${wire.from} → ${wire.to}`;
    const hit = svg("path", { d, class: "hit" }, tip);
    const label = svg("text", { class: "flow" });
    label.setAttribute("x", n(middle.x));
    label.setAttribute("y", n(middle.y - 3));
    for (const part of [hit, label]) part.addEventListener("click", () => this.choose({ wire }));
    return { wire, line, hit, label };
  }

  /**
   * @param {[Point, Point]} ends
   * @returns {{path: string, middle: Point}}
   */
  way([from, to]) {
    if (to.x > from.x + 20) {
      const shares = [0.5, 0.35, 0.65, 0.2, 0.8];  // so that figures stand neither on each other nor on a box
      const first = this.lanes.forward++ % 3;
      const places = [...shares.slice(first), ...shares.slice(0, first)].map((share) => along(from, to, share));
      const free = places.find((p) => !this.rectangles.some((box) => p.x > box.x - 16 && p.x < box.x + box.width + 16 && p.y > box.y && p.y < box.y + box.height + 10));
      return { path: curve(from, to), middle: free ?? places[0] };
    }
    return detour(from, to, this.rectangles, this.lanes.back++);
  }

  /**
   * @param {Wire} wire
   * @returns {[Point, Point] | null}
   */
  ends({ from, to }) {
    const [a, b] = [this.boxes.get(componentOf(from)), this.boxes.get(componentOf(to))];
    if (a === undefined || b === undefined) return null;
    const start = portPlace(a.box, this.places[a.box.name], from);
    const end = portPlace(b.box, this.places[b.box.name], to);
    return start === null || end === null ? null : [start, { x: end.x - 6, y: end.y }];
  }

  /** Shows new figures, and touches only what has changed. */
  refresh() {
    if (!this.isShown) return;
    for (const [name, { group, state, lap }] of this.boxes) {
      const component = this.system.components.get(name);
      if (component === undefined) continue;
      const [mark, kind] = markOf(component.state);
      setText(state, `${mark} ${component.state}${component.alarms === "" ? "" : " !"}`);
      const lap99 = this.system.laps.get(name)?.lap99 ?? null;
      setText(lap, lap99 === null ? "" : `lap ${milliseconds(lap99)}`);
      if (group.dataset.state !== kind) group.dataset.state = kind;
      if (group.ariaLabel !== `${name}: ${component.state}`) group.ariaLabel = `${name}: ${component.state}`;
    }
    for (const { wire, line, label } of this.wires) {
      const { text, loses } = flowText(wire, this.system.flowOf(wire));
      setText(label, text);
      const moves = text === "" ? "still" : loses ? "loses" : "flows";
      if (line.dataset.flow !== moves) line.dataset.flow = label.dataset.flow = moves;
    }
  }

  /** @param {Choice} choice */
  choose(choice) {
    this.choice = choice;
    this.markChoice();
    this.dispatchEvent(new Event("chosen"));
  }

  markChoice() {
    const component = this.choice !== null && "component" in this.choice ? this.choice.component : "";
    const wire = this.choice !== null && "wire" in this.choice ? this.choice.wire : { from: "", to: "" };
    for (const [name, { group }] of this.boxes) group.classList.toggle("chosen", name === component);
    for (const { wire: each, line } of this.wires) {
      line.classList.toggle("chosen", each.from === wire.from && each.to === wire.to);
      line.classList.toggle("near", component !== "" && (componentOf(each.from) === component || componentOf(each.to) === component));
    }
  }

  // ------------------------------------------------------------------------------------------------ hands

  listen() {
    const { drawing } = this;
    drawing.addEventListener("pointerdown", (event) => this.press(event));
    drawing.addEventListener("pointermove", (event) => this.move(event));
    drawing.addEventListener("pointerup", (event) => this.release(event));
    drawing.addEventListener("pointercancel", () => this.letGo());
    drawing.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(Math.exp(-event.deltaY * (event.deltaMode === 1 ? 0.05 : 0.0015)), event);
    }, { passive: false });
    drawing.addEventListener("keydown", (event) => {
      const name = /** @type {HTMLElement} */ (event.target).dataset.component;
      if (name === undefined || (event.key !== "Enter" && event.key !== " ")) return;
      event.preventDefault();
      this.choose({ component: name });
    });
    addEventListener("resize", () => {  // such as a phone that was turned
      this.isFitted &&= this.isTouched;
      if (this.isShown && !this.isFitted) this.fit();
    });
    byId("graph-fit").addEventListener("click", () => this.fit());
    byId("graph-closer").addEventListener("click", () => this.zoom(1.3));
    byId("graph-farther").addEventListener("click", () => this.zoom(1 / 1.3));
    byId("graph-tidy").addEventListener("click", () => {
      this.byHand = {};
      this.keepByHand();
      this.isFitted = false;
      this.rebuild();
    });
    byId("all-ports").addEventListener("change", (event) => {
      /** @type {HTMLInputElement} */ (event.target).dataset.touched = "";
      this.rebuild();
    });
  }

  /** @param {PointerEvent} event */
  press(event) {
    if (event.button !== 0) return;
    const target = /** @type {Element} */ (event.target);
    const port = target.closest("[data-port]")?.getAttribute("data-port");
    const component = target.closest("[data-component]")?.getAttribute("data-component");
    const at = { x: event.clientX, y: event.clientY };
    if (port && this.connection.steers) this.drag = { kind: "wire", name: port, at, moved: false };
    else if (component) this.drag = { kind: "box", name: component, at, moved: false };
    else this.drag = { kind: "sheet", name: "", at, moved: false };
  }

  /** @param {PointerEvent} event */
  move(event) {
    const { drag } = this;
    if (drag === null) return;
    const [dx, dy] = [event.clientX - drag.at.x, event.clientY - drag.at.y];
    if (!drag.moved && Math.hypot(dx, dy) < 4) return;
    if (!drag.moved) this.begin(drag, event);
    if (this.drag === null) return;
    if (drag.kind === "wire") return this.pullWire(drag.name, event);
    drag.at = { x: event.clientX, y: event.clientY };
    this.isTouched = true;
    if (drag.kind === "sheet") this.place({ x: this.zoomed.x + dx, y: this.zoomed.y + dy });
    else this.moveBox(drag.name, dx / this.zoomed.scale, dy / this.zoomed.scale);
  }

  /**
   * @param {NonNullable<SystemView["drag"]>} drag
   * @param {PointerEvent} event
   */
  begin(drag, event) {
    drag.moved = true;
    this.drawing.setPointerCapture(event.pointerId);
    const from = this.system.ports.get(drag.name);
    if (drag.kind !== "wire" || from === undefined) return;
    const refusal = this.connection.refusal("connect");
    if (refusal !== "") {
      notify(refusal, "refused");
      return this.letGo();
    }
    this.drawing.classList.add("connecting");
    for (const grip of this.drawing.querySelectorAll("[data-port]")) grip.classList.toggle("fits", this.verdict(drag.name, grip.getAttribute("data-port") ?? "") === "");
  }

  /**
   * @param {string} one
   * @param {string} other
   * @returns {string} "" if the ports fit, otherwise why not
   */
  verdict(one, other) {
    const [a, b] = this.ordered(one, other).map((name) => this.system.ports.get(name));
    return a === undefined || b === undefined ? "no port" : misfit(a, b, (type, wanted) => this.connection.isA(type, wanted));
  }

  /**
   * @param {string} one
   * @param {string} other
   * @returns {[string, string]} the output first, wherever the pull began
   */
  ordered(one, other) {
    return this.boxes.get(componentOf(one))?.box.inputs.includes(one) ? [other, one] : [one, other];
  }

  /**
   * @param {MouseEvent} event
   * @returns {string | null} the port under the pointer
   */
  portUnder(event) {
    return document.elementFromPoint(event.clientX, event.clientY)?.closest("[data-port]")?.getAttribute("data-port") ?? null;
  }

  /**
   * @param {string} name
   * @param {PointerEvent} event
   */
  pullWire(name, event) {
    const box = this.boxes.get(componentOf(name))?.box;
    const from = box === undefined ? null : portPlace(box, this.places[box.name], name);
    if (from === null || box === undefined) return;
    const to = this.toSheet(event);
    this.rubber.setAttribute("d", box.inputs.includes(name) ? curve(to, from) : curve(from, to));
    const other = this.portUnder(event);
    const word = other === null || other === name ? "" : this.verdict(name, other);
    const types = [name, other ?? ""].map((each) => this.system.ports.get(each)?.type ?? "");
    setText(byId("graph-hint"), other === null || other === name ? `${name}: ${types[0]}` : word === "" ? `${name} and ${other} fit: release to connect` : word);
    this.rubber.classList.toggle("refused", word !== "");
  }

  /** @param {PointerEvent} event */
  release(event) {
    const { drag } = this;
    const other = this.portUnder(event);
    this.letGo();
    if (drag === null) return;
    if (!drag.moved && drag.kind !== "sheet") return this.choose({ component: drag.kind === "box" ? drag.name : componentOf(drag.name) });
    if (drag.kind === "box") this.keepPlace(drag.name);
    if (drag.kind === "wire" && drag.moved && other !== null && other !== drag.name) this.connect(...this.ordered(drag.name, other));
  }

  letGo() {
    this.drag = null;
    this.drawing.classList.remove("connecting");
    this.rubber.setAttribute("d", "");
    setText(byId("graph-hint"), "");
  }

  /**
   * Connects two ports, as the deployer's checker allows.
   * @param {string} from
   * @param {string} to
   * @returns {Promise<boolean>}
   */
  async connect(from, to) {
    const { ok, error } = await this.connection.ask("connect", from, to);
    if (ok) notify(`${from} → ${to} is connected.`, "done");
    else notify(error, "refused");
    await this.system.refresh();
    return ok;
  }

  /**
   * @param {string} name
   * @param {number} dx
   * @param {number} dy
   */
  moveBox(name, dx, dy) {
    const { x, y } = this.places[name];
    this.places[name] = { x: x + dx, y: y + dy };
    this.paint();
  }

  /** @param {string} name */
  keepPlace(name) {
    const { x, y } = this.places[name];
    this.byHand[name] = [Math.round(x), Math.round(y)];
    this.keepByHand();
  }

  // ------------------------------------------------------------------------------------------------ the sheet

  /**
   * @param {MouseEvent} event
   * @returns {Point}
   */
  toSheet(event) {
    const box = this.drawing.getBoundingClientRect();
    const { x, y, scale } = this.zoomed;
    return { x: (event.clientX - box.left - x) / scale, y: (event.clientY - box.top - y) / scale };
  }

  /** @param {Partial<{x: number, y: number, scale: number}>} change */
  place(change) {
    Object.assign(this.zoomed, change);
    const { x, y, scale } = this.zoomed;
    this.sheet.setAttribute("transform", `translate(${x},${y}) scale(${scale})`);
    this.drawing.classList.toggle("far", scale < 0.55);
  }

  /**
   * @param {number} factor
   * @param {MouseEvent} [event]  what is under it stays there
   */
  zoom(factor, event) {
    const box = this.drawing.getBoundingClientRect();
    const at = event === undefined ? { x: box.width / 2, y: box.height / 2 } : { x: event.clientX - box.left, y: event.clientY - box.top };
    const scale = Math.min(3, Math.max(0.08, this.zoomed.scale * factor));
    const grown = scale / this.zoomed.scale;
    this.isTouched = true;
    this.place({ scale, x: at.x - (at.x - this.zoomed.x) * grown, y: at.y - (at.y - this.zoomed.y) * grown });
  }

  /** Shows the whole graph. */
  fit() {
    const view = this.drawing.getBoundingClientRect();
    if (view.width === 0 || this.plan.groups.length === 0 || Object.keys(this.places).length === 0) return;
    const frames = this.plan.groups.map((group) => frameOf(this.plan, this.places, group));
    const left = Math.min(...frames.map((f) => f.x)) - 12;
    const top = Math.min(...frames.map((f) => f.y)) - 12;
    const width = Math.max(...frames.map((f) => f.x + f.width)) + 12 - left;
    const height = Math.max(...frames.map((f) => f.y + f.height)) + 12 - top;
    const above = byId("graph-bar").getBoundingClientRect().bottom - view.top;
    const room = Math.max(1, view.height - above - BELOW);
    const scale = Math.min(1.3, view.width / width, room / height);
    this.place({ scale, x: (view.width - width * scale) / 2 - left * scale, y: above + (room - height * scale) / 2 - top * scale });
    this.isFitted = true;
    this.isTouched = false;
  }

  /** Shows the whole graph if what was chosen is out of sight, such as behind what is shown of it. */
  keepInSight() {
    const { choice } = this;
    const chosen = choice !== null && "component" in choice ? this.boxes.get(choice.component)?.group : undefined;
    const [box, view] = [chosen?.getBoundingClientRect(), this.drawing.getBoundingClientRect()];
    if (box !== undefined && (box.bottom > view.bottom || box.right > view.right || box.top < view.top || box.left < view.left)) this.fit();
  }
}
