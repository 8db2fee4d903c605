// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt

import { byId, setText } from "./dom.js";
import { between, Camera } from "./geometry.js";
import { changeOf } from "./world_change.js";
import * as draw from "./world_draw.js";
import { WorldPanel } from "./world_panel.js";

/**
 * The picture of the world, and what a person does in it.
 * @typedef {import("./geometry.js").Point} Point
 * @typedef {import("./world_model.js").Robot} Robot
 * @typedef {import("./world_model.js").WorldModel} WorldModel
 * @typedef {import("./system_model.js").SystemModel} SystemModel
 * @typedef {import("./connection.js").Connection} Connection
 * @typedef {"look" | "drive" | "pose" | "change" | "measure"} Tool
 */

const EASE = 0.05;  // [s] in which the drawn robot comes two thirds nearer to where it is
const FIT_AGAIN = 1500;  // [ms]
const LABEL = 90;  // pixels of a name beside its place
const LEAST_PULL = 12;  // pixels below which a pull has no direction
/** @type {Record<Tool, string>} */
const HINTS = {
  look: "",
  drive: "Press where the robot is to go, pull to where it is to look, release. Shift: a point on the way. Enter: the middle of the picture.",
  pose: "Press where the robot stands, pull to where it looks, release.",
  change: "Press free floor to put a box there. Pull a thing, or the robot, to another place. Shift: take a thing away. Press the leaf of a door to open or shut it.",
  measure: "Press and pull to measure.",
};
/** @type {Record<string, Tool>} */
const TOOL_KEYS = { v: "look", d: "drive", p: "pose", w: "change", m: "measure" };

/** @param {Tool} tool @returns {boolean} whether this system takes what it orders, and this page may order it */
function isOffered(tool) {
  const button = /** @type {HTMLButtonElement} */ (byId(`tool-${tool}`));
  return !button.hidden && !button.disabled;
}

