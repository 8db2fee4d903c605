#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How much do onlookers cost a running system? Odometry at 100 Hz, on its way between two processes: alone, beside a page, beside a
page that never reads, beside ten pages (five of them never read), and beside these and a recorder. All look at all ports.

    bench/observers.py build/release [--rounds 5] [--seconds 10]

Each round has all cases in turn, so that all see the same machine. It prints for each the median over the rounds of the 99th
percentiles of the time between two arrivals, whose median is 10 ms, and of the age on arrival. orcactl echo, which measures them, is
an onlooker in all. Nothing else should run on the machine.
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
# Pages that read, pages that never do, whether all is recorded.
CASES = {"alone": (0, 0, False), "a page": (1, 0, False), "a page that never reads": (0, 1, False), "ten pages": (5, 5, False),
         "ten pages and a recorder": (5, 5, True)}


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
        """Returns the 99th percentiles of the time between two arrivals of odometry and of its age then [ms]."""
        lines = self.orcactl("--json", "echo", PORT, "--for", f"{seconds}s").stdout.splitlines()
        rows = [json.loads(line) for line in lines]
        assert len(rows) > 80 * seconds, f"only {len(rows)} objects in {seconds} s"
        laps = sorted(1e3 * (late["passed"] - early["passed"]) for early, late in zip(rows, rows[1:]))
        ages = sorted(1e3 * (row["passed"] - row["created"]) for row in rows)
        return laps[int(0.99 * len(laps))], ages[int(0.99 * len(ages))]

    def end(self):
        self.deployer.send_signal(signal.SIGTERM)
        said = self.deployer.communicate(timeout=30)[1]
        return said if self.deployer.returncode == 0 else f"{said}the deployer has ended with {self.deployer.returncode}"


class Onlookers:
    def __init__(self, system, folder, readers, stalled, records):
        self.seen, self.programs, self.pages = 0, [], []
        if readers + stalled > 0:
            self.look(system, readers, stalled)
        if records:
            self.programs.append(subprocess.Popen([system.bin / "orcactl", "record", pathlib.Path(folder) / f"{time.time()}.mcap"],
                                                  env=system.environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL))
        time.sleep(1.0)

    def look(self, system, readers, stalled):
        view = subprocess.Popen([system.bin / "orcaview", NAME, "--port", "0"], env=system.environment, stdout=subprocess.PIPE, text=True)
        self.programs.append(view)
        address = view.stdout.readline().strip()
        port, token = int(address.split(":")[2].split("/")[0]), address.split("token=")[1]
        ports = [row["port"] for row in json.loads(system.orcactl("--json", "ports").stdout)
                 if (row["pattern"], row["role"]) in (("Push", "Server"), ("Send", "Proxy"))]
        self.pages = [WebSocket(port, token) for _ in range(readers + stalled)]
        for page in self.pages:
            for number, name in enumerate(ports, 1):
                page.send(op="look", id=number, port=name)
        for page in self.pages[:readers]:
            threading.Thread(target=self.read, args=(page,), daemon=True).start()

    def read(self, page):
        try:
            while page.receive() is not None:
                self.seen += 1
        except (EOFError, OSError):
            pass

    def end(self):
        for process in reversed(self.programs):
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
    rows, seen = {case: [] for case in CASES}, 0
    with tempfile.TemporaryDirectory(prefix="orca_observers_") as folder:
        system = System(call.build.resolve(), folder)
        try:
            for _ in range(call.rounds):
                for case, onlookers_of_it in CASES.items():
                    onlookers = Onlookers(system, folder, *onlookers_of_it)
                    rows[case].append(system.p99(call.seconds))
                    onlookers.end()
                    seen += onlookers.seen
        finally:
            said = system.end()
    print(f"{'':28}{'p99 between arrivals':>22}{'of all rounds':>20}{'p99 of age':>14}{'of all rounds':>20}")
    first = None
    for case, figures in rows.items():
        laps, ages = ([pair[n] for pair in figures] for n in (0, 1))
        lap, age = statistics.median(laps), statistics.median(ages)
        first = first or lap
        print(f"{case:28}{lap:9.3f} ms ({100 * (lap / first - 1):+5.1f} %){min(laps):10.3f}..{max(laps):.3f}{age:11.3f} ms"
              f"{min(ages):12.3f}..{max(ages):.3f}")
    print(f"pages that read have seen {seen} messages")
    if said:
        print(said, file=sys.stderr)


if __name__ == "__main__":
    main()
