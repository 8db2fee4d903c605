// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt

import { byId, notify, setText } from "./dom.js";
import { motionXml } from "./drive.js";
import { componentOf } from "./system_model.js";

/**
 * Driving by hand: with arrow keys, the pad on the screen, or a gamepad. The dead man's switch is the key, pointer or button that
 * must be held: to let go, to leave the page, or to lose the connection is to stop.
 * @typedef {import("./connection.js").Connection} Connection
 * @typedef {import("./system_model.js").SystemModel} SystemModel
 */

const INTERVAL = 80;  // [ms], well below the dead man's time of Teleop
const HINT = "Hold the pad, an arrow key, or the right shoulder button of a gamepad. To let go is to stop.";
const DEAD_MAN_BUTTON = 5;  // right shoulder of a standard gamepad
/** @type {Record<string, {forward: number, left: number}>} */
const KEYS = {
  ArrowUp: { forward: 1, left: 0 },
  ArrowDown: { forward: -1, left: 0 },
  ArrowLeft: { forward: 0, left: 1 },
  ArrowRight: { forward: 0, left: -1 },
};

/**
 * @param {number} value
 * @returns {number} 0 in the middle of a stick, which is never exact
 */
function outsideMiddle(value) {
  return Math.abs(value) >= 0.12 ? Math.min(1, Math.max(-1, value)) : 0;
}

export class Teleoperation {
  /**
   * @param {Connection} connection
   * @param {SystemModel} system
   */
  constructor(connection, system) {
    this.connection = connection;
    this.system = system;
    /** @type {Set<string>} */
    this.keys = new Set();
    /** @type {{forward: number, left: number} | null} what the pad is pulled to, each in [-1, 1]; null: not held */
    this.pull = null;
    this.isDriving = false;
    this.isWaiting = false;
    /** Whether the gamepad's button has to be let go before it drives again. */
    this.isSpent = false;
    this.pad = byId("pad");
    this.listen();
    setInterval(() => this.turn(), INTERVAL);
  }

  /** The port that takes a person's commands; undefined: nobody can drive this robot by hand. */
  get port() {
    return this.system.servers("Send", "MotionCommand").find((port) => this.system.components.get(componentOf(port.port))?.type === "orca.Teleop");
  }

  listen() {
    addEventListener("keydown", (event) => {
      const target = /** @type {HTMLElement} */ (event.target);
      const isOther = event.shiftKey || event.ctrlKey || event.altKey || event.metaKey;  // Shift moves the picture
      if (!(event.key in KEYS) || isOther || !this.isSeen || target.matches("input, select, textarea, [role=tab], svg *")) return;
      event.preventDefault();
      if (!event.repeat) this.keys.add(event.key);  // a key that was let go by STOP has to be pressed again
    });
    addEventListener("keyup", (event) => this.keys.delete(event.key));
    const letGo = () => {
      this.letGo();
      this.turn();  // now: a page that is left is seldom let to compute
    };
    addEventListener("blur", letGo);
    document.addEventListener("visibilitychange", letGo);
    this.pad.addEventListener("pointerdown", (event) => {
      this.pad.setPointerCapture(event.pointerId);
      this.pullTo(event);
    });
    this.pad.addEventListener("pointermove", (event) => {
      if (this.pull !== null) this.pullTo(event);
    });
    for (const end of ["pointerup", "pointercancel", "lostpointercapture"]) this.pad.addEventListener(end, letGo);
  }

  /** Whether a person sees that this page drives by hand, and is at it. */
  get isSeen() {
    return this.port !== undefined && byId("teleoperation").offsetParent !== null && !document.hidden && document.hasFocus();
  }

  /** Ends whatever is held. A key or button that is still down drives no more before it was let go. */
  letGo() {
    this.keys.clear();
    this.pull = null;
    this.isSpent = true;
    this.showStick();
  }

  /** @param {PointerEvent} event */
  pullTo(event) {
    const box = this.pad.getBoundingClientRect();
    const clip = (/** @type {number} */ value) => Math.max(-1, Math.min(1, value));
    this.pull = {
      forward: clip(1 - (2 * (event.clientY - box.top)) / box.height),
      left: clip(1 - (2 * (event.clientX - box.left)) / box.width),
    };
    this.showStick();
  }

  /** @param {{forward: number, left: number} | null} [wish] */
  showStick(wish = this.pull) {
    const stick = byId("stick");
    const { forward, left } = wish ?? { forward: 0, left: 0 };
    stick.style.transform = `translate(${-38 * left}px, ${-38 * forward}px)`;
  }

  /** @returns {{forward: number, left: number} | null} null: nothing is held */
  wish() {
    if (!this.isSeen) this.letGo();
    if (this.pull !== null) return this.pull;
    if (this.keys.size > 0) {
      const pressed = [...this.keys].map((key) => KEYS[key]);
      return { forward: pressed.reduce((all, key) => all + key.forward, 0), left: pressed.reduce((all, key) => all + key.left, 0) };
    }
    const gamepad = (navigator.getGamepads?.() ?? []).find((each) => each?.connected === true && each.buttons[DEAD_MAN_BUTTON]?.pressed === true);
    if (!gamepad) this.isSpent = false;
    else if (!this.isSpent) return { forward: -outsideMiddle(gamepad.axes[1]), left: -outsideMiddle(gamepad.axes[0]) };
    return null;
  }

  turn() {
    const port = this.port;
    const refusal = this.connection.refusal("line");
    byId("teleoperation").hidden = port === undefined || !this.connection.steers;
    this.pad.classList.toggle("refused", refusal !== "");
    setText(byId("pad-hint"), refusal === "" ? HINT : refusal);
    const wish = port === undefined || !this.connection.may("line") ? null : this.wish();
    if (port === undefined || (wish === null && !this.isDriving)) return;
    this.isDriving = wish !== null;
    this.showStick(wish);
    this.send(port.port, wish ?? { forward: 0, left: 0 });
  }

  /**
   * Sends a command, and no other before it is answered, except a stop.
   * @param {string} port
   * @param {{forward: number, left: number}} wish
   */
  async send(port, wish) {
    if (this.isWaiting && this.isDriving) return;
    this.isWaiting = true;
    const { speed, turnRate } = this.limits(componentOf(port));
    const answer = await this.connection.send(port, motionXml(wish.forward * speed, wish.left * turnRate));
    this.isWaiting = false;
    if (answer.ok) return;
    this.letGo();
    notify(answer.error, "refused");
  }

  /** @param {string} component */
  limits(component) {
    const params = this.system.graph?.components?.find((/** @type {any} */ each) => each.name === component)?.params;
    return { speed: params?.speed ?? 0.3, turnRate: params?.turn_rate ?? 0.8 };
  }
}
