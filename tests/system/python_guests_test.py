#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs that Python steps, and components in Python.

    tests/system/python_guests_test.py BUILD
"""
import os
import pathlib
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

TREE = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(TREE / "python"))
os.environ["PATH"] = f"{BUILD / 'bin'}:{os.environ['PATH']}"

import orca_robots as orca  # noqa: E402: found by the lines above
from orca_robots.guests import PacketLine  # noqa: E402
from orca_robots.objects import Types  # noqa: E402

GOTO = str(TREE / "graphs/scout_goto.xml")


class Pusher(orca.Component):
    """Pushes a pose each 0.1 s."""

    type = "test.Pusher"
    lap_every = 0.1
    pose = orca.PushServer("RobotPose")
    step = orca.Param(0.5, unit="m", text="Way between two poses")
    laps = 0

    def work(self):
        self.laps += 1
        self.pose.push(x=self.laps * self.step, covariance=[0.25] * 9)


class Taker(orca.Component):
    """Takes poses, and pushes what it has seen."""

    type = "test.Taker"
    pose = orca.PushProxy("RobotPose")
    seen = orca.PushServer("RobotPose")

    def work(self):
        pose = self.pose.get_update_wait()
        self.seen.push(x=pose.x + self.random("noise").random(), y=self.now())


class WithGraph(unittest.TestCase):
    """Runs components of its own, in a graph of one `a` and one `b`, whose pushes `seen` shows."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="orca_guests_")
        self.addCleanup(folder.cleanup)
        self.graph = pathlib.Path(folder.name) / "g.xml"

    def system(self, a, b, edge='<connect from="a.pose" to="b.pose"/>', **options):
        self.graph.write_text(f'<graph name="g" version="1"><component name="a" type="{a.type}"/>'
                              f'<component name="b" type="{b.type}" autonomous="true"/>{edge}</graph>')
        return orca.System(self.graph, components=[a, b], **options)


class Stepping(WithGraph):
    def test_steps_and_looks_leave_the_run_as_it_is(self):
        alone = orca.run(GOTO, until=5).trace_hash
        with orca.System(GOTO, until=5) as system:
            self.assertIsNone(system.latest("base.OdometryPush"))
            self.assertEqual([system.step(0.7), system.step(0.05), system.step(1)], [0.7, 0.75, 1.75])
            self.assertEqual(system.latest("base.OdometryPush").creation_time.ns, 1_750_000_000)
            self.assertEqual(system.run().trace_hash, alone)
            self.assertIsNone(system.step(1))
            self.assertTrue(system.is_over)

    def test_a_stepped_run_is_recorded(self):
        file = self.graph.parent / "drive.mcap"
        with orca.System(GOTO, until=5, record=file) as system:
            system.step(1)
        self.assertEqual(orca.read_record(file, "base.OdometryPush").column("stamp")[-1], 1)

    def test_a_parameter_that_is_set_changes_the_run_the_same_way_each_time(self):
        def drive(margin):
            with orca.System(GOTO, until=20) as system:
                system.step(1)
                system.set("avoid.margin", margin)
                return system.run().trace_hash
        wide = drive("0.4 m")
        self.assertEqual(drive("40 cm"), wide)
        self.assertNotEqual(wide, orca.run(GOTO, until=20).trace_hash)

    def test_what_cannot_be_is_said(self):
        with orca.System(GOTO, until=5) as system:
            with self.assertRaisesRegex(orca.OrcaError, "no object leaves a component at \"base.Odometry\""):
                system.latest("base.Odometry")
            with self.assertRaisesRegex(orca.OrcaError, "did you mean \"margin\""):
                system.set("avoid.margim", 1)
            with self.assertRaisesRegex(orca.OrcaError, "above 0 s"):
                system.step(0)
        with self.assertRaisesRegex(orca.OrcaError, "G014: --set nix"):
            orca.System(GOTO, set={"nix": 1})

    def test_a_deployer_does_not_outlive_its_program(self):
        code = (f"import sys; sys.path.insert(0, {str(TREE / 'python')!r})\nimport orca_robots as orca, time\n"
                f"s = orca.System({GOTO!r}); s.step(1); print(s._deployer.pid, flush=True); time.sleep(60)")
        with subprocess.Popen([sys.executable, "-B", "-c", code], stdout=subprocess.PIPE, text=True) as program:
            deployer = int(program.stdout.readline())
            program.send_signal(signal.SIGKILL)
        deadline = time.monotonic() + 20
        while pathlib.Path(f"/proc/{deployer}/exe").exists() and time.monotonic() < deadline:
            try:
                os.readlink(f"/proc/{deployer}/exe")  # a zombie has none
            except OSError:
                break
            time.sleep(0.05)
        self.assertLess(time.monotonic(), deadline)


