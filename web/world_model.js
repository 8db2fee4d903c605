// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt

import { el } from "./dom.js";
import { compose, PoseHistory, transform } from "./geometry.js";
import { componentOf, shortPort } from "./system_model.js";

/**
 * What is known of the world: the newest object of each port that shows something of it.
 *
 * @typedef {import("./geometry.js").Point} Point
 * @typedef {import("./geometry.js").Pose} Pose
 * @typedef {import("./connection.js").Connection} Connection
 * @typedef {import("./system_model.js").SystemModel} SystemModel
 * @typedef {import("./system_model.js").Port} Port
 * @typedef {{pose: Pose, range: number, halfLobe: number, echo: boolean}} Cone  pose in the world
 * @typedef {{origin: Point, points: Float64Array, hits: Uint8Array}} Scan  points x, y, x, y ... in the world
 * @typedef {{speed: number, turnRate: number, direction: number, stops: boolean, silent: boolean}} Wish
 * @typedef {{name: string, x: number, y: number, radius: number, yaw: number | null, via: boolean}} Goal
 * @typedef {{name: string, points: Point[]}} Way
 * @typedef {{corner: Pose, resolution: number, columns: number, rows: number, image: CanvasImageSource}} Grid
 * @typedef {{walls: Path2D, corners: Point[], places: {name: string, x: number, y: number}[]}} Plan  of a simulated world
 * @typedef {{a: Point, b: Point}} Edge
 * @typedef {{name: string, x: number, y: number, yaw: number, radius: number, outline: Edge[], silent: string[]}} TrueRobot
 * @typedef {{name: string, x: number, y: number, yaw: number, radius: number, outline: Edge[], movable: boolean}} Obstacle
 * @typedef {{name: string, x: number, y: number, radius: number}} Person
 * @typedef {{name: string, leaf: Edge, open: boolean}} Door  of a simulated world; its leaf is an obstacle as well
 * @typedef {{robots: TrueRobot[], people: Person[], obstacles: Obstacle[], doors: Door[]}} Scene  what moves in a simulated world
 */

const TRAIL_STEP = 0.02;
const TRAIL_LENGTH = 5000;
const ECHO_CELL = 0.05;
const ECHOES = 4000;
const OLD = 1500;  // [ms] after which a reading, or a command, says nothing about now
const SILENT = 700;  // [ms] without an object after which its server is asked
const ASK_AGAIN = 350;
const AROUND = 3;  // [m] of a robot that belong to the picture

/**
 * @param {{ns: number}} time
 * @returns {number} [s]
 */
export function seconds(time) {
  return time.ns * 1e-9;
}

/** A robot, as its ports show it. Robots of one system have prefixes: `dewey/base` and `huey/base`. */
export class Robot {
  /** @param {string} prefix  of the names of its components, with the slash; "" if there is one robot */
  constructor(prefix) {
    this.prefix = prefix;
    this.name = prefix.replace(/\/$/, "");
    /** Circle that holds the body, and the rectangle if it is one [m]. */
    this.outline = { radius: 0.2, length: 0, width: 0, known: false };
    /** @type {TrueRobot | null} the robot as its simulator knows it */
    this.truth = null;
    /** @type {Pose | null} */
    this.pose = null;
    /** @type {Pose | null} Where it is drawn: it follows the pose within a twentieth of a second, so that the picture does not jump. */
    this.shown = null;
    /** @type {ArrayLike<number> | null} */
    this.covariance = null;
    /** Actual motion: forward [m/s], to the left [m/s], to the left [rad/s]. */
    this.motion = { forward: 0, left: 0, turnRate: 0 };
    this.frame = "world";
    this.history = new PoseHistory();
    /** @type {Map<string, Pose>} poses from other localizers, by port */
    this.others = new Map();
    /** @type {Point[]} */
    this.trail = [];
    /** @type {Map<string, Cone[]>} */
    this.sonars = new Map();
    /** @type {Map<string, Scan>} */
    this.scans = new Map();
    /** @type {Map<string, {stamp: number, at: number}>} the newest reading of each sensor's port: when it was taken [s], and when it came [ms] */
    this.readings = new Map();
    /** @type {Map<string, Wish>} wishes of behaviours, by component */
    this.wishes = new Map();
    /** @type {Wish | null} */
    this.command = null;
    this.commandedAt = 0;
    /** @type {Way | null} */
    this.way = null;
    /** @type {Goal | null} */
    this.goal = null;
    /** @type {Pose | null} goal that this page has sent */
    this.ordered = null;
  }

