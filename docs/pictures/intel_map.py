#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Draws docs/pictures/intel_map.png: the map that SlamLocalizer makes of the log of the Intel Research Lab.

    docs/pictures/intel_map.py [BUILD]         BUILD: build/release

The log is looked up in the folder that the environment variable ORCA_DATA names, else in shared/data beside the source tree. The
picture has no libraries behind it: it is a matrix of bytes, packed by zlib.
"""
import gzip
import math
import os
import pathlib
import re
import struct
import subprocess
import sys
import time
import zlib

TREE = pathlib.Path(__file__).resolve().parents[2]
CELL = 0.05  # [m] side of a pixel
FAR = 20.0  # [m] beyond this the laser heard nothing
MARGIN = 1.0  # [m]
UNKNOWN, FREE, WALL, WAY = 0, 1, 2, 3
COLOURS = bytes((205, 205, 205, 255, 255, 255, 20, 20, 20, 200, 60, 40))


def log_file():
    return pathlib.Path(os.environ.get("ORCA_DATA", TREE / "../shared/data")) / "slam/intel_scans.txt.gz"


def way_of(build):
    """[(x, y, yaw)] of the robot at the scans, by their stamps [s] since the first."""
    player = subprocess.Popen([build / "bin/deployer", TREE / "graphs/intel_log.xml", "--clock", "virtual", "--pace", "0",
                               "--set", f"log={log_file()}"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    control = [build / "bin/orcactl", "--system", "intel_log"]
    try:
        while subprocess.run([*control, "step", "2660s"], capture_output=True, check=False).returncode:
            time.sleep(0.2)
        answer = subprocess.run([*control, "query", "localizer.PathQuery", "<Ask/>"], capture_output=True, text=True,
                                check=True).stdout
    finally:
        player.terminate()
        player.wait()
    found = re.findall(r'<poses x="(\S+)" y="(\S+)" z="0" stamp="(\S+)"><rotation roll="0" pitch="0" yaw="(\S+)"/>', answer)
    first = float(found[0][2])
    return {round(float(t) - first, 3): (float(x), float(y), float(yaw)) for x, y, t, yaw in found}


def scans():
    """(stamp since the first [s], [range]) of the log."""
    with gzip.open(log_file(), "rt", encoding="ascii") as file:
        rows = [[float(word) for word in line.split()] for line in file if not line.startswith("#")]
    return [(round(row[0] - rows[0][0], 3), row[7:]) for row in rows]


def cells_between(a, b):
    """The cells on the line from a to b, without b."""
    steps = max(abs(b[0] - a[0]), abs(b[1] - a[1]), 1)
    return ((a[0] + (b[0] - a[0]) * i // steps, a[1] + (b[1] - a[1]) * i // steps) for i in range(steps))


def draw(way):
    """{cell: [times passed, times hit]} and the cells of the way."""
    grid, passed = {}, []
    for stamp, ranges in scans():
        if stamp not in way:
            continue
        x, y, yaw = way[stamp]
        here = (math.floor(x / CELL), math.floor(y / CELL))
        passed.append(here)
        for i, distance in enumerate(ranges):
            if distance >= FAR:
                continue
            angle = yaw + math.radians(i - 90)
            end = (math.floor((x + distance * math.cos(angle)) / CELL), math.floor((y + distance * math.sin(angle)) / CELL))
            for cell in cells_between(here, end):
                grid.setdefault(cell, [0, 0])[0] += 1
            grid.setdefault(end, [0, 0])[1] += 1
    return grid, passed


def png(rows):
    """A picture of two bits a pixel."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    packed = b"".join(b"\0" + bytes(a << 6 | b << 4 | c << 2 | d for a, b, c, d in zip(*[iter(row)] * 4)) for row in rows)
    head = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 2, 3, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"PLTE", COLOURS) + chunk(b"IDAT", zlib.compress(packed, 9)) +
            chunk(b"IEND", b""))


def main():
    grid, passed = draw(way_of(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else TREE / "build/release")))
    rim = round(MARGIN / CELL)
    known = [cell for cell, (_, hit) in grid.items() if hit > 1]
    left, low = (min(cell[k] for cell in known) - rim for k in (0, 1))
    width, height = (max(cell[k] for cell in known) - at + rim for k, at in ((0, left), (1, low)))
    width += -width % 4
    rows = [bytearray(width) for _ in range(height)]

    def put(cell, colour):
        if 0 <= cell[0] - left < width and 0 <= cell[1] - low < height:
            rows[height - 1 - (cell[1] - low)][cell[0] - left] = colour

    for cell, (through, hit) in grid.items():
        put(cell, WALL if hit > 1 and 4 * hit > through else FREE)
    for a, b in zip(passed, passed[1:]):
        for cell in cells_between(a, b):
            put(cell, WAY)
    (TREE / "docs/pictures/intel_map.png").write_bytes(png(rows))


if __name__ == "__main__":
    main()
