# SPDX-License-Identifier: GPL-3.0-or-later
"""A system and an orcaview for all cases of a test class."""
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

TREE = pathlib.Path(__file__).resolve().parents[3]
BUILD = pathlib.Path(sys.argv[-1]).resolve()
ROLES = ("change", "operate", "observe")  # as orcaview prints their addresses


def await_that(condition, what, limit=20.0):
    end = time.monotonic() + limit
    while not condition():
        if time.monotonic() > end:
            raise AssertionError(f"{what}: not within {limit} s")
        time.sleep(0.05)


class ViewCase(unittest.TestCase):
    """They outlive each case. A class that needs another graph says so."""

    NAME = "scout_goto_processes"
    OPTIONS = ("--set", "command.rounds=0")
    COMPONENTS = 6
    VIEW_OPTIONS = ()

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="orca_view_")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.environment = os.environ | {"XDG_RUNTIME_DIR": folder.name, "XDG_CONFIG_HOME": f"{folder.name}/config"}
        cls.graph = cls.copy_of_tree() / "graphs" / f"{cls.NAME}.xml"
        (cls.folder / "plugins").mkdir()
        cls.system = cls.start_system()
        cls.view = subprocess.Popen([BUILD / "bin" / "orcaview", cls.shown(), "--port", "0", "--web", TREE / "web", *cls.VIEW_OPTIONS],
                                    env=cls.environment, stdout=subprocess.PIPE, text=True)
        cls.addClassCleanup(cls.end, cls.view)
        cls.addresses = [cls.view.stdout.readline().strip() for _ in range(len(ROLES) * (2 if "--listen" in cls.VIEW_OPTIONS else 1))]
        cls.port = int(re.search(r":(\d+)/", cls.addresses[0])[1])
        cls.tokens = {role: address.split("token=")[1] for role, address in zip(ROLES, cls.addresses)}

    @classmethod
    def copy_of_tree(cls):
        """Returns a folder with the tree's own graphs, which may be written to, beside links to all else."""
        tree = cls.folder / "tree"
        tree.mkdir()
        for each in TREE.iterdir():
            if each.name == "graphs":
                shutil.copytree(each, tree / each.name)
            else:
                (tree / each.name).symlink_to(each)
        return tree

    @classmethod
    def shown(cls):
        """Returns what orcaview shows."""
        return cls.NAME

    @classmethod
    def start_system(cls):
        system = subprocess.Popen([BUILD / "bin" / "deployer", cls.graph, "--plugins", cls.folder / "plugins", "--no-progress", "--log", "error", *cls.OPTIONS],
                                  env=cls.environment, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                  stderr=subprocess.DEVNULL)
        cls.addClassCleanup(cls.end, system)
        await_that(lambda: cls.orcactl("ps").stdout.count(" WORK ") >= cls.COMPONENTS, "all components work")
        return system

    @staticmethod
    def end(process):
        if process.poll() is None:
            process.send_signal(signal.SIGTERM)
            assert process.wait(30) == 0, f"{process.args[0]} has ended with {process.returncode}"
        if process.stdout:
            process.stdout.close()

    @classmethod
    def orcactl(cls, *words):
        return subprocess.run([BUILD / "bin" / "orcactl", *words], env=cls.environment, capture_output=True, text=True,
                              timeout=60)
