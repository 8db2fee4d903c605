#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A run in virtual time that people look at: its time stands, steps and passes as they order, and its trace hash stays.

    tests/system/view/pace_test.py [-k PART_OF_A_CASE'S_NAME] BUILD_FOLDER
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time
import unittest

from view_case import BUILD, ROLES, TREE, await_that
from websocket import WebSocket

GRAPH = "scout_goto_processes"
UNTIL = 20  # [s] of the run; it reaches its first goal before
NO_HURRY = 300  # [s] for whatever a test waits for: it is there to end a run that hangs


def hash_of(output):
    return re.search(r"^trace-hash ([0-9a-f]{16})$", output, re.MULTILINE)[1]


class Run:
    """A run in virtual time, by a deployer, and those who look at it."""

    def __init__(self, case, *options, until=UNTIL):
        folder = tempfile.TemporaryDirectory(prefix="orca_pace_")
        case.addCleanup(folder.cleanup)
        self.case = case
        self.folder = pathlib.Path(folder.name)
        self.environment = os.environ | {"XDG_RUNTIME_DIR": folder.name}
        self.deployer = subprocess.Popen(
            [BUILD / "bin" / "deployer", TREE / "graphs" / f"{GRAPH}.xml", "--clock", "virtual", "--until", f"{until}s",
             "--no-progress", "--log", "error", *options],
            env=self.environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        case.addCleanup(self.kill)
        case.addCleanup(self.deployer.stderr.close)

    def kill(self):
        self.deployer.kill()
        self.deployer.wait()
        self.deployer.stdout.close()

    def orcactl(self, *words):
        return subprocess.run([BUILD / "bin" / "orcactl", *words], env=self.environment, capture_output=True, text=True,
                              timeout=NO_HURRY)

    def await_system(self):
        await_that(lambda: self.orcactl("ps").stdout.count(" WORK ") >= 6, "all components work", NO_HURRY)
        return self

    def rows(self, *words):
        done = self.orcactl("--json", *words)
        self.case.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def pace(self, *words):
        """Orders a pace, if any, and returns what is so then."""
        return self.rows("pace", *words)[0]

    def start_view(self):
        view = subprocess.Popen([BUILD / "bin" / "orcaview", GRAPH, "--port", "0", "--web", TREE / "web"], env=self.environment,
                                stdout=subprocess.PIPE, text=True)
        self.case.addCleanup(view.stdout.close)
        self.case.addCleanup(view.wait)
        self.case.addCleanup(view.terminate)
        addresses = [view.stdout.readline() for _ in ROLES]
        self.port = int(re.search(r":(\d+)/", addresses[0])[1])
        self.tokens = {role: address.strip().split("token=")[1] for role, address in zip(ROLES, addresses)}
        return self

    def page(self):
        """A page that looks at all ports, and asks for the walls as a browser does; it reads only what it is made to."""
        page = WebSocket(self.port, self.tokens["change"], limit=NO_HURRY)
        self.case.addCleanup(page.socket.close)
        self.case.assertEqual(page.receive()["op"], "hello")
        page.send(op="ask", id=1, command="ports")
        ports = [row["port"] for row in json.loads(page.answer(1)["text"])]
        self.case.assertIn("world.ScenePush", ports)
        for number, port in enumerate(ports, 10):
            page.send(op="look", id=number, port=port)
        page.send(op="query", id=2, port="world.PlanQuery", xml="<Ask/>")
        self.case.assertTrue(page.answer(2)["ok"])
        return page

    def end(self):
        """Waits for the end, as fast as it comes, and returns the trace hash."""
        if self.deployer.poll() is None:
            self.orcactl("pace", "fast")
        output, errors = self.deployer.communicate(timeout=NO_HURRY)
        self.case.assertEqual(self.deployer.returncode, 0, errors)
        return hash_of(output)


class Pace(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        alone = subprocess.run([BUILD / "bin" / "deployer", TREE / "graphs" / f"{GRAPH}.xml", "--clock", "virtual", "--until",
                                f"{UNTIL}s", "--no-progress", "--log", "error"], stdin=subprocess.DEVNULL, capture_output=True,
                               text=True, timeout=NO_HURRY)
        assert alone.returncode == 0, alone.stderr
        cls.alone = hash_of(alone.stdout)

    # ---- time

    def test_a_paused_run_stands_and_a_step_is_exact(self):
        run = Run(self, "--pace", "0").await_system()
        self.assertEqual(run.pace(), {"time": 0.0, "pace": 0.0, "paused": True})
        self.assertEqual(run.pace(), run.pace())
        self.assertEqual(run.rows("step", "100ms")[0]["time"], 0.1)
        self.assertEqual(run.rows("step", "0.1s")[0]["time"], 0.2)
        time.sleep(0.2)
        self.assertEqual(run.pace(), {"time": 0.2, "pace": 0.0, "paused": True})
        self.assertEqual(run.end(), self.alone)

    def test_a_pause_between_two_moments_stands_too(self):
        run = Run(self, "--pace", "1").await_system()
        await_that(lambda: run.pace()["time"] > 0.2, "time passes", NO_HURRY)
        paused = run.rows("pause")[0]
        self.assertTrue(paused["paused"])
        self.assertEqual(run.pace(), paused)
        stepped = run.rows("step", "100ms")[0]
        self.assertEqual(round(stepped["time"] - paused["time"], 9), 0.1)
        self.assertEqual(run.end(), self.alone)

    def test_a_factor_of_ten_is_about_ten_times_as_fast(self):
        run = Run(self, "--pace", "10", until=2000).await_system()
        first, began = run.pace(), time.monotonic()
        time.sleep(1.0)
        last = run.pace()
        # At least nothing like the clock itself, and never faster than ordered; a busy machine may be slower.
        self.assertGreater(last["time"] - first["time"], 1.5)
        self.assertLess(last["time"] - first["time"], 10.0 * (time.monotonic() - began + 0.5))
        self.assertEqual(run.orcactl("stop").returncode, 0)

    def test_addresses_have_their_roles_in_virtual_time_too(self):
        run = Run(self, "--pace", "1", until=2000).await_system().start_view()
        for role, may_hasten, may_set in (("observe", False, False), ("operate", True, False), ("change", True, True)):
            with WebSocket(run.port, run.tokens[role]) as page:
                page.send(op="ask", id=1, command="pace", words=["2"])
                page.send(op="ask", id=2, command="set", words=["goto.max_speed", "0.4 m/s"])
                self.assertEqual((page.answer(1)["ok"], page.answer(2)["ok"]), (may_hasten, may_set), role)

    def test_orders_that_cannot_be_are_refused(self):
        run = Run(self, "--pace", "0").await_system()
        for words, why in (("pace -1", "pace"), ("pace 0.001", "0.01"), ("pace soon", "fast"), ("step 0s", "above 0 s"),
                           ("step soon", "soon"), ("apply x.xml", "--change"), ("restart main", "one process")):
            done = run.orcactl(*words.split())
            self.assertEqual((done.returncode, why in done.stderr), (1, True), f"{words}: {done.stderr}")
        self.assertEqual(run.end(), self.alone)

    def test_real_time_has_no_pace(self):
        refused = subprocess.run([BUILD / "bin" / "deployer", TREE / "graphs" / f"{GRAPH}.xml", "--pace", "1"],
                                 capture_output=True, text=True, timeout=NO_HURRY)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("--clock virtual", refused.stderr)

    def test_a_paused_run_is_ended_by_a_signal(self):
        run = Run(self, "--pace", "0").await_system()
        run.deployer.terminate()
        output, errors = run.deployer.communicate(timeout=NO_HURRY)
        self.assertEqual(run.deployer.returncode, 0, errors)
        self.assertIn("trace-hash", output)

    # ---- who looks on changes nothing

    def test_a_page_changes_no_trace_hash(self):
        run = Run(self, "--pace", "0").await_system().start_view()
        page = run.page()
        run.pace("10")
        seen = set()
        while len(seen) < 5:
            message = page.receive()
            if isinstance(message, bytes):
                seen.add(message[4:8])
        self.assertEqual(run.end(), self.alone)

    def test_a_page_that_stalls_changes_no_trace_hash(self):
        run = Run(self, "--pace", "0").await_system().start_view()
        run.page()
        self.assertEqual(run.end(), self.alone)

    def test_ten_pages_and_a_recorder_with_pauses_and_steps_change_no_trace_hash(self):
        run = Run(self, "--pace", "0").await_system().start_view()
        pages = [run.page() for _ in range(9)]
        recorder = subprocess.Popen([BUILD / "bin" / "orcactl", "record", run.folder / "run.mcap"], env=run.environment,
                                    stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.addCleanup(recorder.stderr.close)
        self.addCleanup(recorder.kill)
        await_that((run.folder / "run.mcap").exists, "the recorder has begun", NO_HURRY)
        for _ in range(5):
            run.rows("step", "330ms")
        pages.append(run.page())  # comes in the middle
        run.pace("20")
        await_that(lambda: run.pace()["time"] > 4.0, "time passes", NO_HURRY)
        run.rows("pause")
        for page in pages[:3]:
            page.socket.close()  # and these leave
        run.rows("step", "1s")
        self.assertEqual(run.end(), self.alone)
        _, errors = recorder.communicate(timeout=NO_HURRY)
        self.assertEqual(recorder.returncode, 0, errors)

    def test_an_order_that_changes_the_world_changes_the_trace_hash(self):
        run = Run(self, "--pace", "0").await_system()
        run.rows("step", "1s")
        done = run.orcactl("set", "goto.max_speed", "0.1 m/s")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotEqual(run.end(), self.alone)

    # ---- the deployer's page

    def test_the_deployer_starts_a_page_for_a_run_in_virtual_time(self):
        run = Run(self, "--view")
        self.assertRegex(run.deployer.stderr.readline(), r"http://127\.0\.0\.1:\d+/#token=")
        run.await_system()
        self.assertEqual(run.pace()["pace"], 1.0)
        self.assertEqual(run.end(), self.alone)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:-1], verbosity=2)