  /**
   * @param {Pose} pose
   * @param {number} time  [s]
   */
  moveTo(pose, time) {
    this.history.add(time, pose);
    this.pose = pose;
    const last = this.trail.at(-1);
    if (last !== undefined && Math.hypot(last.x - pose.x, last.y - pose.y) < TRAIL_STEP) return;
    this.trail.push({ x: pose.x, y: pose.y });
    if (this.trail.length > TRAIL_LENGTH) this.trail.splice(0, TRAIL_LENGTH / 10);
  }

  /**
   * @param {string} port
   * @param {number} stamp  [s]
   * @returns {boolean} whether a reading is newer than the last one of its port; one that was asked for may be old
   */
  isNews(port, stamp) {
    if (stamp <= (this.readings.get(port)?.stamp ?? -Infinity)) return false;
    this.readings.set(port, { stamp, at: performance.now() });
    return true;
  }

  /** Forgets readings of sensors that have fallen silent. */
  forgetOld() {
    for (const [port, { at }] of this.readings) {
      if (performance.now() - at < OLD) continue;
      this.sonars.delete(port);
      this.scans.delete(port);
    }
  }

  /**
   * Forgets the way to a goal that was reached or given up. Whoever has no goal left may push no empty way any more.
   * @param {string} name
   */
  endWay(name) {
    this.ordered = null;
    if (this.way?.name === name) this.way = null;
  }
}

/** The places where something was echoed, each cell once, the oldest forgotten first. */
export class EchoMemory {
  constructor() {
    /** @type {Map<string, Point>} */
    this.cells = new Map();
  }

  /** @param {Point} p */
  add(p) {
    const [column, row] = [Math.round(p.x / ECHO_CELL), Math.round(p.y / ECHO_CELL)];
    const key = `${column} ${row}`;
    if (this.cells.has(key)) return;
    this.cells.set(key, { x: column * ECHO_CELL, y: row * ECHO_CELL });
    if (this.cells.size > ECHOES) this.cells.delete(/** @type {string} */ (this.cells.keys().next().value));
  }
}

/**
 * @param {any} command  a MotionCommand
 * @returns {Wish}
 */
function wishOf(command) {
  const steered = command.steering === "BY_DIRECTION";
  return {
    speed: command.speed,
    turnRate: steered ? 0 : command.turn_rate,
    direction: steered ? command.direction : 0,
    stops: command.kind === "FULLSTOP",
    silent: command.kind === "DONTCARE",
  };
}

/**
 * Puts each cone of a ring where its sonar fired.
 * @param {Robot} robot
 * @param {any} reading  SonarRangeReadings or InfraredRangeReadings
 * @returns {Cone[]}
 */
export function conesOf(robot, reading) {
  /** @type {Cone[]} */
  const cones = [];
  for (let i = 0; i < reading.poses.length; ++i) {
    const stamp = reading.stamps[i];
    const X_WR = robot.history.at(stamp === undefined ? Infinity : seconds(stamp));
    if (X_WR === null) continue;
    const { position, rotation } = reading.poses[i];
    cones.push({
      pose: compose(X_WR, { x: position.x, y: position.y, yaw: rotation.yaw }),
      range: Math.min(reading.ranges[i], reading.max_range),
      halfLobe: reading.half_lobe ?? reading.half_beam,
      echo: reading.ranges[i] < reading.max_range,
    });
  }
  return cones;
}

/**
 * Puts each point of a scan where the robot was as it was measured.
 * @param {Robot} robot
 * @param {any} scan  LaserRangeReadings
 * @returns {Scan | null}
 */
export function scanOf(robot, scan) {
  const { ranges, pose } = scan;
  const X_RS = { x: pose.position.x, y: pose.position.y, yaw: pose.rotation.yaw };
  const first = robot.history.at(seconds(scan.stamp));
  const last = robot.history.at(seconds(scan.stamp) + ranges.length * scan.time_increment);
  if (first === null || last === null) return null;
  const begin = compose(first, X_RS);
  const end = compose(last, X_RS);
  const points = new Float64Array(2 * ranges.length);
  const hits = new Uint8Array(ranges.length);
  for (let i = 0; i < ranges.length; ++i) {
    const share = i / ranges.length;
    const angle = begin.yaw + share * (end.yaw - begin.yaw) + scan.angle_start + i * scan.angle_increment;
    const range = Math.min(ranges[i], scan.max_range);
    points[2 * i] = begin.x + share * (end.x - begin.x) + range * Math.cos(angle);
    points[2 * i + 1] = begin.y + share * (end.y - begin.y) + range * Math.sin(angle);
    hits[i] = ranges[i] < scan.max_range ? 1 : 0;
  }
  return { origin: end, points, hits };
}

