# SPDX-License-Identifier: GPL-3.0-or-later
"""A page of docs/ done as it says: its commands run in a new folder, and the files that it shows are pasted there, or are what
`orcactl new` has made there. A test that imports this is called with the folder of the build, which stands for ~/orca/build/release of
the pages."""
import contextlib
import os
import pathlib
import re
import signal
import subprocess
import sys

TREE = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(sys.argv.pop()).resolve()
BLOCK = re.compile(r"^<!-- (?:region \S*?/(?P<file>[\w.]+) \w+|made of templates/\w+/(?P<made>\S+)|read by \S+) -->\n```\w+\n(?P<text>.*?)^```$",
                   re.MULTILINE | re.DOTALL)


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
        self.within = ""  # the folder that the commands have gone into
        self.out = ""

    def follow(self):
        for block in BLOCK.finditer((TREE / self.page).read_text()):
            if block["file"]:
                with open(self.folder / block["file"], "a") as file:
                    file.write(block["text"])
            elif block["made"]:
                self.compare(block["made"], block["text"])
            else:
                self.run(block["text"])

    def compare(self, name, shown):
        """Compares a file that `orcactl new` has made with what the page shows."""
        made = (self.folder / self.within / name.replace("@NAME@", self.within)).read_text()
        if made.replace(str(self.installed or BUILD), "~/orca/build/release") != shown:
            raise AssertionError(f"{self.page} does not show {name} as it is made: {made}")

    def run(self, commands):
        """Runs commands as one script. Returns what they have printed."""
        orca = self.installed / "share/orca" if self.installed else TREE
        script = f"PATH={self.installed or BUILD}/bin:$PATH\ncd ./{self.within}\n{commands}"
        if (folder := re.search(r"^cd (\w+)$", commands, re.MULTILINE)):
            self.within = folder[1]
        shell = subprocess.Popen([*self.inside, "sh", "-e", "-c", script], cwd=self.folder, env=dict(os.environ, ORCA=str(orca)),
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True)
        try:
            out, err = shell.communicate(timeout=300)
        finally:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(shell.pid, signal.SIGKILL)  # what the commands have left running
        self.out += out
        if shell.returncode != 0:
            raise AssertionError(f"{self.page}: {commands}ended with {shell.returncode}:\n{out}{err}")
        return out