class Components(WithGraph):
    def test_two_components_in_python_repeat_bit_for_bit(self):
        runs = []
        for seed in (1, 1, 2):
            with self.system(Pusher, Taker, seed=seed, set={"a.step": "20 cm"}, until=2) as system:
                system.step(0.95)
                seen = system.latest("b.seen")
                runs.append((seen.x, system.run().trace_hash))
        self.assertEqual(runs[0], runs[1])
        self.assertNotEqual(runs[0], runs[2])
        self.assertTrue(1.8 <= runs[0][0] <= 3.0, runs[0])
        self.assertAlmostEqual(seen.y, 0.9)

    def test_parameters_change_between_laps(self):
        with self.system(Pusher, Taker) as system:
            system.step(0.55)
            before = system.latest("a.pose").x
            system.set("a.step", "2 m")
            system.step(0.1)
            after = system.latest("a.pose").x
        self.assertEqual(before / 0.5 + 1, after / 2)

    def test_an_exception_is_the_failure_of_the_component(self):
        class Breaking(Taker):
            type = "test.Breaking"

            def work(self):
                pose = self.pose.get_update_wait()
                if pose.x > 1:
                    raise ValueError("too far")

        with self.system(Pusher, Breaking, until=2) as system:
            done = system.run()
        self.assertFalse(done.ended_well)
        self.assertIn("ValueError: too far", done.log)
        self.assertIn("python_guests_test.py", done.log)
        self.assertRegex(done.log, r"\[     0\.[23]00\] error   b: work\(\)")

    def test_a_wrong_field_is_said_with_its_name(self):
        class Wrong(Pusher):
            type = "test.Wrong"

            def work(self):
                self.pose.push(**self.fields)

        for fields, said in (({"z": 1}, "RobotPose has no field 'z'; it has: "), ({"x": "far"}, "RobotPose.x cannot be 'far'"),
                             ({"covariance": [1.0]}, "RobotPose.covariance has 9 elements, not 1"),
                             ({"stamp": {"s": 1}}, "RobotPose.stamp has no field 's'")):
            Wrong.fields = fields
            with self.system(Wrong, Taker, until=1) as system:
                self.assertIn(said, system.run().log)

    def test_a_lap_that_ends_the_task_and_one_that_fails_it(self):
        class Done(Taker):
            type = "test.Done"

            def work(self):
                self.sleep(0.25)
                return self.done() if self.now() > 0.6 else None

        class Failed(Taker):
            type = "test.Failed"

            def work(self):
                return self.failed("no way")

        ends = '<connect from="a.pose" to="b.pose"/>'
        for kind, well in ((Done, True), (Failed, False)):
            with self.system(Pusher, kind, edge=ends, until=1) as system:
                done = system.run()
                self.assertEqual(done.ended_well, well, done.log)
        self.assertIn("no way", done.log)

    def test_it_asks_and_sends(self):
        class Asker(orca.Component):
            type = "test.Asker"
            robot = orca.QueryProxy("Ask", "Robot")
            wheels = orca.SendProxy("MotionCommand")
            found = orca.PushServer("RobotPose")
            odometry = orca.PushProxy("Odometry")

            def work(self):
                assert self.odometry.latest() is None or self.odometry.connected()
                self.odometry.get_update_wait(limit=1)
                self.found.push(x=self.robot.query().radius)
                self.wheels.send(direction=0.0, speed=0.2)

        graph = orca.Graph(TREE / "graphs/scout_goto.xml")
        for name in ("command", "goto", "avoid", "fuser"):
            graph.remove(name)
        graph.add("asker", "test.Asker", autonomous="true")
        for ends in (("asker.robot", "base.RobotQuery"), ("asker.wheels", "base.MotionCommandSend"), ("base.OdometryPush", "asker.odometry")):
            graph.connect(*ends)
        text = pathlib.Path(graph.write(self.graph)).read_text(encoding="utf-8")
        self.graph.write_text(text.replace("../sim", str(TREE / "sim")).replace(' ends="command"', ""), encoding="utf-8")
        with orca.System(self.graph, components=[Asker]) as system:
            system.step(3)
            self.assertGreater(system.latest("asker.found").x, 0.1)
            self.assertGreater(system.latest("base.OdometryPush").x, 0.2)

    def test_it_is_asked_and_is_sent_to(self):
        class Server(orca.Component):
            type = "test.Server"
            goal = orca.SendServer("GoalPoint")
            robot = orca.QueryServer("Ask", "Robot")
            last = orca.PushServer("RobotPose")
            taken = 0

            def on_goal(self, goal):
                if goal.name == "nowhere":
                    return self.failed("there is no such place")
                self.taken += goal.coordinate.point.x

            def on_robot(self, question):
                return {"radius": self.taken} if question.about == "mine" else self.failed("whose?")

            def work(self):
                self.sleep(10)

        class Client(orca.Component):
            type = "test.Client"
            lap_every = 0.1
            goal = orca.SendProxy("GoalPoint")
            robot = orca.QueryProxy("Ask", "Robot")
            seen = orca.PushServer("RobotPose")

            def work(self):
                self.goal.send(name="a", coordinate={"point": {"x": 2.0}})
                self.goal.send(name="nowhere")
                try:
                    self.robot.query()
                except orca.OrcaError as error:
                    self.log(error)
                self.seen.push(x=self.robot.query(about="mine").radius)

        ends = '<connect from="b.goal" to="a.goal"/><connect from="b.robot" to="a.robot"/>'
        with self.system(Server, Client, edge=ends, until=1) as system:
            system.step(0.35)
            laps = system.latest("b.seen").x / 2
            done = system.run()
        self.assertEqual(laps, round(laps))
        self.assertGreaterEqual(laps, 3)
        self.assertTrue(done.ended_well, done.log)
        self.assertIn("whose?", done.log)
        self.assertIn("there is no such place", done.log)

    def test_a_lap_without_end_ends_the_run(self):
        class Endless(Taker):
            type = "test.Endless"

            def work(self):
                self.pose.get_update_wait()
                time.sleep(30)

        start = time.monotonic()
        with self.system(Pusher, Endless, until=2) as system:
            system.step(1)
        self.assertLess(time.monotonic() - start, 20)
        self.assertFalse(system.result.ended_well)
        self.assertRegex(system.result.log, r"b: .*for more than 2 s")


