#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Installs the build into a folder, and uses it from there, without the source tree and the build.

    tests/system/installation_test.py BUILD
"""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from page_reader import BUILD, TREE, Reader, without_tree


class Installation(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.mkdtemp(prefix="orca_installation_")
        cls.addClassCleanup(shutil.rmtree, scratch)
        cls.orca = pathlib.Path(scratch) / "orca"
        done = subprocess.run(["cmake", "--install", BUILD, "--prefix", cls.orca], capture_output=True, text=True, timeout=120)
        assert done.returncode == 0, done.stderr

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="orca_elsewhere_")
        self.addCleanup(shutil.rmtree, self.folder)

    def call(self, program, *words):
        """Runs an installed program in an empty folder. Returns all that it has printed."""
        done = subprocess.run([*without_tree(), self.orca / "bin" / program, *words], cwd=self.folder, capture_output=True, text=True,
                              timeout=120, env=dict(os.environ, XDG_RUNTIME_DIR=self.folder))
        self.assertEqual(done.returncode, 0, f"{program} {' '.join(words)}: {done.stdout}{done.stderr}")
        return done.stdout + done.stderr

    def test_no_file_names_the_source_tree_or_the_build(self):
        files = [file for file in self.orca.rglob("*") if file.is_file()]
        self.assertGreater(len(files), 500)
        for file in files:
            for folder in {TREE, BUILD}:
                self.assertNotIn(os.fsencode(folder), file.read_bytes(), file)

    def test_the_deployer_drives_a_shipped_graph_in_both_kinds_of_time(self):
        self.assertIn("arrived meeting", self.call("deployer", "graphs/scout_goto.xml", "--clock", "virtual"))
        self.call("deployer", "graphs/scout_goto.xml", "--until", "1s")  # in a process of its own, with its control socket

    def test_each_shipped_graph_is_right_where_it_is_installed(self):
        graphs = {path.name for path in (self.orca / "share/orca/graphs").glob("*.xml")}
        self.assertGreater(len(graphs), 30)
        needs_a_file = {"intel_log.xml", "localize_log.xml", "replay.xml", "scout_hospital.xml"}  # a log, a recording or a map, which is not shipped
        for graph in sorted(graphs - needs_a_file):
            self.call("deployer", f"graphs/{graph}", "--check")

    def test_an_experiment_is_found_and_right(self):
        self.assertIn("no errors", self.call("simbatch", "sim/experiments/narrow_door.xml", "--check"))

    def test_the_other_programs_find_what_belongs_to_them(self):
        self.assertIn("orca.hw.P2os", self.call("deployer", "--types"))
        self.assertIn("orcaview", self.call("orcaview", "--help"))
        self.assertTrue((self.orca / "share/orca/web/index.html").exists())
        for program in sorted(path.name for path in (self.orca / "bin").iterdir()):
            self.assertTrue((self.orca / f"share/man/man1/{program}.1").exists(), program)
            self.assertIn(f"_{program} {program}", (self.orca / f"share/bash-completion/completions/{program}").read_text())

    def test_python_finds_the_package_and_the_package_the_programs(self):
        code = "import orca_robots as orca\nwith orca.System('graphs/scout_goto.xml') as s: print(s.step(1), s.latest('base.OdometryPush').seq)"
        done = subprocess.run([*without_tree(), "python3", "-B", "-c", code], cwd=self.folder, capture_output=True, text=True, timeout=120,
                              env=dict(os.environ, PYTHONPATH=str(self.orca / "lib/python3/dist-packages")))
        self.assertEqual(done.stdout, "1.0 20\n", done.stderr)

    def test_a_new_component_is_built_tried_and_driven_outside(self):
        reader = Reader("orcactl new", self.folder, self.orca, without_tree())
        reader.run(reader.run("orcactl new component follow_light\n"))
        self.assertIn("100% tests passed, 0 tests failed out of 1", reader.out)
        self.assertIn("trace-hash", reader.out)
        self.assertNotIn("contact", reader.out)
        self.assertTrue((reader.folder / "follow_light/run.svg").exists())

    def test_a_new_object_type_is_built_tried_and_driven_outside(self):
        reader = Reader("orcactl new", self.folder, self.orca, without_tree())
        reader.run(reader.run("orcactl new object free_way\n"))
        self.assertIn("100% tests passed, 0 tests failed out of 1", reader.out)
        self.assertIn("distance  double [m]", reader.out)
        self.assertGreater((reader.folder / "free_way/nearest.csv").read_text().count("finder.nearest"), 20)

    def test_a_new_experiment_is_right(self):
        reader = Reader("orcactl new", self.folder, self.orca, without_tree())
        reader.run("orcactl new experiment two\ncd two\ndeployer graph.xml --check\nsimbatch two.xml --check 2>&1\n")
        self.assertIn("two.xml: no errors", reader.out)

    def test_a_component_is_built_with_pkg_config(self):
        self.call("orcactl", "new", "component", "avoid")
        shown = re.search(r"^```make\n(.*?)^```", (TREE / "docs/install.md").read_text(), re.MULTILINE | re.DOTALL)
        folder = pathlib.Path(self.folder, "avoid")
        (folder / "Makefile").write_text(shown[1])
        done = subprocess.run([*without_tree(), "make"], cwd=folder, capture_output=True, text=True, timeout=120,
                              env=dict(os.environ, PKG_CONFIG_PATH=str(self.orca / "share/pkgconfig")))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("stop_distance = 0.5 m", self.call("deployer", "--describe", "avoid/avoid.so"))


if __name__ == "__main__":
    unittest.main()
