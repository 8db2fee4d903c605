// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt

import { byId, el, notify, permit, setText } from "./dom.js";

/**
 * The time of a simulation: to let it stand, pass by steps, and pass faster or slower than the clock. It is hidden in real time.
 * @typedef {import("./connection.js").Connection} Connection
 * @typedef {import("./system_model.js").SystemModel} SystemModel
 */

const FAST = "fast";

/**
 * @param {number | null} pace  null: as fast as the machine can
 * @returns {string} as orcactl takes it
 */
export function paceWord(pace) {
  return pace === null ? FAST : String(pace);
}

export class Pacing {
  /**
   * @param {Connection} connection
   * @param {SystemModel} system
   */
  constructor(connection, system) {
    this.connection = connection;
    this.system = system;
    this.choice = /** @type {HTMLSelectElement} */ (byId("pace-factor"));
    byId("pace-pause").addEventListener("click", () => (system.pace?.paused ? this.order("pace", this.choice.value) : this.order("pause")));
    for (const button of /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll("[data-step]"))) {
      button.addEventListener("click", () => this.order("step", button.dataset.step ?? ""));
    }
    this.choice.addEventListener("change", () => {
      if (!system.pace?.paused) this.order("pace", this.choice.value);  // otherwise it counts when time goes on
    });
    for (const event of ["figures", "pace"]) system.addEventListener(event, () => this.show());
    for (const event of ["gone", "state"]) connection.addEventListener(event, () => this.show());
  }

  show() {
    const { pace } = this.system;
    byId("pacing").hidden = pace === null || this.connection.hello === null;
    if (pace === null) return;
    setText(byId("pace-time"), `${pace.time.toFixed(3)} s`);
    setText(byId("pace-pause"), pace.paused ? "Go on" : "Pause");
    byId("pace-orders").hidden = !this.connection.steers;
    permit(byId("pace-pause"), this.connection.refusal("pause"));
    permit(this.choice, this.connection.refusal("pace 1"));
    for (const button of /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll("[data-step]"))) permit(button, this.connection.refusal("step"));
    setText(byId("pace-state"), pace.paused ? "Time stands." : pace.pace === null ? "As fast as the machine can." : `${pace.pace} s of the simulation in a second.`);
    if (pace.paused || this.choice === document.activeElement) return;
    const word = paceWord(pace.pace);
    if (![...this.choice.options].some((option) => option.value === word)) this.choice.append(el("option", { value: word }, `${word} ×`));
    this.choice.value = word;
  }

  /**
   * @param {string} command
   * @param {...string} words
   */
  async order(command, ...words) {
    const { ok, records, error } = await this.connection.ask(command, ...words);
    if (ok) this.system.takePace(/** @type {any} */ (records[0]));
    else notify(error, "refused");
  }
}
