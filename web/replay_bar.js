// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt

import { byId, notify, setText } from "./dom.js";

/**
 * The time of a recording that is played: play and pause, the moment, and the speed.
 *
 * @typedef {import("./connection.js").Connection} Connection
 * @typedef {{begin: number, end: number, now: number, speed: number, plays: boolean}} PlaybackState  times by the run's clock [s]
 */

const INTERVAL = 250;
const SEEK_INTERVAL = 150;
const DAY = 86400;

/** @param {number} time  since 1970, or since the beginning of a run in virtual time [s] @param {number} begin @returns {string} */
export function momentText(time, begin) {
  const since = `${(time - begin).toFixed(1)} s`;
  return begin < DAY ? since : `${new Date(1000 * time).toLocaleTimeString()} (${since})`;
}

export class ReplayBar {
  /** @param {Connection} connection */
  constructor(connection) {
    this.connection = connection;
    /** @type {PlaybackState | null} */
    this.state = null;
    this.isHeld = false;
    this.soughtAt = 0;
    this.bar = byId("replay");
    this.slider = /** @type {HTMLInputElement} */ (byId("replay-at"));
    this.speed = /** @type {HTMLSelectElement} */ (byId("replay-speed"));
    byId("replay-play").addEventListener("click", () => this.order(this.state?.plays ? "pause" : "play"));
    this.speed.addEventListener("change", () => this.order("speed", this.speed.value));
    this.slider.addEventListener("pointerdown", () => { this.isHeld = true; });
    this.slider.addEventListener("input", () => this.scrub());
    this.slider.addEventListener("change", () => {
      this.isHeld = false;
      this.seek();
    });
    connection.addEventListener("hello", () => this.poll());
    setInterval(() => this.poll(), INTERVAL);
  }

  get isShown() {
    return this.connection.hello?.recorded === true;
  }

  async poll() {
    if (this.bar.hidden === this.isShown) this.bar.hidden = !this.isShown;
    if (!this.isShown || document.hidden) return;
    await this.order();
  }

  /** Follows the slider while it is moved, but not more often than the pictures can follow. */
  scrub() {
    const now = performance.now();
    if (now - this.soughtAt < SEEK_INTERVAL) return;
    this.soughtAt = now;
    this.seek();
  }

  /** @returns {Promise<void>} */
  seek() {
    return this.order("seek", this.slider.value);
  }

  /** @param {...string} words */
  async order(...words) {
    const { ok, records, error } = await this.connection.ask("replay", ...words);
    if (!ok && words.length > 0) notify(error, "refused");
    if (ok) this.show(/** @type {any} */ (records[0]));
  }

  /** @param {PlaybackState} state */
  show(state) {
    this.state = state;
    if (!this.isHeld) {
      [this.slider.min, this.slider.max] = [String(state.begin), String(state.end)];
      this.slider.value = String(state.now);
    }
    setText(byId("replay-time"), momentText(state.now, state.begin));
    setText(byId("replay-play"), state.plays ? "Pause" : "Play");
    byId("replay-play").setAttribute("aria-pressed", String(state.plays));
    if (document.activeElement !== this.speed) this.speed.value = String(state.speed);
  }
}
