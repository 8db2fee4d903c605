# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads recorded and simulated runs as steps: how a robot moved by its odometry, and how it really moved.

A motion is (forward [m], left [m], turn [rad]) in the frame at its beginning. A step is a pair of motions over the same
time, (odometry, reference). The public logs are described in docs/realism.md.
"""
import csv
import gzip
import math

# Relations tie poses that are near each other in place; those of one step are near in time, too.
LONGEST_STEP = 14.0  # [s] longest time between two scans of the Intel log


def wrapped(angle):
    """The same angle in (-pi, pi]."""
    return math.atan2(math.sin(angle), math.cos(angle))


def between(a, b):
    """The motion from pose a to pose b, both (x, y, yaw)."""
    dx, dy, c, s = b[0] - a[0], b[1] - a[1], math.cos(a[2]), math.sin(a[2])
    return c * dx + s * dy, c * dy - s * dx, wrapped(b[2] - a[2])


def joined(a, b):
    """The motion a, then b."""
    c, s = math.cos(a[2]), math.sin(a[2])
    return a[0] + c * b[0] - s * b[1], a[1] + s * b[0] + c * b[1], wrapped(a[2] + b[2])


def reversed_motion(a):
    c, s = math.cos(a[2]), math.sin(a[2])
    return -c * a[0] - s * a[1], s * a[0] - c * a[1], -a[2]


def lines_of(path):
    with gzip.open(path, "rt", encoding="ascii") as file:
        yield from (line.split() for line in file if not line.startswith("#"))


def scans(path):
    """[(stamp, odometry pose, corrected pose)] of slam/intel_scans.txt.gz."""
    rows = ([float(word) for word in words[:7]] for words in lines_of(path))
    return [(row[0], tuple(row[1:4]), tuple(row[4:7])) for row in rows]


def steps_of_scans(path):
    rows = scans(path)
    return [(between(a[1], b[1]), between(a[2], b[2])) for a, b in zip(rows, rows[1:])]


def steps_of_carmen_log(path):
    """Steps between the scans of a corrected log.

    Its ODOM lines lead on from the corrected pose of the last scan by the robot's own odometry, up to a line with the stamp
    of the next scan, whose corrected pose follows. So the difference of those two is the error of the odometry in between.
    """
    steps, start, led_on = [], None, None
    for words in lines_of(path):
        if words[0] == "ODOM":
            led_on = words[-1], tuple(float(word) for word in words[1:4])
        elif words[0] == "FLASER":
            corrected = tuple(float(word) for word in words[-9:-6])
            if start is not None and led_on[0] == words[-1]:
                steps.append((between(start, led_on[1]), between(start, corrected)))
            start = corrected
    return steps


def relations(path):
    """{stamp: [(other stamp, motion to there)]}, both ways."""
    graph = {}
    for words in lines_of(path):
        a, b, *motion = (float(word) for word in words)
        motion = motion[0], motion[1], motion[5]
        graph.setdefault(a, []).append((b, motion))
        graph.setdefault(b, []).append((a, reversed_motion(motion)))
    return graph


def motion_through(graph, a, b):
    """The motion from stamp a to stamp b by the fewest relations between stamps of that time; None if they are not tied."""
    ways, seen = [(a, (0.0, 0.0, 0.0))], {a}
    for stamp, motion in ways:
        if stamp == b:
            return motion
        for other, tie in graph.get(stamp, ()):
            if other not in seen and a <= other <= b:
                seen.add(other)
                ways.append((other, joined(motion, tie)))
    return None


def steps_of_relations(scans_path, relations_path):
    """Steps between neighbouring scans that hand-made relations tie, with the relations as reference."""
    rows, graph = scans(scans_path), relations(relations_path)
    steps = []
    for a, b in zip(rows, rows[1:]):
        motion = motion_through(graph, a[0], b[0]) if b[0] - a[0] <= LONGEST_STEP else None
        if motion:
            steps.append((between(a[1], b[1]), motion))
    return steps


def steps_of_runs(lines):
    """{seed: steps} of what sim_odometry_runs prints."""
    runs, last = {}, {}
    for row in csv.DictReader(lines):
        poses = [tuple(float(row[f"{kind}_{part}"]) for part in ("x", "y", "yaw")) for kind in ("odometry", "true")]
        before = last.get(row["seed"], [(0.0, 0.0, 0.0)] * 2)
        runs.setdefault(row["seed"], []).append(tuple(between(a, b) for a, b in zip(before, poses)))
        last[row["seed"]] = poses
    return runs
