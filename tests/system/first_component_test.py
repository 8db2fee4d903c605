#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What README.md, docs/first_component.md and docs/first_comparison.md say, done as they say it: the files are
pasted into a new folder, the commands run.

    tests/system/first_component_test.py BUILD

BUILD stands for the folder build/release of the pages.
"""
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from page_reader import BUILD, SAID, TREE, Reader


class Pages(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="orca_first_component_")
        self.addCleanup(shutil.rmtree, self.folder)

    def test_readme(self):
        reader = Reader("README.md", self.folder)
        reader.follow()
        self.assertIn("trace-hash", reader.out)
        self.assertNotIn("contact", reader.out)
        self.assertTrue((reader.folder / "walk.svg").exists())
        self.assertIn("contact", self.run_without_avoider(reader))

    def run_without_avoider(self, reader):
        graph = reader.folder / "walk.xml"
        text = graph.read_text()
        self.assertIn('value="walk; avoid"', text)
        graph.write_text(text.replace('value="walk; avoid"', 'value="walk"').replace("RandomWalk\"/>",
                         'RandomWalk"><param name="blocked_at" value="0.05 m"/></component>'))
        reader.out = ""
        reader.run("$ORCA/build/release/bin/deployer walk.xml --set orca=$ORCA --clock virtual --until 60s\n")
        return reader.out

    def test_first_component(self):
        reader = Reader("docs/first_component.md", self.folder)
        reader.follow()
        self.assertIn("stop_distance = 0.5 m", reader.out)
        self.assertIn("100% tests passed, 0 tests failed out of 1", reader.out)
        self.assertIn("trace-hash", reader.out)
        self.assertNotIn("contact", reader.out)

    def test_first_comparison(self):
        reader = Reader("docs/first_comparison.md", self.folder)
        reader.follow()
        self.assertTrue((reader.folder / "office.batch/report.html").exists())
        told = [line for block in SAID.finditer((TREE / reader.page).read_text()) for line in block["text"].splitlines()]
        self.assertGreater(len(told), 10)
        for line in told:
            self.assertIn(line, reader.out.splitlines())


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
    """What a new author does wrong, and what says so."""

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
        for command in (["cmake", "-S", ".", "-B", "build", "-G", "Ninja", f"-DOrca_DIR={BUILD}"], ["cmake", "--build", "build"]):
            done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, timeout=300)
            said += done.stdout + done.stderr
        return " ".join(said.split())

    def deployer(self, *words):
        done = subprocess.run([BUILD / "bin/deployer", *words], cwd=self.folder, capture_output=True, text=True, timeout=60)
        return done.returncode, done.stdout + done.stderr

    def test_a_parameter_of_a_type_that_is_none(self):
        said = self.build(mine=COMPONENT % ('orca::Param<int> x_{*this, "x", 1};', 'ORCA_COMPONENT(C, "my.C")'))
        self.assertIn("for a whole number write Param<std::int64_t>", said)

    def test_a_source_without_a_type(self):
        said = self.build(mine=COMPONENT % ("", "[[maybe_unused]] C* unused = nullptr;"))
        self.assertIn('the plugin has no type: write ORCA_COMPONENT(Class, "my.Type") at the end of a source', said)

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
