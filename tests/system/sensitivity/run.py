#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Shows how much shipped comparisons depend on single errors and estimates of the simulator.

    tests/system/sensitivity/run.py [--build DIR] [--robot laser|sonar] [--realism LEVEL] [--seeds 1-10]
                                    [--errors NAME...] [--jobs N]

With a laser: graphs/pioneer_laser_goto.xml with LaserAvoid and with VfhPlus. With sonars: graphs/scout_goto.xml with
SonarAvoid and without it. Each error is left as it is, halved and doubled. Prints a table in Markdown: goals reached, the
mean time of the last one, and the runs in which something was touched. Two calls with the same binaries print the same.
Exit status: 0 if every run ended; 1 if one crashed or hung.
"""
import argparse
import concurrent.futures
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

TREE = pathlib.Path(__file__).resolve().parents[3]
WHEELS = ("wheel_mismatch", "wheel_size", "track_error", "slip", "turn_slip", "slip_length", "slip_angle", "delay_scale")
CONTACT = ("contact_friction", "wheel_grip", "motor_force")
ERRORS = {
    "laser": WHEELS + ("laser_bias", "laser_sigma", "laser_drop_angle", "laser_threshold", "laser_spot") + CONTACT,
    "sonar": WHEELS + ("sonar_noise", "sonar_outliers", "critical_angle", "sonar_edges", "sonar_threshold",
                       "sonar_in_line") + CONTACT,
}
LIMIT = 200  # [s] simulated
GOALS = 3


def without_avoid(graph):
    """Returns the text of the Scout's graph without the component avoid. Its files are found from anywhere."""
    lines = [line for line in graph.read_text().splitlines() if not re.search(r'"avoid["./]', line)]
    return "\n".join(lines).replace("goto; avoid", "goto").replace("../sim", str(TREE / "sim"))


def behaviours(robot, folder):
    """Returns for each column of the table its heading, graph and further arguments."""
    if robot == "laser":
        graph = TREE / "graphs/pioneer_laser_goto.xml"
        return {name: (graph, "--set", f"avoid=orca.{name}") for name in ("LaserAvoid", "VfhPlus")}
    graph = TREE / "graphs/scout_goto.xml"
    alone = folder / "scout_goto_alone.xml"
    alone.write_text(without_avoid(graph))
    return {"SonarAvoid": (graph,), "Goto alone": (alone,)}


def drive(args, behaviour, errors, seed):
    """Returns the times of arrival and whether anything was touched."""
    words = [args.build / "bin/deployer", *behaviour, "--clock", "virtual", "--log", "error", "--until", f"{LIMIT}s",
             "--seed", seed, "--set", f"realism={args.realism}", "--set", f"errors={errors}"]
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
    for name in args.errors or ERRORS[args.robot]:
        for word, factor in (("halved", 0.5), ("doubled", 2)):
            yield f"`{name}` {word}", f"{name}={factor}"


def table(args, columns):
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        pending = [(name, [[pool.submit(drive, args, behaviour, errors, seed) for seed in args.seeds]
                           for behaviour in columns.values()]) for name, errors in rows(args)]
        print("| error | " + " | ".join(columns) + " |\n|---" + "|---" * len(columns) + "|")
        for name, runs in pending:
            cells = [cell([run.result() for run in column]) for column in runs]
            print(f"| {name} | " + " | ".join(cells) + " |", flush=True)


def seeds(text):
    first, _, last = text.partition("-")
    return list(range(int(first), int(last or first) + 1))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=TREE / "build/release")
    parser.add_argument("--robot", default="laser", choices=tuple(ERRORS))
    parser.add_argument("--realism", default="nominal", choices=("nominal", "harsh"))
    parser.add_argument("--seeds", type=seeds, default=seeds("1-10"))
    parser.add_argument("--errors", nargs="*", help="names (default: all that the robot feels)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    args = parser.parse_args()
    try:
        with tempfile.TemporaryDirectory() as folder:
            table(args, behaviours(args.robot, pathlib.Path(folder)))
    except (RuntimeError, subprocess.TimeoutExpired) as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