/**
 * Paints a grid once, so that a frame only copies it: free cells as floor, occupied ones as walls, the rest transparent.
 * @param {any} grid  OccupancyGrid
 * @returns {Grid}
 */
function gridOf(grid) {
  const { columns, rows, cells } = grid;
  const canvas = el("canvas", { width: Math.max(1, columns), height: Math.max(1, rows) });
  const pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
  const pixels = pen.createImageData(canvas.width, canvas.height);
  const words = new Uint32Array(pixels.data.buffer);
  const shades = new Uint32Array(256);
  for (let percent = 0; percent <= 100; ++percent) {
    const grey = Math.round(235 - 1.75 * percent);
    shades[percent] = (Math.round(70 + 1.6 * percent) << 24) | (grey << 16) | (grey << 8) | grey;
  }
  for (let i = 0; i < columns * rows; ++i) words[i] = shades[cells[i]];
  pen.putImageData(pixels, 0, 0);
  return {
    corner: { x: grid.corner.x, y: grid.corner.y, yaw: grid.corner.orientation },
    resolution: grid.resolution,
    columns,
    rows,
    image: canvas,
  };
}

/**
 * How an object of a type is taken: `layer` is what shows it, `rate` how many per second are wanted.
 * @typedef {{layer: string, rate: number, take: (world: WorldModel, robot: Robot, object: any, port: string) => void}} Source
 * @type {Record<string, Source>}
 */
const PUSHED = {
  RobotPose: { layer: "robot", rate: 30, take: (world, robot, o, port) => world.takePose(robot, o, port) },
  Odometry: { layer: "robot", rate: 30, take: (world, robot, o, port) => world.takeOdometry(robot, o, port) },
  SonarRangeReadings: { layer: "sonar", rate: 20, take: (world, robot, o, port) => world.takeCones(robot, o, port) },
  InfraredRangeReadings: { layer: "sonar", rate: 20, take: (world, robot, o, port) => world.takeCones(robot, o, port) },
  LaserRangeReadings: { layer: "laser", rate: 20, take: (world, robot, o, port) => world.takeScan(robot, o, port) },
  Path: {
    layer: "path",
    rate: 10,
    take: (_world, robot, o) => {
      const points = o.poses.map((/** @type {any} */ pose) => ({ x: pose.position.x, y: pose.position.y }));
      robot.way = points.length > 1 ? { name: o.name, points } : null;
    },
  },
  GoalPoint: {
    layer: "path",
    rate: 5,
    take: (_world, robot, o) => {
      const { x, y } = o.coordinate.point;
      const yaw = o.use_orientation ? o.orientation.orientation.yaw : null;
      robot.goal = { name: o.name, x, y, radius: o.reach_radius.distance, yaw, via: o.via };
    },
  },
  MotionCommand: { layer: "wishes", rate: 20, take: (_world, robot, o, port) => robot.wishes.set(componentOf(port), wishOf(o)) },
  OccupancyGrid: { layer: "map", rate: 1, take: (world, _robot, o) => { world.grid = gridOf(o); } },
  Arrived: {
    layer: "path",
    rate: 10,
    take: (world, robot, o) => {
      robot.endWay(o.name);
      world.dispatchEvent(new CustomEvent("ended", { detail: { robot, goal: o.name, text: `has arrived at ${o.name}.` } }));
    },
  },
  GoalFailed: {
    layer: "path",
    rate: 10,
    take: (world, robot, o) => {
      robot.endWay(o.name);
      if (o.reason.startsWith("cancelled")) return;  // whoever has cancelled it knows
      world.dispatchEvent(new CustomEvent("ended", { detail: { robot, goal: o.name, text: `gives up ${o.name}: ${o.reason}` } }));
    },
  },
  WorldScene: { layer: "world", rate: 20, take: (world, _robot, o) => world.takeScene(o) },
  Contact: { layer: "robot", rate: 10, take: (world, _robot, o) => world.contacts.push({ x: o.x, y: o.y, other: o.other }) },
};

