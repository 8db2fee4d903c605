// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt

import { byId, el, figure, notify, permit, setText } from "./dom.js";
import { Driver, PLACE } from "./drive.js";
import { changeXml } from "./world_change.js";

/**
 * What stands beside the picture of the world: in words and figures what a robot does, and the orders that it takes.
 * @typedef {import("./world_model.js").Robot} Robot
 * @typedef {import("./world_model.js").WorldModel} WorldModel
 * @typedef {import("./system_model.js").SystemModel} SystemModel
 * @typedef {import("./connection.js").Connection} Connection
 */

const PLACES = /\bplace_\d+\b/;

export class WorldPanel {
  /**
   * @param {Connection} connection
   * @param {SystemModel} system
   * @param {WorldModel} world
   */
  constructor(connection, system, world) {
    this.connection = connection;
    this.system = system;
    this.world = world;
    /** @type {Map<string, Driver>} */
    this.drivers = new Map();
    /** Prefix of the robot that orders are for. */
    this.chosen = "";
    world.addEventListener("changed", () => this.showRobots());
    world.addEventListener("ended", (event) => this.end(/** @type {CustomEvent} */ (event).detail));
    world.addEventListener("happened", (event) => {
      notify(/** @type {CustomEvent} */ (event).detail);
      this.showDoors();
    });
    for (const event of ["gone", "state"]) connection.addEventListener(event, () => this.showFigures());
    connection.addEventListener("state", () => this.showOrders());
    system.addEventListener("figures", () => this.showOrders());
    system.addEventListener("graph", () => this.showOrders());
    byId("give-up").addEventListener("click", () => this.order(this.driver.giveUp(), "The goal is given up."));
    byId("robot-choice").addEventListener("change", (event) => {
      this.chosen = /** @type {HTMLSelectElement} */ (event.target).value;
      this.showOrders();
    });
  }

  /** @returns {Robot | undefined} the robot that orders are for */
  get robot() {
    return this.world.robots.get(this.chosen) ?? this.world.robots.values().next().value;
  }

  get driver() {
    return this.driverOf(this.robot);
  }

  /**
   * @param {Robot | undefined} robot
   * @returns {Driver}
   */
  driverOf(robot) {
    const prefix = robot?.prefix ?? "";
    const known = this.drivers.get(prefix);
    if (known !== undefined) return known;
    const driver = new Driver(this.connection, this.system, prefix);
    this.drivers.set(prefix, driver);
    return driver;
  }

  showRobots() {
    const choice = /** @type {HTMLSelectElement} */ (byId("robot-choice"));
    const robots = [...this.world.robots.values()].filter((robot) => robot.prefix !== "" || this.world.robots.size === 1);
    choice.replaceChildren(...robots.map((robot) => el("option", { value: robot.prefix, selected: robot === this.robot }, robot.name)));
    choice.hidden = robots.length < 2;
    setText(byId("robot-name"), robots.length < 2 ? this.robot?.name || "Robot" : "");
  }

  /** Offers the orders that this system takes, and no others. */
  showOrders() {
    const driver = this.driver;
    driver.readGoals();
    const steers = this.connection.steers;
    const refusal = this.connection.refusal("line");
    for (const control of ["tool-drive", "tool-pose", "tool-change", "give-up"]) permit(byId(control), refusal);
    byId("tool-drive").hidden = !steers || !driver.takesGoals;
    byId("tool-pose").hidden = !steers || driver.posePort === undefined;
    byId("tool-change").hidden = !steers || this.changePort === undefined;
    this.showSensors();
    this.showDoors();
    byId("give-up").hidden = !steers || !driver.takesGoals;
    const goals = steers && driver.command !== undefined ? driver.goals : [];
    byId("goals").hidden = goals.length === 0;
    for (const box of /** @type {NodeListOf<HTMLInputElement>} */ (document.querySelectorAll("#layers input[data-types]"))) {
      const types = (box.dataset.types ?? "").split(" ");
      const label = /** @type {HTMLElement} */ (box.parentElement);
      label.hidden = this.system.portsThat((port) => types.includes(port.type) || types.includes(port.reply ?? "")).length === 0;
    }
    const list = byId("goal-list");
    const key = [refusal, ...goals.map((goal) => goal.text)].join();
    if (list.dataset.key === key) return;
    list.dataset.key = key;
    list.replaceChildren(
      ...goals.map((goal) => el("button", { title: goal.text, click: () => this.order(driver.commandGoal(goal.text), `Sent to ${goal.name}.`) }, goal.name)),
    );
    for (const control of /** @type {Iterable<HTMLElement>} */ (list.children)) permit(control, refusal);
    this.world.stale = true;
  }

  /** The port that takes changes of a simulated world; undefined: the world is real, or nobody serves it. */
  get changePort() {
    return this.system.servers("Send", "WorldChange")[0];
  }

