#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The schemas that editors use: the graph's is what the deployer writes, and every file that is shipped names its schema and fits it.

    tests/system/schema_test.py BUILD [--write]

With --write, graphs/orca-graph.xsd is brought up to date. What only xmllint can judge is skipped without it.
"""
import argparse
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

TREE = pathlib.Path(__file__).resolve().parents[2]
SKIPPED = 77
MODEL = re.compile(r'^<\?xml-model href="([^"]+)"\?>$', re.MULTILINE)
ROOT = re.compile(r"<([a-z_]+)")
ASIDE = re.compile(r"<!--.*?-->|<\?.*?\?>", re.DOTALL)
# The schema of each kind of file, by its root element.
SCHEMAS = {
    "graph": "graphs/orca-graph.xsd",
    "task": "graphs/tasks/orca-task.xsd",
    "world": "sim/worlds/orca-world.xsd",
    "robot": "sim/robots/orca-robot.xsd",
    "experiment": "sim/experiments/orca-experiment.xsd",
}


def shipped_files():
    """Returns the files of each kind. Others, such as the settings that simbatch tune writes, have no schema."""
    files = {root: [] for root in SCHEMAS}
    for path in sorted([*TREE.glob("graphs/**/*.xml"), *TREE.glob("sim/**/*.xml"), *TREE.glob("sim/**/*.urdf")]):
        files.get(ROOT.search(ASIDE.sub("", path.read_text()))[1], []).append(path)
    return files


def written_schema(build, *options):
    """Some plugins of the tests cannot be loaded, on purpose: then the exit status is 2, and the rest is there."""
    run = subprocess.run([build / "bin/deployer", "--schema", *options], capture_output=True, text=True)
    assert run.returncode == (2 if options else 0), run.stderr
    return run.stdout


def misfits(schema, files):
    """Returns what xmllint says of the files that do not fit."""
    run = subprocess.run(["xmllint", "--noout", "--schema", schema, *files], capture_output=True, text=True)
    return [line for line in run.stderr.splitlines() if not line.endswith(" validates")]


def unnamed(schema, files):
    """Returns the files that do not lead editors to the schema."""
    found = []
    for path in files:
        text = path.read_text()
        model = MODEL.search(text)
        right = model is not None and (path.parent / model[1]).resolve() == (TREE / schema).resolve()
        if not right:
            found.append(f"{path.relative_to(TREE)}: does not name {schema} by <?xml-model href=\"...\"?> in its second line")
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--write", action="store_true")
    args = parser.parse_args()
    shipped = TREE / "graphs/orca-graph.xsd"
    text = written_schema(args.build)
    if args.write:
        shipped.write_text(text)
    faults = []
    if shipped.read_text() != text:
        faults.append("graphs/orca-graph.xsd differs from deployer --schema; bring it up to date: tests/system/schema_test.py BUILD --write")
    count = 0
    for root, files in shipped_files().items():
        schema = SCHEMAS[root]
        count += len(files)
        faults += unnamed(schema, files)
        if shutil.which("xmllint"):
            faults += misfits(TREE / schema, files)
    if count < 150:
        faults.append(f"only {count} files found")
    with tempfile.TemporaryDirectory() as folder:
        more = pathlib.Path(folder) / "more.xsd"
        more.write_text(written_schema(args.build, "--plugins", args.build / "tests/plugins"))
        if 'value="orca.Avoid"' not in more.read_text():
            faults.append("--plugins adds no types to the schema")
        if shutil.which("xmllint"):
            faults += misfits(more, [TREE / "tests/data/graphs/system/avoid.xml"])
    print("\n".join([*faults, f"{count} files compared with {len(SCHEMAS)} schemas"]))
    if not faults and not shutil.which("xmllint"):
        print("SKIPPED: xmllint is not installed; ./dev setup installs it")
        return SKIPPED
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
