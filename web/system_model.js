// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt

/**
 * The system as its deployer reports it: the graph, and once per second how all is.
 *
 * @typedef {import("./connection.js").Connection} Connection
 * @typedef {{port: string, declared_as: string, process: string, pattern: "Push" | "Send" | "Query", role: "Server" | "Proxy", type: string,
 *   reply?: string, required: boolean, many: boolean, disabled: boolean, connected_to: string[], text: string}} Port
 * @typedef {{name: string, type: string, process: string, pid: number, state: string, plugin: string, build_id: string, restarts: number,
 *   alarms: string, memory_mb: number, log_per_s: number, machine?: string}} Component
 * @typedef {{from: string, to: string, pattern: string, queue?: string, overflow?: string, link?: string, deadline?: string}} Wire
 *   a connection of the graph
 * @typedef {{rate: number, lossRate: number, total: number, lost: number, queued: number, late: number, age50: number | null, age99: number | null}} Flow
 *   rates per second; lost: dropped, refused, failed or timed out since the beginning; ages at the arrival lately [ms], where they are measured
 * @typedef {{lap50: number | null, lap99: number | null}} Laps  processor time of laps lately [ms]
 * @typedef {{time: number, pace: number | null, paused: boolean}} PaceRow
 *   virtual time: where it is [s], how fast it passes (null: as fast as it can), and whether it stands
 * @typedef {{number: number, time: number, severity: string, kind: string, source: string, active: boolean, text: string}} AlarmRow
 */

const INTERVAL = 1000;

/**
 * @param {string} port
 * @returns {string} the component that has it
 */
export function componentOf(port) {
  return port.slice(0, port.lastIndexOf("."));
}

/**
 * @param {string} port
 * @returns {string} its name without the component's
 */
export function shortPort(port) {
  return port.slice(port.lastIndexOf(".") + 1);
}

/**
 * @param {Port} port
 * @returns {boolean} whether connections begin there: at a PushServer, SendProxy or QueryProxy
 */
export function isSource(port) {
  return (port.pattern === "Push") === (port.role === "Server");
}

/**
 * Returns what a row of `counters` says since an earlier one.
 * @param {Record<string, any>} row
 * @param {Record<string, any> | undefined} before
 * @param {number} seconds  between the two
 * @returns {Flow}
 */
export function flowOf(row, before, seconds) {
  const sum = (/** @type {Record<string, any>} */ of, /** @type {string[]} */ names) => names.reduce((all, name) => all + Number(of[name] ?? 0), 0);
  const carried = ["delivered", "accepted", "sent"];
  const spoiled = ["dropped", "refused", "failed", "timed_out"];
  const total = sum(row, carried);
  const lost = sum(row, spoiled);
  const rate = (/** @type {number} */ now, /** @type {number} */ then) => (seconds > 0 ? Math.max(0, now - then) / seconds : 0);
  return {
    total,
    lost,
    rate: before === undefined ? 0 : rate(total, sum(before, carried)),
    lossRate: before === undefined ? 0 : rate(lost, sum(before, spoiled)),
    queued: Number(row.queued ?? 0),
    late: Number(row.late ?? 0),
    age50: row.age_p50_ms ?? null,
    age99: row.age_p99_ms ?? null,
  };
}

/**
 * @param {Record<string, any>} row  of `counters`
 * @returns {string} a name for what it counts
 */
export function rowKey(row) {
  return row.from !== undefined ? `${row.from}>${row.to}` : String(row.server ?? row.client);
}

/** Events: `graph` when what runs, or how it is connected, has changed; `figures` when there are new numbers; `pace` after an order. */
export class SystemModel extends EventTarget {
  /** @param {Connection} connection */
  constructor(connection) {
    super();
    this.connection = connection;
    /** @type {any} */
    this.graph = null;
    /** @type {Map<string, Port>} */
    this.ports = new Map();
    /** @type {Map<string, Component>} */
    this.components = new Map();
    /** @type {Map<string, Flow>} */
    this.flows = new Map();
    /** @type {Map<string, Laps>} */
    this.laps = new Map();
    /** @type {AlarmRow[]} */
    this.alarms = [];
    /** @type {PaceRow | null} null: it is in real time */
    this.pace = null;
    /** Whether it may be in virtual time, so that the pace is asked for. */
    this.mayBeVirtual = true;
    /** @type {Map<string, Record<string, any>>} */
    this.rows = new Map();
    this.rowsAt = 0;
    this.shape = "";
    this.busy = false;
    /** The graph that ran before this page has applied another one; empty: it has not. */
    this.graphBefore = "";
    connection.addEventListener("hello", () => this.begin());
    connection.addEventListener("gone", () => {
      this.graphBefore = "";
    });
    setInterval(() => this.poll(), INTERVAL);
  }

