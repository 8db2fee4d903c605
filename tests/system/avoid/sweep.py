#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Drives the simulated Scout to many random goals in a straight line and counts its contacts.

    tests/system/avoid/sweep.py [--build DIR] [--worlds office,cave,hospital] [--realism nominal,harsh] [--count 200]

Starts, goals and seeds are fixed, so two runs of the same binaries print the same. Cave and hospital are maps of the Stage
project. They are looked up in $ORCA_DATA or in ../shared/data beside the tree; missing ones are reported and left out.
"""
import argparse
import concurrent.futures
import os
import pathlib
import subprocess
import sys
from dataclasses import dataclass

TREE = pathlib.Path(__file__).resolve().parents[3]
DATA = pathlib.Path(os.environ.get("ORCA_DATA", TREE.parent / "shared" / "data"))
WORLDS = {
    "office": (TREE / "sim/worlds/office.xml", 0.0),
    "cave": (DATA / "stage_maps/cave.png", 16.0),
    "hospital": (DATA / "stage_maps/hospital.png", 140.0),
}


@dataclass(frozen=True)
class Drive:
    world: str
    realism: str
    seed: int
    places: tuple  # start x, y, heading, goal x, y
    clear: bool  # the straight line is free


@dataclass(frozen=True)
class Outcome:
    contacts: int
    arrived_at: float  # [s]; 0: it did not arrive


def command(args, drive):
    path, width = WORLDS[drive.world]
    x, y, heading, goal_x, goal_y = drive.places
    settings = {"map": path, "map_width": width, "x": x, "y": y, "heading": heading, "realism": drive.realism,
                "goals": f"a: {goal_x} {goal_y}"}
    line = [args.build / "bin/deployer", args.graph, "--clock", "virtual", "--log", "off",
            "--until", f"{args.limit}s", "--seed", drive.seed]
    for setting in [f"{name}={value}" for name, value in settings.items()] + args.set:
        line += ["--set", setting]
    return [str(word) for word in line]


def run(args, drive):
    done = subprocess.run(command(args, drive), capture_output=True, text=True, timeout=60)
    lines = done.stdout.splitlines()
    # 1 says that a goal was not reached.
    if done.returncode not in (0, 1) or not lines or not lines[-1].startswith("trace-hash"):
        sys.exit(f"a run failed with status {done.returncode}: {' '.join(command(args, drive))}\n{done.stderr}")
    arrivals = [float(line.split()[-1]) for line in lines if line.startswith("arrived")]
    return Outcome(sum(line.startswith("contact") for line in lines), arrivals[0] if arrivals else 0.0)


def draw(args, world, realism):
    path, width = WORLDS[world]
    drawn = subprocess.run([args.build / "tests/draw_goals", path, str(width), str(args.count), "1"],
                           capture_output=True, text=True, check=True).stdout
    for seed, line in enumerate(drawn.splitlines(), start=1):
        *places, clear = line.split()
        yield Drive(world, realism, seed, tuple(places), clear == "clear")


def report(args, drives, outcomes):
    touched = [(d, o) for d, o in zip(drives, outcomes) if o.contacts]
    clear = [o for d, o in zip(drives, outcomes) if d.clear]
    times = sorted(o.arrived_at for o in outcomes if o.arrived_at)
    print(f"{drives[0].world:9} {drives[0].realism:8} runs {len(drives)}  touching {len(touched)}  "
          f"contacts {sum(o.contacts for o in outcomes)}  arrived {len(times)}  "
          f"of clear ways {sum(o.arrived_at > 0 for o in clear)}/{len(clear)}  "
          f"median time {times[len(times) // 2] if times else 0:.1f} s", flush=True)
    if args.verbose:
        for drive, outcome in touched:
            print(f"  {outcome.contacts} contacts: {' '.join(repr(w) if ' ' in w else w for w in command(args, drive))}")
    return len(touched)


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=TREE / "build/release")
    parser.add_argument("--graph", type=pathlib.Path, default=TREE / "graphs/scout_hospital.xml",
                        help="a graph with the arguments map, map_width, x, y, heading, realism and goals")
    parser.add_argument("--set", action="append", default=[], metavar="ARG=VALUE", help="another argument of the graph")
    parser.add_argument("--worlds", default="office,cave,hospital")
    parser.add_argument("--realism", default="nominal,harsh")
    parser.add_argument("--count", type=int, default=200, help="drives per world and realism")
    parser.add_argument("--limit", type=float, default=75.0, help="[s] simulated time of a drive")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--most-touching", type=int, default=0, help="exit 1 if more drives than this touch anything")
    parser.add_argument("--verbose", action="store_true", help="print the command of each drive that touches")
    return parser.parse_args()


def main():
    args = options()
    touching = 0
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        for world in args.worlds.split(","):
            if not WORLDS[world][0].exists():
                print(f"{world:9} left out: there is no {WORLDS[world][0]}")
                continue
            for realism in args.realism.split(","):
                drives = list(draw(args, world, realism))
                touching += report(args, drives, list(pool.map(lambda d: run(args, d), drives)))
    return 1 if touching > args.most_touching else 0


if __name__ == "__main__":
    sys.exit(main())