/** @type {Source} what a base is commanded */
const COMMANDED = {
  layer: "robot",
  rate: 20,
  take: (_world, robot, o) => {
    robot.command = wishOf(o);
    robot.commandedAt = performance.now();
  },
};

/** The world, kept up to date while somebody looks at it. Events: `changed` when there are other robots, `ended` when a goal
 * is reached or given up, `happened` with a sentence about a simulated world. */
export class WorldModel extends EventTarget {
  /**
   * @param {Connection} connection
   * @param {SystemModel} system
   */
  constructor(connection, system) {
    super();
    this.connection = connection;
    this.system = system;
    /** @type {Map<string, Robot>} */
    this.robots = new Map();
    /** @type {Grid | null} */
    this.grid = null;
    /** @type {Plan | null} */
    this.plan = null;
    /** @type {Scene | null} */
    this.scene = null;
    this.lastEvent = 0;
    this.echoes = new EchoMemory();
    /** @type {Point[]} places where a localizer thinks that a robot may be; no object type carries them yet */
    this.particles = [];
    /** @type {{x: number, y: number, other: string}[]} */
    this.contacts = [];
    /** Whether something has come since the last frame. */
    this.stale = true;
    this.isWatching = false;
    /** @type {Set<string>} layers that are not shown, and so not asked for */
    this.hidden = new Set(["wishes"]);
    /** @type {Map<string, () => void>} */
    this.looks = new Map();
    /** @type {Map<Robot, string>} the port that says where a robot is */
    this.localizers = new Map();
    /** @type {Map<string, number>} when the last object came, by port [ms] */
    this.heard = new Map();
    /** @type {Set<string>} ports whose answer has not come yet */
    this.waiting = new Set();
    connection.addEventListener("hello", () => this.forgetAll());
    connection.addEventListener("moved", () => {
      this.forgetAll();
      this.chooseLocalizers();
    });
    system.addEventListener("graph", () => this.follow());
    setInterval(() => this.askSilent(), ASK_AGAIN);
  }

  /** Begins with nothing: a system has come, and may be another one. */
  forgetAll() {
    this.robots.clear();
    this.localizers.clear();
    this.heard.clear();
    this.waiting.clear();
    [this.grid, this.plan, this.scene] = [null, null, null];
    this.echoes = new EchoMemory();
    this.contacts = [];
    this.lastEvent = 0;
    this.stale = true;
    this.dispatchEvent(new Event("changed"));
  }

  /** @returns {Point[]} corners of what is known: the map, the robots and their surroundings, what was echoed */
  extent() {
    /** @type {Point[]} */
    const points = [...this.echoes.cells.values(), ...(this.plan?.corners ?? [])];
    for (const { pose, way } of this.robots.values()) {
      if (pose !== null) points.push({ x: pose.x - AROUND, y: pose.y - AROUND }, { x: pose.x + AROUND, y: pose.y + AROUND });
      points.push(...(way?.points ?? []));
    }
    if (this.grid !== null) {
      const { corner, resolution, columns, rows } = this.grid;
      points.push(corner, transform(corner, { x: columns * resolution, y: rows * resolution }));
    }
    return points;
  }

  /** @param {string} port */
  robotOf(port) {
    const component = componentOf(port);
    return this.robotNamed(component.slice(0, component.lastIndexOf("/") + 1));
  }

  /** @param {string} prefix */
  robotNamed(prefix) {
    const known = this.robots.get(prefix);
    if (known !== undefined) return known;
    const robot = new Robot(prefix);
    this.robots.set(prefix, robot);
    this.dispatchEvent(new Event("changed"));
    return robot;
  }

  /** @param {boolean} on  false while nobody can see the world */
  watch(on) {
    this.isWatching = on;
    this.follow();
  }

  /**
   * @param {string} layer
   * @param {boolean} on
   */
  show(layer, on) {
    if (on) this.hidden.delete(layer);
    else this.hidden.add(layer);
    this.stale = true;
    this.follow();
  }

