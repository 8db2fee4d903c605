#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""simbatch submit with a Slurm of its own, on the loopback interface: munged, slurmctld and two slurmd.

    tests/system/slurm_test.py BUILD

Exit status 77 (skipped) without Slurm (Debian's slurmctld, slurmd, slurm-client and munge) or the rights of root.
"""
import contextlib
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
SIMBATCH = BUILD / "bin/simbatch"
LIMIT = 120  # [s] for whatever a cluster of two nodes has to do here

EXPERIMENT = """<experiment name="drive" seeds="1-{seeds}" until="12 s" graph="{graph}">
  <variant name="LaserAvoid"><set arg="avoid" value="orca.LaserAvoid"/></variant>
  <variant name="VfhPlus"><set arg="avoid" value="orca.VfhPlus"/></variant>
  <world name="nominal"/>
</experiment>"""

CONFIGURATION = """ClusterName=orca
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort={controller}
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
MailProg=/bin/true
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool_%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd_%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd_%n.log
SlurmdTimeout=5
ReturnToService=2
JobRequeue=1
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
NodeName=n1 NodeHostname=localhost NodeAddr=127.0.0.1 Port={first} CPUs=1
NodeName=n2 NodeHostname=localhost NodeAddr=127.0.0.1 Port={second} CPUs=1
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
"""


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Cluster:
    """A Slurm of two nodes in a folder."""

    def __init__(self, folder):
        self.folder, self.daemons = pathlib.Path(folder), {}
        self.configuration = self.folder / "slurm.conf"
        controller, first, second = free_ports(3)
        self.configuration.write_text(
            CONFIGURATION.format(folder=folder, controller=controller, first=first, second=second))
        (self.folder / "state").mkdir()
        self.environment = dict(os.environ, SLURM_CONF=str(self.configuration))
        self.start_munge()
        self.start("slurmctld", ["slurmctld", "-D", "-f", str(self.configuration)])
        for node in ("n1", "n2"):
            self.start_node(node)
        self.wait_until("both nodes are idle", lambda: self.said("sinfo", "-h", "-o", "%D %t") == "2 idle")

    def start_munge(self):
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o600)
        files = {"key-file": key, "socket": self.folder / "munge.socket"}
        files |= {name: self.folder / f"munge.{name[:-5]}" for name in ("pid-file", "log-file", "seed-file")}
        self.start("munged", ["munged", "-F", "--force"] + [f"--{name}={path}" for name, path in files.items()])
        self.wait_until("munged listens", (self.folder / "munge.socket").exists)

    def start_node(self, node):
        self.start(node, ["slurmd", "-D", "-N", node, "-f", str(self.configuration)])

    def start(self, name, words):
        self.daemons[name] = subprocess.Popen(words, env=self.environment, stdout=subprocess.DEVNULL,
                                              stderr=subprocess.DEVNULL, stdin=subprocess.DEVNULL,
                                              start_new_session=True)

    def lose_node(self, node):
        """Ends all that runs on a node at once, as if its power had gone."""
        self.daemons[node].kill()
        self.daemons.pop(node).wait()
        for process in pathlib.Path("/proc").glob("[0-9]*"):
            with contextlib.suppress(OSError):
                if f"SLURMD_NODENAME={node}\0".encode() in (process / "environ").read_bytes():
                    os.kill(int(process.name), signal.SIGKILL)

    def said(self, *words):
        return subprocess.run(words, env=self.environment, capture_output=True, text=True, timeout=20).stdout.strip()

    @staticmethod
    def wait_until(what, is_so):
        end = time.monotonic() + LIMIT
        while not is_so():
            if time.monotonic() > end:
                raise AssertionError(f"not within {LIMIT} s: {what}")
            time.sleep(0.2)

    def stop(self):
        self.said("scancel", "--user=root")
        for daemon in reversed(self.daemons.values()):
            daemon.terminate()
        for daemon in self.daemons.values():
            try:
                daemon.wait(20)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()


def export(folder):
    return subprocess.run([SIMBATCH, "export", folder], capture_output=True, text=True, check=True).stdout


class Submit(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.home = tempfile.mkdtemp(prefix="orca_slurm_")
        cls.cluster = Cluster(cls.home)

    @classmethod
    def tearDownClass(cls):
        cls.cluster.stop()
        shutil.rmtree(cls.home)

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(dir=self.home))

    def experiment(self, seeds):
        file = self.folder / "drive.xml"
        file.write_text(EXPERIMENT.format(seeds=seeds, graph=TREE / "graphs/pioneer_laser_goto.xml"))
        return file

    def submit(self, file, *more):
        return subprocess.Popen([SIMBATCH, "submit", file, "--slurm", "--shards", "4", "--out", self.folder / "out", *more],
                                env=self.cluster.environment, stderr=subprocess.PIPE, text=True)

    def whole(self, file):
        subprocess.run([SIMBATCH, file, "--out", self.folder / "whole"], check=True, capture_output=True)
        return export(self.folder / "whole")

    def test_parts_of_a_cluster_give_the_bytes_of_one_machine(self):
        file = self.experiment(6)
        submitted = self.submit(file)
        _, said = submitted.communicate(timeout=LIMIT)
        self.assertEqual(submitted.returncode, 0, said)
        self.assertIn("of 4 parts have ended", said)
        self.assertEqual(export(self.folder / "out"), self.whole(file))
        self.assertTrue((self.folder / "out/report.html").exists())
        again = self.submit(file)
        _, said = again.communicate(timeout=LIMIT)
        self.assertEqual(again.returncode, 2)
        self.assertIn("holds parts already; --resume makes what is missing", said)
        resumed = self.submit(file, "--resume")
        _, said = resumed.communicate(timeout=LIMIT)
        self.assertEqual(resumed.returncode, 0, said)
        self.assertEqual(export(self.folder / "out"), export(self.folder / "whole"))

    def test_what_a_lost_node_was_doing_is_done_by_another(self):
        file = self.experiment(40)
        submitted = self.submit(file)
        self.cluster.wait_until("parts run", lambda: self.cluster.said("squeue", "-h", "-t", "R", "-o", "%N").count("n") == 2)
        time.sleep(2)
        self.cluster.lose_node("n2")
        try:
            _, said = submitted.communicate(timeout=3 * LIMIT)
            self.assertEqual(submitted.returncode, 0, said)
            self.assertIn("Restarts=1", self.cluster.said("scontrol", "show", "jobs"))
            self.assertEqual(export(self.folder / "out"), self.whole(file))
        finally:
            self.cluster.start_node("n2")

    def test_without_a_cluster_it_says_so(self):
        done = subprocess.run([SIMBATCH, "submit", self.experiment(1), "--slurm", "--out", self.folder / "out"],
                              env=dict(os.environ, PATH=str(self.folder)), capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn('cannot start "sbatch"', done.stderr)


if __name__ == "__main__":
    missing = [name for name in ("munged", "slurmctld", "slurmd", "sbatch", "squeue") if shutil.which(name) is None]
    if missing or os.geteuid() != 0:
        print("SKIPPED: it needs root and Debian's slurmctld, slurmd, slurm-client and munge; missing:", *missing)
        sys.exit(77)
    unittest.main(verbosity=2)
