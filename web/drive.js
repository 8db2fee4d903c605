// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt

import { xmlText } from "./dom.js";
import { componentOf } from "./system_model.js";

/**
 * Orders to a robot: goals, its pose, and driving by hand (docs/orders.md, "Goals from outside").
 * @typedef {import("./geometry.js").Point} Point
 * @typedef {import("./geometry.js").Pose} Pose
 * @typedef {import("./connection.js").Connection} Connection
 * @typedef {import("./connection.js").Answer} Answer
 * @typedef {import("./system_model.js").SystemModel} SystemModel
 * @typedef {import("./system_model.js").Port} Port
 * @typedef {{name: string, end: Point, text: string}} NamedGoal
 */

/** The names of goals that the page sends: place_1, place_2 ... */
export const PLACE = /^place_\d+$/;
const REACH = 0.2;
const REACH_ANGLE = 0.1;

/** @type {Answer} */
const NO_WAY = { ok: false, records: [], text: "", notes: [], error: "no component of this system takes goals", type: "", object: null };

/**
 * @param {Point[]} points  via points, then the goal
 * @param {number | null} yaw  to face at the goal; null: any
 * @param {string} name
 * @returns {string} as Command reads it
 */
export function goalText(points, yaw, name) {
  const way = points.map((p) => `${p.x.toFixed(3)} ${p.y.toFixed(3)}`).join(" > ");
  return `${name}: ${way}${yaw === null ? "" : ` @ ${((yaw * 180) / Math.PI).toFixed(1)}`}`;
}

/**
 * @param {Point} p
 * @param {number | null} yaw
 * @param {string} name
 * @returns {string} a GoalPoint
 */
export function goalXml(p, yaw, name) {
  const facing = yaw === null ? "" : `<orientation><orientation yaw="${yaw.toFixed(4)}"/></orientation>`;
  const use = yaw === null ? "" : ` use_orientation="true" reach_angle="${REACH_ANGLE}"`;
  return `<GoalPoint name="${name}"${use}><coordinate x="${p.x.toFixed(3)}" y="${p.y.toFixed(3)}"/><reach_radius distance="${REACH}"/>${facing}</GoalPoint>`;
}

/**
 * @param {Pose} pose
 * @returns {string} a RobotPose
 */
export function poseXml(pose) {
  return `<RobotPose x="${pose.x.toFixed(3)}" y="${pose.y.toFixed(3)}" orientation="${pose.yaw.toFixed(4)}"/>`;
}

/**
 * @param {string[]} names
 * @returns {string} a ClientList
 */
export function clientsXml(names) {
  return `<ClientList>${names.map((name) => `<clients value="${xmlText(name)}"/>`).join("")}</ClientList>`;
}

/**
 * @param {string} text  a goal, as Command reads it
 * @returns {string} a TripOrder
 */
export function tripXml(text) {
  return `<TripOrder kind="TRIP_GO" rounds="1"><goals value="${xmlText(text)}"/></TripOrder>`;
}

/**
 * @param {number} speed  [m/s]
 * @param {number} turnRate  [rad/s]
 * @returns {string} a MotionCommand
 */
export function motionXml(speed, turnRate) {
  if (speed === 0 && turnRate === 0) return '<MotionCommand kind="FULLSTOP"/>';
  return `<MotionCommand kind="NORMAL" steering="BY_TURN_RATE" speed="${speed.toFixed(3)}" turn_rate="${turnRate.toFixed(3)}" weight="1"/>`;
}

/**
 * Reads where a goal of Command ends: `kitchen: 3.6 6 > 4.2 9.8 @ 90`.
 * @param {string} text
 * @returns {NamedGoal | null} null: its end has no coordinates of its own
 */
export function namedGoal(text) {
  const read = /^\s*([A-Za-z]\w*)\s*:(.*)$/s.exec(text);
  const end = /(?:^|>)\s*(?:door\s+)?(-?[\d.]+)\s+(-?[\d.]+)[^>]*$/.exec(read?.[2] ?? "");
  if (read === null || end === null) return null;
  return { name: read[1], end: { x: Number(end[1]), y: Number(end[2]) }, text: text.trim() };
}

