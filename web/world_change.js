// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt

import { xmlText } from "./dom.js";
import { transform } from "./geometry.js";

/**
 * Changes of a simulated world, by hand: things that come, move and go, doors that open and shut, a robot that is carried off, sensors
 * that fail.
 * @typedef {import("./geometry.js").Point} Point
 * @typedef {import("./geometry.js").Pose} Pose
 * @typedef {import("./world_model.js").Scene} Scene
 * @typedef {{kind: "obstacle" | "robot", name: string, pose: Pose} | {kind: "door", name: string, open: boolean}} Thing
 */

const NEAR = 0.3;  // [m] beside a thing at which a hand still takes it
const BOX = { length: 0.6, width: 0.4 };

/**
 * @param {string} kind  as in WorldChangeKind
 * @param {Record<string, string | number>} fields
 * @returns {string} a WorldChange
 */
export function changeXml(kind, fields) {
  const text = (/** @type {string | number} */ value) => (typeof value === "number" ? value.toFixed(3) : xmlText(value));
  return `<WorldChange kind="${kind}"${Object.entries(fields).map(([name, value]) => ` ${name}="${text(value)}"`).join("")}/>`;
}

/**
 * @param {Scene} scene
 * @returns {string} a name that no obstacle has
 */
export function freeName(scene) {
  const taken = new Set(scene.obstacles.map(({ name }) => name));
  let number = 1;
  while (taken.has(`box${number}`)) ++number;
  return `box${number}`;
}

/**
 * Returns what stands at a place, and a hand could take.
 * @param {Scene} scene
 * @param {Point} p
 * @returns {Thing | null}
 */
export function thingAt(scene, p) {
  /** @type {{thing: Thing, distance: number}[]} */
  const things = [
    ...scene.robots.map((each) => ({ thing: { kind: /** @type {const} */ ("robot"), name: each.name, pose: each }, distance: Math.hypot(each.x - p.x, each.y - p.y) - each.radius })),
    ...scene.doors.map((each) => ({ thing: { kind: /** @type {const} */ ("door"), name: each.name, open: each.open }, distance: distanceToEdge(each.leaf, p) })),
    ...scene.obstacles.filter((each) => each.movable).map((each) => ({ thing: { kind: /** @type {const} */ ("obstacle"), name: each.name, pose: each }, distance: distanceTo(each, p) })),
  ];
  things.sort((a, b) => a.distance - b.distance);
  return things.length > 0 && things[0].distance < NEAR ? things[0].thing : null;
}

/**
 * @param {import("./world_model.js").Obstacle} obstacle
 * @param {Point} p
 * @returns {number} [m] from the circle that holds it
 */
function distanceTo(obstacle, p) {
  const reach = Math.max(obstacle.radius, ...obstacle.outline.map(({ a }) => Math.hypot(a.x, a.y)));
  return Math.hypot(obstacle.x - p.x, obstacle.y - p.y) - reach;
}

/**
 * @param {import("./world_model.js").Edge} edge
 * @param {Point} p
 * @returns {number} [m]
 */
function distanceToEdge({ a, b }, p) {
  const [dx, dy] = [b.x - a.x, b.y - a.y];
  const along = Math.max(0, Math.min(1, ((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy)));
  return Math.hypot(a.x + along * dx - p.x, a.y + along * dy - p.y);
}

/**
 * Returns what a hand has done that pressed at one place and released at another one: on free floor it puts a box, a thing it moves,
 * and with Shift it takes it away; the leaf of a door it opens or shuts.
 * @param {Scene} scene
 * @param {Point} from
 * @param {Point} to
 * @param {boolean} takes
 * @returns {string | null} a WorldChange; null: nothing
 */
export function changeOf(scene, from, to, takes) {
  const thing = thingAt(scene, from);
  if (takes) return thing?.kind === "obstacle" ? changeXml("TAKE_OBSTACLE", { name: thing.name }) : null;
  if (thing?.kind === "door") return changeXml(thing.open ? "SHUT_DOOR" : "OPEN_DOOR", { name: thing.name });
  if (thing === null) {
    const yaw = Math.hypot(to.x - from.x, to.y - from.y) < 0.15 ? 0 : Math.atan2(to.y - from.y, to.x - from.x);
    return changeXml("PUT_OBSTACLE", { name: freeName(scene), x: from.x, y: from.y, yaw, ...BOX });
  }
  const grip = { x: from.x - thing.pose.x, y: from.y - thing.pose.y };
  const { x, y } = transform({ x: to.x, y: to.y, yaw: 0 }, { x: -grip.x, y: -grip.y });
  return changeXml(thing.kind === "robot" ? "CARRY_ROBOT" : "MOVE_OBSTACLE", { name: thing.name, x, y, yaw: thing.pose.yaw });
}
