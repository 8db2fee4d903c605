#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What README.md, docs/first_component.md and docs/first_comparison.md say, done as they say it, and what `orcactl new` makes.

    tests/system/first_component_test.py BUILD

BUILD stands for the folder build/release of the pages.
"""
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from page_reader import BUILD, SAID, TREE, Reader


def lines_of_code(source):
    lines = (line.strip() for line in source.read_text().splitlines())
    return sum(bool(line) and not line.startswith("//") for line in lines)


class Pages(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="orca_first_component_")
        self.addCleanup(shutil.rmtree, self.folder)

    def test_first_component(self):
        reader = Reader("docs/first_component.md", self.folder)
        reader.follow()
        self.assertIn("stop_distance = 0.5 m", reader.out)
        self.assertIn("100% tests passed, 0 tests failed out of 1", reader.out)
        self.assertEqual(reader.out.count("trace-hash"), 2)
        self.assertNotIn("contact", reader.out)
        self.assertTrue((reader.folder / "avoid/run.svg").exists())
        self.assertIn("contact", self.run_without_avoider(reader))
        self.assertEqual(pathlib.Path(reader.folder, "hello.xml").read_text().count("\n"), 3)
        self.assert_says_hello(reader)

    def run_without_avoider(self, reader):
        graph = reader.folder / "avoid/avoid.xml"
        text = graph.read_text()
        self.assertIn('value="walk; avoid"', text)
        graph.write_text(text.replace('value="walk; avoid"', 'value="walk"').replace("RandomWalk\"/>",
                         'RandomWalk"><param name="blocked_at" value="0.05 m"/></component>'))
        return reader.run("deployer avoid.xml --clock virtual --until 60s\n")

    def assert_says_hello(self, reader):
        """The files at the end of the page, built into the same plugin folder, say hello once per second; their lines are as many as
        it says."""
        page = " ".join((TREE / reader.page).read_text().split())
        self.assertIn(f"has {lines_of_code(reader.folder / 'hello.cpp')} lines of code", page)
        self.assertIn(f"has a parameter, has {lines_of_code(reader.folder / 'avoid/avoid.cpp')}.", page)
        for file in ("hello.cpp", "hello.xml"):
            shutil.move(reader.folder / file, reader.folder / "avoid")
        with open(reader.folder / "avoid/CMakeLists.txt", "a") as build:
            build.write((reader.folder / "CMakeLists.txt").read_text())
        said = reader.run("cmake --build build > build.log\ndeployer hello.xml --clock virtual --until 3.5s 2>&1\n")
        self.assertEqual(len([line for line in said.splitlines() if line.endswith("hello")]), 4)

    def test_what_orcactl_new_prints_is_what_pages_show_and_a_readme_explains(self):
        """README.md, docs/first_component.md and docs/first_driver.md."""
        for kind, name, page in (("component", "avoid", "README.md"), ("component", "avoid", "docs/first_component.md"),
                                 ("driver", "owl", "docs/first_driver.md")):
            with tempfile.TemporaryDirectory() as folder:
                printed = Reader(page, folder).run(f"orcactl new {kind} {name}\n")
                files = {path.name for path in pathlib.Path(folder, name).iterdir()}
                readme = pathlib.Path(folder, name, "README.md").read_text()
            self.assertEqual(printed.splitlines()[0], f"# made {name}: {', '.join(sorted(files))}")
            commands = printed.split("\n", 1)[1]
            self.assertIn(f"{commands}```", (TREE / page).read_text())
            self.assertIn(f"```sh\n{commands.removeprefix(f'cd {name}' + chr(10))}```", readme)
            self.assertEqual(len(readme.splitlines()[-4:]), sum(line[0].isdigit() for line in readme.splitlines()[-4:]))
            self.assertLessEqual(len(readme.splitlines()), 17)

    def test_a_new_experiment_runs(self):
        reader = Reader("orcactl new experiment", self.folder)
        commands = reader.run("orcactl new experiment two\n")
        self.assertIn("xdg-open two.batch/report.html\n", commands)
        reader.run(commands.replace("xdg-open", "ls"))
        self.assertEqual(reader.out.count("vfh_plus: 3 runs"), 1)
        self.assertIn("laser_avoid - vfh_plus, success:", reader.out)
        self.assertIn("</html>", (reader.folder / "two/two.batch/report.html").read_text())

    def test_orcactl_prints_the_path_that_is_missing(self):
        done = subprocess.run([BUILD / "bin/orcactl", "new", "experiment", "two"], cwd=self.folder, capture_output=True, text=True, timeout=60)
        self.assertIn(f"\nexport PATH='{BUILD}/bin':$PATH\ncd two\n", done.stdout)

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
        for command in (["cmake", "-S", ".", "-B", "build", "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={BUILD}"], ["cmake", "--build", "build"]):
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
