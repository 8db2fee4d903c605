// SPDX-License-Identifier: GPL-3.0-or-later
import assert from "node:assert/strict";
import test from "node:test";

import { clientsXml, goalText, goalXml, motionXml, namedGoal, poseXml, tripXml } from "../../../web/drive.js";
import { between, Camera, compose, ellipse, PoseHistory, transform, wrap } from "../../../web/geometry.js";
import { changeOf } from "../../../web/world_change.js";
import { conesOf, EchoMemory, Robot, scanOf } from "../../../web/world_model.js";

const near = (a, b, within = 1e-9) => assert.ok(Math.abs(a - b) <= within, `${a} is not ${b}`);

test("angles are wrapped into (-pi, pi]", () => {
  near(wrap(3 * Math.PI), Math.PI);
  near(wrap(-Math.PI), Math.PI);
  near(wrap(Math.PI + 0.1), -Math.PI + 0.1);
});

test("a point of a turned frame is found in the world", () => {
  const { x, y } = transform({ x: 1, y: 2, yaw: Math.PI / 2 }, { x: 3, y: 1 });
  near(x, 0);
  near(y, 5);
  const { yaw } = compose({ x: 0, y: 0, yaw: 3 }, { x: 0, y: 0, yaw: 3 });
  near(yaw, 6 - 2 * Math.PI);
});

test("between two poses the robot turns the short way", () => {
  near(between({ x: 0, y: 0, yaw: 3.1 }, { x: 2, y: 0, yaw: -3.1 }, 0.5).yaw, Math.PI, 1e-9);
});

test("the ellipse of a covariance has the axes of its matrix", () => {
  const turned = Math.PI / 6;
  const [c, s] = [Math.cos(turned), Math.sin(turned)];
  const [a, b] = [0.04, 0.01];  // variances along and across
  const covariance = [a * c * c + b * s * s, (a - b) * c * s, 0, (a - b) * c * s, a * s * s + b * c * c, 0, 0, 0, 0.0009];
  const found = ellipse(covariance, 2);
  near(found.major, 0.4);
  near(found.minor, 0.2);
  near(found.yaw, turned);
  near(found.spread, 0.06);
  assert.equal(ellipse(new Array(9).fill(0), 2), null);
});

test("the camera shows a place where it finds it again, and zooms about the pointer", () => {
  const camera = new Camera();
  Object.assign(camera, { width: 800, height: 600, x: 3, y: -2 });
  const pixel = camera.toScreen({ x: 4, y: -1 });
  assert.deepEqual(pixel, { x: 460, y: 240 });
  camera.zoom(2, pixel);
  const back = camera.toWorld(pixel);
  near(back.x, 4);
  near(back.y, -1);
  camera.fit({ min: { x: 0, y: 0 }, max: { x: 10, y: 2 } });
  const corner = camera.toScreen({ x: 10, y: 2 });
  assert.ok(corner.x <= 800 && corner.y >= 0);
});

test("the history knows where the robot was between two poses, and begins anew with the clock", () => {
  const history = new PoseHistory();
  assert.equal(history.at(1), null);
  history.add(10, { x: 0, y: 0, yaw: 0 });
  history.add(11, { x: 2, y: 0, yaw: 0 });
  near(history.at(10.25).x, 0.5);
  near(history.at(5).x, 0);
  near(history.at(99).x, 2);
  history.add(3, { x: 7, y: 0, yaw: 0 });
  near(history.at(10.25).x, 7);
});

function drivingRobot() {
  const robot = new Robot("");
  robot.moveTo({ x: 0, y: 0, yaw: 0 }, 100);
  robot.moveTo({ x: 1, y: 0, yaw: Math.PI / 2 }, 101);
  return robot;
}

test("a cone is drawn from where its sonar fired", () => {
  const mount = { position: { x: 0.2, y: 0, z: 0 }, rotation: { yaw: 0 } };
  const reading = { ranges: [1.5, 6.5], max_range: 6.5, half_lobe: 0.2, poses: [mount, mount], stamps: [{ ns: 100e9 }, { ns: 101e9 }] };
  const [first, second] = conesOf(drivingRobot(), reading);
  near(first.pose.x, 0.2);
  assert.ok(first.echo);
  near(second.pose.x, 1);
  near(second.pose.y, 0.2);
  assert.ok(!second.echo);
});

test("a scan of a robot that turns meanwhile is drawn unbent", () => {
  const scan = { ranges: [2, 2, 9], max_range: 8, pose: { position: { x: 0, y: 0 }, rotation: { yaw: 0 } }, stamp: { ns: 101e9 }, angle_start: -0.5, angle_increment: 0.5, time_increment: 0 };
  const { points, hits } = scanOf(drivingRobot(), scan);
  near(points[2], 1);  // straight ahead, which is up
  near(points[3], 2);
  assert.deepEqual([...hits], [1, 1, 0]);
});

test("echoes of one place are kept once, and the oldest are forgotten", () => {
  const memory = new EchoMemory();
  for (let i = 0; i < 5000; ++i) memory.add({ x: i, y: 0 });
  memory.add({ x: 4999.01, y: 0 });
  assert.equal(memory.cells.size, 4000);
  assert.ok(!memory.cells.has("0 0"));
});

