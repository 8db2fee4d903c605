#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python package, as docs/python.md and the lessons show it.

    tests/system/python_test.py BUILD
"""
import contextlib
import importlib.util
import io
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

TREE = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(TREE / "python"))
os.environ["PATH"] = f"{BUILD / 'bin'}:{os.environ['PATH']}"

import orca_robots as orca  # noqa: E402: found by the lines above

GOTO = str(TREE / "graphs/scout_goto.xml")
PAGE = "docs/python.md"
PYTHON = shutil.which("python3", path="/usr/bin") or sys.executable  # Debian's, for which it has the packages
BLOCK = re.compile(r"^<!-- (read|compared) by \S+ -->\n```\w+\n(.*?)^```$", re.MULTILINE | re.DOTALL)
has_numpy, has_pandas = (importlib.util.find_spec(name) is not None for name in ("numpy", "pandas"))


def printed_by(code, names):
    """Runs code and returns what it prints."""
    with contextlib.redirect_stdout(io.StringIO()) as out:
        exec(compile(code, "lesson", "exec"), names)
    return out.getvalue()


class InFolder(unittest.TestCase):
    """Works in a folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="orca_python_")
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        self.folder = pathlib.Path(folder.name)
        os.chdir(self.folder)

    def copy_of_tree(self):
        """Copies what a reader of the pages has at hand, and goes there."""
        for name in ("graphs", "sim", "python"):
            shutil.copytree(TREE / name, self.folder / name)


class Pages(InFolder):
    def test_the_page_does_what_it_says(self):
        self.copy_of_tree()
        names, said, compared = {}, "", 0
        for kind, text in BLOCK.findall((TREE / PAGE).read_text(encoding="utf-8")):
            if kind == "read":
                said = printed_by(text, names)
            else:
                self.assertEqual(said, text)
                compared += 1
        self.assertGreater(compared, 4)

    def test_the_avoider_of_the_page_repeats_and_is_what_keeps_the_robot_off(self):
        code = next(text for _, text in BLOCK.findall((TREE / PAGE).read_text(encoding="utf-8")) if "class Avoid" in text)
        names = {"orca": orca}
        exec(code[:code.index("with orca.System")], names)

        class Careless(names["Avoid"]):
            def work(self):
                self.laser.get_update_wait()
                self.motion.push(kind="DONTCARE")

        def drive(avoider, seed):
            with orca.System(TREE / "graphs/pioneer_laser_goto.xml", components=[avoider], seed=seed, set={"avoid": "my.Avoid"}, until=100) as system:
                return system.run()

        first, again, other, careless = (drive(*how) for how in ((names["Avoid"], 5), (names["Avoid"], 5), (names["Avoid"], 6), (Careless, 5)))
        self.assertEqual(first.trace_hash, again.trace_hash)
        self.assertNotEqual(first.trace_hash, other.trace_hash)
        for done in (first, other):
            self.assertEqual(([goal[0] for goal in done.arrived], done.contacts), (["kitchen", "office_2", "meeting"], []))
        self.assertNotEqual(careless.contacts, [])

    def test_the_notebook_makes_its_comparison(self):
        self.copy_of_tree()
        os.chdir("python/lessons")
        cells = json.loads(pathlib.Path("compare.ipynb").read_text(encoding="utf-8"))["cells"]
        code = ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]
        self.assertEqual(len(code), 1)
        self.assertLessEqual(len([line for line in code[0].splitlines() if line]), 20)
        said = printed_by(code[0].replace('seeds="1-20"', 'seeds="1-3"'), {})
        self.assertIn("narrow is sooner in 3 of 3 runs", said)
        self.assertIn("narrow - wide", said)


class Graphs(InFolder):
    def test_a_fault_has_its_place(self):
        pathlib.Path("g.xml").write_text('<graph name="g" version="1">\n  <component name="a" type="orca.Gotoo"/>\n</graph>\n')
        first = orca.check("g.xml")[0]
        self.assertEqual((first.severity, first.file, first.line, first.column), ("error", "g.xml", 2, 29))
        self.assertIn("orca.Goto", str(first))

    def test_a_file_that_is_none_is_a_fault(self):
        self.assertEqual([fault.severity for fault in orca.check("nowhere.xml")], ["error"])

    def test_a_changed_graph_is_the_graph_with_the_change(self):
        graph = orca.Graph(GOTO)
        self.assertEqual(graph.components["avoid"], "orca.SonarAvoid")
        graph.set("avoid", "margin", "5 cm")
        graph.set("avoid", "margin", "6 cm")
        graph.add("walk", "orca.RandomWalk", period="0.2 s")
        graph.connect("walk.motion", "fuser.motion")
        file = pathlib.Path(graph.write("mine.xml")).read_text(encoding="utf-8")
        self.assertEqual(file.count("margin"), 1)
        self.assertIn('<component name="walk" type="orca.RandomWalk" period="0.2 s" />', file)
        self.assertIn('<connect from="walk.motion" to="fuser.motion" />', file)
        self.assertIn("<!-- Over sim:", file)
        graph.remove("avoid")
        self.assertNotIn('"avoid.', pathlib.Path(graph.write("mine.xml")).read_text(encoding="utf-8"))
        with self.assertRaisesRegex(KeyError, "no component 'avoid'; it has: command, goto"):
            graph.set("avoid", "margin", "5 cm")


