#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lays the odometry of recorded robots beside that of the simulator's levels: the table of docs/realism.md.

    odometry_table.py BUILD            compares the page with the table; exit status 1 if they differ
    odometry_table.py BUILD --write    puts the table into the page

BUILD is a build folder with tests/sim_odometry_runs. The logs are looked up in the folder that the environment variable
ORCA_DATA names, else in shared/data beside the source tree. Without them the comparison is skipped.
"""
import argparse
import difflib
import math
import os
import pathlib
import subprocess
import sys

import odometry_errors
import odometry_logs

TREE = pathlib.Path(__file__).resolve().parents[4]
PAGE = TREE / "docs/realism.md"
BEGIN, END = "<!-- odometry of recorded robots: made by tests/unit/sim/recorded/odometry_table.py -->\n", "<!-- end of odometry -->\n"
FILES = ("slam/intel_scans.txt.gz", "slam/intel.relations.gz", "localization/aces-corrected.carmen.log.gz")
ROBOT = TREE / "sim/robots/pioneer_2dx.urdf"
LEVELS = ("ideal", "nominal", "harsh", "recorded")
ROBOTS, METRES = 60, 200.0
DEGREE = math.pi / 180.0
# What is shown, how it is called, and its unit.
QUANTITIES = (
    ("way_per_metre", "way: true less measured, per way", "%", 0.01),
    ("turn_per_rad", "turn: true less measured, per turn", "%", 0.01),
    ("turn_per_metre", "turn: true less measured, per metre", "deg", DEGREE),
    ("way_sigma_metre", "way: deviation after 1 m", "mm", 0.001),
    ("way_sigma_rad", "way: deviation after 1 rad", "mm", 0.001),
    ("turn_sigma_metre", "turn: deviation after 1 m", "deg", DEGREE),
    ("turn_sigma_rad", "turn: deviation after 1 rad", "deg", DEGREE),
    ("way_sigma_constant", "way: deviation of any step", "mm", 0.001),
    ("turn_sigma_constant", "turn: deviation of any step", "deg", DEGREE))


def data_files():
    folder = pathlib.Path(os.environ.get("ORCA_DATA", TREE.parent / "shared/data"))
    return [folder / file for file in FILES]


def errors_of_logs(scans, relations, aces):
    steps = {"Intel, map": odometry_logs.steps_of_scans(scans),
             "Intel, by hand": odometry_logs.steps_of_relations(scans, relations),
             "ACES, map": odometry_logs.steps_of_carmen_log(aces)}
    return {name: odometry_errors.errors_of_log(of_log) for name, of_log in steps.items()}


def errors_of_level(build, level):
    command = [build / "tests/sim_odometry_runs", ROBOT, level, str(ROBOTS), str(METRES)]
    run = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True)
    return odometry_errors.errors_of_level(odometry_logs.steps_of_runs(run.stdout.splitlines()).values())


def number(value, unit):
    text = f"{value / unit:.2f}" if abs(value / unit) < 9.995 else f"{value / unit:.1f}"
    return text.removeprefix("-") if float(text) == 0.0 else text


def cell(errors, name, unit):
    value, low, high = (number(part, unit) for part in errors[name])
    return value if low == high else f"{value} ({low} to {high})"


def covers(level, log, name):
    """Whether what the level draws meets the log's interval; a random part may also be smaller."""
    _, low, high = level[name]
    return log[name][1] <= high and (name in odometry_errors.RANDOM or low <= log[name][2])


def least_level(levels, log, name):
    """"any" if even the ideal level covers the log: its interval holds 0, so it says little."""
    level = next((level for level in LEVELS if covers(levels[level], log, name)), "beyond")
    return "any" if level == LEVELS[0] else level


def rows(logs, levels):
    for name, words, unit_name, unit in QUANTITIES:
        measured = [f"{cell(log, name, unit)}, {least_level(levels, log, name)}" for log in logs.values()]
        simulated = [cell(level, name, unit) for level in levels.values()]
        if name.endswith("_constant"):  # the reference's own noise, which no level has
            measured = [cell(log, name, unit) for log in logs.values()]
        yield [f"{words} [{unit_name}]", *measured, *simulated]


def table(logs, levels):
    heading = ["error of the odometry", *logs, *levels]
    lines = [heading, ["---"] * len(heading), *rows(logs, levels)]
    return "\n" + "".join("| " + " | ".join(line) + " |\n" for line in lines).replace("| --- ", "|---").replace("--- |", "---|") + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    missing = [str(file) for file in data_files() if not file.exists()]
    if missing:
        print(f"SKIPPED: there is no {', no '.join(missing)}; set ORCA_DATA to the folder that holds {', '.join(FILES)}")
        return 0
    made = table(errors_of_logs(*data_files()), {level: errors_of_level(options.build, level) for level in LEVELS})
    page = PAGE.read_text(encoding="utf-8")
    before, _, rest = page.partition(BEGIN)
    shown, _, after = rest.partition(END)
    if options.write:
        PAGE.write_text(before + BEGIN + made + END + after, encoding="utf-8")
    elif shown != made:
        print(*difflib.unified_diff(shown.splitlines(), made.splitlines(), "docs/realism.md", "made now", lineterm=""), sep="\n")
        print("Make it anew with odometry_table.py BUILD --write")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
