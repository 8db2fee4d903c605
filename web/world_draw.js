// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt

import { ellipse, transform } from "./geometry.js";

/**
 * The parts of the picture of the world, each a function. All take a canvas whose unit is the metre, with y up, and the
 * width of a pixel [m].
 *
 * @typedef {CanvasRenderingContext2D} Pen
 * @typedef {import("./geometry.js").Point} Point
 * @typedef {import("./geometry.js").Pose} Pose
 * @typedef {import("./geometry.js").Camera} Camera
 * @typedef {import("./world_model.js").Robot} Robot
 * @typedef {import("./world_model.js").Wish} Wish
 * @typedef {Record<string, string>} Palette
 */

const COLOURS = [
  "floor", "grid", "ink", "muted", "wall", "robot", "robot-edge", "sonar", "sonar-edge", "laser", "laser-fill", "motion", "command", "wish", "path",
  "goal", "trail", "echo", "sure", "contact", "particle",
];
const TURN = 2 * Math.PI;
const LINE = 15;  // pixels from text to text
const EDGE = 3;  // pixels from a text to the right edge of the picture
const SECOND = 1;  // [s] of motion that arrows and arcs show

/** @returns {Palette} the colours of style.css, in the light or the dark */
export function readPalette() {
  const style = getComputedStyle(document.documentElement);
  return Object.fromEntries(COLOURS.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
}

/**
 * Sets the canvas to metres.
 * @param {Pen} pen
 * @param {Camera} camera
 * @param {number} dots  of the screen per pixel
 */
export function setMetres(pen, camera, dots) {
  const s = camera.scale * dots;
  pen.setTransform(s, 0, 0, -s, (camera.width / 2) * dots - camera.x * s, (camera.height / 2) * dots + camera.y * s);
}

/**
 * Draws lines at whole metres, or at as many as can be told apart.
 * @param {Pen} pen
 * @param {Camera} camera
 * @param {Palette} palette
 * @returns {number} distance of the lines [m]
 */
export function drawRaster(pen, camera, palette) {
  const step = [0.1, 0.5, 1, 5, 10, 50, 100].find((each) => each * camera.scale >= 32) ?? 500;
  const a = camera.toWorld({ x: 0, y: camera.height });
  const b = camera.toWorld({ x: camera.width, y: 0 });
  pen.beginPath();
  for (let x = Math.ceil(a.x / step) * step; x <= b.x; x += step) {
    pen.moveTo(x, a.y);
    pen.lineTo(x, b.y);
  }
  for (let y = Math.ceil(a.y / step) * step; y <= b.y; y += step) {
    pen.moveTo(a.x, y);
    pen.lineTo(b.x, y);
  }
  pen.lineWidth = 1 / camera.scale;
  pen.strokeStyle = palette.grid;
  pen.stroke();
  return step;
}

/**
 * @param {Pen} pen
 * @param {import("./world_model.js").Grid} grid
 */
export function drawGrid(pen, grid) {
  pen.save();
  pen.translate(grid.corner.x, grid.corner.y);
  pen.rotate(grid.corner.yaw);
  pen.imageSmoothingEnabled = false;
  pen.drawImage(grid.image, 0, 0, grid.columns * grid.resolution, grid.rows * grid.resolution);
  pen.restore();
}

/**
 * Draws the walls of a simulated world, and the names of its places.
 * @param {Pen} pen
 * @param {import("./world_model.js").Plan} plan
 * @param {number} pixel
 * @param {Palette} palette
 * @param {Label[]} labels
 */
export function drawPlan(pen, plan, pixel, palette, labels) {
  pen.lineWidth = 2 * pixel;
  pen.strokeStyle = palette.wall;
  pen.stroke(plan.walls);
  for (const { name, x, y } of plan.places) labels.push({ x, y, text: name, colour: palette.muted, isPlace: true });
}

/**
 * Draws what stands or walks about in a simulated world.
 * @param {Pen} pen
 * @param {import("./world_model.js").Scene} scene
 * @param {number} pixel
 * @param {Palette} palette
 * @param {Label[]} labels
 */
export function drawScene(pen, scene, pixel, palette, labels) {
  pen.lineWidth = 2 * pixel;
  for (const obstacle of scene.obstacles) {
    traceShape(pen, obstacle, obstacle.outline, obstacle.radius);
    pen.fillStyle = palette.grid;
    pen.fill();
    pen.strokeStyle = palette.wall;
    pen.stroke();
    if (obstacle.movable) labels.push({ x: obstacle.x + 8 * pixel, y: obstacle.y, text: obstacle.name, colour: palette.muted });
  }
  pen.strokeStyle = palette.wish;
  for (const { name, x, y, radius } of scene.people) {
    traceShape(pen, { x, y, yaw: 0 }, [], radius);
    pen.stroke();
    labels.push({ x: x + radius + 4 * pixel, y, text: name, colour: palette.wish });
  }
}

/**
 * @param {Pen} pen
 * @param {Pose} pose
 * @param {import("./world_model.js").Edge[]} outline  around the pose; empty: a circle
 * @param {number} radius
 */
function traceShape(pen, pose, outline, radius) {
  pen.beginPath();
  if (outline.length === 0) pen.arc(pose.x, pose.y, radius, 0, TURN);
  outline.map(({ a }) => transform(pose, a)).forEach((p, i) => (i === 0 ? pen.moveTo(p.x, p.y) : pen.lineTo(p.x, p.y)));
  pen.closePath();
}

/**
 * @param {Pen} pen
 * @param {Iterable<Point>} points
 * @param {number} size  [m]
 * @param {string} colour
 */
export function drawDots(pen, points, size, colour) {
  pen.fillStyle = colour;
  for (const { x, y } of points) pen.fillRect(x - size / 2, y - size / 2, size, size);
}

/**
 * @param {Pen} pen
 * @param {Point[]} points
 */
function trace(pen, points) {
  pen.beginPath();
  points.forEach((p, i) => (i === 0 ? pen.moveTo(p.x, p.y) : pen.lineTo(p.x, p.y)));
}

/**
 * @param {Pen} pen
 * @param {Robot} robot
 * @param {number} pixel
 * @param {Palette} palette
 */
export function drawTrail(pen, robot, pixel, palette) {
  trace(pen, robot.shown === null ? robot.trail : [...robot.trail, robot.shown]);
  pen.lineWidth = 2 * pixel;
  pen.strokeStyle = palette.trail;
  pen.stroke();
}

/**
 * @param {Pen} pen
 * @param {Robot} robot
 * @param {number} pixel
 * @param {Palette} palette
 */
export function drawSonars(pen, robot, pixel, palette) {
  pen.lineWidth = pixel;
  for (const cones of robot.sonars.values()) {
    pen.beginPath();
    for (const cone of cones) if (cone.echo) wedge(pen, cone);
    pen.fillStyle = palette.sonar;
    pen.fill();
    pen.strokeStyle = palette["sonar-edge"];
    pen.stroke();
    pen.beginPath();  // the arc that the echo comes from
    for (const { pose, range, halfLobe, echo } of cones) {
      if (!echo) continue;
      pen.moveTo(pose.x + range * Math.cos(pose.yaw - halfLobe), pose.y + range * Math.sin(pose.yaw - halfLobe));
      pen.arc(pose.x, pose.y, range, pose.yaw - halfLobe, pose.yaw + halfLobe);
    }
    pen.lineWidth = 2.5 * pixel;
    pen.stroke();
    pen.lineWidth = pixel;
    pen.beginPath();
    for (const cone of cones) if (!cone.echo) wedge(pen, { ...cone, range: 0.4 });
    pen.setLineDash([3 * pixel, 3 * pixel]);
    pen.stroke();
    pen.setLineDash([]);
  }
}

/**
 * @param {Pen} pen
 * @param {{pose: Pose, range: number, halfLobe: number}} cone
 */
function wedge(pen, { pose, range, halfLobe }) {
  pen.moveTo(pose.x, pose.y);
  pen.arc(pose.x, pose.y, range, pose.yaw - halfLobe, pose.yaw + halfLobe);
  pen.closePath();
}

/**
 * @param {Pen} pen
 * @param {Robot} robot
 * @param {number} pixel
 * @param {Palette} palette
 */
export function drawScans(pen, robot, pixel, palette) {
  const size = Math.max(3 * pixel, 0.03);
  for (const { origin, points, hits } of robot.scans.values()) {
    pen.beginPath();
    pen.moveTo(origin.x, origin.y);
    for (let i = 0; i < points.length; i += 2) pen.lineTo(points[i], points[i + 1]);
    pen.closePath();
    pen.fillStyle = palette["laser-fill"];
    pen.fill();
    pen.fillStyle = palette.laser;
    for (let i = 0; i < hits.length; ++i) {
      if (hits[i] !== 0) pen.fillRect(points[2 * i] - size / 2, points[2 * i + 1] - size / 2, size, size);
    }
  }
}

/**
 * @param {Pen} pen
 * @param {Pose} pose
 * @param {Robot["outline"]} outline
 */
function traceBody(pen, pose, outline) {
  const { radius, length, width } = outline;
  if (!(length > 0 && width > 0)) {
    pen.beginPath();
    pen.arc(pose.x, pose.y, radius, 0, TURN);
    return;
  }
  trace(pen, [[1, 1], [-1, 1], [-1, -1], [1, -1]].map(([a, b]) => transform(pose, { x: (a * length) / 2, y: (b * width) / 2 })));
  pen.closePath();
}

/**
 * @param {Pen} pen
 * @param {Robot} robot
 * @param {number} pixel
 * @param {Palette} palette
 */
export function drawRobot(pen, robot, pixel, palette) {
  for (const pose of robot.others.values()) drawGhost(pen, pose, robot.outline, pixel, palette.muted);
  const { shown: pose, truth } = robot;
  if (truth !== null && pose !== null && Math.hypot(truth.x - pose.x, truth.y - pose.y) > 0.1) {
    traceShape(pen, truth, truth.outline, truth.radius);
    pen.lineWidth = 1.5 * pixel;
    pen.strokeStyle = palette.wall;
    pen.stroke();
  }
  if (pose === null) return;
  if (truth !== null && truth.outline.length > 0) traceShape(pen, pose, truth.outline, truth.radius);
  else traceBody(pen, pose, robot.outline);
  pen.fillStyle = palette.robot;
  pen.fill();
  pen.lineWidth = Math.max(2 * pixel, 0.015);
  pen.strokeStyle = palette["robot-edge"];
  pen.stroke();
  drawNose(pen, pose, robot.outline, palette["robot-edge"]);
}

/**
 * @param {Pen} pen
 * @param {Pose} pose
 * @param {Robot["outline"]} outline
 * @param {string} colour
 */
function drawNose(pen, pose, outline, colour) {
  const front = outline.length > 0 ? outline.length / 2 : outline.radius;
  const side = 0.45 * (outline.width > 0 ? outline.width / 2 : outline.radius);
  trace(pen, [{ x: front * 0.88, y: 0 }, { x: front * 0.4, y: side }, { x: front * 0.4, y: -side }].map((p) => transform(pose, p)));
  pen.closePath();
  pen.fillStyle = colour;
  pen.fill();
}

/**
 * Draws where a robot could be: the outline only.
 * @param {Pen} pen
 * @param {Pose} pose
 * @param {Robot["outline"]} outline
 * @param {number} pixel
 * @param {string} colour
 */
export function drawGhost(pen, pose, outline, pixel, colour) {
  traceBody(pen, pose, outline);
  pen.lineWidth = 1.5 * pixel;
  pen.strokeStyle = colour;
  pen.setLineDash([5 * pixel, 4 * pixel]);
  pen.stroke();
  pen.setLineDash([]);
  drawNose(pen, pose, outline, colour);
}

/**
 * Draws two standard deviations of the position, and of the direction.
 * @param {Pen} pen
 * @param {Robot} robot
 * @param {number} pixel
 * @param {Palette} palette
 */
export function drawUncertainty(pen, robot, pixel, palette) {
  const sure = robot.covariance === null ? null : ellipse(robot.covariance, 2);
  if (sure === null || robot.shown === null) return;
  const { x, y, yaw } = robot.shown;
  pen.lineWidth = 1.5 * pixel;
  pen.strokeStyle = palette.sure;
  pen.beginPath();
  pen.ellipse(x, y, sure.major, sure.minor, sure.yaw, 0, TURN);
  pen.stroke();
  const spread = Math.min(sure.spread, Math.PI);
  pen.beginPath();
  pen.moveTo(x, y);
  pen.arc(x, y, 3 * robot.outline.radius, yaw - spread, yaw + spread);
  pen.closePath();
  pen.globalAlpha = 0.18;
  pen.fillStyle = palette.sure;
  pen.fill();
  pen.globalAlpha = 1;
}

/**
 * @param {Pen} pen
 * @param {Point} from
 * @param {Point} to
 * @param {number} head  [m]
 */
function traceArrow(pen, from, to, head) {
  const yaw = Math.atan2(to.y - from.y, to.x - from.x);
  pen.beginPath();
  pen.moveTo(from.x, from.y);
  pen.lineTo(to.x, to.y);
  for (const side of [-2.6, 2.6]) {
    pen.moveTo(to.x, to.y);
    pen.lineTo(to.x + head * Math.cos(yaw + side), to.y + head * Math.sin(yaw + side));
  }
}

/**
 * Draws the speed as an arrow as long as the way of a second, and the turn rate as an arc as wide as the turn of a second.
 * @param {Pen} pen
 * @param {Pose} pose
 * @param {number} radius  of the arc [m]
 * @param {{forward: number, left: number, turnRate: number}} motion
 * @param {number} pixel
 */
function strokeMotion(pen, pose, radius, motion, pixel) {
  if (Math.hypot(motion.forward, motion.left) > 0.005) {
    const length = Math.hypot(motion.forward, motion.left) * SECOND;
    traceArrow(pen, pose, transform(pose, { x: motion.forward * SECOND, y: motion.left * SECOND }), Math.min(0.6 * length, Math.max(9 * pixel, 0.06)));
    pen.stroke();
  }
  if (Math.abs(motion.turnRate) < 0.01) return;
  const turn = Math.max(-0.95 * TURN, Math.min(0.95 * TURN, motion.turnRate * SECOND));
  const end = pose.yaw + turn;
  const tip = { x: pose.x + radius * Math.cos(end), y: pose.y + radius * Math.sin(end) };
  pen.beginPath();
  pen.arc(pose.x, pose.y, radius, pose.yaw, end, turn < 0);
  pen.stroke();
  const forward = end + (Math.PI / 2) * Math.sign(turn);
  pen.beginPath();
  for (const side of [-2.5, 2.5]) {
    pen.moveTo(tip.x, tip.y);
    pen.lineTo(tip.x + 8 * pixel * Math.cos(forward + side), tip.y + 8 * pixel * Math.sin(forward + side));
  }
  pen.stroke();
}

/**
 * Draws the actual motion in red, and what is commanded beside it, dashed (thesis Fig. 11.11).
 * @param {Pen} pen
 * @param {Robot} robot
 * @param {number} pixel
 * @param {Palette} palette
 */
export function drawMotion(pen, robot, pixel, palette) {
  if (robot.shown === null) return;
  const radius = robot.outline.radius * 1.35 + 4 * pixel;
  if (robot.command !== null) {
    pen.lineWidth = 2 * pixel;
    pen.strokeStyle = palette.command;
    pen.setLineDash([5 * pixel, 4 * pixel]);
    strokeMotion(pen, { ...robot.shown, yaw: robot.shown.yaw }, radius + 7 * pixel, commanded(robot.command), pixel);
    pen.setLineDash([]);
  }
  pen.lineWidth = 3.5 * pixel;
  pen.strokeStyle = palette.motion;
  strokeMotion(pen, robot.shown, radius, robot.motion, pixel);
}

/**
 * @param {Wish} wish
 * @returns {{forward: number, left: number, turnRate: number}}
 */
function commanded(wish) {
  if (wish.stops || wish.silent) return { forward: 0, left: 0, turnRate: 0 };
  return { forward: wish.speed * Math.cos(wish.direction), left: wish.speed * Math.sin(wish.direction), turnRate: wish.turnRate };
}

/**
 * Draws what each behaviour wishes, with its name.
 * @param {Pen} pen
 * @param {Robot} robot
 * @param {number} pixel
 * @param {Palette} palette
 * @param {Label[]} labels
 */
export function drawWishes(pen, robot, pixel, palette, labels) {
  const pose = robot.shown;
  if (pose === null) return;
  pen.strokeStyle = palette.wish;
  pen.lineWidth = 1.5 * pixel;
  for (const [component, wish] of robot.wishes) {
    if (wish.silent) continue;
    const motion = commanded(wish);
    strokeMotion(pen, pose, robot.outline.radius * 1.8, motion, pixel);
    const tip = transform(pose, { x: motion.forward, y: motion.left });
    labels.push({ ...tip, text: wish.stops ? `${component}: stop` : component, colour: palette.wish });
  }
}

/** @typedef {{x: number, y: number, text: string, colour: string, isPlace?: boolean}} Label  text beside a place */

/**
 * Draws the way that is left, and the goal with its name.
 * @param {Pen} pen
 * @param {Robot} robot
 * @param {number} pixel
 * @param {Palette} palette
 * @param {Label[]} labels
 */
export function drawWay(pen, robot, pixel, palette, labels) {
  const end = robot.way?.points.at(-1) ?? null;
  if (robot.way !== null && robot.shown !== null) {
    trace(pen, [robot.shown, ...robot.way.points.slice(1)]);
    pen.lineWidth = 2.5 * pixel;
    pen.strokeStyle = palette.path;
    pen.setLineDash([8 * pixel, 5 * pixel]);
    pen.stroke();
    pen.setLineDash([]);
    pen.fillStyle = palette.path;
    for (const p of robot.way.points.slice(1, -1)) {
      pen.beginPath();
      pen.arc(p.x, p.y, 4 * pixel, 0, TURN);
      pen.fill();
    }
  }
  if (end !== null && robot.way !== null) {
    const goal = robot.goal !== null && Math.hypot(robot.goal.x - end.x, robot.goal.y - end.y) < 0.01 ? robot.goal : null;
    drawFlag(pen, end, pixel, palette.goal);
    if (goal !== null) drawReach(pen, goal, pixel, palette.goal);
    labels.push({ x: end.x + 16 * pixel, y: end.y + 14 * pixel, text: robot.way.name.replace(/^place_\d+$/, ""), colour: palette.goal });
  }
  if (robot.ordered !== null) drawGhost(pen, robot.ordered, robot.outline, pixel, palette.goal);
}

/**
 * @param {Pen} pen
 * @param {Point} p
 * @param {number} pixel
 * @param {string} colour
 */
function drawFlag(pen, { x, y }, pixel, colour) {
  pen.beginPath();
  pen.moveTo(x, y);
  pen.lineTo(x, y + 24 * pixel);
  pen.lineTo(x + 14 * pixel, y + 18 * pixel);
  pen.lineTo(x, y + 12 * pixel);
  pen.lineWidth = 2 * pixel;
  pen.strokeStyle = colour;
  pen.fillStyle = colour;
  pen.fill();
  pen.stroke();
}

/**
 * @param {Pen} pen
 * @param {import("./world_model.js").Goal} goal
 * @param {number} pixel
 * @param {string} colour
 */
function drawReach(pen, goal, pixel, colour) {
  pen.lineWidth = 1.5 * pixel;
  pen.strokeStyle = colour;
  pen.beginPath();
  pen.arc(goal.x, goal.y, goal.radius, 0, TURN);
  pen.stroke();
  if (goal.yaw === null) return;
  traceArrow(pen, goal, transform({ x: goal.x, y: goal.y, yaw: goal.yaw }, { x: 0.45, y: 0 }), 8 * pixel);
  pen.stroke();
}

/**
 * @param {Pen} pen
 * @param {Point[]} contacts
 * @param {number} pixel
 * @param {Palette} palette
 */
export function drawContacts(pen, contacts, pixel, palette) {
  pen.lineWidth = 3 * pixel;
  pen.strokeStyle = palette.contact;
  pen.beginPath();
  for (const { x, y } of contacts) {
    for (const side of [1, -1]) {
      pen.moveTo(x - 7 * pixel, y - 7 * side * pixel);
      pen.lineTo(x + 7 * pixel, y + 7 * side * pixel);
    }
  }
  pen.stroke();
}

/**
 * Draws an arrow that a person pulls, or a measured distance.
 * @param {Pen} pen
 * @param {Point} from
 * @param {Point} to
 * @param {number} pixel
 * @param {string} colour
 */
export function drawPull(pen, from, to, pixel, colour) {
  pen.lineWidth = 2.5 * pixel;
  pen.strokeStyle = colour;
  traceArrow(pen, from, to, 10 * pixel);
  pen.stroke();
  pen.beginPath();
  pen.arc(from.x, from.y, 4 * pixel, 0, TURN);
  pen.fillStyle = colour;
  pen.fill();
}

/**
 * Writes texts, in pixels, with a rim that keeps them readable on everything. Of two in one place the one is written that came first,
 * and names of places only where nothing else is.
 * @param {Pen} pen
 * @param {Camera} camera
 * @param {Label[]} labels
 * @param {number} dots
 * @param {Palette} palette
 */
export function writeLabels(pen, camera, labels, dots, palette) {
  pen.setTransform(dots, 0, 0, dots, 0, 0);
  pen.textBaseline = "middle";
  pen.lineJoin = "round";
  pen.lineWidth = 4;
  pen.strokeStyle = palette.floor;
  /** @type {{left: number, right: number, y: number}[]} */
  const written = [];
  for (const label of [...labels.filter((each) => !each.isPlace), ...labels.filter((each) => each.isPlace)]) {
    pen.font = label.isPlace ? "11px system-ui, sans-serif" : "600 13px system-ui, sans-serif";
    const { x: at, y } = camera.toScreen(label);
    const { width } = pen.measureText(label.text);
    const x = at < camera.width ? Math.min(at, camera.width - width - EDGE) : at;
    const right = x + width;
    if (written.some((other) => Math.abs(other.y - y) < LINE && other.left < right && x < other.right)) continue;
    written.push({ left: x, right, y });
    pen.strokeText(label.text, x, y);
    pen.fillStyle = label.colour;
    pen.fillText(label.text, x, y);
  }
}

/**
 * Draws how long a metre is, in the lower right corner.
 * @param {Pen} pen
 * @param {Camera} camera
 * @param {number} step  [m]
 * @param {number} dots
 * @param {Palette} palette
 */
export function drawScale(pen, camera, step, dots, palette) {
  pen.setTransform(dots, 0, 0, dots, 0, 0);
  const right = camera.width - 16;
  const bottom = camera.height - 14;
  pen.lineWidth = 2;
  pen.strokeStyle = palette.muted;
  pen.beginPath();
  pen.moveTo(right - step * camera.scale, bottom - 5);
  pen.lineTo(right - step * camera.scale, bottom);
  pen.lineTo(right, bottom);
  pen.lineTo(right, bottom - 5);
  pen.stroke();
  pen.font = "12px system-ui, sans-serif";
  pen.textBaseline = "alphabetic";
  pen.fillStyle = palette.muted;
  pen.textAlign = "right";
  pen.fillText(`${step} m`, right, bottom - 8);
  pen.textAlign = "left";
}
