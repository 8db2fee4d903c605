#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Drives a robot from start to goal through each of many worlds and reports how often that succeeds.

    tests/system/barn/run.py [--build DIR] [--file FILE] [--numbers 1-20] [--set ARG=VALUE] [--jobs N]

FILE holds numbered worlds: by default the 200 worlds of the BARN benchmark, looked up in $ORCA_DATA or in
../shared/data beside the tree. It may also be a world with a <generate>, whose seed is the number. A run succeeds if the robot
comes within 1 m of the goal in 100 s and touches nothing. The clock starts with the run, not 0.1 m later as in BARN.

The worlds.csv beside FILE may hold the length of a reference path of each world. Then the BARN score is printed as well: the mean over
all runs of success * OT / clip(AT, 2 OT, 8 OT), AT the run's time and OT that of the reference path at 2 m/s; at most 0.5. BARN
itself takes its scores in Gazebo, so a score from here is not comparable to them.

The seed of each run is the number of its world, so two calls with the same binaries print the same.
Exit status: 0 if every run ended, whatever its result; 1 if one crashed or hung; 2 if it is not said which worlds; 77 if the file
is missing.
"""
import argparse
import concurrent.futures
import csv
import math
import os
import pathlib
import subprocess
import sys
from dataclasses import dataclass

TREE = pathlib.Path(__file__).resolve().parents[3]
DATA = pathlib.Path(os.environ.get("ORCA_DATA", TREE.parent / "shared" / "data"))
BROKEN = ("crash", "hang")
BARN_SPEED = 2.0  # [m/s] at which the benchmark's best robot drives the reference path
LENGTH = "path_len_start_m2.25"  # of the reference path from the place start of barn_goto.xml [m]


@dataclass(frozen=True)
class Outcome:
    number: int
    result: str  # success, collision, time-out, crash or hang
    time: float  # [s] of the arrival or of the first contact; else of the end
    detail: str = ""


def command(args, number):
    words = [args.build / "bin/deployer", args.graph, "--clock", "virtual", "--log", "error", "--until",
             f"{args.limit}s", "--seed", number, "--set", f"world={args.file}#{number}"]
    for setting in args.set:
        words += ["--set", setting]
    return [str(word) for word in words]


def judged(number, lines, limit):
    """Returns the outcome by the deployer's lines: `contact NAME t`, `arrived NAME x y t`."""
    touched = [float(line.split()[-1]) for line in lines if line.startswith("contact")]
    arrived = [float(line.split()[-1]) for line in lines if line.startswith("arrived")]
    if touched:
        return Outcome(number, "collision", touched[0])
    return Outcome(number, "success", arrived[0]) if arrived else Outcome(number, "time-out", limit)


def run(args, number):
    try:
        done = subprocess.run(command(args, number), capture_output=True, text=True, timeout=args.hang)
    except subprocess.TimeoutExpired:
        return Outcome(number, "hang", args.limit, f"no end after {args.hang} s")
    lines = done.stdout.splitlines()
    # A component that fails does not end the run, but leaves its error on stderr.
    if done.returncode != 0 or done.stderr or not lines or not lines[-1].startswith("trace-hash"):
        return Outcome(number, "crash", args.limit, f"status {done.returncode}: {done.stderr.strip()}")
    return judged(number, lines, args.limit)


def wilson(successes, count):
    """Returns the 95 % confidence interval of a rate."""
    z, rate = 1.959964, successes / count
    middle = (rate + z * z / (2 * count)) / (1 + z * z / count)
    half = z * math.sqrt(rate * (1 - rate) / count + z * z / (4 * count * count)) / (1 + z * z / count)
    return middle - half, middle + half


def score(outcome, length):
    """Returns the BARN score of a run in a world with a reference path of that length [m]."""
    optimal = length / BARN_SPEED
    return (outcome.result == "success") * optimal / min(max(outcome.time, 2 * optimal), 8 * optimal)


def report_score(outcomes, lengths):
    scores = [score(o, lengths[o.number]) for o in outcomes if o.number in lengths]
    if not scores:
        print("no BARN score: no worlds.csv beside the worlds gives the lengths of their reference paths")
        return
    missing = len(outcomes) - len(scores)
    print(f"BARN score {sum(scores) / len(scores):.4f}"
          + (f" (without {missing} runs in worlds of no reference length)" if missing else ""))


def report(outcomes):
    by_result = {}
    for outcome in outcomes:
        by_result.setdefault(outcome.result, []).append(outcome)
    good = sorted(o.time for o in by_result.get("success", []))
    low, high = wilson(len(good), len(outcomes))
    print(f"success {len(good)} of {len(outcomes)} = {100 * len(good) / len(outcomes):.1f} % "
          f"(95 %: {100 * low:.1f} to {100 * high:.1f} %)"
          + (f", median time {good[len(good) // 2]:.1f} s" if good else ""))
    for result in sorted(by_result.keys() - {"success"}):
        print(f"{result} {len(by_result[result])}")


def numbers_of(text):
    """Yields the numbers of a list of ranges: 1-3,7 -> 1 2 3 7."""
    for part in text.split(","):
        first, _, last = part.partition("-")
        yield from range(int(first), int(last or first) + 1)


def table_of_worlds(args):
    """Returns the rows of the worlds.csv beside the worlds; none if there is no such file."""
    path = args.file.parent / "worlds.csv"
    if not path.exists():
        return []
    with open(path, newline="", encoding="utf-8") as table:
        return list(csv.DictReader(table))


def numbers(args, worlds):
    return list(numbers_of(args.numbers)) if args.numbers else [int(row["world"]) for row in worlds]


def reference_lengths(worlds):
    return {int(row["world"]): float(row[LENGTH]) for row in worlds if row.get(LENGTH)}


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=TREE / "build/release")
    parser.add_argument("--graph", type=pathlib.Path, default=pathlib.Path(__file__).with_name("barn_goto.xml"))
    parser.add_argument("--file", type=pathlib.Path, default=DATA / "barn/cylinders.csv.gz")
    parser.add_argument("--numbers", default="", help="e.g. 1-20 or 1,4,7; default: all in the file's worlds.csv")
    parser.add_argument("--set", action="append", default=[], metavar="ARG=VALUE", help="an argument of the graph")
    parser.add_argument("--limit", type=float, default=100.0, help="[s] simulated time of a run")
    parser.add_argument("--hang", type=float, default=300.0, help="[s] real time after which a run counts as hung")
    parser.add_argument("--jobs", type=int, default=2)
    return parser.parse_args()


def main():
    args = options()
    if not args.file.exists():
        print(f"SKIPPED: there is no {args.file}; set ORCA_DATA to the folder that holds barn/")
        return 77
    worlds = table_of_worlds(args)
    if not args.numbers and not worlds:
        print(f"there is no worlds.csv beside {args.file}; say --numbers")
        return 2
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        outcomes = []
        for outcome in pool.map(lambda number: run(args, number), numbers(args, worlds)):
            outcomes.append(outcome)
            print(f"world {outcome.number:4}  {outcome.result:9}  {outcome.time:6.2f} s  {outcome.detail}".rstrip(),
                  flush=True)
    report(outcomes)
    report_score(outcomes, reference_lengths(worlds))
    return 1 if any(o.result in BROKEN for o in outcomes) else 0


if __name__ == "__main__":
    sys.exit(main())
