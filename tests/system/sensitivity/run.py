#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Shows how much the comparison of LaserAvoid and VfhPlus depends on single errors of the simulator.

    tests/system/sensitivity/run.py [--build DIR] [--realism LEVEL] [--seeds 1-10] [--errors NAME...] [--jobs N]

Drives graphs/pioneer_laser_goto.xml with each of the two, with each error as it is, halved and doubled, and prints a table
in Markdown: goals reached and the mean time of the last one. Two calls with the same binaries print the same.
Exit status: 0 if every run ended; 1 if one crashed or hung.
"""
import argparse
import concurrent.futures
import os
import pathlib
import statistics
import subprocess
import sys

TREE = pathlib.Path(__file__).resolve().parents[3]
BEHAVIOURS = ("orca.LaserAvoid", "orca.VfhPlus")
LASER_ROBOT = ("wheel_mismatch", "track_error", "slip", "turn_slip", "delay_scale", "laser_bias", "laser_sigma",
               "laser_drop_angle")
LIMIT = 200  # [s] simulated
GOALS = 3


def drive(args, behaviour, errors, seed):
    """Returns the times of arrival and whether anything was touched."""
    words = [args.build / "bin/deployer", TREE / "graphs/pioneer_laser_goto.xml", "--clock", "virtual", "--log", "error",
             "--until", f"{LIMIT}s", "--seed", seed, "--set", f"avoid={behaviour}", "--set", f"realism={args.realism}",
             "--set", f"errors={errors}"]
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=300)
    lines = done.stdout.splitlines()
    if not lines or not lines[-1].startswith("trace-hash"):
        raise RuntimeError(f"{behaviour} {errors} seed {seed}: status {done.returncode}: {done.stderr.strip()}")
    arrived = [float(line.split()[-1]) for line in lines if line.startswith("arrived")]
    return arrived, any(line.startswith("contact") for line in lines)


def cell(results):
    reached = sum(len(arrived) for arrived, _ in results)
    whole = [arrived[-1] for arrived, _ in results if len(arrived) == GOALS]
    time = f"{statistics.mean(whole):.1f} s" if whole else "-"
    touched = sum(contact for _, contact in results)
    return f"{reached} of {GOALS * len(results)}, {time}" + (f", {touched} touched" if touched else "")


def rows(args):
    """Yields the name of each row and its settings of errors."""
    yield "as it is", ""
    for name in args.errors:
        for word, factor in (("halved", 0.5), ("doubled", 2)):
            yield f"`{name}` {word}", f"{name}={factor}"


def table(args):
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        pending = [(name, [[pool.submit(drive, args, behaviour, errors, seed) for seed in args.seeds]
                           for behaviour in BEHAVIOURS]) for name, errors in rows(args)]
        print("| error | LaserAvoid | VfhPlus |\n|---|---|---|")
        for name, columns in pending:
            cells = [cell([run.result() for run in column]) for column in columns]
            print(f"| {name} | " + " | ".join(cells) + " |", flush=True)


def seeds(text):
    first, _, last = text.partition("-")
    return list(range(int(first), int(last or first) + 1))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=TREE / "build/release")
    parser.add_argument("--realism", default="nominal", choices=("nominal", "harsh"))
    parser.add_argument("--seeds", type=seeds, default=seeds("1-10"))
    parser.add_argument("--errors", nargs="*", default=LASER_ROBOT)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    try:
        table(parser.parse_args())
    except (RuntimeError, subprocess.TimeoutExpired) as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
