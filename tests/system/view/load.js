// SPDX-License-Identifier: GPL-3.0-or-later
// A system that does not exist, larger and quicker than most, for the page to show: view_speed_test.py measures how well it keeps up.
// It stands in for orcaview's connection; everything behind that is the page's own.
import { decode } from "./cdr.js";
import { parseLayout } from "./layout.js";
import { SystemModel } from "./system_model.js";
import { SystemView } from "./system_view.js";
import { WorldModel } from "./world_model.js";
import { WorldView } from "./world_view.js";

const BEAMS = 361;
const SCANS = 20;  // per second
const PARTICLES = 5000;
const MAP = 1000;
const COMPONENTS = 200;
const WIRES = 500;
const MEASURED = 4000;  // [ms]

const kind = new URLSearchParams(location.search).get("load");
const later = (/** @type {number} */ ms) => new Promise((resolve) => setTimeout(resolve, ms));

/** @returns {{ports: any[], components: any[], connections: any[]}} a robot with a laser, a localizer and a map */
function robotSystem() {
  const port = (name, pattern, role, type, more = {}) => ({ port: name, pattern, role, type, connected_to: [], text: "", process: "p", required: false, disabled: false, ...more });
  return {
    components: ["laser", "localizer", "maps"].map((name) => ({ name, type: "orca.X", process: "p", state: "WORK", alarms: "", pid: 1, plugin: "", build_id: "", restarts: 0, memory_mb: 1, log_per_s: 0 })),
    ports: [
      port("laser.LaserRangeReadingsPush", "Push", "Server", "LaserRangeReadings"), port("localizer.RobotPosePush", "Push", "Server", "RobotPose"),
      port("maps.MapQuery", "Query", "Server", "Ask", { reply: "OccupancyGrid" }),
    ],
    connections: [],
  };
}

/** @returns {{ports: any[], components: any[], connections: any[]}} many components in ten processes, each connected to others */
function largeSystem() {
  const system = robotSystem();
  const name = (i) => `component_${i}`;
  system.components = Array.from({ length: COMPONENTS }, (_, i) => ({ ...system.components[0], name: name(i), process: `process_${i % 10}` }));
  system.ports = [];
  for (let i = 0; i < WIRES; ++i) {
    const [a, b] = [i % COMPONENTS, (i * 7 + 13) % COMPONENTS];
    const [from, to] = [`${name(a)}.out_${i}`, `${name(b)}.in_${i}`];
    const common = { pattern: "Push", type: "T", text: "", process: "p", required: true, disabled: false };
    system.ports.push({ ...common, port: from, role: "Server", connected_to: [to] }, { ...common, port: to, role: "Proxy", connected_to: [from] });
    system.connections.push({ from, to, pattern: "Push", queue: "1", overflow: "drop_oldest" });
  }
  return system;
}

/** A scan of so many beams as it travels. */
function scanFrame() {
  const layout = "Scan{ranges:sequence<double>,ranges_uncertainty:sequence<double>,min_range:double,max_range:double,x:double,y:double,yaw:double,ns:int64,start:double,increment:double,time:double}";
  const bytes = new DataView(new ArrayBuffer(16 + 8 * (BEAMS + 9)));
  bytes.setUint32(0, BEAMS, true);
  for (let i = 0; i < BEAMS; ++i) bytes.setFloat64(8 + 8 * i, 6 + 2 * Math.sin(i / 9), true);
  const rest = 8 + 8 * BEAMS;
  [0.1, 32, 0.2, 0, 0].forEach((value, i) => bytes.setFloat64(rest + 8 + 8 * i, value, true));
  [-Math.PI / 2, Math.PI / (BEAMS - 1), 0].forEach((value, i) => bytes.setFloat64(rest + 8 * (7 + i), value, true));
  return { type: parseLayout(layout), buffer: bytes.buffer };
}

class Load extends EventTarget {
  constructor(system) {
    super();
    this.system = system;
    this.hello = { system: "load", role: "change", time: 0, version: "" };
    this.role = this.hello.role;
    this.steers = true;
    this.laps = 0;
    this.scan = scanFrame();
  }

  isA(type, wanted) {
    return type === wanted;
  }

  typeOf() {
    return null;
  }

  stream() {
    return () => {};
  }

