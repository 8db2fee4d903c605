#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What README.md says of a component of your own, done as it says it, and what `orcactl new` makes.

    tests/system/new_folder_test.py BUILD

BUILD stands for the folder build/release of the pages. docs/lessons goes on from there: lessons_test.py.
"""
import csv
import math
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from page_reader import BUILD, TREE, Reader


class Pages(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="orca_new_folder_")
        self.addCleanup(shutil.rmtree, self.folder)

    def test_the_component_of_the_readme_builds_passes_its_test_and_keeps_the_robot_off(self):
        reader = Reader("README.md", self.folder)
        reader.follow()
        self.assertIn("stop_distance = 0.5 m", reader.out)
        self.assertIn("100% tests passed, 0 tests failed out of 1", reader.out)
        self.assertEqual(reader.out.count("trace-hash"), 1)
        self.assertNotIn("contact", reader.out)
        self.assertTrue((reader.folder / "avoid/run.svg").exists())
        self.assertIn("contact", self.run_without_avoider(reader))

    def run_without_avoider(self, reader):
        graph = reader.folder / "avoid/avoid.xml"
        text = graph.read_text()
        self.assertIn('value="walk; avoid"', text)
        graph.write_text(text.replace('value="walk; avoid"', 'value="walk"').replace("RandomWalk\"/>",
                         'RandomWalk"><param name="blocked_at" value="0.05 m"/></component>'))
        return reader.run("deployer avoid.xml --clock virtual --until 60s\n")

    def test_what_orcactl_new_prints_is_what_the_readme_shows_and_explains(self):
        """The README of a new folder; README.md shows the same for a component."""
        for kind, name in (("component", "avoid"), ("driver", "owl")):
            with tempfile.TemporaryDirectory() as folder:
                printed = Reader("orcactl new", folder).run(f"orcactl new {kind} {name}\n")
                files = {path.name for path in pathlib.Path(folder, name).iterdir()}
                readme = pathlib.Path(folder, name, "README.md").read_text()
            self.assertEqual(printed.splitlines()[0], f"# made {name}: {', '.join(sorted(files))}")
            commands = printed.split("\n", 1)[1]
            self.assertIn(f"```sh\n{commands.removeprefix(f'cd {name}' + chr(10))}```", readme)
            self.assertEqual(len(readme.splitlines()[-4:]), sum(line[0].isdigit() for line in readme.splitlines()[-4:]))
            self.assertLessEqual(len(readme.splitlines()), 17)
            if kind == "component":
                self.assertIn(f"{commands}```", (TREE / "README.md").read_text())

    def test_a_new_experiment_runs(self):
        reader = Reader("orcactl new experiment", self.folder)
        commands = reader.run("orcactl new experiment two\n")
        self.assertIn("xdg-open two.batch/report.html\n", commands)
        reader.run(commands.replace("xdg-open", "ls"))
        self.assertEqual(reader.out.count("vfh_plus: 3 runs"), 1)
        self.assertIn("laser_avoid - vfh_plus, success:", reader.out)
        self.assertIn("</html>", (reader.folder / "two/two.batch/report.html").read_text())
        reader.run("simbatch pack two.xml\nsimbatch repeat two.batch/two.pack.tar.gz --out elsewhere\n")
        self.assertIn("the same: all 6 runs, byte for byte", reader.out)

    def test_orcactl_prints_the_path_that_is_missing(self):
        done = subprocess.run([BUILD / "bin/orcactl", "new", "experiment", "two"], cwd=self.folder, capture_output=True, text=True, timeout=60)
        self.assertIn(f"\nexport PATH='{BUILD}/bin':$PATH\ncd two\n", done.stdout)


class Drivers(unittest.TestCase):
    def test_a_new_driver_passes_its_trial_which_finds_the_faults_of_another_one(self):
        folder = tempfile.mkdtemp(prefix="orca_new_driver_")
        self.addCleanup(shutil.rmtree, folder)
        reader = Reader("orcactl new driver", folder)
        reader.run(reader.run("orcactl new driver owl\n"))
        self.assertIn("100% tests passed, 0 tests failed out of 1", reader.out)
        with open(reader.folder / "owl/scans.csv", newline="", encoding="utf-8") as table:
            scans = list(csv.DictReader(table))
        self.assertGreater(len(scans), 10)
        self.assertAlmostEqual(float(scans[-1]["ranges[30]"]), 2.0, places=3)  # the wall ahead
        self.assertEqual(float(scans[-1]["ranges[0]"]), math.inf)
        self.assert_finds_faults(reader)

    def assert_finds_faults(self, reader):
        """A driver that never gives up on a silent device does not pass."""
        source = reader.folder / "owl/owl.cpp"
        text = source.read_text()
        self.assertIn("? Duration(1s) : Duration::max();", text)
        source.write_text(text.replace("? Duration(1s) : Duration::max();", "? Duration::max() : Duration::max();"))
        with self.assertRaisesRegex(AssertionError, "silent: .* readings in 5 s; nobody said that the device is silent"):
            reader.run("cmake --build build\nctest --test-dir build --verbose\n")


COMPONENT = """#include "orca/component.hpp"
#include "orca/idl/motion.hpp"
namespace {
class C final : public orca::Component {
 public:
  using Component::Component;
  orca::Outcome work() override { return orca::again(); }
  %s
};
}
%s
"""
SOUND = COMPONENT % ('orca::PushServer<orca::idl::MotionCommand> motion_{*this, "motion"};', 'ORCA_COMPONENT(C, "my.Sound")')


class Faults(unittest.TestCase):
    """What a new author does wrong, and what says so; docs/lessons/wrong-turns.md has more."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="orca_faulty_component_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def build(self, **sources):
        """Builds a plugin for each source. Returns what the build says, in one line."""
        for name, text in sources.items():
            (self.folder / f"{name}.cpp").write_text(text)
        targets = "".join(f"orca_add_component({name} {name}.cpp)\n" for name in sources)
        (self.folder / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.25)\nproject(mine LANGUAGES CXX)\nfind_package(Orca REQUIRED)\n" + targets)
        said = ""
        for command in (["cmake", "-S", ".", "-B", "build", "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={BUILD}"], ["cmake", "--build", "build"]):
            done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, timeout=300)
            said += done.stdout + done.stderr
        return " ".join(said.split())

    def deployer(self, *words):
        done = subprocess.run([BUILD / "bin/deployer", *words], cwd=self.folder, capture_output=True, text=True, timeout=60)
        return done.returncode, done.stdout + done.stderr

    def test_two_ports_of_one_name(self):
        port = 'orca::PushServer<orca::idl::MotionCommand> %s{*this, "motion"};'
        self.build(mine=COMPONENT % (port % "a_" + port % "b_", 'ORCA_COMPONENT(C, "my.C")'))
        status, said = self.deployer("--describe", "build/plugins/mine.so")
        self.assertNotEqual(status, 0)
        self.assertIn('it has two ports of the name "motion"; give one of them another name', said)

    def test_a_type_in_two_plugins_and_a_plugin_whose_target_is_gone(self):
        self.build(one=SOUND, two=SOUND)
        (self.folder / "g.xml").write_text(
            '<graph name="g" version="1" plugins="build/plugins"><component name="a" type="my.Sound" autonomous="true"/></graph>')
        status, said = self.deployer("g.xml", "--check")
        self.assertEqual(status, 2)
        self.assertIn('two plugins hold the type "my.Sound"', said)
        self.assertIn("two.so, whose target is gone", self.build(one=SOUND))
        self.assertEqual(self.deployer("g.xml", "--check")[0], 0)


if __name__ == "__main__":
    unittest.main()
