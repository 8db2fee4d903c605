# SPDX-License-Identifier: GPL-3.0-or-later
"""Damages shipped files at random, and checks that the deployer neither crashes nor hangs on any of them.

Each case takes a graph, a world, a robot, a bitmap or a plugin, changes a few bytes, words or lines of it, and runs the
deployer with it. It must end by itself, with an exit status of its own, and name what is wrong if it refuses the file.
The same seed damages the same files in the same way.
"""

import argparse
import concurrent.futures
import pathlib
import random
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
LIMIT = 60  # [s] until a run counts as hung
STATUSES = range(4)  # the deployer's own: finished, failed, refused, not started
TOKENS = [b"", b"<", b">", b"\"", b"'", b"&", b"&#0;", b"-1", b"1e999", b"nan", b"${x}", b"9" * 400, b"\0", b"\xff\xfe", b"<a>" * 200]


def flip(data, rng):
    at = rng.randrange(len(data))
    data[at] ^= 1 << rng.randrange(8)


def cut(data, rng):
    begin = rng.randrange(len(data))
    del data[begin:begin + rng.randrange(1, 200)]


def truncate(data, rng):
    del data[rng.randrange(len(data)):]


def double(data, rng):
    begin = rng.randrange(len(data))
    piece = data[begin:begin + rng.randrange(1, 400)]
    at = rng.randrange(len(data))
    data[at:at] = piece


def insert(data, rng):
    at = rng.randrange(len(data))
    data[at:at] = rng.choice(TOKENS)


def replace_number(data, rng):
    digits = [i for i, byte in enumerate(data) if chr(byte).isdigit()]
    if digits:
        at = rng.choice(digits)
        data[at:at + 1] = rng.choice(TOKENS)


BINARY = [flip, flip, cut, truncate, double]
TEXT = BINARY + [insert, insert, replace_number, replace_number]


def damaged(path, rng):
    data = bytearray(path.read_bytes())
    kinds = TEXT if path.suffix in (".xml", ".urdf") else BINARY
    for _ in range(rng.choice([1, 1, 1, 2, 4])):
        if data:
            rng.choice(kinds)(data, rng)
    return bytes(data)


def shipped(build):
    """The files that are damaged, by kind. Graphs refer to what is beside them, so they stay in a copy of their folder."""
    return {
        "graph": sorted((ROOT / "graphs").glob("*.xml")),
        "world": sorted((ROOT / "sim/worlds").glob("*.xml")),
        "robot": sorted((ROOT / "sim/robots").glob("*.urdf")),
        "bitmap": [ROOT / "tests/fuzz/corpus/world/small.png"],
        "plugin": sorted((build / "plugins").glob("*.so")),
    }


class Case:
    """One damaged file and the command that reads it."""

    def __init__(self, number, seed, files, deployer):
        rng = random.Random(f"{seed}/{number}")
        self.number = number
        self.kind = rng.choice(list(files))
        self.file = rng.choice(files[self.kind])
        self.content = damaged(self.file, rng)
        self.deployer = deployer

    def words(self, file):
        run = ["--clock", "virtual", "--until", "1 s", "--no-progress"]
        if self.kind == "graph":
            return [file, *run]
        if self.kind == "plugin":
            return ["--describe", file]
        arg = "robot" if self.kind == "robot" else "world"
        return [ROOT / "graphs/scout_goto.xml", "--set", f"{arg}={file}", *run]

    def fault(self):
        """Returns what is wrong with the deployer's answer, or None."""
        with tempfile.TemporaryDirectory(prefix="orca-damaged-") as folder:
            folder = pathlib.Path(folder)
            (folder / "graphs").mkdir()
            (folder / "sim").symlink_to(ROOT / "sim")
            file = folder / "graphs" / self.file.name
            file.write_bytes(self.content)
            command = [str(word) for word in (self.deployer, *self.words(file))]
            try:
                done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, timeout=LIMIT, cwd=folder)
            except subprocess.TimeoutExpired:
                return self.kept(f"did not end within {LIMIT} s")
            if done.returncode not in STATUSES:
                return self.kept(f"ended with {done.returncode}: {done.stderr[-500:]!r}")
            if done.returncode != 0 and not done.stderr.strip():
                return self.kept(f"exit status {done.returncode} without a word")
        return None

    def kept(self, fault):
        self.place().write_bytes(self.content)
        return f"case {self.number}, {self.file.name}, kept as {self.place()}: {fault}"

    def place(self):
        return pathlib.Path(tempfile.gettempdir()) / f"orca-damaged-{self.number}{self.file.suffix}"


def sees_crashes(files):
    """Returns whether a program that crashes is found, and one that refuses a file without a word."""
    with tempfile.TemporaryDirectory(prefix="orca-damaged-") as folder:
        for number, deed in ((-1, "kill -SEGV $$"), (-2, "exit 2")):
            deployer = pathlib.Path(folder) / f"deployer{number}"
            deployer.write_text(f"#!/bin/sh\n{deed}\n")
            deployer.chmod(0o755)
            case = Case(number, 0, files, deployer)
            if case.fault() is None:
                return False
            case.place().unlink()
    return True


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("build", type=pathlib.Path, help="build folder, for example build/release")
    parser.add_argument("--count", type=int, default=3000, help="number of damaged files (default 3000)")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    files = shipped(options.build.resolve())
    for kind, found in files.items():
        if not found:
            sys.exit(f"there is no {kind} to damage")
    if not sees_crashes(files):
        sys.exit("a deployer that crashes, or refuses a file without a word, would not be noticed")
    deployer = options.build.resolve() / "bin/deployer"
    faults = []
    with concurrent.futures.ThreadPoolExecutor(max_workers=2) as workers:
        cases = (Case(i, options.seed, files, deployer) for i in range(options.count))
        for number, fault in enumerate(workers.map(Case.fault, cases), 1):
            if fault:
                faults.append(fault)
                print(fault, flush=True)
            if number % 500 == 0:
                print(f"{number} of {options.count}, {len(faults)} faults", flush=True)
    print(f"{options.count} damaged files, seed {options.seed}: {len(faults)} crashes, hangs or silent refusals")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
