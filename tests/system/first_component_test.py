#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What README.md and docs/first_component.md say, done as they say it: the files are pasted into a new folder, the commands run.

    tests/system/first_component_test.py BUILD

BUILD stands for the folder build/release of the pages.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

TREE = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(sys.argv.pop()).resolve()
BLOCK = re.compile(r"^<!-- (?:region \S*?/(?P<file>[\w.]+) \w+|read by \S+) -->\n```\w+\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL)


class Reader:
    """Somebody who follows a page in a new folder."""

    def __init__(self, page, folder):
        self.page, self.folder = page, pathlib.Path(folder)
        self.out = ""

    def follow(self):
        for block in BLOCK.finditer((TREE / self.page).read_text()):
            if block["file"]:
                with open(self.folder / block["file"], "a") as file:
                    file.write(block["text"])
            else:
                self.run(block["text"])

    def run(self, commands):
        commands = commands.replace("$ORCA/build/release", str(BUILD))
        done = subprocess.run(["sh", "-e", "-c", commands], cwd=self.folder, env=dict(os.environ, ORCA=str(TREE)),
                              capture_output=True, text=True, timeout=300)
        self.out += done.stdout
        if done.returncode != 0:
            raise AssertionError(f"{self.page}: {commands}ended with {done.returncode}:\n{done.stdout}{done.stderr}")


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


if __name__ == "__main__":
    unittest.main()
