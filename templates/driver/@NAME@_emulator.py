"""@NAME@_emulator.py --link PATH: @CLASS@ at a pseudo terminal, which PATH leads to."""
import argparse
import contextlib
import math
import os
import select
import struct
import time
import tty


def crc_ccitt(data):
    crc = 0xFFFF
    for byte in data:
        crc ^= byte << 8
        for _ in range(8):
            crc = (crc << 1 ^ 0x1021 if crc & 0x8000 else crc << 1) & 0xFFFF
    return crc


def frame(kind, content):
    head = struct.pack("<BBH", 0xA5, ord(kind), len(content)) + content
    return head + struct.pack("<H", crc_ccitt(head))


def scan():
    """A wall 2 m ahead, as 61 beams over half a circle see it."""
    angles = (math.radians(-90 + 3 * i) for i in range(61))
    ranges = (2000 / math.cos(a) if math.cos(a) > 0.25 else 0 for a in angles)
    return frame("s", struct.pack("<61H", *(round(r) for r in ranges)))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--link", required=True)
    link = parser.parse_args().link
    device, host_side = os.openpty()
    tty.setraw(host_side)
    with contextlib.suppress(FileNotFoundError):
        os.unlink(link)  # of a run before
    os.symlink(os.ttyname(host_side), link)
    scans, due = False, time.monotonic()
    while True:
        if select.select([device], [], [], 0.02)[0]:
            for command in os.read(device, 64).decode("latin-1"):
                if command == "V":
                    os.write(device, frame("v", b"@CLASS@ 1.0"))
                if command in "SQ":
                    scans, due = command == "S", time.monotonic()
        if scans and time.monotonic() >= due:
            os.write(device, scan())
            due += 0.1


main()
