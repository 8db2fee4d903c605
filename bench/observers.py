#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How much do onlookers cost a running system? Odometry at 100 Hz, on its way between two processes, alone and beside ten pages that
look at all ports (five of them never read), and a recorder of all ports.

    bench/observers.py build/release [--rounds 5] [--seconds 10]

Rounds alternate, so that both see the same machine. It prints the ratio of the medians of the 99th percentiles of the age on arrival;
orcactl echo, which measures it, is an onlooker in both. Nothing else should run on the machine.
"""
import argparse
import json
import os
import pathlib
import signal
import statistics
import subprocess
import sys
import tempfile
import threading
import time

TREE = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(TREE / "tests" / "system" / "view"))
from websocket import WebSocket  # noqa: E402

NAME = "scout_goto_processes"
PORT = "avoid.odometry"


class System:
    def __init__(self, build, folder):
        self.bin = build / "bin"
        self.environment = os.environ | {"XDG_RUNTIME_DIR": folder}
        self.deployer = subprocess.Popen(
            [self.bin / "deployer", TREE / "graphs" / f"{NAME}.xml", "--no-progress", "--log", "error", "--set",
             "command.rounds=0", "--set", f"robot={self.robot(folder)}"],
            env=self.environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        for _ in range(200):
            if self.orcactl("ps").stdout.count(" WORK ") >= 6:
                return
            time.sleep(0.1)
        raise SystemExit("the system does not come up: " + self.end())

    @staticmethod
    def robot(folder):
        """Returns the file of a Scout that says where it is a hundred times a second, not twenty."""
        text = (TREE / "sim" / "robots" / "nomad_scout.urdf").read_text(encoding="utf-8")
        quick = text.replace('<odometry period="50 ms"', '<odometry period="10 ms"')
        assert quick != text
        path = pathlib.Path(folder) / "scout.urdf"
        path.write_text(quick, encoding="utf-8")
        return path

    def orcactl(self, *words):
        return subprocess.run([self.bin / "orcactl", *words], env=self.environment, capture_output=True, text=True, check=False)

    def p99(self, seconds):
        """Returns the 99th percentile of the age of odometry when it arrives [ms]."""
        lines = self.orcactl("--json", "echo", PORT, "--for", f"{seconds}s").stdout.splitlines()
        ages = sorted(1e3 * (row["passed"] - row["created"]) for row in map(json.loads, lines))
        assert len(ages) > 90 * seconds, f"only {len(ages)} objects in {seconds} s"
        return ages[int(0.99 * len(ages))]

    def end(self):
        self.deployer.send_signal(signal.SIGTERM)
        said = self.deployer.communicate(timeout=30)[1]
        return said if self.deployer.returncode == 0 else f"{said}the deployer has ended with {self.deployer.returncode}"


class Onlookers:
    def __init__(self, system, folder):
        self.view = subprocess.Popen([system.bin / "orcaview", NAME, "--port", "0"], env=system.environment,
                                     stdout=subprocess.PIPE, text=True)
        address = self.view.stdout.readline().strip()
        port, token = int(address.split(":")[2].split("/")[0]), address.split("token=")[1]
        ports = [row["port"] for row in json.loads(system.orcactl("--json", "ports").stdout)
                 if (row["pattern"], row["role"]) in (("Push", "Server"), ("Send", "Proxy"))]
        self.pages = [WebSocket(port, token) for _ in range(10)]
        for page in self.pages:
            for number, name in enumerate(ports, 1):
                page.send(op="look", id=number, port=name)
        self.seen = 0
        for page in self.pages[::2]:
            threading.Thread(target=self.read, args=(page,), daemon=True).start()
        self.recorder = subprocess.Popen([system.bin / "orcactl", "record", pathlib.Path(folder) / f"{time.time()}.mcap"],
                                         env=system.environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(1.0)

    def read(self, page):
        try:
            while page.receive() is not None:
                self.seen += 1
        except (EOFError, OSError):
            pass

    def end(self):
        for process in (self.recorder, self.view):
            process.send_signal(signal.SIGTERM)
            if process.wait(10):
                raise SystemExit(f"{process.args[0]} has ended with {process.returncode}")
        for page in self.pages:
            page.socket.close()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--seconds", type=int, default=10)
    call = parser.parse_args()
    alone, beside, seen = [], [], 0
    with tempfile.TemporaryDirectory(prefix="orca_observers_") as folder:
        system = System(call.build.resolve(), folder)
        try:
            for _ in range(call.rounds):
                alone.append(system.p99(call.seconds))
                onlookers = Onlookers(system, folder)
                beside.append(system.p99(call.seconds))
                onlookers.end()
                seen += onlookers.seen
        finally:
            said = system.end()
    a, b = statistics.median(alone), statistics.median(beside)
    print(f"p99 of the age of odometry: alone {a:.3f} ms {sorted(alone)}, beside onlookers {b:.3f} ms {sorted(beside)}, "
          f"ratio {b / a:.2f}; pages that read have seen {seen} messages")
    if said:
        print(said, file=sys.stderr)


if __name__ == "__main__":
    main()
