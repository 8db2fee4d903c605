#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests the parts of ./dev that need no build: its help, its exit codes, its speed when all packages are there."""
import subprocess
import sys
import time
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
COMMANDS = ("setup", "build", "run", "test", "bench", "lint", "docs")


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

    def test_wrong_use_ends_with_2_and_says_what_was_wrong(self):
        for arguments, word in ((["biuld"], "biuld"), (["build", "relaese"], "relaese"), (["run"], "needs a graph"),
                                (["run", "no/such.xml"], "no/such.xml")):
            answer = dev(*arguments)
            self.assertEqual((answer.returncode, answer.stdout), (2, ""), arguments)
            self.assertIn(word, answer.stderr)

    def test_setup_is_quick_and_silent_when_all_packages_are_there(self):
        dev("setup")
        start = time.process_time()
        answer = dev("setup")
        self.assertLess(time.process_time() - start, 0.2)
        self.assertEqual(answer.stdout + answer.stderr, "")


if __name__ == "__main__":
    sys.exit(unittest.main())