  /**
   * @param {Port} port
   * @returns {Source | null} null: it shows nothing of the world
   */
  sourceOf(port) {
    if (port.disabled) return null;
    if (port.pattern === "Push" && port.role === "Server") return PUSHED[port.type] ?? null;
    const isBase = port.type === "MotionCommand" && port.pattern === "Send" && port.role === "Server" && shortPort(port.port) === "MotionCommandSend";
    return isBase ? COMMANDED : null;
  }

  /**
   * @param {Port} port
   * @returns {boolean} whether nobody uses these readings, although somebody uses such readings from elsewhere: a base passes on what
   *   a laser's own server pushes as well
   */
  isSpare(port) {
    const isReading = port.type.endsWith("RangeReadings") && port.connected_to.length === 0;
    const isUsed = (/** @type {Port} */ other) => other.type === port.type && other.pattern === "Push" && other.role === "Server" && other.connected_to.length > 0;
    return isReading && this.system.portsThat((other) => isUsed(other) && this.robotOf(other.port) === this.robotOf(port.port)).length > 0;
  }

  /** Looks at the ports that there are to look at, and at no others. */
  follow() {
    this.chooseLocalizers();
    const wanted = new Map();
    for (const port of this.isWatching ? this.system.ports.values() : []) {
      const source = this.sourceOf(port);
      if (source !== null && !this.hidden.has(source.layer) && !this.isSpare(port)) wanted.set(port.port, source);
    }
    for (const [port, end] of this.looks) {
      if (wanted.has(port)) continue;
      end();
      this.looks.delete(port);
      this.forget(port);
    }
    for (const [port, source] of wanted) if (!this.looks.has(port)) this.lookAt(port, source);
    if (this.isWatching) this.askAbout();
  }

  /**
   * @param {string} port
   * @param {Source} source
   */
  lookAt(port, source) {
    this.looks.set(port, this.connection.look(port, source.rate, (object) => this.take(port, source, object)));
  }

  /**
   * @param {string} port
   * @param {Source} source
   * @param {any} object
   */
  take(port, source, object) {
    this.heard.set(port, performance.now());
    source.take(this, this.robotOf(port), object, port);
    this.stale = true;
  }

  /** Asks for readings that nobody subscribes to, and that are not pushed therefore: a robot without a goal is still somewhere. */
  askSilent() {
    if (!this.isWatching || this.connection.hello === null || this.system.pace?.paused) return;
    if (this.connection.hello.recorded) return;  // what is recorded may stand still
    const now = performance.now();
    for (const robot of this.robots.values()) {
      robot.forgetOld();
      if (now - robot.commandedAt > OLD) robot.command = null;
    }
    this.stale = true;
    for (const port of this.system.portsThat((p) => p.pattern === "Query" && p.role === "Server" && p.type === "AskReading")) {
      const pushed = port.port.replace(/Query$/, "Push");
      const source = this.looks.has(pushed) ? PUSHED[port.reply ?? ""] : undefined;
      if (source === undefined || !this.system.mayAsk(componentOf(port.port)) || now - (this.heard.get(pushed) ?? 0) < SILENT || this.waiting.has(pushed)) continue;
      this.waiting.add(pushed);
      this.connection.query(port.port, "<AskReading/>").then(({ ok, object }) => {
        this.waiting.delete(pushed);
        if (!ok || object === null || !this.looks.has(pushed)) return;
        source.take(this, this.robotOf(pushed), object, pushed);
        this.stale = true;
      });
    }
  }

  /** @param {string} port */
  forget(port) {
    const robot = this.robotOf(port);
    for (const map of [robot.sonars, robot.scans, robot.others]) map.delete(port);
    const { type } = this.system.ports.get(port) ?? { type: "" };
    if (type === "Path") robot.way = null;
    if (type === "GoalPoint") robot.goal = null;
    robot.readings.delete(port);
    if (type === "WorldScene") this.scene = null;
    robot.wishes.delete(componentOf(port));
  }

  /** Asks once for what does not change: the robots' bodies, and maps. */
  askAbout() {
    for (const port of this.system.portsThat((p) => p.pattern === "Query" && p.role === "Server" && this.system.mayAsk(componentOf(p.port)))) {
      if (port.reply === "Robot" && !this.robotOf(port.port).outline.known) this.askOutline(port.port);
      if (port.reply === "OccupancyGrid" && this.grid === null) this.askGrid(port.port);
      if (port.reply === "WorldPlan" && this.plan === null) this.askPlan(port.port);
    }
  }