  /** @returns {Wire[]} */
  get wires() {
    return this.graph?.connections ?? [];
  }

  /** Whether an operator holds the motors, or a base wants a person. */
  get motorsHeld() {
    return this.alarms.some((alarm) => alarm.kind === "ESTOP" && alarm.active);
  }

  /**
   * Returns whether a component may be asked without an order of a person. A question may change what a simulation does, unless the
   * component is there for those who look on.
   * @param {string} component
   */
  mayAsk(component) {
    if (this.pace === null) return !this.mayBeVirtual;  // that is not known yet
    return this.graph?.components.find((/** @type {any} */ each) => each.name === component)?.watchable === "true";
  }

  /** @param {PaceRow} row */
  takePace(row) {
    this.pace = row;
    this.dispatchEvent(new Event("pace"));
  }

  begin() {
    this.pace = null;
    this.mayBeVirtual = true;
    this.rows.clear();
    this.shape = "";
    return this.poll();
  }

  /** Asks again at once, because an order has changed something. */
  async refresh() {
    await this.readGraph();
    await this.poll();
  }

  async readGraph() {
    const [graph, ports] = await Promise.all([this.connection.ask("graph"), this.connection.ask("ports")]);
    if (!graph.ok || !ports.ok) return;
    this.graph = JSON.parse(graph.text);
    this.ports = new Map(JSON.parse(ports.text).map((/** @type {Port} */ port) => [port.port, port]));
    this.dispatchEvent(new Event("graph"));
  }

  async poll() {
    if (this.connection.hello === null || this.busy || document.hidden) return;
    this.busy = true;
    const commands = ["ps", "counters", "alarms", ...(this.mayBeVirtual ? ["pace"] : [])];
    const [ps, counters, alarms, pace] = await Promise.all(commands.map((command) => this.connection.ask(command)));
    this.busy = false;
    if (!ps.ok || !counters.ok || !alarms.ok) return;
    if (pace !== undefined) {
      this.mayBeVirtual = pace.ok;
      this.pace = pace.ok ? /** @type {any} */ (pace.records[0]) : null;
    }
    this.components = new Map(ps.records.map((row) => [row.name, /** @type {any} */ (row)]));
    this.alarms = /** @type {any[]} */ (alarms.records);
    this.takeCounters(counters.records);
    const shape = [...ps.records.map((row) => `${row.name} ${row.type} ${row.process}`), ...counters.records.filter((row) => !("component" in row)).map(rowKey)].join("\n");
    if (shape !== this.shape) {
      this.shape = shape;
      await this.readGraph();
    }
    this.dispatchEvent(new Event("figures"));
  }

  /** @param {Record<string, any>[]} all */
  takeCounters(all) {
    this.laps = new Map(all.filter((row) => "component" in row).map((row) => [row.component, { lap50: row.lap_p50_ms ?? null, lap99: row.lap_p99_ms ?? null }]));
    const rows = all.filter((row) => !("component" in row));
    const now = performance.now();
    const seconds = (now - this.rowsAt) / 1000;
    this.flows = new Map(rows.map((row) => [rowKey(row), flowOf(row, this.rows.get(rowKey(row)), seconds)]));
    this.rows = new Map(rows.map((row) => [rowKey(row), row]));
    this.rowsAt = now;
  }

  /**
   * @param {Wire} wire
   * @returns {Flow | undefined} requests are counted at their client
   */
  flowOf(wire) {
    return this.flows.get(`${wire.from}>${wire.to}`) ?? this.flows.get(wire.from);
  }

  /**
   * @param {(port: Port) => boolean} wanted
   * @returns {Port[]}
   */
  portsThat(wanted) {
    return [...this.ports.values()].filter(wanted);
  }

  /**
   * Returns the SendServers or QueryServers that take a type, of components of certain types if any are named.
   * @param {"Send" | "Query"} pattern
   * @param {string} type
   * @returns {Port[]}
   */
  servers(pattern, type) {
    return this.portsThat((port) => port.pattern === pattern && port.role === "Server" && port.type === type && !port.disabled);
  }
}