class Runs(InFolder):
    def test_deployer_simbatch_and_python_agree_on_the_hash(self):
        pathlib.Path("plain.xml").write_text(f'<experiment name="plain" graph="{GOTO}" seeds="3" until="10 s">'
                                             '<variant name="a"><set arg="avoid.margin" value="5 cm"/></variant>'
                                             '<world name="w"/></experiment>')
        rows = orca.simulate("plain.xml", jobs=1)
        done = orca.run(GOTO, seed=3, until="10 s", set={"avoid.margin": "5 cm"})
        self.assertEqual(rows.column("trace_hash"), [done.trace_hash])
        alone = subprocess.run([BUILD / "bin/deployer", GOTO, "--clock", "virtual", "--seed", "3", "--until", "10s", "--set",
                                "avoid.margin=5 cm"], capture_output=True, text=True, check=True).stdout
        self.assertIn(f"trace-hash {done.trace_hash}", alone)
        self.assertNotEqual(done.trace_hash, orca.run(GOTO, seed=4, until=10).trace_hash)

    def test_a_run_that_fails_says_so(self):
        with self.assertRaisesRegex(orca.OrcaError, "G014: --set nix"):
            orca.run(GOTO, set={"nix": 1})
        with self.assertRaisesRegex(orca.OrcaError, "nowhere.xml"):
            orca.simulate("nowhere.xml")


class Tables(unittest.TestCase):
    TEXT = "name,time,hash,reason\na,1.5,1e10000000000000,\nb,,0012345678901234,late\n"

    def test_cells_have_the_kind_of_their_column(self):
        table = orca.Table.of_csv(self.TEXT)
        self.assertEqual(table[0], {"name": "a", "time": 1.5, "hash": "1e10000000000000", "reason": ""})
        self.assertEqual(table.column("time"), [1.5, None])
        self.assertEqual(table.where(name="b").column("reason"), ["late"])
        with self.assertRaisesRegex(KeyError, "there are: name, time, hash, reason"):
            table.column("nix")
        self.assertEqual(str(table.where(name="b")).splitlines(), ["name  time  hash              reason", "b           0012345678901234  late"])

    @unittest.skipUnless(has_numpy, "numpy is not installed")
    def test_numpy_gets_a_column(self):
        self.assertEqual(orca.Table.of_csv(self.TEXT).array("time")[0], 1.5)

    @unittest.skipUnless(has_pandas, "pandas is not installed")
    def test_pandas_gets_the_table(self):
        self.assertEqual(list(orca.Table.of_csv(self.TEXT).frame()["time"].dropna()), [1.5])


class Wheel(InFolder):
    def test_a_wheel_installs_into_an_empty_environment(self):
        shutil.copytree(TREE / "python", "source")
        made = subprocess.run([PYTHON, "-m", "pip", "wheel", "--no-index", "--no-build-isolation", "--no-deps", "./source", "-w", "made"],
                              capture_output=True, text=True)
        lacks = re.search("No module named .*|Cannot import .*|invalid command 'bdist_wheel'", made.stderr)
        if lacks:
            self.skipTest("python3-pip, python3-setuptools or python3-wheel is not installed: " + lacks[0])
        self.assertEqual(made.returncode, 0, made.stderr)
        wheel, = pathlib.Path("made").glob("orca_robots-*-py3-none-any.whl")
        subprocess.run([PYTHON, "-m", "venv", "--without-pip", "env"], check=True)
        python = str(self.folder / "env/bin/python")
        subprocess.run([PYTHON, "-m", "pip", "--python", python, "install", "--no-index", str(wheel)], check=True, capture_output=True)
        code = f"import orca_robots as orca; print(orca.__file__, orca.check({GOTO!r}))"
        said = subprocess.run([python, "-c", code], check=True, capture_output=True, text=True).stdout
        self.assertTrue(said.startswith(str(self.folder / "env")) and said.endswith(" []\n"), said)


if __name__ == "__main__":
    unittest.main()
