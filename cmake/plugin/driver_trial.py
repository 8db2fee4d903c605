#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tries a driver of a device on a line, with an emulation of the device, and with all that happens to lines.

    driver_trial.py --deployer FILE --plugins FOLDER --type TYPE --server TYPE --port PORT [--param NAME=VALUE]... EMULATOR...

EMULATOR is a command that plays the device; "--link PATH" is put behind it, and PATH must become a link to the device's line, a
pseudo terminal. The driver is run behind a server, in a system of its own for each trial, all at the same time. What must be true
of each driver: readings come through a good line, through one that gives one byte at a time, and through one with garbage, spoiled
bytes or an echo; they come again when the device was unplugged; a device that falls silent, and a line that is not there, are
reported, and the system ends as it should in all cases.
"""
import argparse
import concurrent.futures
import csv
import os
import pathlib
import random
import select
import subprocess
import sys
import tempfile
import threading
import time
import tty

RUN = 5.0  # [s]
ENDS_WELL = 0


class Line:
    """What lies between the device and the driver. A thread carries the bytes both ways, with what a trial does to them."""

    def __init__(self, device, path):
        self.device, self.path = os.open(device, os.O_RDWR | os.O_NOCTTY), path
        tty.setraw(self.device)
        self.begin, self.ends, self.host = time.monotonic(), False, None
        self.random = random.Random(1)
        self.plug_in()
        self.thread = threading.Thread(target=self.carry)
        self.thread.start()

    def plug_in(self):
        self.host, self.host_side = os.openpty()
        tty.setraw(self.host_side)
        os.symlink(os.ttyname(self.host_side), self.path)

    def unplug(self):
        os.unlink(self.path)
        os.close(self.host)
        os.close(self.host_side)
        self.host = None

    def age(self):
        return time.monotonic() - self.begin

    def carry(self):
        while not self.ends:
            self.happen()
            ends = [self.device] + ([self.host] if self.host is not None else [])
            for end in select.select(ends, [], [], 0.01)[0]:
                data = self.read(end)
                for piece in self.to_host(data) if end == self.device else [data]:
                    self.write(self.host if end == self.device else self.device, piece)
                if end == self.host:
                    self.answer_host(data)

    def read(self, end):
        try:
            return os.read(end, 256)
        except OSError:  # nobody has opened the other side
            time.sleep(0.01)
            return b""

    def write(self, end, data):
        if end is not None and data:
            os.write(end, data)

    def happen(self):
        """What happens by itself, as time goes on."""

    def to_host(self, data):
        """Returns the pieces in which the driver gets what the device has sent."""
        return [data]

    def answer_host(self, data):
        """What the line does when the driver has sent something."""

    def end(self):
        self.ends = True
        self.thread.join()


class ByteByByte(Line):
    def to_host(self, data):
        return [data[i:i + 1] for i in range(len(data))]


class Garbage(Line):
    def to_host(self, data):
        return [self.random.randbytes(7), data] if self.random.random() < 0.3 else [data]


class Spoiled(Line):
    def to_host(self, data):
        return [bytes(b ^ 1 << self.random.randrange(8) if self.random.random() < 0.001 else b for b in data)]


class Echo(Line):
    def answer_host(self, data):
        self.write(self.host, data)


class Unplugged(Line):
    """For a second, from one and a half seconds on."""

    def happen(self):
        if self.host is not None and 1.5 < self.age() < 2.5:
            self.unplug()
        if self.host is None and self.age() >= 2.5:
            self.plug_in()


class Silent(Line):
    def to_host(self, data):
        return [data] if self.age() < 1.5 else []


class Trial:
    """A system with the driver. It runs for RUN seconds."""

    def __init__(self, given, folder, name, kind):
        self.given, self.name, self.kind = given, name, kind
        self.folder = pathlib.Path(folder) / name
        self.folder.mkdir()

    def run(self):
        line, emulator = None, None
        try:
            if self.kind is not None:
                emulator = subprocess.Popen(self.given.emulator + ["--link", str(self.folder / "device")])
                line = self.kind(self.await_link(emulator), str(self.folder / "line"))
            done = subprocess.run(
                [self.given.deployer, str(self.graph()), "--until", f"{RUN:g}s", "--record",
                 f"{self.folder / 'readings.csv'}=server.{self.given.port}"],
                capture_output=True, text=True, errors="replace", timeout=60, cwd=self.folder)
            return done.returncode, done.stdout + done.stderr, self.readings()
        finally:
            if line is not None:
                line.end()
            if emulator is not None:
                emulator.kill()
                emulator.wait()

    def await_link(self, emulator):
        for _ in range(1000):
            if (self.folder / "device").exists():
                return str(self.folder / "device")
            if emulator.poll() is not None:
                sys.exit(f"the emulator {' '.join(self.given.emulator)} has ended with {emulator.returncode}")
            time.sleep(0.01)
        sys.exit(f"the emulator {' '.join(self.given.emulator)} has made no link within 10 s")

    def graph(self):
        params = [f'<param name="{name}" value="{value}"/>' for name, value in
                  [("device", str(self.folder / "line"))] + [p.split("=", 1) for p in self.given.param]]
        graph = self.folder / "trial.xml"
        graph.write_text(f'<graph name="driver_trial_{os.getpid()}_{self.name}" version="1" plugins="{self.given.plugins}">'
                         f'<hardware name="device" type="{self.given.type}">{"".join(params)}</hardware>'
                         f'<component name="server" type="{self.given.server}" hardware="device" autonomous="true"/></graph>')
        return graph

    def readings(self):
        """Returns the times of the readings since the first one [s]."""
        file = self.folder / "readings.csv"
        if not file.exists():
            return []
        with open(file, newline="", encoding="utf-8") as table:
            return [float(row["stamp"]) for row in csv.DictReader(table)]


def faults(name, outcome, whole):
    """Returns what is wrong with the outcome of a trial. `whole` is the number of readings over a good line."""
    status, said, readings = outcome
    if name == "absent":
        return [] if status > 0 and "line" in said else [f"status {status}; expected an error that names the line"]
    wrong = []
    if status != ENDS_WELL and name != "silent":
        wrong.append(f"the system ended with status {status}")
    if status < 0 or status > 3:
        wrong.append(f"the system crashed (status {status})")
    least = {"silent": 1, "unplugged": whole // 3}.get(name, whole // 2)
    if len(readings) < max(least, 1):
        wrong.append(f"{len(readings)} readings came, expected at least {max(least, 1)}")
    if name == "unplugged" and readings and readings[-1] - readings[0] < 2.0:
        wrong.append("no reading came after it was plugged in again")
    if name == "silent" and "nothing has come from it" not in said:
        wrong.append("nobody said that the device is silent: see longest_silence() and heard()")
    return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for word in ("deployer", "plugins", "type", "server", "port"):
        parser.add_argument("--" + word, required=True)
    parser.add_argument("--param", action="append", default=[])
    parser.add_argument("emulator", nargs=argparse.REMAINDER)
    given = parser.parse_args()
    kinds = {"whole": Line, "byte_by_byte": ByteByByte, "garbage": Garbage, "spoiled": Spoiled, "echo": Echo,
             "unplugged": Unplugged, "silent": Silent, "absent": None}
    with tempfile.TemporaryDirectory(prefix="orca_driver_trial_") as folder, concurrent.futures.ThreadPoolExecutor(len(kinds)) as pool:
        running = {name: pool.submit(Trial(given, folder, name, kind).run) for name, kind in kinds.items()}
        outcomes = {name: one.result() for name, one in running.items()}
    whole, failed = len(outcomes["whole"][2]), False
    for name, outcome in outcomes.items():
        wrong = faults(name, outcome, whole)
        print(f"{name}: {len(outcome[2])} readings in {RUN:g} s" + "".join(f"; {text}" for text in wrong))
        if wrong:
            failed = True
            print(outcome[1])
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
