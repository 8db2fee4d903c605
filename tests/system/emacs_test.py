#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Emacs with the setting of docs/graph.md finds no fault in the files that are shipped, finds faults, and completes.

    tests/system/emacs_test.py

Is skipped where there is no Emacs: apt install emacs-nox.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import schema_test
from schema_test import SCHEMAS, SKIPPED, TREE

INSTALLED = "/usr/share/orca"
SETTING = re.compile(r"`(\(with-eval-after-load 'rng-loc .*?\))`")
# What stands before the point, and a word that is offered there.
COMPLETED = {
    "graph_elements": ('<graph name="g"><', "component"),
    "graph_types": ('<graph name="g"><component name="c" type="', "orca.Goto"),
    "graph_params": ('<graph name="g"><component name="c" type="orca.Goto"><param name="', "max_speed"),
    "graph_ports": ('<graph name="g"><component name="c" type="orca.Goto"><port name="', "goal"),
    "graph_choices": ('<graph name="g"><component name="c" start="', "on_demand"),
    "task": ("<task ", "name"),
    "world": ("<world><", "wall"),
    "robot": ('<robot name="r"><', "orca"),
    "experiment": ("<experiment ", "name"),
}
FAULTY = {
    "element": '<graph name="g"><komponent name="c"/></graph>',
    "attribute": '<graph name="g"><component name="c" typ="orca.Goto"/></graph>',
    "type": '<graph name="g"><component name="c" type="orca.Gotoo"/></graph>',
    "missing": "<graph/>",
    "unit": '<graph name="g" within="3 kg"/>',
    "whole_number": '<graph name="g" restarts="1001"/>',
    "world": "<world><wal/></world>",
}


def setting():
    """Returns the setting as the page has it, for the files of this tree instead of those that are installed."""
    found = SETTING.search((TREE / "docs/graph.md").read_text())
    assert found and INSTALLED in found[1], "docs/graph.md: the setting for Emacs is not there"
    return found[1].replace(INSTALLED, str(TREE))


def emacs(files):
    """Returns the number of errors of each file, the schema of each, and the words that are offered."""
    run = subprocess.run(
        ["emacs", "-Q", "--batch", "--eval", setting(), "-l", TREE / "tests/system/emacs_test.el", *files], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr[-2000:]
    errors, schemas, words = {}, {}, {}
    for line in run.stdout.splitlines():
        what, file, *rest = line.split(" ")
        if what == "errors":
            errors[file], schemas[file] = int(rest[0]), rest[1]
        elif what == "words":
            words[file] = rest
    return errors, schemas, words


def shipped_faults():
    files = {str(path): SCHEMAS[root] for root, paths in schema_test.shipped_files().items() for path in paths}
    errors, schemas, _ = emacs(files)
    faults = [f"{file}: Emacs finds {errors.get(file)} errors" for file in files if errors.get(file) != 0]
    for file, schema in files.items():
        wanted = str((TREE / schema).with_suffix(".rnc"))
        if schemas.get(file) != wanted:
            faults.append(f"{file}: Emacs takes {schemas.get(file)}, not {wanted}")
    return faults, len(files)


def written_faults(folder):
    """Returns what is wrong with Emacs's judgment of texts that are written here."""
    for name, (text, _) in COMPLETED.items():
        (folder / f"complete_{name}.xml").write_text(text)
    for name, text in FAULTY.items():
        (folder / f"{name}.xml").write_text(text)
    errors, _, words = emacs(sorted(map(str, folder.iterdir())))
    faults = []
    for name, (text, word) in COMPLETED.items():
        offered = words.get(str(folder / f"complete_{name}.xml"), [])
        if word not in offered:
            faults.append(f"after {text} Emacs does not offer {word}, but {offered}")
    for name, text in FAULTY.items():
        if not errors.get(str(folder / f"{name}.xml")):
            faults.append(f"Emacs finds no error in {text}")
    return faults


def main():
    if not shutil.which("emacs"):
        print("SKIPPED: there is no emacs; apt install emacs-nox")
        return SKIPPED
    faults, count = shipped_faults()
    with tempfile.TemporaryDirectory() as folder:
        faults += written_faults(pathlib.Path(folder))
    print("\n".join([*faults, f"{count} shipped files, {len(FAULTY)} faulty ones, {len(COMPLETED)} places to complete"]))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
