#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The schemas that editors use, each in the languages of VS Code (.xsd) and of Emacs (.rnc): those of graphs are what the deployer
writes, and every file that is shipped names its schema and fits it.

    tests/system/schema_test.py BUILD [--write]

With --write, graphs/orca-graph.xsd and .rnc are brought up to date. What only xmllint and rnc2rng can judge is skipped without them.
"""
import argparse
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

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
# The schemas of graphs, and the options of the deployer that write them.
LANGUAGES = {"graphs/orca-graph.xsd": "--schema", "graphs/orca-graph.rnc": "--rnc"}
# Files with a fault, and the root of each.
FAULTY = {"world": "tests/data/worlds/broken/*.xml", "robot": "tests/data/robots/broken/*.urdf"}
FOUND = 33  # in how many of them both languages find it, at least
TOOLS = {"xmllint": "libxml2-utils", "rnc2rng": "python3-rnc2rng"}
LOCATED = "{http://thaiopensource.com/ns/locating-rules/1.0}documentElement"


def shipped_files():
    """Returns the files of each kind. Others, such as the settings that simbatch tune writes, have no schema."""
    files = {root: [] for root in SCHEMAS}
    for path in sorted([*TREE.glob("graphs/**/*.xml"), *TREE.glob("sim/**/*.xml"), *TREE.glob("sim/**/*.urdf")]):
        files.get(ROOT.search(ASIDE.sub("", path.read_text()))[1], []).append(path)
    return files


def written_schema(build, language, *options):
    """Some plugins of the tests cannot be loaded, on purpose: then the exit status is 2, and the rest is there."""
    run = subprocess.run([build / "bin/deployer", language, *options], capture_output=True, text=True)
    assert run.returncode == (2 if options else 0), run.stderr
    return run.stdout


def misfits(schema, files):
    """Returns what xmllint says of the files that do not fit; of an .rnc by way of RELAX NG in XML syntax."""
    if schema.suffix == ".xsd":
        return said_of_misfits("--schema", schema, files)
    with tempfile.TemporaryDirectory() as folder:
        converted = pathlib.Path(folder) / "schema.rng"
        subprocess.run(["rnc2rng", schema, converted], check=True)
        return said_of_misfits("--relaxng", converted, files)


def said_of_misfits(option, schema, files):
    run = subprocess.run(["xmllint", "--noout", option, schema, *files], capture_output=True, text=True)
    return [line for line in run.stderr.splitlines() if not line.endswith(" validates")]


def differences():
    """Returns the faulty files in which only one of the two languages finds a fault, and in how many both do."""
    found = []
    count = 0
    for root, pattern in FAULTY.items():
        files = sorted(TREE.glob(pattern))
        schema = TREE / SCHEMAS[root]
        by_xsd, by_rnc = ({line for line in misfits(language, files) if line.endswith(" fails to validate")}
                          for language in (schema, schema.with_suffix(".rnc")))
        found += [f"{line} by one language only" for line in sorted(by_xsd ^ by_rnc)]
        count += len(by_xsd & by_rnc)
    return found, count


def check_both(schema, files, faults):
    """Compares the files with both schemas as far as the tools are there."""
    if shutil.which("xmllint"):
        faults += misfits(schema, files)
    if all(map(shutil.which, TOOLS)):
        faults += misfits(schema.with_suffix(".rnc"), files)


def mislocated():
    """Returns where schemas.xml leads Emacs to another schema than that of the same name."""
    rules = ElementTree.parse(TREE / "schemas.xml").getroot().findall(LOCATED)
    right = {root: str(pathlib.Path(schema).with_suffix(".rnc")) for root, schema in SCHEMAS.items()}
    located = {rule.get("localName"): rule.get("uri") for rule in rules}
    return [] if located == right else [f"schemas.xml leads to {located}, not {right}"]


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
    faults = mislocated()
    for name, language in LANGUAGES.items():
        shipped = TREE / name
        text = written_schema(args.build, language)
        if args.write:
            shipped.write_text(text)
        if shipped.read_text() != text:
            faults.append(f"{name} differs from deployer {language}; bring it up to date: tests/system/schema_test.py BUILD --write")
    count = 0
    for root, files in shipped_files().items():
        count += len(files)
        faults += unnamed(SCHEMAS[root], files)
        check_both(TREE / SCHEMAS[root], files, faults)
    if count < 150:
        faults.append(f"only {count} files found")
    with tempfile.TemporaryDirectory() as folder:
        more = pathlib.Path(folder) / "more.xsd"
        for name, language in LANGUAGES.items():
            written = more.with_suffix(pathlib.Path(name).suffix)
            written.write_text(written_schema(args.build, language, "--plugins", args.build / "tests/plugins"))
            if '"orca.Avoid"' not in written.read_text():
                faults.append(f"--plugins adds no types to deployer {language}")
        check_both(more, [TREE / "tests/data/graphs/system/avoid.xml"], faults)
    missing = [tool for tool in TOOLS if not shutil.which(tool)]
    if not missing:
        different, found = differences()
        faults += different
        print(f"both languages find a fault in {found} faulty worlds and robots")
        if found < FOUND:
            faults.append(f"fewer than {FOUND}")
    print("\n".join([*faults, f"{count} files compared with {len(SCHEMAS)} schemas"]))
    if not faults and missing:
        print(f"SKIPPED: {', '.join(missing)} not installed; apt install {' '.join(TOOLS[tool] for tool in missing)}")
        return SKIPPED
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
