# SPDX-License-Identifier: GPL-3.0-or-later
"""A page of docs/ done as it says: the files that it shows are pasted into a new folder, its commands run. A test that imports this
is called with the folder of the build, which stands for build/release of the pages."""
import os
import pathlib
import re
import subprocess
import sys

TREE = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(sys.argv.pop()).resolve()
BLOCK = re.compile(r"^<!-- (?:region \S*?/(?P<file>[\w.]+) \w+|read by \S+) -->\n```\w+\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL)
SAID = re.compile(r"^<!-- compared by \S+ -->\n```text\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL)


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
