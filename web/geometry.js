// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt

/**
 * Poses in the plane, and the camera that shows the world on the screen. Lengths in metres, angles in radians,
 * counter-clockwise; X_AB is the pose of frame B in frame A. On the screen pixels count to the right and down.
 * @typedef {{x: number, y: number}} Point
 * @typedef {{x: number, y: number, yaw: number}} Pose
 */

/** @param {number} angle @returns {number} the same direction in (-pi, pi] */
export function wrap(angle) {
  const turned = angle - 2 * Math.PI * Math.floor((angle + Math.PI) / (2 * Math.PI));
  return turned === -Math.PI ? Math.PI : turned;
}

/** @param {Pose} X_AB @param {Point} p_B @returns {Point} the point in frame A */
export function transform(X_AB, p_B) {
  const c = Math.cos(X_AB.yaw);
  const s = Math.sin(X_AB.yaw);
  return { x: X_AB.x + c * p_B.x - s * p_B.y, y: X_AB.y + s * p_B.x + c * p_B.y };
}

/** @param {Pose} X_AB @param {Pose} X_BC @returns {Pose} X_AC */
export function compose(X_AB, X_BC) {
  return { ...transform(X_AB, X_BC), yaw: wrap(X_AB.yaw + X_BC.yaw) };
}

/** @param {Pose} a @param {Pose} b @param {number} share  0: a, 1: b @returns {Pose} */
export function between(a, b, share) {
  return { x: a.x + share * (b.x - a.x), y: a.y + share * (b.y - a.y), yaw: wrap(a.yaw + share * wrap(b.yaw - a.yaw)) };
}

/**
 * Returns the ellipse of a covariance: half its axes are `sigmas` standard deviations.
 * @param {ArrayLike<number>} covariance  3 x 3, row by row, of x, y, yaw
 * @param {number} sigmas
 * @returns {{major: number, minor: number, yaw: number, spread: number} | null} spread is that of the yaw; null: not known
 */
export function ellipse(covariance, sigmas) {
  const [xx, xy, yy] = [covariance[0], covariance[1], covariance[4]];
  if (!(xx > 0 || yy > 0)) return null;
  const middle = (xx + yy) / 2;
  const root = Math.hypot((xx - yy) / 2, xy);
  return {
    major: sigmas * Math.sqrt(Math.max(0, middle + root)),
    minor: sigmas * Math.sqrt(Math.max(0, middle - root)),
    yaw: Math.atan2(2 * xy, xx - yy) / 2,
    spread: sigmas * Math.sqrt(Math.max(0, covariance[8])),
  };
}

const HISTORY = 256;

/** The poses of a robot of the last seconds, so that readings are drawn from where they were taken. */
export class PoseHistory {
  constructor() {
    /** @type {{time: number, pose: Pose}[]} */
    this.entries = [];
  }

  /** @param {number} time [s] @param {Pose} pose */
  add(time, pose) {
    const last = this.entries.at(-1);
    if (last !== undefined && time <= last.time) {
      if (last.time - time < 1) return;
      this.entries = [];  // the clock, or the robot, began anew
    }
    this.entries.push({ time, pose });
    if (this.entries.length > HISTORY) this.entries.shift();
  }

  /** @param {number} time [s] @returns {Pose | null} the pose then, or the nearest known one; null: none is known */
  at(time) {
    const entries = this.entries;
    if (entries.length === 0) return null;
    let i = entries.length - 1;
    while (i > 0 && entries[i].time > time) --i;
    const before = entries[i];
    const after = entries[i + 1];
    if (after === undefined || time <= before.time) return before.pose;
    return between(before.pose, after.pose, (time - before.time) / (after.time - before.time));
  }
}

/** The part of the world that the screen shows. */
export class Camera {
  constructor() {
    /** Middle of the screen, in the world [m]. */
    this.x = 0;
    this.y = 0;
    /** Pixels per metre. */
    this.scale = 60;
    this.width = 1;
    this.height = 1;
  }

  /** @param {Point} p @returns {Point} pixels */
  toScreen(p) {
    return { x: this.width / 2 + (p.x - this.x) * this.scale, y: this.height / 2 - (p.y - this.y) * this.scale };
  }

  /** @param {Point} p  pixels @returns {Point} metres */
  toWorld(p) {
    return { x: this.x + (p.x - this.width / 2) / this.scale, y: this.y - (p.y - this.height / 2) / this.scale };
  }

  /**
   * Zooms so that the world under a pixel stays there.
   * @param {number} factor
   * @param {Point} pixel
   */
  zoom(factor, pixel) {
    const fixed = this.toWorld(pixel);
    this.scale = Math.min(2000, Math.max(2, this.scale * factor));
    const moved = this.toWorld(pixel);
    this.x += fixed.x - moved.x;
    this.y += fixed.y - moved.y;
  }

  /** @param {number} dx @param {number} dy  pixels */
  pan(dx, dy) {
    this.x -= dx / this.scale;
    this.y += dy / this.scale;
  }

  /**
   * Shows a rectangle of the world, with some room around it.
   * @param {{min: Point, max: Point}} box
   */
  fit(box) {
    const width = Math.max(2, box.max.x - box.min.x);
    const height = Math.max(2, box.max.y - box.min.y);
    this.x = (box.min.x + box.max.x) / 2;
    this.y = (box.min.y + box.max.y) / 2;
    this.scale = Math.min(160, 0.84 * Math.min(this.width / width, this.height / height));
  }
}
