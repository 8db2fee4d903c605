#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lets client libraries of others use the emulated devices: connect, drive a metre, turn, read, disconnect, connect again.

    foreign_clients.py CLIENT BUILD

The libraries are their users' and come from PyPI: `pip install pycreate2 rplidar-roboticia pyrplidar pyrplidarsdk`, for instance into
a virtual environment whose Python the variable ORCA_CLIENTS_PYTHON names. A client whose library is not there is skipped.
"""
import importlib
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

SOURCE = pathlib.Path(__file__).resolve().parents[2]


class Devices:
    """A Create 2 with an RPLIDAR in an office, emulated by the deployer."""

    def __init__(self, build):
        self.build = pathlib.Path(build)
        self.folder = tempfile.TemporaryDirectory()
        os.environ["XDG_RUNTIME_DIR"] = self.folder.name
        self.process = subprocess.Popen(
            [str(self.build / "bin/deployer"), str(SOURCE / "graphs/emulated_devices.xml"), "--set", "realism=ideal",
             "--set", "lines=create2 foreign_base; rplidar foreign_laser",
             "--set", f"robot={SOURCE}/sim/robots/create2.urdf"], stderr=subprocess.PIPE, text=True)
        self.ports = {}
        while len(self.ports) < 2:
            line = self.process.stderr.readline()
            if not line:
                sys.exit("the deployer has ended")
            found = re.search(r": (create2|rplidar): .* other programs as (\S+)", line)
            if found:
                self.ports[found[1]] = found[2]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.communicate(timeout=20)
        self.folder.cleanup()

    def pose(self):
        """Returns where the robot really is: x, y [m], heading [rad]."""
        text = subprocess.run([str(self.build / "bin/orcactl"), "query", "truth.RobotPoseQuery", "<AskReading/>"],
                              capture_output=True, text=True, timeout=30, check=True).stdout
        values = [re.search(rf'\b{name}="([^"]*)"', text) for name in ("x", "y", "orientation")]
        assert all(values), text
        return [float(value[1]) for value in values]


def check(is_so, what):
    if not is_so:
        sys.exit(f"FAILED: {what}")


def drive_create2(devices, library):
    def drive(robot, right, left, seconds):  # [mm/s]
        robot.drive_direct(right, left)
        time.sleep(seconds)
        robot.drive_stop()
        time.sleep(0.5)

    for _ in range(2):
        robot = library.Create2(devices.ports["create2"])
        robot.start()
        robot.safe()
        begin = devices.pose()
        before = robot.get_sensors()
        drive(robot, 200, 200, 5.0)
        ahead = devices.pose()
        way = math.dist(begin[:2], ahead[:2])
        check(0.9 < way < 1.15, f"it drove {way:.3f} m for 1 m")
        drive(robot, 100, -100, 1.85)  # a quarter of a turn to the left
        turn = math.remainder(devices.pose()[2] - ahead[2], 2 * math.pi)
        check(1.3 < turn < 1.9, f"it turned by {turn:.3f} rad for 1.57")
        drive(robot, -200, -200, 0.1)
        after = robot.get_sensors()
        counts = (after.encoder_counts_left - before.encoder_counts_left) % 65536
        check(counts > 1500, f"its left wheel counted {counts}")
        check(after.voltage > 10000, f"its battery has {after.voltage} mV")
        drive(robot, 100, -100, 1.85)
        del robot  # which disconnects


def scan_with_rplidar(devices, library):
    for _ in range(2):
        laser = library.RPLidar(devices.ports["rplidar"])
        check(laser.get_info()["firmware"] == (1, 29), "its firmware is another one")
        check(laser.get_health()[0] == "Good", "it is not well")
        for number, scan in enumerate(laser.iter_scans()):
            check(len(scan) > 100, f"a turn has {len(scan)} points")
            if number == 4:
                break
        laser.stop()
        laser.stop_motor()
        laser.disconnect()


def scan_with_pyrplidar(devices, library):
    for _ in range(2):
        laser = library.PyRPlidar()
        laser.connect(port=devices.ports["rplidar"], baudrate=115200, timeout=3)
        check(len(laser.get_scan_modes()) == 2, "it does not have two scan modes")
        check(laser.get_scan_mode_typical() == 1, "its typical mode is not the express one")
        for number, point in enumerate(laser.start_scan_express(1)()):
            if number == 2000:
                break
        laser.stop()
        time.sleep(0.1)  # as the laser needs, which this library leaves to its user
        laser.disconnect()


def scan_with_sdk(devices, library):
    for _ in range(2):
        laser = library.RplidarDriver(port=devices.ports["rplidar"], baudrate=115200)
        check(laser.connect(), "the maker's SDK does not connect")
        check(laser.get_device_info() is not None, "it does not say what it is")
        check(laser.start_scan(), "the maker's SDK cannot begin a scan")
        scans = [scan for scan in (laser.get_scan_data() for _ in range(10)) if scan]
        check(len(scans) >= 5, f"{len(scans)} of 10 scans came")
        check(len(scans[-1][1]) > 100, f"a turn has {len(scans[-1][1])} points")
        laser.stop_scan()
        laser.disconnect()


def without_dtr():
    """Lets pyserial switch the line DTR of a pseudo terminal, which has none."""
    try:
        import serial
    except ImportError:
        return
    serial.Serial._update_dtr_state = lambda self: None


CLIENTS = {"pycreate2": ("pycreate2", drive_create2), "rplidar_roboticia": ("rplidar", scan_with_rplidar),
           "pyrplidar": ("pyrplidar", scan_with_pyrplidar), "pyrplidarsdk": ("pyrplidarsdk", scan_with_sdk)}


def main():
    client, build = sys.argv[1:]
    python = os.environ.pop("ORCA_CLIENTS_PYTHON", None)
    if python:
        os.execv(python, [python, "-B", *sys.argv])
    module, use = CLIENTS[client]
    try:
        library = importlib.import_module(module)
    except ImportError as missing:
        print(f"SKIPPED: {missing}; pip install {client.replace('_', '-')}")
        return
    without_dtr()
    with Devices(build) as devices:
        time.sleep(2.0)  # they have started up long before a program comes
        use(devices, library)
    print("all is well")


main()