class Checking(WithGraph):
    def test_ports_and_parameters_are_checked_like_those_of_a_plugin(self):
        self.graph.write_text('<graph name="g" version="1">\n<component name="a" type="test.Pusher">\n<param name="stepp" value="1 m"/>\n'
                              '</component>\n<component name="b" type="test.Taker" autonomous="true"/>\n</graph>')
        faults = orca.check(self.graph, components=[Pusher, Taker])
        self.assertEqual([(fault.line, fault.code) for fault in faults if fault.severity == "error"],
                         [(3, "G029"), (5, "G025")])  # no such parameter; a port that must be connected
        self.assertIn('did you mean "step"', str(faults[0]))

    def test_a_type_that_cannot_be_is_refused(self):
        class Wrong(Pusher):
            type = "test.Wrong"
            pose = orca.PushServer("RobotPos")

        with self.assertRaisesRegex(orca.OrcaError, 'test.Wrong: port "pose": there is no object type "RobotPos"; did you mean "RobotPose"'):
            orca.check(GOTO, components=[Wrong])

        class Nameless(orca.Component):
            pass

        with self.assertRaisesRegex(orca.OrcaError, "Nameless has no type"):
            orca.check(GOTO, components=[Nameless])


class Protocol(unittest.TestCase):
    """What the deployer makes of a program that is none of Orca's."""

    def refusal_of(self, *packets, raw=b""):
        here, there = socket.socketpair()
        line = PacketLine(here)
        with subprocess.Popen([BUILD / "bin/deployer", GOTO, "--check", "--guest", str(there.fileno())], pass_fds=[there.fileno()],
                              stderr=subprocess.PIPE, text=True) as deployer:
            there.close()
            for packet in packets:
                line.send(*packet)
            here.sendall(raw)
            here.shutdown(socket.SHUT_WR)
            said = deployer.communicate(timeout=60)[1]
        line.close()
        self.assertEqual(deployer.returncode, 2, said)
        return said

    def test_other_versions_and_rubbish_are_refused(self):
        hello = ("guest", "1")
        self.assertIn("does not belong to this version", self.refusal_of(("guest", "0")))
        self.assertIn("does not belong to this version", self.refusal_of(raw=b"\xff" * 64))
        self.assertIn("has ended before", self.refusal_of(hello))
        self.assertIn("has ended before", self.refusal_of(hello, raw=b"\x08\0\0\0\xff\0\0\0abcd"))
        self.assertIn("a packet \"port\" of 7 words", self.refusal_of(hello, ["port"] + [""] * 6))
        self.assertIn("a packet \"nix\" of 1 words", self.refusal_of(hello, ["nix"]))
        self.assertIn("a port cannot be a Pipe", self.refusal_of(hello, ["type", "a.B", "", ""], ["port", "Pipe", "p", "RobotPose", "", "", ""]))
        self.assertIn("lap_every", self.refusal_of(hello, ["type", "a.B", "period", "-1"]))
        self.assertIn("32 component types", self.refusal_of(hello, *[["type", f"a.B{i}", "", ""] for i in range(33)]))

    def test_layouts_of_all_shapes_are_read_back(self):
        types = Types({"A": "A:B{flag:bool,kind:Kind(ONE,TWO),small:octet,list:sequence<C{x:double {m},name:string}> {m},"
                            "grid:double[2] {m2, m rad},long:int64 {ns},words:sequence<string>}"})
        made = types.make("A", {"flag": True, "kind": "TWO", "small": 7, "list": [{"x": 0.1, "name": "ä"}, {"name": ""}],
                                "grid": [1.5, -2.0], "long": -3, "words": ["a", ""]})
        read = types.decode("A", types.encode(made))
        self.assertEqual(repr(read), "A(flag=True, kind='TWO', small=7, list=[C(x=0.1, name='ä'), C(x=0.0, name='')], grid=[1.5, -2.0], "
                                     "long=-3, words=['a', ''])")
        self.assertEqual(types.encode(read), types.encode(made))


if __name__ == "__main__":
    unittest.main()
