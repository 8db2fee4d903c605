#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures how far Localizer is off the truth in a hospital or an office whose furniture has been moved since the map was made, and among people.

    tests/system/localizer/figures.py [--build DIR] [--floor hospital] [--levels nominal,harsh] [--moved 0,10,30] [--people 0] [--told]
                                      [--seeds 1-20] [--pieces 400] [--jobs N]

The hospital is hospital.png of the Stage project, looked up in $ORCA_DATA or in ../shared/data beside the tree. It has no
furniture, so PIECES boxes are drawn at free places. The map has all of them; in the world that share of them [%] stands 0.4 to 1 m
elsewhere, turned by up to 0.5 rad. The office is sim/worlds/office.xml, of whose own furniture that is moved, and the start is one of its places.
A Pioneer walks about at random for 200 s from a drawn place, which Localizer is not told without --told.
With --people 30 four people who walk beside the robot and across its way hide 30 % of the beams from Localizer (tests/data/plugins/crowd.cpp);
who drives does not see them, so the robot goes the same way as without them.
Seeds are fixed, so two runs of the same binaries print the same.

A line for each run and each level: median and 95 % of the error [m] and of the direction [degrees] while it claims a place, the share of the poses with
which it claims one, the share claimed more than 0.5 m off, and the mean of NEES (3 if the covariance is right) with the share of poses inside
their own 95 % ellipsoid (NEES below 7.81). With people, also the share of the beams that they hid, as the crowd itself has counted it.
Exit status: 0 if all runs were made; 1 if one failed; 77 if the hospital is missing.
"""
import argparse
import concurrent.futures
import csv
import math
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from xml.etree import ElementTree

TREE = pathlib.Path(__file__).resolve().parents[3]
DATA = pathlib.Path(os.environ.get("ORCA_DATA", TREE.parent / "shared" / "data"))
PLAN = DATA / "stage_maps/hospital.png"
OFFICE = TREE / "sim/worlds/office.xml"
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
    hidden: float  # [%] of the beams, by people


def drawn_places(args, count, seed):
    """Returns free places on the floor: x, y, heading."""
    lines = subprocess.run([args.build / "tests/draw_goals", PLAN, str(WIDTH), str((count + 1) // 2), str(seed)],
                           capture_output=True, text=True, check=True).stdout.splitlines()
    places = []
    for line in lines:
        x, y, heading, other_x, other_y = map(float, line.split()[:5])
        places += [(x, y, heading), (other_x, other_y, heading + 1.0)]
    return places[:count]


def displaced(pose, chance, start):
    """Returns another pose of a piece of furniture, but the same if that would be over the start."""
    x, y, yaw = pose
    way, to, turn = chance.uniform(0.4, 1.0), chance.uniform(-math.pi, math.pi), chance.uniform(-0.5, 0.5)
    there = (x + way * math.cos(to), y + way * math.sin(to))
    return (*there, yaw + turn) if math.hypot(there[0] - start[0], there[1] - start[1]) > 1.5 else pose


class Hospital:
    def __init__(self, args):
        self.starts = drawn_places(args, max(20, *args.seeds), 1)
        chance = random.Random(1)
        free = [place for place in drawn_places(args, args.pieces, 2)
                if all(math.hypot(place[0] - x, place[1] - y) > 1.5 for x, y, _ in self.starts)]
        self.boxes = [(pose, chance.uniform(0.4, 1.5), chance.uniform(0.4, 0.8)) for pose in free]

    def world(self, seed, share):
        """Returns the floor as a world, that share [1] of its furniture elsewhere."""
        chance = random.Random(seed)
        start = self.starts[seed - 1]
        pieces = ""
        for pose, length, width in self.boxes:
            x, y, yaw = displaced(pose, chance, start) if chance.random() < share else pose
            pieces += f'  <box x="{x:.3f}" y="{y:.3f}" yaw="{yaw:.3f}" length="{length:.3f}" width="{width:.3f}" height="1 m"/>\n'
        return (f'<world name="hospital" version="1">\n  <bitmap file="{PLAN}" width="{WIDTH} m"/>\n{pieces}'
                f'  <place name="start" x="{start[0]}" y="{start[1]}" yaw="{start[2]}"/>\n</world>\n')


class Office:
    def __init__(self, _args):
        places = ElementTree.parse(OFFICE).getroot().iter("place")
        self.starts = [(number(place, "x"), number(place, "y"), number(place, "yaw")) for place in places
                       if not place.get("name").endswith("_door") and place.get("name") != "dock"]

    def world(self, seed, share):
        """As that of the hospital. What has no height is part of the building."""
        chance = random.Random(seed)
        root = ElementTree.parse(OFFICE).getroot()
        start = self.starts[(seed - 1) % len(self.starts)]
        for piece in root:
            pose = (number(piece, "x"), number(piece, "y"), number(piece, "yaw"))
            if piece.tag in ("box", "cylinder") and piece.get("height") and chance.random() < share:
                pose = displaced(pose, chance, start)
            elif piece.tag == "place" and piece.get("name") == "start":
                pose = start
            else:
                continue
            piece.set("x", str(pose[0]))
            piece.set("y", str(pose[1]))
            if piece.tag != "cylinder":
                piece.set("yaw", str(pose[2]))
        return ElementTree.tostring(root, encoding="unicode")


def number(element, name):
    """Returns an attribute [m], [rad]."""
    value, _, unit = element.get(name, "0").partition(" ")
    return math.radians(float(value)) if unit == "deg" else float(value)


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


def errors_of(file, hidden):
    claimed, truth = (poses_of(file)[port] for port in PORTS)
    errors = Errors([], [], [], sum(stamp in claimed for stamp in truth), hidden)
    for stamp, true in truth.items():
        pose = claimed.get(stamp)
        if pose is None or pose.covariance[0] >= ANYWHERE:
            continue
        e = (pose.x - true.x, pose.y - true.y, math.remainder(pose.yaw - true.yaw, 2.0 * math.pi))
        errors.place.append(math.hypot(e[0], e[1]))
        errors.turn.append(abs(e[2]))
        errors.nees.append(quadratic_form(pose.covariance, e))
    return errors


def drive(args, folder, level, share, seed, floor):
    name = folder / f"{level}_{share}_{seed}"
    files = {"map": name.with_suffix(".map.xml"), "world": name.with_suffix(".world.xml")}
    files["map"].write_text(floor.world(seed, 0.0), encoding="utf-8")
    files["world"].write_text(floor.world(seed, share / 100.0), encoding="utf-8")
    poses = name.with_suffix(".csv")
    words = [args.build / "bin/deployer", GRAPH, "--clock", "virtual", "--log", "info" if args.people else "error", "--until", f"{args.time}s", "--seed", seed,
             "--set", f"realism={level}", "--record", f"{poses}={','.join(PORTS)}"]
    if args.told:
        words += ["--profile", "sim", "--profile", "told"]
    if args.people:
        words += ["--profile", "sim", "--profile", "people", "--set", f"plugins={args.build}/tests/plugins",
                  "--set", "scans=crowd.laser_out", "--set", f"crowd.share={args.people / 100.0}"]
    for arg, file in files.items():
        words += ["--set", f"{arg}={file}"]
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        print(f"{level} moved {share} % seed {seed}: status {done.returncode}: {done.stderr.strip()}")
        return None
    said = re.search(r"people hid ([\d.]+) %", done.stderr)
    errors = errors_of(poses, float(said[1]) if said else 0.0)
    for file in (*files.values(), poses):
        file.unlink()
    return errors


def part(values, share):
    return sorted(values)[int(share * (len(values) - 1))] if values else math.nan


def line(name, all_errors):
    place = [e for errors in all_errors for e in errors.place]
    turn = [e for errors in all_errors for e in errors.turn]
    nees = [e for errors in all_errors for e in errors.nees]
    hidden = [errors.hidden for errors in all_errors]
    count = max(1, len(place))
    return (f"{name}: {100 * part(place, 0.5):.2f} cm, 95 % {100 * part(place, 0.95):.2f} cm, {math.degrees(part(turn, 0.95)):.2f} degrees; "
            f"claimed {100 * len(place) / sum(errors.poses for errors in all_errors):.1f} %, "
            f"wrongly {100 * sum(e > FAR for e in place) / count:.2f} %; "
            f"NEES {sum(nees) / count:.2f}, inside {100 * sum(e < CHI2 for e in nees) / count:.1f} %"
            + (f"; people hid {sum(hidden) / len(hidden):.1f} %" if any(hidden) else ""))


def measure(args, pool, folder, level, share, floor):
    """Makes the runs of one level; returns whether all of them were made."""
    runs = [(seed, pool.submit(drive, args, folder, level, share, seed, floor)) for seed in args.seeds]
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


FLOORS = {"hospital": Hospital, "office": Office}


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=TREE / "build/release")
    parser.add_argument("--floor", choices=FLOORS, default="hospital")
    parser.add_argument("--told", action="store_true", help="Localizer is told where the robot starts")
    parser.add_argument("--levels", default="nominal,harsh")
    parser.add_argument("--moved", type=numbers_of, default=[0, 10, 30], help="[%%] shares of the furniture")
    parser.add_argument("--people", type=float, default=0.0, help="[%%] of the beams that they hide")
    parser.add_argument("--seeds", type=numbers_of, default=list(range(1, 21)))
    parser.add_argument("--pieces", type=int, default=400)
    parser.add_argument("--time", type=float, default=200.0, help="[s] of a walk")
    parser.add_argument("--jobs", type=int, default=2)
    return parser.parse_args()


def main():
    args = options()
    if args.floor == "hospital" and not PLAN.exists():
        print(f"SKIPPED: there is no {PLAN}; set ORCA_DATA to the folder that holds stage_maps/")
        return 77
    floor = FLOORS[args.floor](args)
    all_made = True
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        for level in args.levels.split(","):
            for share in args.moved:
                all_made &= measure(args, pool, pathlib.Path(folder), level, share, floor)
    return 0 if all_made else 1


if __name__ == "__main__":
    sys.exit(main())
