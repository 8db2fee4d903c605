// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt

import { byId, el, notify } from "./dom.js";

/**
 * Questions that a person answers before an order is given: which code to take, which graph to apply.
 * @typedef {import("./connection.js").Connection} Connection
 * @typedef {import("./connection.js").Answer} Answer
 * @typedef {import("./system_model.js").SystemModel} SystemModel
 * @typedef {import("./system_model.js").Component} Component
 */

/**
 * Opens a dialog. The verdict on what was ordered stays in it until it is closed.
 * @param {string} title
 * @param {HTMLElement[]} content
 * @param {{label: string, order: (say: (...parts: (Node | string)[]) => void) => Promise<boolean>, isReady?: () => boolean}[]} orders
 *   an order returns whether it is done; one that is not ready cannot be given
 * @returns {{say: (...parts: (Node | string)[]) => void, enable: () => void}} to be used when something else has changed
 */
function ask(title, content, orders) {
  const dialog = /** @type {HTMLDialogElement} */ (byId("dialog"));
  const verdict = el("div", { class: "verdict", "aria-live": "polite" });
  const say = (/** @type {(Node | string)[]} */ ...parts) => verdict.replaceChildren(...parts);
  const enable = () => orders.forEach(({ isReady }, i) => {
    buttons[i].disabled = isReady !== undefined && !isReady();
  });
  const buttons = orders.map(({ label, order }) => {
    const button = el("button", { class: "primary", type: "button" }, label);
    button.addEventListener("click", async () => {
      for (const each of buttons) each.disabled = true;
      await order(say);
      enable();
    });
    return button;
  });
  const close = el("button", { type: "button", click: () => dialog.close() }, "Close");
  enable();
  dialog.oninput = enable;
  dialog.close();
  dialog.replaceChildren(el("h2", { id: "dialog-title" }, title), ...content, verdict, el("div", { class: "row end" }, ...buttons, close));
  dialog.show();  // not modal: STOP stays in reach
  dialog.querySelector("input")?.focus();
  return { say, enable };
}

/**
 * @param {Record<string, any>[]} rows
 * @returns {HTMLTableElement}
 */
export function tableOf(rows) {
  const names = [...new Set(rows.flatMap((row) => Object.keys(row)))].filter((name) => rows.some((row) => row[name] !== ""));
  return el(
    "table", { class: "rows" },
    el("thead", {}, el("tr", {}, ...names.map((name) => el("th", { scope: "col" }, name.replace(/_/g, " "))))),
    el("tbody", {}, ...rows.map((row) => el("tr", {}, ...names.map((name) => el("td", {}, String(row[name] ?? "")))))),
  );
}

/**
 * Exchanges the code of a component: chosen from what fits, tried out with its verdict shown, and only then put in its place.
 * @param {Connection} connection
 * @param {SystemModel} system
 * @param {Component} component
 */
export async function askSwap(connection, system, component) {
  const { name } = component;
  const file = el("input", { type: "text", id: "swap-file", value: component.plugin, spellcheck: "false", size: 60 });
  const type = el("input", { type: "text", id: "swap-type", value: component.type, spellcheck: "false" });
  const fresh = el("input", { type: "checkbox", id: "swap-fresh" });
  const untried = el("input", { type: "checkbox", id: "swap-untried" });
  const choice = el("select", { id: "swap-choice", disabled: true }, el("option", {}, "looking for what fits …"));
  const other = el("details", {}, el("summary", {}, "another file"), el("label", { for: "swap-file" }, "File on the robot's machine"), file, el("label", { for: "swap-type" }, "Type in it"), type);
  choice.addEventListener("input", () => {
    [file.value, type.value] = choice.value.split("\n");
  });
  const wanted = () => `${file.value}:${type.value}`;
  let tried = "";
  const attempt = async (/** @type {(...parts: (Node | string)[]) => void} */ say) => {
    say("It is tried out with what reaches the component now. That takes some seconds; nothing changes.");
    const code = wanted();
    const { ok, records, error } = await connection.ask("swap", name, code, "--only-try", ...(untried.checked ? ["--untried"] : []));
    tried = ok ? code : "";
    if (!ok) say(el("pre", { class: "bad" }, error));
    else say(el("p", { class: "good" }, verdictOf(name, records[0])));
    return ok;
  };
  const swap = async (/** @type {(...parts: (Node | string)[]) => void} */ say) => {
    say("It is tried out once more, then it takes over between two laps, then it is on probation. That takes some seconds.");
    const answer = await connection.ask("swap", name, wanted(), ...(fresh.checked ? ["--fresh"] : []), ...(untried.checked ? ["--untried"] : []));
    if (answer.ok) say(el("p", { class: "good" }, `${name} runs the code of ${file.value}.`), tableOf(answer.records), ...answer.notes.map((note) => el("p", {}, note)));
    else say(el("pre", { class: "bad" }, answer.error));
    await system.refresh();
    return answer.ok;
  };
  ask(`Exchange the code of ${name}`, [
    el("label", { for: "swap-choice" }, "Code whose ports fit"), choice, other,
    el("label", { class: "check" }, fresh, "begin without the old code's state"),
    el("label", { class: "check" }, untried, "take it even if it cannot be tried out"),
  ], [{ label: "Try", order: attempt }, { label: "Swap", order: swap, isReady: () => tried !== "" && tried === wanted() }]);
  const { ok, records, error } = await connection.ask("fits", name);
  if (!ok) choice.replaceChildren(el("option", {}, error));
  else choice.replaceChildren(...records.map((row) => el("option", { value: `${row.plugin}\n${row.type}`, selected: row.plugin === file.value && row.type === type.value }, `${row.type} of ${row.plugin}`)));
  choice.disabled = !ok || records.length === 0;
  other.open = choice.disabled;
}

