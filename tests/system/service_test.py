#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The deployer as a service: the notices that systemd expects, and the unit orca@.service.

    tests/system/service_test.py BUILD
"""
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

TREE = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(sys.argv.pop()).resolve()
BEAT = 1.0  # [s]
NOTICE = "READY=1\nWATCHDOG=1"


class Notices(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="orca_service_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self.addCleanup(self.socket.close)

    def start(self, address, *words):
        self.socket.bind(address)
        env = dict(os.environ, XDG_RUNTIME_DIR=str(self.folder), NOTIFY_SOCKET=address.replace("\0", "@"))
        process = subprocess.Popen([BUILD / "bin/deployer", TREE / "graphs/scout_goto.xml", "--hold", "--no-progress", *words], env=env,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.kill)
        return process

    def hear(self, seconds):
        """Returns the next notice; "" if none comes in that time."""
        self.socket.settimeout(seconds)
        try:
            return self.socket.recv(100).decode()
        except TimeoutError:
            return ""

    def test_it_says_each_second_that_the_system_is_up_and_the_supervisor_turns(self):
        process = self.start(str(self.folder / "notify"))
        self.assertEqual(self.hear(20), NOTICE)
        begin = time.monotonic()
        self.assertEqual([self.hear(2 * BEAT) for _ in range(3)], [NOTICE] * 3)
        self.assertAlmostEqual(time.monotonic() - begin, 3 * BEAT, delta=BEAT)
        process.terminate()
        self.assertEqual(process.wait(10), 0, process.stdout.read())

    def test_a_deployer_that_stands_still_is_silent(self):
        process = self.start("\0orca_service_test_%d" % os.getpid())  # an address that is no file
        self.assertEqual(self.hear(20), NOTICE)
        process.send_signal(signal.SIGSTOP)
        while self.hear(0.1):
            continue
        self.assertEqual(self.hear(2 * BEAT), "")
        process.send_signal(signal.SIGCONT)
        self.assertEqual(self.hear(2 * BEAT), NOTICE)
        process.terminate()
        process.wait(10)

    def test_a_graph_that_is_refused_is_never_ready(self):
        process = self.start(str(self.folder / "notify"), "--set", "world=nowhere.xml")
        self.assertNotEqual(process.wait(20), 0)
        self.assertEqual(self.hear(0.1), "")


class Unit(unittest.TestCase):
    @unittest.skipIf(shutil.which("systemd-analyze") is None, "SKIPPED: systemd-analyze is not installed; apt-get install systemd")
    def test_systemd_finds_nothing_wrong_with_the_unit(self):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="orca_unit_"))
        self.addCleanup(shutil.rmtree, folder)
        text = (TREE / "cmake/install/orca@.service").read_text()
        self.assertIn("\nExecStart=deployer ", text)
        # It looks for programs where they are installed, which the build is not.
        (folder / "orca@robot.service").write_text(text.replace("ExecStart=deployer", f"ExecStart={BUILD}/bin/deployer")
                                                   .replace("man:deployer(1) man:orcactl(1)", "https://example.org"))
        done = subprocess.run(["systemd-analyze", "verify", folder / "orca@robot.service"], capture_output=True, text=True, timeout=60)
        self.assertEqual((done.returncode, done.stderr), (0, ""))


if __name__ == "__main__":
    unittest.main()
