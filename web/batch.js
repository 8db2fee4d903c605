// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt

import { tableOf } from "./dialogs.js";
import { byId, el, figure, notify, permit, setText } from "./dom.js";

/**
 * The page of a batch of simbatch (orcaview --batch): how far it is, its report, its failed runs.
 * @typedef {{run?: number, variant: string, world: string, seed: number, ending: string, failure: string, reason: string, time: number, command?: string}} Failed
 * @typedef {{name: string, runs: number, done: number, endings: Record<string, number>}} Variant
 * @typedef {{experiment?: string, runs?: number, done?: number, variants?: Variant[], failures?: number, failed?: Failed[], report: boolean, refusal: string,
 *   error: string, watched?: {name: string, address: string, said: string, ended: number}}} Status
 */

const INTERVAL = 2000;
const token = new URLSearchParams(location.hash.slice(1)).get("token") ?? "";

/**
 * @param {string} what  a path with its query
 * @returns {string} the same with the token
 */
function withToken(what) {
  return `/batch/${what}${what.includes("?") ? "&" : "?"}token=${encodeURIComponent(token)}`;
}

/** @param {Variant} variant @returns {Record<string, any>} a row */
function rowOf({ name, runs, done, endings }) {
  const successes = endings.success ?? 0;
  const others = Object.entries(endings).filter(([ending]) => ending !== "success").map(([ending, count]) => `${count} ${ending.replace(/_/g, " ")}`);
  return { variant: name, done: `${done} of ${runs}`, success: done === 0 ? "" : `${successes} (${figure((100 * successes) / done, 0)} %)`, others: others.join(", ") };
}

/**
 * @param {Failed} run
 * @param {string} refusal  why this page may not watch it; "": it may
 */
function failedRow(run, refusal) {
  const why = [run.ending, run.failure === run.ending ? "" : run.failure, run.reason].filter((word) => word !== "").join(", ").replace(/_/g, " ");
  const watch = el("button", { class: "small look", "data-run": run.run ?? "", click: () => order(run) }, "Watch");
  permit(watch, refusal);
  return el(
    "details", { class: "failed-run" },
    el("summary", {}, `${run.variant} in ${run.world}, seed ${run.seed}: ${why}`),
    run.command === undefined ? el("p", {}, "The experiment does not have this run any more.") : el("pre", {}, run.command),
    run.command === undefined ? null : watch,
  );
}

/** @param {Failed} run */
async function order(run) {
  const response = await fetch(withToken(`watch?run=${run.run}`), { method: "POST" });
  const { error } = await response.json();
  notify(error === "" ? "It begins; its page is named above in a moment." : error, error === "" ? "done" : "refused");
  if (error === "") await poll();
}

/** @param {Status} status */
function show(status) {
  const { experiment = "", runs = 0, done = 0, variants = [], failures = 0, failed = [] } = status;
  const link = byId("link");
  link.className = `pill ${status.error === "" ? "good" : "bad"}`;
  setText(link, status.error !== "" ? status.error : done === runs ? "complete" : "not complete");
  setText(byId("batch-name"), experiment);
  document.title = experiment === "" ? "Orca: a batch" : `${experiment} – Orca`;
  const progress = /** @type {HTMLProgressElement} */ (byId("batch-progress"));
  progress.max = Math.max(1, runs);
  progress.value = done;
  setText(byId("batch-done"), `${done} of ${runs} runs`);
  byId("batch-variants").replaceChildren(tableOf(variants.map(rowOf)));
  const report = /** @type {HTMLAnchorElement} */ (byId("batch-report"));
  report.hidden = !status.report;
  report.href = withToken("report.html");
  showFailed(failed, status.refusal);
  setText(byId("batch-more"), failures > failed.length ? `And ${failures - failed.length} more.` : failures === 0 ? "None so far." : "");
  showWatched(status.watched);
}

/**
 * Draws them anew only if there are others, so that one that is open stays so.
 * @param {Failed[]} failed
 * @param {string} refusal
 */
function showFailed(failed, refusal) {
  const list = byId("batch-failed");
  const shape = failed.map(({ run }) => run).join();
  if (list.dataset.shape === shape) return;
  list.dataset.shape = shape;
  list.replaceChildren(...failed.map((run) => failedRow(run, refusal)));
}

/** @param {Status["watched"]} watched */
function showWatched(watched) {
  byId("batch-watched").hidden = watched === undefined;
  if (watched === undefined) return;
  const page = /** @type {HTMLAnchorElement} */ (byId("watched-page"));
  setText(byId("watched-name"), watched.name);
  setText(byId("watched-state"), watched.ended < 0 ? (watched.address === "" ? "begins …" : "runs") : `has ended with ${watched.ended}`);
  page.hidden = watched.address === "" || watched.ended >= 0;
  page.href = watched.address;
  setText(byId("watched-said"), watched.said);
}

async function poll() {
  try {
    const response = await fetch(withToken("status"));
    if (!response.ok) throw new Error((await response.text()).trim());
    show(await response.json());
  } catch (error) {
    byId("link").className = "pill bad";
    setText(byId("link"), `orcaview does not answer: ${error instanceof Error ? error.message : error}`);
  }
}

poll();
setInterval(() => {
  if (!document.hidden) poll();
}, INTERVAL);