/**
 * @param {string} name  of the component
 * @param {Record<string, any>} tried  what a trial has answered
 * @returns {string}
 */
function verdictOf(name, tried) {
  if (tried.untried !== "") return `It could not be tried out: ${tried.untried}`;
  return `${tried.type} can take the place of ${name}: it got ${tried.got} objects, pushed ${tried.pushed}, and did not fail.`;
}

/**
 * Shows what an answer to `diff` or `apply` says.
 * @param {(...parts: (Node | string)[]) => void} say
 * @param {Answer} answer
 * @param {string} title
 */
function sayChanges(say, answer, title) {
  if (!answer.ok) say(el("pre", { class: "bad" }, answer.error));
  else if (answer.records.length === 0) say("Nothing differs from what runs.");
  else say(el("p", { class: "good" }, title), tableOf(answer.records));
}

/**
 * Lets the system become another graph, and keeps what ran before.
 * @param {Connection} connection
 * @param {SystemModel} system
 * @param {() => Promise<Answer>} apply
 * @returns {Promise<Answer>}
 */
async function applied(connection, system, apply) {
  const before = await connection.askGraphThatRuns();
  const answer = await apply();
  if (answer.ok && answer.records.length > 0) system.graphBefore = before.ok ? before.text : "";
  if (answer.ok && !before.ok) notify(`There is no way back, since it could not be read what ran before: ${before.error}`, "refused");
  await system.refresh();
  return answer;
}

/**
 * Applies a graph file: first the difference, then the order.
 * @param {Connection} connection
 * @param {SystemModel} system
 */
export function askApply(connection, system) {
  const file = el("input", { type: "text", id: "apply-file", spellcheck: "false", size: 60, placeholder: "graphs/my.xml" });
  const own = el("input", { type: "file", id: "apply-own", accept: ".xml" });
  const askWith = async (/** @type {string} */ command) => {
    const chosen = own.files?.[0];
    return chosen === undefined ? connection.ask(command, file.value.trim()) : connection.askWithGraph(command, await chosen.text());
  };
  const isNamed = () => file.value.trim() !== "" || own.files?.[0] !== undefined;
  ask("Let the system become what a graph says", [
    el("label", { for: "apply-file" }, "Graph file on the deployer's machine"), file,
    el("label", { for: "apply-own" }, "or a file of this computer, whose paths are absolute"), own,
  ], [
    {
      label: "Compare", isReady: isNamed, order: async (say) => {
        say("It is compared …");
        const answer = await askWith("diff");
        sayChanges(say, answer, "This would change:");
        return answer.ok;
      },
    },
    {
      label: "Apply", isReady: isNamed, order: async (say) => {
        say("It is applied …");
        const answer = await applied(connection, system, () => askWith("apply"));
        sayChanges(say, answer, "This has changed. “Undo apply …” goes back to the graph that ran before:");
        return answer.ok;
      },
    },
  ]);
}

/**
 * Goes back to the graph that ran before another one was applied: first it shows what would change, or why that is not possible.
 * @param {Connection} connection
 * @param {SystemModel} system
 */
export async function askUndo(connection, system) {
  const before = system.graphBefore;
  let isPossible = false;
  const order = async (/** @type {(...parts: (Node | string)[]) => void} */ say) => {
    say("It goes back …");
    const answer = await applied(connection, system, () => connection.askWithGraph("apply", before));
    isPossible = !answer.ok;
    sayChanges(say, answer, "It has gone back. This has changed:");
    return answer.ok;
  };
  const { say, enable } = ask("Go back to the graph that ran before", [
    el("p", { class: "small" }, "With the values and types that it had then. What others have changed since goes back, too."),
  ], [{ label: "Go back", order, isReady: () => isPossible }]);
  say("It is compared with what runs …");
  const answer = await connection.askWithGraph("diff", before);
  isPossible = answer.ok && answer.records.length > 0;
  sayChanges(say, answer, "This would change:");
  if (!answer.ok) say(el("p", { class: "bad" }, "The system cannot go back:"), el("pre", { class: "bad" }, answer.error));
  enable();
}

/**
 * Gives an order and shows what becomes of it.
 * @param {Promise<Answer>} asked
 * @param {string} done
 * @returns {Promise<boolean>}
 */
export async function report(asked, done) {
  const { ok, error, notes } = await asked;
  notify(ok ? [done, ...notes].join("\n") : error, ok ? "done" : "refused");
  return ok;
}
