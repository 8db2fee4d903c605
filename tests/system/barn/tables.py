#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the runs of sim/experiments/barn.xml at one level of realism with one kind of pose, and writes their table.

    tests/system/barn/tables.py LEVEL POSE [--tuned DIR] [--build DIR] [--out DIR] [--jobs N] [--to FILE.md] [--numbers "1-20 25"] [--variants A,B]

With --tuned it runs those variants only for which DIR holds settings, NAME.xml, as `simbatch tune sim/experiments/barn.xml` writes them. Where
the declared values were the best there are none, and the row is that of the table without --tuned.
LEVEL is ideal, nominal, harsh or recorded; POSE is odometry (drifts, as that of a robot without a map), slam (a map made on the way) or truth (the simulator's).
The runs are kept in OUT/LEVEL_POSE.batch; called again it goes on where it was stopped. All columns are the referee's
(docs/many-runs.md). Exit status: 0 if all runs were made; 77 if the worlds are missing; otherwise that of simbatch.
"""
import argparse
import csv
import io
import os
import pathlib
import statistics
import subprocess
import sys
import time
import xml.etree.ElementTree as ElementTree

from run import DATA, TREE, wilson

EXPERIMENT = TREE / "sim/experiments/barn.xml"
PROFILES = {"odometry": "sim odometry", "slam": "sim slam", "truth": "sim"}
CLASSES = ("contact", "lost", "trap", "oscillation", "time_out", "overload", "crash")


def absolute(attributes, name):
    if name in attributes:
        attributes[name] = os.path.normpath(EXPERIMENT.parent / attributes[name])


def take_settings(root, folder):
    """Gives variants the settings that the folder holds, and leaves out the others."""
    for variant in root.findall("variant"):
        file = folder.resolve() / f"{variant.get('name')}.xml"
        if file.exists() and ElementTree.parse(file).getroot().find("set") is not None:
            variant.set("settings", str(file))
        else:
            root.remove(variant)


def experiment(level, pose, numbers, tuned, variants):
    """Returns the text of barn.xml at that level and pose. Its paths are absolute, so that it may lie anywhere."""
    root = ElementTree.parse(EXPERIMENT).getroot()
    root.set("name", f"barn_{level}_{pose}{'_tuned' if tuned else ''}")
    root.set("profile", PROFILES[pose])
    root.insert(0, ElementTree.Element("set", {"arg": "realism", "value": level}))
    if tuned:
        take_settings(root, tuned)
    for control in [variant for variant in root.findall("variant") if variant.get("name").endswith("_truth")]:
        root.remove(control)  # here the pose is the table's
    for other in [variant for variant in root.findall("variant") if variants and variant.get("name") not in variants]:
        root.remove(other)
    for element in root.iter():
        absolute(element.attrib, "graph")
    root.remove(root.find("tuning"))
    for worlds in root.iter("worlds"):
        for name in ("file", "references"):
            worlds.set(name, str(DATA / "barn" / pathlib.Path(worlds.get(name)).name))
        if numbers:
            worlds.set("numbers", numbers)
    return ElementTree.tostring(root, encoding="unicode") + "\n"


def mean(rows, column):
    values = [float(row[column]) for row in rows if row[column]]
    return f"{sum(values) / len(values):.3f}" if values else "-"


def total(rows, column):
    return round(sum(float(row[column]) for row in rows if row[column]))


def line(variant, rows):
    good = [float(row["time"]) for row in rows if row["ending"] == "success"]
    low, high = wilson(len(good), len(rows))
    failures = [f"{name} {count}" for name in CLASSES
                if (count := sum(row["failure"] == name for row in rows)) > 0]
    return (f"| {variant} | {len(good)} of {len(rows)} | {100 * max(0, low):.1f} to {100 * high:.1f} % "
            f"| {mean(rows, 'barn_score')} | {mean(rows, 'spl')} "
            f"| {f'{statistics.median(good):.1f} s' if good else '-'} "
            f"| {total(rows, 'claimed_wrongly')} | {total(rows, 'not_claimed')} | {', '.join(failures) or '-'} |")


def command(args):
    """Returns the command that makes the same table."""
    words = ["tests/system/barn/tables.py", args.level, args.pose]
    if args.tuned:
        words += ["--tuned", os.path.relpath(args.tuned, TREE)]
    if args.variants:
        words += ["--variants", ",".join(args.variants)]
    return " ".join(words)


def table(args, rows, commit):
    variants = {}
    for row in rows:
        variants.setdefault(row["variant"], []).append(row)
    worlds = len({row["world"] for row in rows})
    order = [element.get("name") for element in ElementTree.parse(EXPERIMENT).getroot().iter("variant")]
    return "\n".join([
        "<!-- SPDX-License-Identifier: LGPL-3.0-or-later -->",
        f"# BARN, level {args.level}, pose by {args.pose}{', tuned' if args.tuned else ''}",
        "",
        f"Made by `{command(args)}` on {time.strftime('%Y-%m-%d', time.gmtime())} with commit {commit}: "
        f"{len(rows)} runs, each behaviour once in each of {worlds} worlds,",
        "judged by the referee. [many-runs.md](../many-runs.md#barn) says what the columns mean.",
        "",
        "| behaviour | success | 95 % | BARN score | SPL | median time of successes | claimed wrongly | not claimed | failures |",
        "|---|---|---|---|---|---|---|---|---|",
    ] + [line(name, variants[name]) for name in order if name in variants]) + "\n"


def commit_of_tree():
    done = subprocess.run(["git", "-C", str(TREE), "rev-parse", "--short=8", "HEAD"], capture_output=True, text=True, check=False)
    return done.stdout.strip() or "unknown"


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("level", choices=("ideal", "nominal", "harsh", "recorded"))
    parser.add_argument("pose", choices=PROFILES)
    parser.add_argument("--tuned", type=pathlib.Path, help="folder of settings for variants")
    parser.add_argument("--build", type=pathlib.Path, default=TREE / "build/release")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("."))
    parser.add_argument("--to", type=pathlib.Path, help="the table; default: LEVEL_POSE.md in OUT")
    parser.add_argument("--numbers", default="", help="worlds, e.g. 1-20; default: all of the benchmark's table")
    parser.add_argument("--variants", type=lambda text: text.split(","), default=[], help="e.g. GridPlanner; default: all")
    parser.add_argument("--jobs", type=int, default=2)
    return parser.parse_args()


def main():
    args = options()
    if not (DATA / "barn/cylinders.csv.gz").exists():
        print(f"SKIPPED: there is no {DATA}/barn; set ORCA_DATA to the folder that holds barn/")
        return 77
    name = f"{args.level}_{args.pose}{'_tuned' if args.tuned else ''}"
    args.out.mkdir(parents=True, exist_ok=True)
    file = args.out / f"{name}.xml"
    file.write_text(experiment(args.level, args.pose, args.numbers, args.tuned, args.variants), encoding="utf-8")
    simbatch = str(args.build / "bin/simbatch")
    folder = args.out / f"{name}.batch"
    made = subprocess.run([simbatch, str(file), "--out", str(folder), "--resume", "--jobs", str(args.jobs)],
                          check=False, stdout=subprocess.DEVNULL)
    if made.returncode != 0:
        return made.returncode
    runs = subprocess.run([simbatch, "export", str(folder)], capture_output=True, text=True, check=True).stdout
    rows = list(csv.DictReader(io.StringIO(runs)))
    to = args.to or args.out / f"{name}.md"
    to.write_text(table(args, rows, commit_of_tree()), encoding="utf-8")
    print(to)
    return 0


if __name__ == "__main__":
    sys.exit(main())
