// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt

import { seconds } from "./world_model.js";

/**
 * From a sensor to the wheels: each object names the one that it answers, its cause. Following these back from a command that
 * reaches a base shows which way data have taken, and how old they were when they moved the wheels.
 *
 * @typedef {{key: string, name: string, cause: string, sensed: number}} Link  sensed: when the data were [s]
 * @typedef {{name: string, age: number}} Step  age when the command arrived [s]
 */

const REMEMBERED = 4000;
const LONGEST = 12;
const SAMPLES = 500;

/**
 * @param {any} object  with the header of each object
 * @returns {Link}
 */
export function linkOf(object) {
  const { origin, origin_port: port, seq, cause, creation_time, stamp } = object;
  return {
    key: `${origin}.${port} ${seq}`,
    name: `${origin}.${port}`,
    cause: cause.origin === "" ? "" : `${cause.origin}.${cause.port} ${cause.seq}`,
    sensed: seconds(stamp !== undefined && stamp.ns > 0 ? stamp : creation_time),
  };
}

/**
 * @param {number[]} sorted
 * @param {number} share  0 to 1
 * @returns {number} the value that this share of them does not exceed
 */
export function quantile(sorted, share) {
  return sorted[Math.max(0, Math.ceil(share * sorted.length) - 1)] ?? NaN;
}

/** The objects of the last seconds, by what they were caused by, and how long each way took. */
export class Causes {
  constructor() {
    /** @type {Map<string, Link>} */
    this.links = new Map();
    /** @type {Map<string, number[]>} ages [s] by way */
    this.ways = new Map();
  }

  /** @param {any} object */
  add(object) {
    const link = linkOf(object);
    this.links.delete(link.key);
    this.links.set(link.key, link);
    if (this.links.size > REMEMBERED) this.links.delete(/** @type {string} */ (this.links.keys().next().value));
  }

  /**
   * Follows an object back to where its causes begin.
   * @param {any} object  that arrived
   * @param {number} time  of its arrival [s]
   * @returns {Step[]} the first cause first; empty if a cause was not seen
   */
  arrive(object, time) {
    let link = linkOf(object);
    const steps = [{ name: link.name, age: time - link.sensed }];
    for (let i = 0; link.cause !== "" && i < LONGEST; ++i) {
      const before = this.links.get(link.cause);
      if (before === undefined) return [];
      steps.unshift({ name: before.name, age: time - before.sensed });
      link = before;
    }
    const way = steps.map((step) => step.name).join(" → ");
    const ages = this.ways.get(way) ?? [];
    ages.push(steps[0].age);
    if (ages.length > SAMPLES) ages.shift();
    this.ways.set(way, ages);
    return steps;
  }

  /** @returns {{way: string, count: number, p50: number, p99: number}[]} ages in seconds, the most frequent way first */
  summary() {
    const rows = [...this.ways].map(([way, ages]) => {
      const sorted = [...ages].sort((a, b) => a - b);
      return { way, count: ages.length, p50: quantile(sorted, 0.5), p99: quantile(sorted, 0.99) };
    });
    return rows.sort((a, b) => b.count - a.count);
  }
}