test("orders are written as Command and the ports read them", () => {
  assert.equal(goalText([{ x: 1, y: 2 }, { x: 3.25, y: -4 }], Math.PI / 2, "place_1"), "place_1: 1.000 2.000 > 3.250 -4.000 @ 90.0");
  assert.equal(goalText([{ x: 1, y: 2 }], null, "place_2"), "place_2: 1.000 2.000");
  assert.match(goalXml({ x: 1, y: 2 }, 1, "place_1"), /use_orientation="true".*<coordinate x="1.000" y="2.000"\/>.*yaw="1.0000"/);
  assert.ok(!goalXml({ x: 1, y: 2 }, null, "place_1").includes("orientation"));
  assert.equal(poseXml({ x: 1, y: 2, yaw: 3 }), '<RobotPose x="1.000" y="2.000" orientation="3.0000"/>');
  assert.equal(clientsXml(["a", 'b"<&']), '<ClientList><clients value="a"/><clients value="b&quot;&lt;&amp;"/></ClientList>');
  assert.equal(tripXml('a: 1 2 > "b"'), '<TripOrder kind="TRIP_GO" rounds="1"><goals value="a: 1 2 > &quot;b&quot;"/></TripOrder>');
  assert.equal(motionXml(0, 0), '<MotionCommand kind="FULLSTOP"/>');
  assert.match(motionXml(0.2, -0.5), /kind="NORMAL" steering="BY_TURN_RATE" speed="0.200" turn_rate="-0.500"/);
});

test("the end of a named goal is found, with via points, doors and directions before and behind it", () => {
  assert.deepEqual(namedGoal("kitchen: 3.6 6 > 4.2 9.8")?.end, { x: 4.2, y: 9.8 });
  assert.deepEqual(namedGoal("dock: 1 2 > 5 4.5 @ 90")?.end, { x: 5, y: 4.5 });
  assert.deepEqual(namedGoal("gate: door 2 4.5 90 0.95")?.end, { x: 2, y: 4.5 });
  assert.equal(namedGoal("hall > kitchen"), null);
  assert.equal(namedGoal("room: hall > kitchen"), null);
});

const scene = {
  robots: [{ name: "Dewey", x: 0, y: 0, yaw: 1, radius: 0.2, outline: [], silent: [] }],
  people: [],
  obstacles: [{ name: "box1", x: 3, y: 0, yaw: 0, radius: 0, outline: [{ a: { x: 0.3, y: 0.2 }, b: { x: -0.3, y: 0.2 } }], movable: true }, { name: "block", x: 6, y: 0, yaw: 0, radius: 0.2, outline: [], movable: false }],
  doors: [{ name: "gate", leaf: { a: { x: 5, y: 4 }, b: { x: 6, y: 4 } }, open: false }, { name: "hatch", leaf: { a: { x: 5, y: 8 }, b: { x: 5, y: 9 } }, open: true }],
};

test("a hand on free floor puts a box, with a name of its own", () => {
  assert.equal(changeOf(scene, { x: 1.5, y: 2 }, { x: 1.5, y: 3 }, false),
    '<WorldChange kind="PUT_OBSTACLE" name="box2" x="1.500" y="2.000" yaw="1.571" length="0.600" width="0.400"/>');
});

test("a hand moves what it takes hold of, by as much as it is pulled", () => {
  assert.equal(changeOf(scene, { x: 3.2, y: 0.1 }, { x: 4.2, y: 1.1 }, false), '<WorldChange kind="MOVE_OBSTACLE" name="box1" x="4.000" y="1.000" yaw="0.000"/>');
  assert.equal(changeOf(scene, { x: 0.1, y: 0 }, { x: 0.1, y: -2 }, false), '<WorldChange kind="CARRY_ROBOT" name="Dewey" x="0.000" y="-2.000" yaw="1.000"/>');
});

test("a hand on the leaf of a door opens it, or shuts it if it is open", () => {
  assert.equal(changeOf(scene, { x: 5.5, y: 4.1 }, { x: 5.5, y: 4.1 }, false), '<WorldChange kind="OPEN_DOOR" name="gate"/>');
  assert.equal(changeOf(scene, { x: 5.1, y: 8.5 }, { x: 5.3, y: 8.5 }, false), '<WorldChange kind="SHUT_DOOR" name="hatch"/>');
  assert.match(changeOf(scene, { x: 5.5, y: 4.5 }, { x: 5.5, y: 4.5 }, false), /PUT_OBSTACLE/);
});

test("with Shift a hand takes an obstacle away, but no robot, no door and nothing that stands fast", () => {
  assert.equal(changeOf(scene, { x: 3, y: 0 }, { x: 3, y: 0 }, true), '<WorldChange kind="TAKE_OBSTACLE" name="box1"/>');
  assert.equal(changeOf(scene, { x: 0, y: 0 }, { x: 0, y: 0 }, true), null);
  assert.equal(changeOf(scene, { x: 6, y: 0 }, { x: 6, y: 0 }, true), null);
  assert.equal(changeOf(scene, { x: 5.5, y: 4 }, { x: 5.5, y: 4 }, true), null);
});
