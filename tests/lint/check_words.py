# SPDX-License-Identifier: GPL-3.0-or-later
"""The tree has no marks of unfinished work and no path of one person's machine."""
import re

# Written in pieces so that this file does not find itself.
UNFINISHED = re.compile(r"\b(" + "TO" + "DO|FIX" + r"ME|X" + r"XX)\b")
MACHINE_PATH = re.compile(r"(?<![\w./>}])/(?:" + "home/[a-z]|Users/[A-Za-z]|root/|work/" + r")[\w./-]*")
TEXT = (".cpp", ".hpp", ".h", ".c", ".idl", ".py", ".sh", ".cmake", ".txt", ".md", ".json", ".xml", ".xsd", ".urdf",
        ".toml", "dev", ".ci/run", ".map", ".clang-tidy", ".clang-format")
FREE = ("LICENSES/", "tests/data/", "tests/fuzz/")


def find(tree):
    findings = []
    for path in tree.with_suffix(*TEXT):
        if path.startswith(FREE):
            continue
        for number, line in enumerate(tree.text(path).splitlines(), 1):
            mark = UNFINISHED.search(line)
            if mark:
                findings.append(f"{path}:{number}: {mark[0]}: finish it, or write an issue and remove the mark")
            place = MACHINE_PATH.search(line)
            if place:
                findings.append(f"{path}:{number}: {place[0]} is a path of one machine; use one that starts in the tree")
    return findings


BAD = [
    ({"src/a.cpp": "int a;  // TO" + "DO later\n"}, "src/a.cpp:1: TO" + "DO"),
    ({"README.md": "one\n\nFIX" + "ME\n"}, "README.md:3"),
    ({"a.py": "# X" + "XX\n"}, "a.py:1"),
    ({"CMakeLists.txt": 'set(a "/ho' + 'me/anna/orca")\n'}, "path of one machine"),
    ({"docs/a.md": "see /wo" + "rk/orca\n"}, "path of one machine"),
    ({"dev": "cd /ro" + "ot/x\n"}, "path of one machine"),
]
GOOD = [
    {"src/a.cpp": "// todos los robots; /proc/self/maps; build/wo" + "rk/x; ${X}/ro" + "ot/x; </root>\n"},
    {"docs/a.md": "the socket is in /tmp/orca-<uid>/\n", "LICENSES/a.txt": "TO" + "DO\n"},
]
