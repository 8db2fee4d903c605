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


def without_tree():
    """Returns the beginning of a command that sees neither the source tree nor the build in it; nothing where the system does not
    let a user have mounts of their own."""
    hide = ["unshare", "--map-root-user", "--mount", "sh", "-c", 'mount -t tmpfs none "$0" && exec "$@"', str(TREE)]
    if subprocess.run([*hide, "true"], capture_output=True).returncode == 0:
        return hide
    print("SKIPPED: that nothing is needed of the source tree, since this system lets nobody hide it by a mount")
    return []


class Reader:
    """Somebody who follows a page in a new folder, with the build, or with what is installed in a folder `installed`. Commands begin
    with `inside`."""

    def __init__(self, page, folder, installed=None, inside=()):
        self.page, self.folder, self.installed, self.inside = page, pathlib.Path(folder), installed, inside
        self.out = ""

    def follow(self):
        for block in BLOCK.finditer((TREE / self.page).read_text()):
            if block["file"]:
                with open(self.folder / block["file"], "a") as file:
                    file.write(block["text"])
            else:
                self.run(block["text"])

    def run(self, commands):
        orca = TREE
        if self.installed:
            commands = commands.replace("-DOrca_DIR=$ORCA/build/release", f"-DCMAKE_PREFIX_PATH={self.installed}")
            orca = self.installed / "share/orca"
        commands = commands.replace("$ORCA/build/release", str(self.installed or BUILD))
        done = subprocess.run([*self.inside, "sh", "-e", "-c", commands], cwd=self.folder, env=dict(os.environ, ORCA=str(orca)),
                              capture_output=True, text=True, timeout=300)
        self.out += done.stdout
        if done.returncode != 0:
            raise AssertionError(f"{self.page}: {commands}ended with {done.returncode}:\n{done.stdout}{done.stderr}")
