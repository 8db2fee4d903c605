#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""--record, read back as a user would: with the csv module.

    tests/system/record_test.py DEPLOYER
"""
import csv
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

TREE = pathlib.Path(__file__).resolve().parents[2]
DEPLOYER = sys.argv.pop()
GRAPH = str(TREE / "graphs" / "scout_goto.xml")
EXECUTOR = ["--executor", "baton"]  # works with every sanitizer
VIRTUAL = ["--clock", "virtual", *EXECUTOR]
POSE, SONAR, MOTION = "localizer.RobotPosePush", "base.SonarRangeReadingsPush", "fuser.base"


def run(*words, **more):
    return subprocess.run([DEPLOYER, *words], capture_output=True, text=True, timeout=300, **more)


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file, strict=True))


class Record(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="orca_record_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def file(self, name):
        return str(self.folder / name)

    def run_well(self, *words):
        done = run(GRAPH, *VIRTUAL, "--until", "5s", *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def test_every_push_is_a_row(self):
        trace, poses = self.file("trace"), self.file("poses.csv")
        self.run_well("--record", f"{poses}={POSE}", "--trace", trace)
        rows = table(poses)
        self.assertEqual(list(rows[0])[:2], ["stamp", "port"])
        self.assertEqual({row["port"] for row in rows}, {POSE})
        self.assertEqual([int(row["seq"]) for row in rows], list(range(1, len(rows) + 1)))
        lines = pathlib.Path(trace).read_text(encoding="utf-8").splitlines()
        delivered = [line.split() for line in lines if " RobotPose from localizer" in line]
        self.assertEqual({int(words[4]) for words in delivered if words[2] == "goto"}, {int(row["seq"]) for row in rows})
        stamps = [float(row["stamp"]) for row in rows]
        self.assertEqual(stamps, sorted(stamps))
        self.assertEqual(rows[0]["x"], "1")  # the place "start" of the world
        self.assertNotEqual(rows[0]["x"], rows[-1]["x"])

    def test_numbers_are_exact_and_sequences_spread(self):
        sonar = self.file("sonar.csv")
        self.run_well("--record", f"{sonar}={SONAR}")
        rows = table(sonar)
        names = [name for name in rows[0] if name.startswith("ranges[")]
        self.assertEqual(names, [f"ranges[{i}]" for i in range(16)] + ["ranges[rest]"])
        for row in rows:
            self.assertEqual(row["ranges[rest]"], "")
            for name in names[:-1]:
                number = float(row[name])
                self.assertGreater(number, 0.0)
                self.assertLessEqual(len(row[name]), len(repr(number)))  # the shortest form that gives it back

    def test_ports_of_several_types_share_a_file(self):
        both = self.file("both.csv")
        self.run_well("--record", f"{both}={POSE},{MOTION}")
        rows = table(both)
        self.assertEqual({row["port"] for row in rows}, {POSE, MOTION})
        for row in rows:
            self.assertEqual(row["x"] == "", row["port"] == MOTION)
            self.assertEqual(row["speed"] == "", row["port"] == POSE)

    def test_same_seed_same_bytes_and_the_hash_is_that_of_a_run_without(self):
        plain = self.run_well().stdout
        for name in ("a.csv", "b.csv"):
            done = self.run_well("--record", f"{self.file(name)}={POSE},{SONAR},{MOTION}")
            self.assertEqual(done.stdout, plain)
        first = (self.folder / "a.csv").read_bytes()
        self.assertGreater(len(first), 10000)
        self.assertEqual(first, (self.folder / "b.csv").read_bytes())
        other = self.run_well("--seed", "2", "--record", f"{self.file('c.csv')}={POSE},{SONAR},{MOTION}")
        self.assertEqual(other.returncode, 0)
        self.assertNotEqual(first, (self.folder / "c.csv").read_bytes())

    def test_real_time_records_too(self):
        poses, commands = self.file("poses.csv"), self.file("commands.csv")
        done = run(GRAPH, "--until", "1s", "--record", f"{poses}={POSE}", "--record", f"{commands}=base.MotionCommandSend")
        self.assertEqual(done.returncode, 0, done.stderr)
        for path in (poses, commands):
            rows = table(path)
            self.assertGreater(len(rows), 3)
            for row in rows:
                self.assertTrue(0.0 <= float(row["stamp"]) < 1.5, row["stamp"])

    def test_renamed_and_unknown_ports(self):
        done = run(GRAPH, "--check", "--record", f"x.csv=localizer.RobotPosPush,fusr.base,{POSE}", "--record", "y.csv=goto",
                   "--set", "avoid.margn=1")
        self.assertEqual(done.returncode, 2)
        for message in ('command line: error G017: component "localizer": port "RobotPosPush" does not exist; "localizer" has '
                        'in: RobotPoseQuery; out: RobotPosePush; did you mean "RobotPosePush"?',
                        'command line: error G016: --record fusr.base: there is no component "fusr"; did you mean "fuser"?',
                        'command line: error G018: --record: "goto" is no port: write component.port; "goto" has ',
                        "margn"):
            self.assertIn(message, done.stderr)
        self.assertFalse(os.path.exists("x.csv"))

    def test_wrong_options_are_refused(self):
        for value in ("poses.txt=" + POSE, "poses.csv", "=", "poses.csv="):
            done = run(GRAPH, "--check", "--record", value)
            self.assertEqual(done.returncode, 2, value)
            self.assertIn("C002", done.stderr)
        done = run(GRAPH, "--check", "--record", "a.csv=" + POSE, "--record", "a.csv=" + SONAR)
        self.assertIn('"a.csv" is given twice', done.stderr)

    def test_no_output_overwrites_another_or_an_input(self):
        one = self.file("one.csv")
        link = self.folder / "two.csv"
        link.symlink_to(one)
        graph = self.folder / "graph.csv"
        graph.write_text((TREE / "graphs" / "scout_goto.xml").read_text().replace("../sim", str(TREE / "sim")))
        before = graph.read_text()
        for words, message in ((["--trace", one, "--record", f"{link}={POSE}"], "the recording would overwrite the trace"),
                               (["--record", f"{one}={POSE}", "--record", f"{link}={SONAR}"],
                                "the recording would overwrite the recording"),
                               (["--record", f"{graph}={POSE}"], "the recording would overwrite a file that has been read")):
            done = run(str(graph), *VIRTUAL, "--until", "1s", *words)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(message, done.stderr)
            self.assertEqual(done.stdout, "")
        self.assertEqual(graph.read_text(), before)

    def test_a_full_disk_is_an_error(self):
        full = self.folder / "full.csv"
        full.symlink_to("/dev/full")
        for clock in (VIRTUAL, []):
            done = run(GRAPH, *clock, "--until", "1s", "--record", f"{full}={POSE}")
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn("cannot write the recording: No space left on device", done.stderr)

    def test_a_run_that_is_stopped_leaves_whole_lines(self):
        poses = self.file("poses.csv")
        with subprocess.Popen([DEPLOYER, GRAPH, "--record", f"{poses}={POSE}", "--trace", "/dev/stdout"], stdout=subprocess.PIPE,
                              stderr=subprocess.DEVNULL, text=True) as program:
            for line in program.stdout:
                if " deliver goto localizer 20 " in line:
                    break
            program.terminate()
            program.communicate(timeout=30)
            self.assertEqual(program.returncode, 0)
        self.assertGreaterEqual(len(table(poses)), 20)
        self.assertTrue(pathlib.Path(poses).read_text().endswith("\n"))


if __name__ == "__main__":
    unittest.main()