  /** Offers to let sensors of a simulated robot fail. */
  showSensors() {
    const { robot, changePort } = this;
    const rings = { SonarRangeReadings: "sonar", LaserRangeReadings: "laser", InfraredRangeReadings: "infrared", BumperReadings: "bumper", Odometry: "odometry" };
    const ports = this.driver.own(this.system.portsThat((port) => port.pattern === "Push" && port.role === "Server" && port.type in rings));
    const kinds = changePort === undefined || robot === undefined || !this.connection.steers ? [] : [...new Set(ports.map((port) => rings[/** @type {keyof typeof rings} */ (port.type)]))];
    byId("sensors").hidden = kinds.length === 0;
    const list = byId("sensor-list");
    if (list.dataset.kinds !== `${robot?.name} ${kinds.join()}`) {
      list.dataset.kinds = `${robot?.name} ${kinds.join()}`;
      list.replaceChildren(...kinds.map((kind) => el("label", { class: "check" }, el("input", { type: "checkbox", value: kind, change: (event) => this.switchSensor(kind, event.target.checked) }), kind)));
    }
    for (const box of /** @type {NodeListOf<HTMLInputElement>} */ (list.querySelectorAll("input"))) {
      box.checked = !(robot?.truth?.silent ?? []).some((each) => each.split(" ")[0] === box.value);
      permit(box, this.connection.refusal("line"));
    }
  }

  /** Offers to open and shut the doors of a simulated world. */
  showDoors() {
    const doors = this.changePort === undefined || !this.connection.steers ? [] : this.world.scene?.doors ?? [];
    byId("doors").hidden = doors.length === 0;
    const list = byId("door-list");
    const names = doors.map(({ name }) => name).join();
    if (list.dataset.names !== names) {
      list.dataset.names = names;
      list.replaceChildren(...doors.map(({ name }) => el("label", { class: "check" }, el("input", { type: "checkbox", value: name, change: (event) => this.turnDoor(name, event.target.checked) }), name)));
    }
    for (const [i, box] of [.../** @type {NodeListOf<HTMLInputElement>} */ (list.querySelectorAll("input"))].entries()) {
      box.checked = doors[i].open;
      permit(box, this.connection.refusal("line"));
    }
  }

  /**
   * @param {string} name
   * @param {boolean} opens
   */
  turnDoor(name, opens) {
    const port = this.changePort?.port;
    if (port !== undefined) this.order(this.connection.send(port, changeXml(opens ? "OPEN_DOOR" : "SHUT_DOOR", { name })), "");
  }

  /**
   * @param {string} sensor
   * @param {boolean} works
   */
  switchSensor(sensor, works) {
    const port = this.changePort?.port;
    if (port === undefined) return;
    const xml = changeXml(works ? "RESTORE_SENSOR" : "SILENCE_SENSOR", { name: this.robot?.name ?? "", sensor });
    this.order(this.connection.send(port, xml), "");  // the world's events say what has become of it
  }

  /** Says in plain words what the robot does. */
  describe() {
    const robot = this.robot;
    if (this.connection.hello === null) return "No system is there. What is shown is how it was.";
    if (robot === undefined || robot.pose === null) return "Nothing is known of a robot yet.";
    if (this.system.motorsHeld) return "The motors are held. Nothing moves before they are released.";
    const moves = Math.hypot(robot.motion.forward, robot.motion.left) > 0.01;
    const turns = Math.abs(robot.motion.turnRate) > 0.03;
    const doing = moves ? (robot.motion.forward < 0 ? "Backs up" : "Drives") : turns ? "Turns" : "Stands";
    if (robot.way === null) return `${doing}. It has no goal.`;
    const points = [robot.pose, ...robot.way.points.slice(1)];
    const left = points.slice(1).reduce((sum, p, i) => sum + Math.hypot(p.x - points[i].x, p.y - points[i].y), 0);
    const where = PLACE.test(robot.way.name) ? "the place you chose" : robot.way.name || "a place";
    return `${doing}, on the way to ${where}: ${left.toFixed(1)} m to go.`;
  }

  showFigures() {
    const robot = this.robot;
    setText(byId("plain"), this.describe());
    if (robot === undefined || robot.pose === null) return;
    const { pose, motion, command } = robot;
    setText(byId("figure-place"), `${figure(pose.x)}, ${figure(pose.y)} m${robot.frame === "world" ? "" : " (odometry)"}`);
    setText(byId("figure-heading"), `${figure((pose.yaw * 180) / Math.PI, 0)}°`);
    setText(byId("figure-speed"), `${figure(motion.forward)} m/s`);
    setText(byId("figure-turn"), `${figure((motion.turnRate * 180) / Math.PI, 0)}°/s`);
    const wanted = command === null ? "–" : command.stops ? "stop" : command.silent ? "no wish" : `${figure(command.speed)} m/s`;
    setText(byId("figure-command"), wanted);
  }

  /** @param {{robot: Robot, text: string}} ended */
  end({ robot, text }) {
    notify(`${robot.name || "The robot"} ${text.replace(PLACES, "the place you chose")}`);
  }

  /**
   * Shows what becomes of an order.
   * @param {Promise<import("./connection.js").Answer>} answer
   * @param {string} done
   * @returns {Promise<boolean>}
   */
  async order(answer, done) {
    const { ok, error } = await answer;
    if (!ok) notify(error, "refused");
    else if (done !== "") notify(done, "done");
    return ok;
  }
}
