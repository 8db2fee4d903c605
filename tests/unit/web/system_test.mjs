// SPDX-License-Identifier: GPL-3.0-or-later
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { createRequire } from "node:module";
import test from "node:test";

import { Causes, quantile } from "../../../web/causes.js";
import { policyOf } from "../../../web/inspector.js";
import { csvOf, mergedRows } from "../../../web/plots.js";
import { arrange, curve, detour, frameOf, misfit, planOf, portPlace } from "../../../web/system_layout.js";
import { componentOf, flowOf, rowKey } from "../../../web/system_model.js";
import { flowText, milliseconds } from "../../../web/system_view.js";

const DAGRE = "/usr/share/nodejs/dagre/dist/dagre.min.js";

const port = (name, pattern, role, type, more = {}) =>
  ({ port: name, pattern, role, type, required: false, disabled: false, connected_to: [], text: "", process: "p", ...more });
const component = (name, process) => ({ name, process, type: "orca.X", state: "WORK" });
const isA = (type, wanted) => type === wanted || (type === "Door" && wanted === "GoalPoint");

test("a port belongs to the component before its last point", () => {
  assert.equal(componentOf("dewey/base.OdometryPush"), "dewey/base");
});

test("ports fit by pattern, direction and type, as the deployer's checker sees it", () => {
  const out = port("a.GoalPush", "Push", "Server", "Door");
  const into = port("b.goal", "Push", "Proxy", "GoalPoint");
  assert.equal(misfit(out, into, isA), "");
  assert.match(misfit(into, out, isA), /output on the right/);
  assert.match(misfit(out, port("b.x", "Push", "Proxy", "Path"), isA), /Door is no Path/);
  assert.match(misfit(out, port("b.x", "Send", "Server", "Door"), isA), /Push does not go to Send/);
  assert.match(misfit({ ...out, connected_to: ["b.goal"] }, into, isA), /already/);
  const question = port("a.map", "Query", "Proxy", "Ask", { reply: "GoalPoint" });
  assert.equal(misfit(question, port("b.q", "Query", "Server", "Ask", { reply: "Door" }), isA), "");
  assert.match(misfit(question, port("b.q", "Query", "Server", "Ask", { reply: "Path" }), isA), /reply Path is no GoalPoint/);
});

test("figures of a connection are rates since the last look", () => {
  const before = { from: "a.x", to: "b.y", delivered: 100, dropped: 3 };
  const now = { from: "a.x", to: "b.y", delivered: 120, dropped: 5, queued: 2, late: 1 };
  assert.deepEqual(flowOf(now, before, 2), { total: 120, lost: 5, rate: 10, lossRate: 1, queued: 2, late: 1, age50: null, age99: null });
  assert.equal(flowOf({ ...now, age_p50_ms: 0.12, age_p99_ms: 0.4 }, before, 2).age99, 0.4);
  assert.equal(flowOf(now, undefined, 2).rate, 0);
  assert.equal(flowOf({ ...now, delivered: 0 }, before, 2).rate, 0, "a process that was started again counts from 0");
  assert.equal(rowKey(now), "a.x>b.y");
  assert.equal(rowKey({ client: "a.x", sent: 1 }), "a.x");
});

test("a queue of one that keeps the newest loses nothing", () => {
  const flow = { rate: 20, lossRate: 5, total: 0, lost: 0, queued: 0, late: 0, age50: null, age99: null };
  assert.deepEqual(flowText({ from: "a", to: "b", pattern: "Push", queue: "1", overflow: "drop_oldest" }, flow), { text: "20/s", loses: false });
  assert.deepEqual(flowText({ from: "a", to: "b", pattern: "Push", queue: "16", overflow: "refuse" }, flow), { text: "20/s lost 5/s", loses: true });
});

test("a connection shows how old its objects are when they arrive", () => {
  const flow = { rate: 20, lossRate: 0, total: 0, lost: 0, queued: 2, late: 0, age50: 0.1, age99: 0.25 };
  assert.equal(flowText({ from: "a", to: "b", pattern: "Push", queue: "16" }, flow).text, "20/s 0.25 ms 2 wait");
  assert.equal(flowText({ from: "a", to: "b", pattern: "Push", queue: "16" }, { ...flow, rate: 0 }).text, " 2 wait");
  assert.deepEqual([milliseconds(null), milliseconds(0.123), milliseconds(4.56), milliseconds(123.4)], ["–", "0.12 ms", "4.6 ms", "123 ms"]);
});

test("a removed connection is made again with its policy", () => {
  assert.deepEqual(policyOf({ from: "a.x", to: "b.y", pattern: "Push", link: "shm", queue: "4", overflow: "drop_oldest" }), ["queue=4", "overflow=drop_oldest"]);
});