  /** @param {string} port */
  async askOutline(port) {
    const robot = this.robotOf(port);
    const answer = await this.connection.query(port, "<Ask/>");
    if (!answer.ok || answer.object === null) return;
    const { name, radius, length, width } = answer.object;
    robot.outline = { radius, length, width, known: true };
    if (name !== "") robot.name = name;
    this.stale = true;
    this.dispatchEvent(new Event("changed"));
  }

  /** @param {string} port */
  async askGrid(port) {
    const answer = await this.connection.query(port, "<Ask/>");
    if (answer.ok && answer.object !== null) this.grid = gridOf(answer.object);
    this.stale = true;
  }

  /** @param {string} port */
  async askPlan(port) {
    const answer = await this.connection.query(port, "<Ask/>");
    if (!answer.ok || answer.object === null) return;
    const walls = new Path2D();
    for (const { a, b } of answer.object.walls) {
      walls.moveTo(a.x, a.y);
      walls.lineTo(b.x, b.y);
    }
    const corners = answer.object.walls.flatMap((/** @type {Edge} */ { a, b }) => [a, b]);
    this.plan = { walls, corners, places: answer.object.places };
    this.stale = true;
  }

  /**
   * Takes the truth about a simulated world. Its events are said once.
   * @param {any} o  WorldScene
   */
  takeScene(o) {
    this.scene = o;
    for (const robot of this.robots.values()) robot.truth = o.robots.find((/** @type {TrueRobot} */ each) => each.name === robot.name) ?? null;
    for (const { text, x, y, stamp } of o.events) {
      if (stamp.ns <= this.lastEvent) continue;
      this.lastEvent = stamp.ns;
      if (Number.isFinite(x) && / touches /.test(text)) this.contacts.push({ x, y, other: text });
      this.dispatchEvent(new CustomEvent("happened", { detail: text }));
    }
  }

  /** Of several localizers the one is believed that most components follow. */
  chooseLocalizers() {
    const ports = this.system.portsThat((p) => p.type === "RobotPose" && p.pattern === "Push" && p.role === "Server");
    ports.sort((a, b) => a.connected_to.length - b.connected_to.length);
    this.localizers = new Map(ports.map((p) => [this.robotOf(p.port), p.port]));
  }

  /**
   * @param {Robot} robot
   * @param {any} o  RobotPose
   * @param {string} port
   */
  takePose(robot, o, port) {
    const pose = { x: o.x, y: o.y, yaw: o.orientation };
    if (this.localizers.get(robot) !== port) {
      robot.others.set(port, pose);
      return;
    }
    robot.frame = "world";
    robot.covariance = o.covariance;
    robot.motion = { forward: o.translational_velocity, left: o.sideways_velocity, turnRate: o.steering_velocity };
    robot.moveTo(pose, seconds(o.stamp));
  }

  /**
   * Takes odometry for the motion, and where there is no localizer also for the pose.
   * @param {Robot} robot
   * @param {any} o  Odometry
   * @param {string} _port
   */
  takeOdometry(robot, o, _port) {
    robot.motion = { forward: o.translational_velocity, left: o.sideways_velocity, turnRate: o.steering_velocity };
    if (this.localizers.has(robot)) return;
    robot.frame = "odometry";
    robot.covariance = o.covariance;
    robot.moveTo({ x: o.x, y: o.y, yaw: o.steer_angle }, seconds(o.stamp));
  }

  /**
   * @param {Robot} robot
   * @param {any} o
   * @param {string} port
   */
  takeCones(robot, o, port) {
    if (!robot.isNews(port, Math.max(...o.stamps.map(seconds)))) return;
    const cones = conesOf(robot, o);
    robot.sonars.set(port, cones);
    for (const cone of cones) if (cone.echo && cone.range < 3) this.echoes.add(transform(cone.pose, { x: cone.range, y: 0 }));
  }

  /**
   * @param {Robot} robot
   * @param {any} o
   * @param {string} port
   */
  takeScan(robot, o, port) {
    const scan = robot.isNews(port, seconds(o.stamp)) ? scanOf(robot, o) : null;
    if (scan === null) return;
    robot.scans.set(port, scan);
    for (let i = 0; i < scan.hits.length; ++i) if (scan.hits[i] !== 0) this.echoes.add({ x: scan.points[2 * i], y: scan.points[2 * i + 1] });
  }
}