  refusal() {
    return "";
  }

  may() {
    return true;
  }

  async ask(command) {
    this.laps += 1;
    const answer = (records, text = "") => ({ ok: true, records, text, notes: [], error: "", type: "", object: null });
    const { ports, components, connections } = this.system;
    if (command === "pace") return { ...answer([]), ok: false };  // it is in real time
    if (command === "ps") return answer(components);
    if (command === "counters") return answer(connections.map(({ from, to }, i) => ({ from, to, delivered: this.laps * (i % 50), dropped: this.laps * (i % 3), queued: i % 4, late: 0 })));
    if (command === "graph") return answer([], JSON.stringify({ name: "load", components, connections }));
    return command === "ports" ? answer([], JSON.stringify(ports)) : answer([]);
  }

  async layout() {
    return { ok: true, text: "{}" };
  }

  async query(_port, _xml) {
    const cells = Uint8Array.from({ length: MAP * MAP }, (_, i) => (i % 97 === 0 ? 100 : i % 13 === 0 ? 255 : 0));
    const object = { corner: { x: -25, y: -25, orientation: 0 }, resolution: 0.05, columns: MAP, rows: MAP, cells };
    return { ok: true, records: [], text: "", notes: [], error: "", type: "OccupancyGrid", object };
  }

  look(port, _rate, take) {
    const isScan = port.startsWith("laser");
    const timer = setInterval(() => take(isScan ? this.newScan() : this.newPose(), {}), 1000 / SCANS);
    return () => clearInterval(timer);
  }

  newPose() {
    const time = performance.now() / 1000;
    return { x: 8 * Math.cos(time / 5), y: 8 * Math.sin(time / 5), orientation: time / 5 + Math.PI / 2, translational_velocity: 1.6, sideways_velocity: 0, steering_velocity: 0.2, stamp: { ns: time * 1e9 }, covariance: [0.02, 0, 0, 0, 0.04, 0, 0, 0, 0.01] };
  }

  newScan() {
    const read = decode(this.scan.type, this.scan.buffer);
    return { ...read, pose: { position: { x: read.x, y: read.y }, rotation: { yaw: read.yaw } }, stamp: { ns: performance.now() * 1e6 }, angle_start: read.start, angle_increment: read.increment, time_increment: 0 };
  }
}

/** @returns {Promise<Record<string, number>>} frames per second that were painted */
async function measureWorld(connection, system) {
  const world = new WorldModel(connection, system);
  const view = new WorldView(connection, system, world);
  await system.begin();
  view.show(true);
  setInterval(() => {
    const { x, y } = world.robots.get("")?.pose ?? { x: 0, y: 0 };
    world.particles = Array.from({ length: PARTICLES }, () => ({ x: x + Math.random() - 0.5, y: y + Math.random() - 0.5 }));
  }, 200);
  await later(2500);
  const before = view.frames;
  await later(MEASURED);
  return { frames: (view.frames - before) / (MEASURED / 1000), map: world.grid === null ? 0 : world.grid.columns, beams: [...world.robots.get("").scans.values()][0].hits.length, particles: world.particles.length };
}

/** @returns {Promise<Record<string, number>>} the longest time that new figures take [ms], the browser's layout included */
async function measureGraph(connection, system) {
  const view = new SystemView(connection, system);
  await system.begin();
  document.getElementById("view-world").hidden = true;
  document.getElementById("view-system").hidden = false;
  view.show(true);
  while (view.boxes.size < COMPONENTS) await later(100);
  let longest = 0;
  for (let i = 0; i < 8; ++i) {
    const { records } = await connection.ask("counters");
    const began = performance.now();
    system.takeCounters(records);
    view.refresh();
    document.body.getBoundingClientRect();
    longest = Math.max(longest, performance.now() - began);
    await later(300);
  }
  return { longest, boxes: view.boxes.size, wires: view.wires.length, figures: view.wires.filter(({ label }) => label.textContent !== "").length };
}

const connection = new Load(kind === "graph" ? largeSystem() : robotSystem());
const system = new SystemModel(/** @type {any} */ (connection));
const result = kind === "graph" ? await measureGraph(connection, system) : await measureWorld(connection, system);
document.body.dataset.result = JSON.stringify(result);