export class WorldView {
  /**
   * @param {Connection} connection
   * @param {SystemModel} system
   * @param {WorldModel} world
   */
  constructor(connection, system, world) {
    this.connection = connection;
    this.world = world;
    this.canvas = /** @type {HTMLCanvasElement} */ (byId("map"));
    this.pen = /** @type {CanvasRenderingContext2D} */ (this.canvas.getContext("2d", { alpha: false }));
    this.camera = new Camera();
    this.palette = draw.readPalette();
    this.dots = 1;
    /** @type {Tool} */
    this.tool = "look";
    this.follows = false;
    /** Whether a person has moved the picture. */
    this.isTouched = false;
    this.lastFit = -Infinity;
    this.isShown = false;
    this.lastFrame = 0;
    this.frames = 0;
    this.owesFigures = false;
    /** @type {Map<number, Point>} pointers that are down, in pixels */
    this.pointers = new Map();
    /** @type {{from: Point, to: Point} | null} what a person pulls, in the world */
    this.pull = null;
    /** @type {{from: Point, to: Point} | null} */
    this.measured = null;
    /** @type {Point[]} points on the way to a goal that is not given yet */
    this.via = [];
    this.panel = new WorldPanel(connection, system, world);
    this.listen();
    new ResizeObserver(() => this.resize()).observe(this.canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.repaint());
    const frame = (/** @type {number} */ now) => {
      this.frame(now);
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }

  // ------------------------------------------------------------------------------------------------ what is shown

  /** @param {boolean} on */
  show(on) {
    this.isShown = on;
    this.world.watch(on && !document.hidden);
    if (on) this.resize();
  }

  repaint() {
    this.palette = draw.readPalette();
    this.world.stale = true;
  }

  resize() {
    const box = this.canvas.getBoundingClientRect();
    if (box.width === 0) return;
    this.dots = Math.min(2, devicePixelRatio);
    this.canvas.width = Math.round(box.width * this.dots);
    this.canvas.height = Math.round(box.height * this.dots);
    this.camera.width = box.width;
    this.camera.height = box.height;
    this.world.stale = true;
  }

  // ------------------------------------------------------------------------------------------------ a frame

  /** @param {number} now  [ms] */
  frame(now) {
    const seconds = Math.min(0.1, (now - this.lastFrame) / 1000);
    this.lastFrame = now;
    if (!this.isShown || document.hidden) return;
    this.ease(seconds);
    if (!this.world.stale) return this.finishFigures();
    this.world.stale = false;
    if (!this.isTouched && now - this.lastFit > FIT_AGAIN && this.panel.robot?.shown && !this.showsAll()) this.fit(now);
    if (this.follows && this.panel.robot?.shown) Object.assign(this.camera, { x: this.panel.robot.shown.x, y: this.panel.robot.shown.y });
    this.paint();
    this.frames += 1;
    this.owesFigures = this.frames % 6 !== 0;
    if (!this.owesFigures) this.panel.showFigures();
  }

  /** Shows the figures of the last picture, once it stands still. */
  finishFigures() {
    if (this.owesFigures) this.panel.showFigures();
    this.owesFigures = false;
  }

  /** @param {number} seconds  since the last frame */
  ease(seconds) {
    const share = 1 - Math.exp(-seconds / EASE);
    for (const robot of this.world.robots.values()) {
      if (robot.pose === null || robot.shown === robot.pose) continue;
      const jumps = robot.shown === null || Math.hypot(robot.pose.x - robot.shown.x, robot.pose.y - robot.shown.y) > 1;
      robot.shown = jumps || robot.shown === null ? robot.pose : between(robot.shown, robot.pose, share);
      const rest = Math.hypot(robot.pose.x - robot.shown.x, robot.pose.y - robot.shown.y) + Math.abs(robot.pose.yaw - robot.shown.yaw);
      if (rest < 1e-4) robot.shown = robot.pose;
      this.world.stale = true;
    }
  }

  paint() {
    const { pen, camera, palette, dots, world } = this;
    const pixel = 1 / camera.scale;
    const shows = (/** @type {string} */ layer) => !world.hidden.has(layer);
    /** @type {draw.Label[]} */
    const labels = [];
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.fillStyle = palette.floor;
    pen.fillRect(0, 0, this.canvas.width, this.canvas.height);
    draw.setMetres(pen, camera, dots);
    if (world.grid !== null && shows("map")) draw.drawGrid(pen, world.grid);
    const step = draw.drawRaster(pen, camera, palette);
    if (world.plan !== null && shows("world")) draw.drawPlan(pen, world.plan, pixel, palette, labels);
    if (world.scene !== null && shows("world")) draw.drawScene(pen, world.scene, pixel, palette, labels);
    if (shows("echoes")) draw.drawDots(pen, world.echoes.cells.values(), Math.max(0.05, 2 * pixel), palette.echo);
    draw.drawDots(pen, world.particles, Math.max(0.03, 2 * pixel), palette.particle);
    for (const robot of world.robots.values()) {
      if (shows("sonar")) draw.drawSonars(pen, robot, pixel, palette);
      if (shows("laser")) draw.drawScans(pen, robot, pixel, palette);
    }
    for (const robot of world.robots.values()) this.paintRobot(robot, labels, shows);
    draw.drawContacts(pen, world.contacts, pixel, palette);
    this.paintGoals(labels);
    this.paintPull(labels);
    draw.writeLabels(pen, camera, labels, dots, palette);
    this.canvas.dataset.view = `${camera.x} ${camera.y} ${camera.scale}`;  // for whoever measures in the picture, as tests do
    draw.drawScale(pen, camera, step, dots, palette);
    if (document.activeElement === this.canvas && this.tool === "drive") this.paintCross();
  }

  /**
   * @param {Robot} robot
   * @param {draw.Label[]} labels
   * @param {(layer: string) => boolean} shows
   */
  paintRobot(robot, labels, shows) {
    const { pen, palette } = this;
    const pixel = 1 / this.camera.scale;
    if (shows("trail")) draw.drawTrail(pen, robot, pixel, palette);
    if (shows("path")) draw.drawWay(pen, robot, pixel, palette, labels);
    draw.drawUncertainty(pen, robot, pixel, palette);
    draw.drawRobot(pen, robot, pixel, palette);
    if (shows("wishes")) draw.drawWishes(pen, robot, pixel, palette, labels);
    if (shows("motion")) draw.drawMotion(pen, robot, pixel, palette);
    const { shown, outline } = robot;
    if (shown !== null) labels.push({ x: shown.x + outline.radius + 10 * pixel, y: shown.y - outline.radius - 8 * pixel, text: robot.name, colour: palette.ink });
  }

  /**
   * Marks the goals that the graph names.
   * @param {draw.Label[]} labels
   */
  paintGoals(labels) {
    const pixel = 1 / this.camera.scale;
    const { goals } = this.panel.driver;
    draw.drawDots(this.pen, goals.map((goal) => goal.end), 8 * pixel, this.palette.muted);
    for (const { name, end } of goals) if (name !== this.panel.robot?.way?.name) labels.push({ x: end.x + 9 * pixel, y: end.y, text: name, colour: this.palette.muted });
  }

  /** @param {draw.Label[]} labels */
  paintPull(labels) {
    const pixel = 1 / this.camera.scale;
    for (const p of this.via) draw.drawDots(this.pen, [p], 9 * pixel, this.palette.goal);
    const line = this.pull ?? this.measured;
    if (line === null) return;
    const colour = this.tool === "measure" ? this.palette.ink : this.palette.goal;
    draw.drawPull(this.pen, line.from, line.to, pixel, colour);
    if (this.tool !== "measure") return;
    const [dx, dy] = [line.to.x - line.from.x, line.to.y - line.from.y];
    const degrees = (Math.atan2(dy, dx) * 180) / Math.PI;
    labels.push({ x: line.to.x + 12 * pixel, y: line.to.y + 12 * pixel, text: `${Math.hypot(dx, dy).toFixed(2)} m, ${degrees.toFixed(0)}°`, colour });
  }

  paintCross() {
    const { pen, camera } = this;
    const [x, y] = [camera.width / 2, camera.height / 2];
    pen.beginPath();
    pen.moveTo(x - 12, y);
    pen.lineTo(x + 12, y);
    pen.moveTo(x, y - 12);
    pen.lineTo(x, y + 12);
    pen.lineWidth = 2;
    pen.strokeStyle = this.palette.goal;
    pen.stroke();
  }

  get known() {
    return [...this.panel.driver.goals.map((goal) => goal.end), ...this.world.extent()];
  }

  showsAll() {
    return this.known.map((p) => this.camera.toScreen(p)).every(({ x, y }) => x >= 0 && y >= 0 && x <= this.camera.width - LABEL && y <= this.camera.height);
  }

  /**
   * Shows everything that is known.
   * @param {number} now  [ms]
   */
  fit(now) {
    const points = this.known;
    if (points.length === 0) return;
    const xs = points.map((p) => p.x);
    const ys = points.map((p) => p.y);
    this.camera.fit({ min: { x: Math.min(...xs), y: Math.min(...ys) }, max: { x: Math.max(...xs), y: Math.max(...ys) } });
    this.lastFit = now;
    this.world.stale = true;
  }

  // ------------------------------------------------------------------------------------------------ what a person does

  listen() {
    const { canvas } = this;
    canvas.addEventListener("pointerdown", (event) => this.press(event));
    canvas.addEventListener("pointermove", (event) => this.drag(event));
    canvas.addEventListener("pointerup", (event) => this.release(event));
    canvas.addEventListener("pointercancel", (event) => this.cancel(event));
    canvas.addEventListener("wheel", (event) => this.turnWheel(event), { passive: false });
    canvas.addEventListener("keydown", (event) => this.key(event));
    for (const change of ["focus", "blur"]) canvas.addEventListener(change, () => (this.world.stale = true));
    for (const tool of Object.values(TOOL_KEYS)) byId(`tool-${tool}`).addEventListener("click", () => this.take(tool));
    byId("follow").addEventListener("click", () => this.follow(!this.follows));
    byId("fit").addEventListener("click", () => this.fit(performance.now()));
    byId("closer").addEventListener("click", () => this.zoom(1.5));
    byId("farther").addEventListener("click", () => this.zoom(1 / 1.5));
    for (const box of /** @type {NodeListOf<HTMLInputElement>} */ (document.querySelectorAll("#layers input"))) {
      box.checked = !this.world.hidden.has(box.value);
      box.addEventListener("change", () => this.world.show(box.value, box.checked));
    }
    document.addEventListener("visibilitychange", () => this.show(this.isShown));
  }

  /** @param {Tool} tool */
  take(tool) {
    this.tool = tool;
    this.measured = null;
    this.via = [];
    for (const each of Object.values(TOOL_KEYS)) byId(`tool-${each}`).setAttribute("aria-pressed", String(each === tool));
    setText(byId("hint"), HINTS[tool]);
    this.canvas.dataset.tool = tool;
    this.world.stale = true;
  }

  /** @param {boolean} on */
  follow(on) {
    this.follows = on;
    this.isTouched ||= on;
    byId("follow").setAttribute("aria-pressed", String(on));
    this.world.stale = true;
  }

  /** @param {number} factor */
  zoom(factor) {
    this.isTouched = true;
    this.camera.zoom(factor, { x: this.camera.width / 2, y: this.camera.height / 2 });
    this.world.stale = true;
  }

  /**
   * @param {MouseEvent} event
   * @returns {Point} pixels
   */
  pixelOf(event) {
    const box = this.canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  /** @param {PointerEvent} event */
  press(event) {
    this.canvas.setPointerCapture(event.pointerId);
    this.isTouched = true;
    const pixel = this.pixelOf(event);
    this.pointers.set(event.pointerId, pixel);
    const at = this.camera.toWorld(pixel);
    const pulls = this.tool !== "look" && this.pointers.size === 1 && event.button === 0;
    this.pull = pulls ? { from: at, to: at } : null;
    this.world.stale = true;
  }

  /** @param {PointerEvent} event */
  drag(event) {
    const before = this.pointers.get(event.pointerId);
    if (before === undefined) return;
    const pixel = this.pixelOf(event);
    const other = [...this.pointers].find(([id]) => id !== event.pointerId)?.[1];
    if (this.pull !== null) {
      this.pull.to = this.camera.toWorld(pixel);
    } else if (other !== undefined) {
      const spread = Math.hypot(pixel.x - other.x, pixel.y - other.y) / Math.max(1, Math.hypot(before.x - other.x, before.y - other.y));
      this.camera.pan((pixel.x - before.x) / 2, (pixel.y - before.y) / 2);
      this.camera.zoom(spread, { x: (pixel.x + other.x) / 2, y: (pixel.y + other.y) / 2 });
    } else {
      this.follow(false);
      this.camera.pan(pixel.x - before.x, pixel.y - before.y);
    }
    this.pointers.set(event.pointerId, pixel);
    this.world.stale = true;
  }

  /** @param {PointerEvent} event */
  release(event) {
    const pull = this.pull;
    this.cancel(event);
    if (pull === null) return;
    const length = Math.hypot(pull.to.x - pull.from.x, pull.to.y - pull.from.y) * this.camera.scale;
    const yaw = length < LEAST_PULL ? null : Math.atan2(pull.to.y - pull.from.y, pull.to.x - pull.from.x);
    if (this.tool === "measure") this.measured = pull;
    else if (this.tool === "pose") this.putRobot(pull.from, yaw);
    else if (this.tool === "change") this.changeWorld(pull, event.shiftKey);
    else if (event.shiftKey && this.panel.driver.takesWays) this.via.push(pull.from);
    else this.driveTo(pull.from, yaw);
  }

  /** @param {PointerEvent} event */
  cancel(event) {
    this.pointers.delete(event.pointerId);
    this.pull = null;
    this.world.stale = true;
  }

  /** @param {WheelEvent} event */
  turnWheel(event) {
    event.preventDefault();
    this.isTouched = true;
    this.camera.zoom(Math.exp(-event.deltaY * (event.deltaMode === 1 ? 0.05 : 0.0015)), this.pixelOf(event));
    this.world.stale = true;
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    const key = event.key.toLowerCase();
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (key in TOOL_KEYS && isOffered(TOOL_KEYS[key])) this.take(TOOL_KEYS[key]);
    else if (key === "f") this.follow(!this.follows);
    else if (key === "0") this.fit(performance.now());
    else if (key === "+") this.zoom(1.25);
    else if (key === "-") this.zoom(0.8);
    else if (key === "enter" && this.tool === "drive") this.driveTo({ x: this.camera.x, y: this.camera.y }, null);
    else if (event.shiftKey && key.startsWith("arrow")) this.step(key);
  }

  /** @param {string} key */
  step(key) {
    this.isTouched = true;
    const sideways = { arrowleft: 60, arrowright: -60 }[key] ?? 0;
    const upwards = { arrowup: 60, arrowdown: -60 }[key] ?? 0;
    this.camera.pan(sideways, upwards);
    this.follow(false);
  }

  /**
   * @param {Point} place
   * @param {number | null} yaw
   */
  driveTo(place, yaw) {
    const robot = this.panel.robot;
    const points = [...this.via, place];
    this.via = [];
    if (robot !== undefined) robot.ordered = { ...place, yaw: yaw ?? Math.atan2(place.y - (robot.pose?.y ?? 0), place.x - (robot.pose?.x ?? 0)) };
    this.panel.order(this.panel.driver.driveTo(points, yaw), "").then((ok) => {
      if (!ok && robot !== undefined) robot.ordered = null;
    });
  }

  /**
   * @param {Point} place
   * @param {number | null} yaw
   */
  putRobot(place, yaw) {
    this.panel.order(this.panel.driver.setPose({ ...place, yaw: yaw ?? this.panel.robot?.pose?.yaw ?? 0 }), "The robot knows where it is.");
  }

  /**
   * @param {{from: Point, to: Point}} pull
   * @param {boolean} takes
   */
  changeWorld({ from, to }, takes) {
    const port = this.panel.changePort?.port;
    const xml = this.world.scene === null ? null : changeOf(this.world.scene, from, to, takes);
    if (port !== undefined && xml !== null) this.panel.order(this.connection.send(port, xml), "");
  }
}
