// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt

import { Connection } from "./connection.js";
import { ComponentView } from "./component_view.js";
import { askApply, askUndo } from "./dialogs.js";
import { byId, notify, permit, setText } from "./dom.js";
import { Inspector } from "./inspector.js";
import { Pacing } from "./pacing.js";
import { ReplayBar } from "./replay_bar.js";
import { SystemModel } from "./system_model.js";
import { SystemView } from "./system_view.js";
import { Teleoperation } from "./teleoperation.js";
import { TimeView } from "./time_view.js";
import { WorldModel } from "./world_model.js";
import { WorldView } from "./world_view.js";

/** @type {Record<string, string>} */
const WHAT_A_ROLE_MAY = {
  observe: "This address has the role observe: it looks, and gives no orders.",
  operate: "This address has the role operate: it steers the robot, and does not change its software.",
};

/** Puts the page together: the views behind the tabs, the state of the connection, and STOP. */

const token = new URLSearchParams(location.hash.slice(1)).get("token") ?? "";
const scheme = location.protocol === "https:" ? "wss" : "ws";
const connection = new Connection(`${scheme}://${location.host}/ws?token=${encodeURIComponent(token)}`);
const system = new SystemModel(connection);
const world = new WorldModel(connection, system);
const worldView = new WorldView(connection, system, world);
const systemView = new SystemView(connection, system);
const inspector = new Inspector(byId("inspector"), connection, system, (choice) => systemView.choose(choice));
systemView.addEventListener("chosen", () => {
  inspector.show(systemView.choice);
  systemView.keepInSight();
});
byId("graph-apply").addEventListener("click", () => askApply(connection, system));
byId("graph-undo").addEventListener("click", () => askUndo(connection, system));
system.addEventListener("figures", showUndo);
connection.addEventListener("gone", showUndo);
const teleoperation = new Teleoperation(connection, system);
new Pacing(connection, system);
new ReplayBar(connection);

/** @type {Record<string, {show(on: boolean): void}>} */
const views = { world: worldView, system: systemView, component: new ComponentView(connection, system), time: new TimeView(connection, system) };

/** @param {string} name */
function open(name) {
  for (const [each, view] of Object.entries(views)) {
    byId(`tab-${each}`).setAttribute("aria-selected", String(each === name));
    byId(`tab-${each}`).tabIndex = each === name ? 0 : -1;
    byId(`view-${each}`).hidden = each !== name;
    view.show(each === name);
  }
  sessionStorage.setItem("view", name);
}

function listenToTabs() {
  const names = Object.keys(views);
  names.forEach((name, i) => {
    byId(`tab-${name}`).addEventListener("click", (event) => {
      open(name);
      if (event.detail > 0) byId(`tab-${name}`).blur();  // a pointer was here: arrow keys are for driving
    });
    byId(`tab-${name}`).addEventListener("keydown", (event) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (step === undefined) return;
      const next = names[(i + step + names.length) % names.length];
      open(next);
      byId(`tab-${next}`).focus();
    });
  });
}

const SILENCE = 2200;  // [ms] without an answer to STOP; a deployer waits 2 s for other machines

/** Sends the stop before anything else is done. */
function stop() {
  const began = performance.now();
  const answer = connection.ask("estop");
  const silence = setTimeout(() => notify("STOP IS NOT CONFIRMED: what the system moves may go on; take the power from the motors. Nothing answers; "
    + "orcactl estop on the robot's machine says why.", "refused"), SILENCE);
  teleoperation.letGo();
  byId("stop").classList.add("pressed");
  answer.then(({ ok, error }) => {
    clearTimeout(silence);
    byId("stop").classList.remove("pressed");
    if (ok) notify(`All motors are held, confirmed after ${Math.round(performance.now() - began)} ms.`, "done");
    else notify(`STOP is not confirmed: ${error}`, "refused");
    system.poll();
  });
}

async function release() {
  const { ok, error } = await connection.ask("estop", "--release");
  if (!ok) notify(error, "refused");
  system.poll();
}

function listenToStop() {
  const button = byId("stop");
  button.addEventListener("pointerdown", stop);
  button.addEventListener("click", (event) => {
    if (event.detail === 0) stop();  // by keyboard: no pointer was down
  });
  addEventListener("keydown", (event) => {
    if (event.key !== "Escape" || event.repeat) return;
    if (connection.may("estop")) stop();
    /** @type {HTMLDialogElement} */ (byId("dialog")).close();
  }, { capture: true });
  byId("release").addEventListener("click", release);
}

function showState() {
  const link = byId("link");
  const { hello } = connection;
  const [state, text] = hello?.recorded ? ["good", "recording"] : hello !== null ? ["good", hello.role === "change" ? "live" : `live, ${hello.role}`]
    : connection.isOpen ? ["waiting", "waiting for a system"] : ["bad", "no connection"];
  link.className = `pill ${state}`;
  setText(link, text);
  setText(byId("system-name"), hello?.system ?? "");
  document.title = hello === null ? "Orca" : `${hello.system} – Orca`;
  byId("graph-apply").hidden = !connection.steers;
  permit(byId("graph-apply"), connection.refusal("apply"));
  byId("stop").hidden = hello?.recorded === true;
  permit(byId("stop"), hello === null ? "" : connection.refusal("estop"));
  byId("role").hidden = !connection.steers || connection.role === "change";
  setText(byId("role"), WHAT_A_ROLE_MAY[connection.role] ?? "");
  showUndo();
  showHold();
  byId("dropped").hidden = connection.dropped === 0;
  setText(byId("dropped"), `${connection.dropped} objects left out`);
}

function showUndo() {
  byId("graph-undo").hidden = system.graphBefore === "" || !connection.steers;
  permit(byId("graph-undo"), connection.refusal("apply"));
}

function showHold() {
  const alarm = system.alarms.find((each) => each.kind === "ESTOP" && each.active);
  byId("release").hidden = alarm === undefined || !connection.steers;
  permit(byId("release"), connection.refusal("estop"));
  byId("held").hidden = alarm === undefined;
  setText(byId("held"), alarm === undefined ? "" : `Motors held: ${alarm.text}`);
  document.body.classList.toggle("is-held", alarm !== undefined);
}

listenToTabs();
listenToStop();
for (const event of ["hello", "gone", "state", "figures"]) connection.addEventListener(event, showState);
system.addEventListener("figures", showHold);
const last = sessionStorage.getItem("view") ?? "";
open(last in views ? last : "world");
showState();
connection.open();