/** The orders to the robot with a prefix. */
export class Driver {
  /**
   * @param {Connection} connection
   * @param {SystemModel} system
   * @param {string} prefix  of the robot's components, with the slash
   */
  constructor(connection, system, prefix) {
    this.connection = connection;
    this.system = system;
    this.prefix = prefix;
    this.orders = 0;
    /** @type {NamedGoal[]} goals of the graph */
    this.goals = [];
  }

  /** @param {Port[]} ports */
  own(ports) {
    return ports.filter((port) => {
      const component = componentOf(port.port);
      return component.slice(0, component.lastIndexOf("/") + 1) === this.prefix;
    });
  }

  /** The component that drives to one goal after the other; undefined: there is none. */
  get command() {
    const all = [...this.system.components.values()];
    return all.find((each) => each.type === "orca.Command" && each.name.startsWith(this.prefix) && each.state.startsWith("WORK"));
  }

  /** The outermost component that takes goals: a planner before the Goto that it uses. */
  get goalPort() {
    const ports = this.own(this.system.servers("Send", "GoalPoint"));
    return ports.sort((a, b) => a.connected_to.length - b.connected_to.length)[0];
  }

  get posePort() {
    return this.own(this.system.servers("Send", "RobotPose"))[0];
  }

  get cancelPort() {
    return this.own(this.system.servers("Send", "GoalFailed"))[0];
  }

  get takesGoals() {
    return this.command !== undefined || this.goalPort !== undefined;
  }

  /** Whether a way of several points can be ordered. */
  get takesWays() {
    return this.command !== undefined;
  }

  /** Keeps the goals that the graph gave Command, also after this page has given it others. */
  readGoals() {
    const name = this.command?.name;
    const params = this.system.graph?.components?.find((/** @type {any} */ each) => each.name === name)?.params;
    const goals = (params?.goals ?? []).map(namedGoal).filter((/** @type {NamedGoal | null} */ goal) => goal !== null && !PLACE.test(goal.name));
    if (goals.length > 0) this.goals = goals;
  }

  /**
   * Sends the robot to a place.
   * @param {Point[]} points  via points, then the goal
   * @param {number | null} yaw  to face there; null: any
   * @returns {Promise<Answer>}
   */
  driveTo(points, yaw) {
    this.orders += 1;
    const name = `place_${this.orders}`;
    return this.command === undefined ? this.sendGoal(points[points.length - 1], yaw, name) : this.commandGoal(goalText(points, yaw, name));
  }

  /**
   * Gives Command one goal, as `orcactl go` does. It waits at its end.
   * @param {string} text
   * @returns {Promise<Answer>}
   */
  async commandGoal(text) {
    const command = this.command?.name;
    return command === undefined ? NO_WAY : this.connection.query(`${command}.TripQuery`, tripXml(text));
  }

  /**
   * @param {Point} p
   * @param {number | null} yaw
   * @param {string} name
   * @returns {Promise<Answer>}
   */
  async sendGoal(p, yaw, name) {
    const goal = this.goalPort;
    if (goal === undefined) return NO_WAY;
    for (const list of this.own(this.system.servers("Send", "ClientList"))) {
      const told = await this.connection.send(list.port, clientsXml(this.behavioursOf(componentOf(list.port))));
      if (!told.ok) return told;
    }
    return this.connection.send(goal.port, goalXml(p, yaw, name));
  }

  /**
   * @param {string} fuser
   * @returns {string[]} all that send it commands, except those by which a person drives
   */
  behavioursOf(fuser) {
    const inputs = this.system.portsThat((port) => componentOf(port.port) === fuser && port.type === "MotionCommand" && port.pattern === "Push");
    const names = inputs.flatMap((port) => port.connected_to.map(componentOf));
    return [...new Set(names)].filter((name) => this.system.components.get(name)?.type !== "orca.Teleop");
  }

  /** @returns {Promise<Answer>} */
  async giveUp() {
    if (this.command !== undefined) return this.connection.query(`${this.command.name}.TripQuery`, '<TripOrder kind="TRIP_CANCEL"/>');
    return this.cancelPort === undefined ? NO_WAY : this.connection.send(this.cancelPort.port, "<GoalFailed/>");
  }

  /**
   * @param {Pose} pose
   * @returns {Promise<Answer>}
   */
  setPose(pose) {
    return this.posePort === undefined ? Promise.resolve(NO_WAY) : this.connection.send(this.posePort.port, poseXml(pose));
  }
}
