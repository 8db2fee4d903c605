#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""An object type of one's own, as `orcactl new object` makes it: built, tried and driven, over every link, shown, recorded, and with
each mistake that an author makes.

    tests/system/own_objects_test.py BUILD
"""
import csv
import io
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import time
import unittest

from page_reader import BUILD, TREE, Reader

LIBRARY = "free_way_objects.so"
PROCESSES = """  <process name="other"/>
  <component name="near" process="other" type="my.FreeWayStop" autonomous="true"/>
  <component name="far" process="other" type="my.FreeWayStop" autonomous="true"/>
  <connect from="finder.nearest" to="near.nearest"/>
  <connect from="finder.nearest" to="far.nearest" link="dds"/>
</graph>"""


class OwnObjects(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.mkdtemp(prefix="orca_own_objects_")
        cls.addClassCleanup(shutil.rmtree, scratch)
        command = re.search(r"^orcactl new object free_way\n", (TREE / "docs/objects.md").read_text(), re.MULTILINE)[0]
        reader = Reader("docs/objects.md", scratch)
        reader.run(reader.run(command))
        cls.out, cls.made = reader.out, reader.folder / "free_way"

    def setUp(self):
        scratch = tempfile.mkdtemp(prefix="orca_own_objects_")
        self.addCleanup(shutil.rmtree, scratch)
        self.folder = pathlib.Path(scratch) / "free_way"
        shutil.copytree(self.made, self.folder, symlinks=True)
        self.environment = dict(os.environ, XDG_RUNTIME_DIR=scratch)

    def call(self, program, *words):
        """Returns the exit status of an Orca program in the folder, and all that it has printed."""
        done = subprocess.run([BUILD / "bin" / program, *words], cwd=self.folder, capture_output=True, text=True, timeout=120,
                              env=self.environment)
        return done.returncode, done.stdout + done.stderr

    def orcactl(self, *words):
        status, said = self.call("orcactl", *words)
        self.assertEqual(status, 0, said)
        return said

    def run_in_processes(self):
        graph = self.folder / "free_way.xml"
        graph.write_text(graph.read_text().replace("</graph>", PROCESSES))
        deployer = subprocess.Popen([BUILD / "bin/deployer", graph, "--no-progress"], cwd=self.folder, env=self.environment,
                                    stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.addCleanup(deployer.wait)
        self.addCleanup(deployer.stderr.close)
        self.addCleanup(deployer.terminate)
        for _ in range(600):
            status, said = self.call("orcactl", "ps", "--json")
            if status == 0 and '"state": "WORK"' in said.replace("WORKING", "WORK"):
                return
            self.assertIsNone(deployer.poll(), deployer.stderr.read() if deployer.poll() is not None else "")
            time.sleep(0.05)
        self.fail(f"the system did not come up: {said}")

    def test_what_orcactl_new_prints_builds_passes_its_test_and_drives(self):
        self.assertIn("100% tests passed, 0 tests failed out of 1", self.out)
        self.assertIn("distance  double [m]", self.out)
        self.assertIn("trace-hash", self.out)
        with open(self.made / "nearest.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file, strict=True))
        self.assertGreater(len(rows), 20)
        self.assertTrue(all(0 < float(row["distance"]) < 6.5 and 0 <= int(row["sensor"]) < 16 for row in rows))

    def test_objects_go_over_each_link_are_shown_and_recorded_and_their_plugin_can_be_exchanged(self):
        self.run_in_processes()
        self.assertRegex(self.orcactl("echo", "finder.nearest", "--count", "2"), r"^<my.FreeWay .*distance=\"\d")
        self.assertRegex(self.orcactl("echo", "near.nearest", "--count", "1", "--field", "distance"), r"^\d")
        self.assertIn(f"/{LIBRARY}", self.orcactl("objects"))
        self.orcactl("record", "run.mcap", "finder.nearest", "--for", "2s")
        rows = list(csv.DictReader(io.StringIO(self.orcactl("bag", "csv", "run.mcap", "finder.nearest", "--plugins", "build/plugins"))))
        self.assertGreater(len(rows), 3)
        self.assertTrue(all(float(row["distance"]) > 0 for row in rows))
        status, said = self.call("orcactl", "bag", "csv", "run.mcap")
        self.assertEqual(status, 1)
        self.assertIn("objects of the type my.FreeWay of finder.nearest are not known here; the folder of their library", said)

        self.orcactl("swap", "finder", "build/plugins/free_way.so")
        self.assertIn("my.FreeWay", self.orcactl("echo", "finder.nearest", "--count", "1"))
        self.assertNotIn('"pinned": true', self.orcactl("plugins", "--json"))
        edges = [row for row in json.loads(self.orcactl("counters", "--json")) if row.get("from") == "finder.nearest"]
        self.assertEqual({row["to"] for row in edges}, {"stop.nearest", "near.nearest", "far.nearest"})
        for row in edges:
            self.assertGreater(int(row["delivered"]), 5, row)

    def test_the_deployer_lists_and_describes_the_type(self):
        self.assertRegex(self.call("deployer", "--types", "--plugins", "build/plugins")[1], rf"my\.FreeWay +object +.*/{LIBRARY}")
        described = self.call("deployer", "--describe", f"build/plugins/{LIBRARY}", "--json")[1]
        self.assertEqual([field["name"] for field in json.loads(described)["types"][0]["fields"]], ["distance", "sensor", "stamp"])

    def test_a_broken_library_is_a_warning_for_those_who_do_not_use_it(self):
        (self.folder / "build/plugins/broken.so").write_text("no library")
        (self.folder / "build/plugins/broken.types").write_text("object my.Broken\n")
        status, said = self.call("deployer", "free_way.xml", "--check")
        self.assertEqual(status, 0, said)
        self.assertRegex(said, r"warning: .*broken.so: is no shared library")

    def test_a_plugin_without_its_library_is_refused_with_the_name_of_the_library(self):
        for file in (LIBRARY, "free_way_objects.types"):
            (self.folder / "build/plugins" / file).unlink()
        shutil.copytree(self.folder / "build/plugins", self.folder / "elsewhere")
        graph = self.folder / "free_way.xml"
        graph.write_text(graph.read_text().replace('plugins="build/plugins"', 'plugins="elsewhere"'))
        status, said = self.call("deployer", "free_way.xml", "--check")
        self.assertEqual(status, 2)
        self.assertIn("uses the object type my.FreeWay, whose library is not loaded: it must lie beside the plugin", said)

    def build(self, *targets):
        """Builds in the folder that was copied. Returns what the build says, in one line."""
        done = subprocess.run(["cmake", "-S", self.folder, "-B", self.folder / "again", "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={BUILD}"],
                              capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        done = subprocess.run(["cmake", "--build", self.folder / "again", *(f"--target={target}" for target in targets)],
                              capture_output=True, text=True, timeout=300)
        return " ".join((done.stdout + done.stderr).split())

    def change(self, before, after):
        idl = self.folder / "free_way.idl"
        self.assertIn(before, idl.read_text())
        idl.write_text(idl.read_text().replace(before, after))

    def test_a_mistake_is_named_with_file_and_line_and_a_changed_library_told_from_its_plugin_by_the_field(self):
        self.change("double distance;", "duoble distance;")
        self.assertIn("free_way.idl:9: unknown type 'duoble'; did you mean 'double'?", self.build("free_way_objects"))
        self.change("duoble distance;", "double range;")
        self.assertNotIn("error", self.build("free_way_objects"))
        for file in (LIBRARY, "free_way_objects.types"):
            shutil.copy(self.folder / "again/plugins" / file, self.folder / "build/plugins")
        status, said = self.call("deployer", "free_way.xml", "--check")
        self.assertEqual(status, 2)
        self.assertIn("was built for another layout of the object type my.FreeWay: the field \"distance\" in the plugin is \"range\" in the "
                      "library; build it again with the library of that type", said)


if __name__ == "__main__":
    unittest.main()
