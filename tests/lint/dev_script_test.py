#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests the parts of ./dev that need no build of Orca: its help, its exit codes, its speed when all packages are there, and what
it does with a project of one target that stands for Orca."""
import json
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
COMMANDS = ("setup", "build", "run", "quick", "test", "nightly", "bench", "package", "lint", "docs")
# Leaves a file in the folder of the project whenever it is built.
SMALL_PROJECT = """cmake_minimum_required(VERSION 3.25)
project(small NONE)
add_custom_target(mark ALL COMMAND ${CMAKE_COMMAND} -E touch ${CMAKE_SOURCE_DIR}/made)
"""


def dev(*arguments):
    return subprocess.run([ROOT / "dev", *arguments], capture_output=True, text=True, stdin=subprocess.DEVNULL)


class DevScript(unittest.TestCase):
    def test_help_names_each_command(self):
        for ask in (["--help"], ["-h"], ["help"], []):
            answer = dev(*ask)
            self.assertEqual(answer.returncode, 0)
            for command in COMMANDS:
                self.assertIn(f"./dev {command}", answer.stdout)

    def test_each_command_has_help_of_its_own(self):
        for command in COMMANDS:
            answer = dev(command, "--help")
            self.assertEqual((answer.returncode, answer.stderr), (0, ""), command)
            self.assertTrue(answer.stdout.startswith(f"./dev {command}"), command)

    def test_the_container_for_editors_is_the_debian_of_the_image_and_is_set_up_by_dev(self):
        container = json.loads((ROOT / ".devcontainer/devcontainer.json").read_text())
        self.assertIn(f"FROM {container['image']} AS build\n", (ROOT / "Containerfile").read_text())
        self.assertEqual(container["postCreateCommand"], "./dev setup")
        self.assertLessEqual(set(container), {"name", "image", "postCreateCommand", "customizations"})  # nothing that names other files

    def test_wrong_use_ends_with_2_and_says_what_was_wrong(self):
        for arguments, word in ((["biuld"], "biuld"), (["build", "relaese"], "relaese"), (["run"], "needs a graph"),
                                (["run", "no/such.xml"], "no/such.xml"), (["nightly", "slwo"], "slwo")):
            answer = dev(*arguments)
            self.assertEqual((answer.returncode, answer.stdout), (2, ""), arguments)
            self.assertIn(word, answer.stderr)

    def test_a_clone_that_was_moved_or_copied_builds(self):
        folder = Path(tempfile.mkdtemp(prefix="orca_dev_"))
        self.addCleanup(shutil.rmtree, folder)
        here, there, copy = folder / "here", folder / "there", folder / "copy"
        here.mkdir()
        for file in ("dev", "CMakePresets.json"):
            shutil.copy(ROOT / file, here)
        (here / "CMakeLists.txt").write_text(SMALL_PROJECT)
        self.build_in(here)
        here.rename(there)
        self.assertIn(f"made when this folder was {here}", self.build_in(there))
        self.assertFalse(here.exists())
        shutil.copytree(there, copy)
        (there / "made").unlink()
        self.assertIn(f"made when this folder was {there}", self.build_in(copy))
        self.assertFalse((there / "made").exists())
        self.assertNotIn("made when", self.build_in(copy))

    def build_in(self, folder):
        (folder / "made").unlink(missing_ok=True)
        answer = subprocess.run([folder / "dev", "build"], capture_output=True, text=True, stdin=subprocess.DEVNULL)
        self.assertEqual(answer.returncode, 0, answer.stderr)
        self.assertTrue((folder / "made").exists(), answer.stderr)
        return answer.stderr

    def test_the_time_left_is_guessed_from_what_is_done(self):
        for elapsed, line, left in ((60, "[30/60] Building", "about 60 s left"), (60, "[30/120]", "about 3 min left"), (5, "[0/9]", ""),
                                    (5, "-- Configuring done", "")):
            answer = subprocess.run(["bash", "-c", 'source <(sed -n "/^time_left()/,/^}/p" "$0"); time_left "$1" "$2"', ROOT / "dev",
                                     str(elapsed), line], capture_output=True, text=True, check=True)
            self.assertEqual(answer.stdout.strip().removeprefix(", "), left)

    def test_the_dearest_entries_of_a_suite_of_any_size_are_shown(self):
        with tempfile.NamedTemporaryFile("w", suffix=".log") as log:
            for number in range(50000):
                log.write(f"{number + 1:5}/50000 Test #{number + 1}: entry_{number} .........   Passed    {number}.50 sec\n")
            log.flush()
            answer = subprocess.run(
                ["bash", "-c", 'set -euo pipefail; say() { :; }; source <(sed -n "/^show_dearest()/,/^}/p" "$0"); show_dearest "$1"',
                 ROOT / "dev", log.name], capture_output=True, text=True)
        self.assertEqual(answer.returncode, 0)
        self.assertEqual(answer.stderr.splitlines(), [f"dev:   {number}.50 s  entry_{number}" for number in range(49999, 49989, -1)])

    def test_setup_is_quick_and_silent_when_all_packages_are_there(self):
        dev("setup")
        start = time.process_time()
        answer = dev("setup")
        self.assertLess(time.process_time() - start, 0.2)
        self.assertEqual(answer.stdout + answer.stderr, "")


if __name__ == "__main__":
    sys.exit(unittest.main())
