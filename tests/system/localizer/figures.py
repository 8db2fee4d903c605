#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures how far Localizer is off the truth in a hospital whose furniture has been moved since the map was made.

    tests/system/localizer/figures.py [--build DIR] [--levels nominal,harsh] [--moved 0,10,30] [--seeds 1-20] [--pieces 400] [--jobs N]

The floor plan is hospital.png of the Stage project, looked up in $ORCA_DATA or in ../shared/data beside the tree. It has no
furniture, so PIECES boxes are drawn at free places. The map has all of them; in the world that share of them [%] stands 0.4 to 1 m
elsewhere, turned by up to 0.5 rad. A Pioneer walks about at random for 200 s from a drawn place, which Localizer is not told.
Seeds are fixed, so two runs of the same binaries print the same.

A line for each run and each level: median and 95 % of the error [m] and of the direction [degrees] while it claims a place, the share of the poses with
which it claims one, the share claimed more than 0.5 m off, and the mean of NEES (3 if the covariance is right) with the share of poses inside
their own 95 % ellipsoid (NEES below 7.81).
Exit status: 0 if all runs were made; 1 if one failed; 77 if the floor plan is missing.
"""
import argparse
import concurrent.futures
import csv
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile
from dataclasses import dataclass

TREE = pathlib.Path(__file__).resolve().parents[3]
DATA = pathlib.Path(os.environ.get("ORCA_DATA", TREE.parent / "shared" / "data"))
PLAN = DATA / "stage_maps/hospital.png"
WIDTH = 140.0  # [m]
GRAPH = TREE / "tests/data/graphs/system/kidnapped.xml"
ANYWHERE = 1e9  # [m2] a variance that says that no place is claimed
FAR = 0.5  # [m]
CHI2 = 7.815  # 95 % of the chi-square distribution with 3 degrees of freedom
PORTS = ("localizer.RobotPosePush", "truth.RobotPosePush")


@dataclass(frozen=True)
class Pose:
    x: float
    y: float
    yaw: float
    covariance: tuple = ()


@dataclass(frozen=True)
class Errors:
    place: list  # [m]
    turn: list  # [rad]
    nees: list
    poses: int  # with and without a claim


def drawn_places(args, count, seed):
    """Returns free places on the floor: x, y, heading."""
    lines = subprocess.run([args.build / "tests/draw_goals", PLAN, str(WIDTH), str((count + 1) // 2), str(seed)],
                           capture_output=True, text=True, check=True).stdout.splitlines()
    places = []
    for line in lines:
        x, y, heading, other_x, other_y = map(float, line.split()[:5])
        places += [(x, y, heading), (other_x, other_y, heading + 1.0)]
    return places[:count]


def furniture(args, starts):
    """Returns boxes x, y, yaw, length, width, none of them within 1.5 m of a start."""
    chance = random.Random(1)
    free = [place for place in drawn_places(args, args.pieces, 2)
            if all(math.hypot(place[0] - x, place[1] - y) > 1.5 for x, y, _ in starts)]
    return [(x, y, yaw, chance.uniform(0.4, 1.5), chance.uniform(0.4, 0.8)) for x, y, yaw in free]


def moved(boxes, share, seed, start):
    """Returns the boxes, a share of them elsewhere, but none over the start."""
    chance = random.Random(seed)
    result = []
    for x, y, yaw, length, width in boxes:
        if chance.random() < share:
            way, to, turn = chance.uniform(0.4, 1.0), chance.uniform(-math.pi, math.pi), chance.uniform(-0.5, 0.5)
            there = (x + way * math.cos(to), y + way * math.sin(to))
            if math.hypot(there[0] - start[0], there[1] - start[1]) > 1.5:
                x, y, yaw = *there, yaw + turn
        result.append((x, y, yaw, length, width))
    return result


def world(boxes, start):
    pieces = "\n".join(f'  <box x="{x:.3f}" y="{y:.3f}" yaw="{yaw:.3f}" length="{length:.3f}" width="{width:.3f}" height="1 m"/>'
                       for x, y, yaw, length, width in boxes)
    return (f'<world name="hospital" version="1">\n  <bitmap file="{PLAN}" width="{WIDTH} m"/>\n{pieces}\n'
            f'  <place name="start" x="{start[0]}" y="{start[1]}" yaw="{start[2]}"/>\n</world>\n')


def poses_of(file):
    """Returns the poses of both ports by their stamps."""
    poses = {port: {} for port in PORTS}
    with open(file, newline="", encoding="utf-8") as table:
        for row in csv.DictReader(table):
            covariance = tuple(float(row[f"covariance[{i}]"]) for i in range(9))
            poses[row["port"]][round(1e4 * float(row["stamp"]))] = Pose(
                float(row["x"]), float(row["y"]), float(row["orientation"]), covariance)
    return poses


def quadratic_form(covariance, e):
    """Returns e^T P^-1 e of a 3 x 3 matrix, by its adjugate."""
    a, b, c, d, f, g, h, i, j = covariance
    adjugate = ((f * j - g * i, c * i - b * j, b * g - c * f),
                (g * h - d * j, a * j - c * h, c * d - a * g),
                (d * i - f * h, b * h - a * i, a * f - b * d))
    determinant = a * adjugate[0][0] + b * adjugate[1][0] + c * adjugate[2][0]
    return sum(e[r] * adjugate[r][s] * e[s] for r in range(3) for s in range(3)) / determinant


def errors_of(file):
    claimed, truth = (poses_of(file)[port] for port in PORTS)
    errors = Errors([], [], [], sum(stamp in claimed for stamp in truth))
    for stamp, true in truth.items():
        pose = claimed.get(stamp)
        if pose is None or pose.covariance[0] >= ANYWHERE:
            continue
        e = (pose.x - true.x, pose.y - true.y, math.remainder(pose.yaw - true.yaw, 2.0 * math.pi))
        errors.place.append(math.hypot(e[0], e[1]))
        errors.turn.append(abs(e[2]))
        errors.nees.append(quadratic_form(pose.covariance, e))
    return errors


def drive(args, folder, level, share, seed, boxes, start):
    name = folder / f"{level}_{share}_{seed}"
    files = {"map": name.with_suffix(".map.xml"), "world": name.with_suffix(".world.xml")}
    files["map"].write_text(world(boxes, start), encoding="utf-8")
    files["world"].write_text(world(moved(boxes, share / 100.0, seed, start), start), encoding="utf-8")
    poses = name.with_suffix(".csv")
    words = [args.build / "bin/deployer", GRAPH, "--clock", "virtual", "--log", "error", "--until", f"{args.time}s", "--seed", seed,
             "--set", f"realism={level}", "--record", f"{poses}={','.join(PORTS)}"]
    for arg, file in files.items():
        words += ["--set", f"{arg}={file}"]
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        print(f"{level} moved {share} % seed {seed}: status {done.returncode}: {done.stderr.strip()}")
        return None
    errors = errors_of(poses)
    for file in (*files.values(), poses):
        file.unlink()
    return errors


def part(values, share):
    return sorted(values)[int(share * (len(values) - 1))] if values else math.nan


def line(name, all_errors):
    place = [e for errors in all_errors for e in errors.place]
    turn = [e for errors in all_errors for e in errors.turn]
    nees = [e for errors in all_errors for e in errors.nees]
    count = max(1, len(place))
    return (f"{name}: {100 * part(place, 0.5):.2f} cm, 95 % {100 * part(place, 0.95):.2f} cm, {math.degrees(part(turn, 0.95)):.2f} degrees; "
            f"claimed {100 * len(place) / sum(errors.poses for errors in all_errors):.1f} %, "
            f"wrongly {100 * sum(e > FAR for e in place) / count:.2f} %; "
            f"NEES {sum(nees) / count:.2f}, inside {100 * sum(e < CHI2 for e in nees) / count:.1f} %")


def measure(args, pool, folder, level, share, boxes, starts):
    """Makes the runs of one level; returns whether all of them were made."""
    runs = [(seed, pool.submit(drive, args, folder, level, share, seed, boxes, starts[seed - 1])) for seed in args.seeds]
    made = []
    for seed, run in runs:
        if errors := run.result():
            made.append(errors)
            print(line(f"{level} moved {share} % seed {seed}", [errors]), flush=True)
    if made:
        print(line(f"{level} moved {share} %, {len(made)} runs", made), flush=True)
    return len(made) == len(runs)


def numbers_of(text):
    """Returns the numbers of a list of ranges: 1-3,7 -> [1, 2, 3, 7]."""
    return [number for part_of in text.split(",")
            for number in range(int(part_of.partition("-")[0]), int(part_of.partition("-")[2] or part_of) + 1)]


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=TREE / "build/release")
    parser.add_argument("--levels", default="nominal,harsh")
    parser.add_argument("--moved", type=numbers_of, default=[0, 10, 30], help="[%%] shares of the furniture")
    parser.add_argument("--seeds", type=numbers_of, default=list(range(1, 21)))
    parser.add_argument("--pieces", type=int, default=400)
    parser.add_argument("--time", type=float, default=200.0, help="[s] of a walk")
    parser.add_argument("--jobs", type=int, default=2)
    return parser.parse_args()


def main():
    args = options()
    if not PLAN.exists():
        print(f"SKIPPED: there is no {PLAN}; set ORCA_DATA to the folder that holds stage_maps/")
        return 77
    starts = drawn_places(args, max(20, *args.seeds), 1)
    boxes = furniture(args, starts)
    all_made = True
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        for level in args.levels.split(","):
            for share in args.moved:
                all_made &= measure(args, pool, pathlib.Path(folder), level, share, boxes, starts)
    return 0 if all_made else 1


if __name__ == "__main__":
    sys.exit(main())