function smallPlan() {
  const ports = [
    port("sensor.Push", "Push", "Server", "T", { connected_to: ["brain.in"] }), port("brain.in", "Push", "Proxy", "T", { connected_to: ["sensor.Push"] }),
    port("brain.wheels", "Send", "Proxy", "M", { connected_to: ["sensor.MotionSend"] }), port("sensor.MotionSend", "Send", "Server", "M", { connected_to: ["brain.wheels"] }),
    port("brain.free", "Push", "Server", "T"),
  ];
  const wires = [{ from: "sensor.Push", to: "brain.in", pattern: "Push" }, { from: "brain.wheels", to: "sensor.MotionSend", pattern: "Send" }];
  return [[component("sensor", "one"), { ...component("brain", "two"), machine: "m" }], ports, wires];
}

test("the plan of a graph has a box for each component, and free ports on demand", () => {
  const few = planOf(...smallPlan(), false);
  assert.deepEqual(few.boxes.map(({ name, inputs, outputs }) => [name, inputs, outputs]), [["sensor", ["sensor.MotionSend"], ["sensor.Push"]], ["brain", ["brain.in"], ["brain.wheels"]]]);
  assert.deepEqual(planOf(...smallPlan(), true).boxes[1].outputs, ["brain.wheels", "brain.free"]);
  assert.deepEqual(few.groups, [{ name: "one", parent: "", kind: "process" }, { name: "m", parent: "", kind: "machine" }, { name: "two", parent: "machine m", kind: "process" }]);
});

test("what is pushed leads to the right, and frames hold their boxes", { skip: existsSync(DAGRE) ? false : "node-dagre-layout is not installed" }, () => {
  const plan = planOf(...smallPlan(), true);
  const places = arrange(createRequire(import.meta.url)(DAGRE), plan);
  assert.ok(places.sensor.x < places.brain.x);
  for (const group of plan.groups) {
    const frame = frameOf(plan, places, group);
    for (const box of plan.boxes.filter((each) => each.group === `${group.kind} ${group.name}`)) {
      assert.ok(frame.x < places[box.name].x - box.width / 2 && frame.x + frame.width > places[box.name].x + box.width / 2);
    }
  }
  const from = portPlace(plan.boxes[0], places.sensor, "sensor.Push");
  assert.ok(from.x > places.sensor.x);
  assert.equal(portPlace(plan.boxes[0], places.sensor, "brain.in"), null);
});

test("a connection that leads back goes round the boxes", () => {
  const boxes = [{ x: 0, y: 0, width: 100, height: 50 }, { x: 200, y: 0, width: 100, height: 50 }, { x: 120, y: 55, width: 60, height: 400 }];
  const { middle } = detour({ x: 300, y: 25 }, { x: 0, y: 25 }, boxes, 0);
  assert.ok(middle.y < 0, "over the boxes, since another one stands below");
  assert.match(curve({ x: 0, y: 0 }, { x: 100, y: 10 }), /^M0.0,0.0 C50.0,0.0 50.0,10.0 100.0,10.0$/);
});

const sent = (origin, origin_port, seq, cause, ns) => ({ origin, origin_port, seq, creation_time: { ns }, cause: { origin: cause[0] ?? "", port: cause[1] ?? "", seq: cause[2] ?? 0 } });

test("a command is followed back to the reading that caused it", () => {
  const causes = new Causes();
  causes.add({ ...sent("base", "OdometryPush", 7, [], 1e9), stamp: { ns: 0.99e9 } });
  causes.add(sent("avoid", "motion", 3, ["base", "OdometryPush", 7], 1.01e9));
  const steps = causes.arrive(sent("fuser", "base", 9, ["avoid", "motion", 3], 1.02e9), 1.03);
  assert.deepEqual(steps.map(({ name, age }) => [name, age.toFixed(3)]), [["base.OdometryPush", "0.040"], ["avoid.motion", "0.020"], ["fuser.base", "0.010"]]);
  assert.equal(causes.summary()[0].way, "base.OdometryPush → avoid.motion → fuser.base");
  assert.deepEqual(causes.arrive(sent("fuser", "base", 10, ["avoid", "motion", 99], 1.1e9), 1.2), [], "a cause that nobody saw");
  assert.equal(causes.summary().length, 1);
});

test("quantiles are values that occurred", () => {
  assert.equal(quantile([1, 2, 3, 4], 0.5), 2);
  assert.equal(quantile([1, 2, 3, 4], 0.99), 4);
  assert.ok(Number.isNaN(quantile([], 0.5)));
});

test("series of different times are merged, and written as CSV", () => {
  const series = [
    { name: "a.x v", unit: "m/s", port: "", path: "", points: [[1, 10], [2, 20]] },
    { name: 'b "y", z', unit: "", port: "", path: "", points: [[2, 5], [1.5, 4]] },
  ];
  assert.deepEqual(mergedRows(series, 1.2).map(([time, ...values]) => [time.getTime(), ...values]), [[1500, null, 4], [2000, 20, 5]]);
  assert.equal(csvOf(series), 'time [s],a.x v [m/s],"b ""y"", z"\n1,10,\n1.5,,4\n2,20,5\n');
});
