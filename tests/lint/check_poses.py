# SPDX-License-Identifier: GPL-3.0-or-later
"""In shipped experiments a robot has a pose that it can have, or the variant says by "_truth" in its name that it has the simulator's."""
import re
import xml.etree.ElementTree as ElementTree

OWN_POSE = {"odometry", "slam", "localized"}  # profiles whose pose is the robot's own
OWN_GRAPHS = ("pioneer_tasks.xml", "pioneer_fetch_task.xml", "pioneer_roam.xml", "pioneer_map.xml", "scout_tasks.xml")  # graphs with a pose of their own in every profile


def variants_of(text):
    """Returns name and profiles of each variant; none if the text is no experiment."""
    root = ElementTree.fromstring(text.encode())
    if root.tag != "experiment":
        return []
    variants = []
    for variant in root.findall("variant"):
        profiles = set((variant.get("profile") or root.get("profile") or "").split())
        if (variant.get("graph") or root.get("graph") or "").endswith(OWN_GRAPHS):
            profiles.add("odometry")
        variants.append((variant.get("name"), profiles))
    return variants


def find(tree):
    findings = []
    for path in tree.paths:
        if not re.match(r"sim/experiments/[^/]+\.xml$", path):
            continue
        for name, profiles in variants_of(tree.text(path)):
            is_own, says_truth = bool(profiles & OWN_POSE), "_truth" in name
            if not is_own and not says_truth:
                findings.append(f"{path}: variant {name} has the simulator's pose: add the profile odometry, slam or localized, or \"_truth\" to the name")
            if is_own and says_truth:
                findings.append(f"{path}: variant {name} says \"_truth\", but has a pose of its own")
    return findings


def _experiment(variant, profile=""):
    return {"sim/experiments/e.xml": f'<experiment name="e"{profile}><variant {variant}/></experiment>'}


_ODOMETRY = ' profile="sim odometry"'
BAD = [
    (_experiment('name="a"'), "variant a has the simulator's pose"),
    (_experiment('name="a" profile="sim"', _ODOMETRY), "variant a has the simulator's pose"),
    (_experiment('name="a_truth"', _ODOMETRY), "says \"_truth\", but"),
]
GOOD = [
    _experiment('name="a"', _ODOMETRY),
    _experiment('name="a"' + _ODOMETRY),
    _experiment('name="a" profile="sim slam"'),
    _experiment('name="a_truth" profile="sim"', _ODOMETRY),
    {"sim/experiments/e.xml": '<experiment name="e" graph="../../graphs/pioneer_tasks.xml"><variant name="a"/></experiment>'},
    {"sim/experiments/g.xml": '<graph name="g"/>'},
    {"tests/data/e.xml": '<experiment name="e"><variant name="a"/></experiment>'},
]
