# SPDX-License-Identifier: GPL-3.0-or-later
"""The tree has no marks of unfinished work and no path of one person's machine; comments of the rooms that are written in plain
English keep to it: no sentence begins with What, Of or That, and reports are not told."""
import re

# Written in pieces so that this file does not find itself.
UNFINISHED = re.compile(r"\b(" + "TO" + "DO|FIX" + r"ME|X" + r"XX)\b")
MACHINE_PATH = re.compile(r"(?<![\w./>}])/(?:" + "home/[a-z]|Users/[A-Za-z]|root/|work/" + r")[\w./-]*")
TEXT = (".cpp", ".hpp", ".h", ".c", ".idl", ".py", ".sh", ".cmake", ".txt", ".md", ".json", ".xml", ".xsd", ".rnc", ".urdf",
        ".toml", "dev", ".ci/run", ".map", ".clang-tidy", ".clang-format")
FREE = ("LICENSES/", "tests/data/", "tests/fuzz/")
# Rooms whose comments were read sentence by sentence. Others join them as they are.
PLAIN = ("idl/", "src/base/", "src/component_api/", "src/components/", "src/geometry/", "src/navigation/", "src/patterns/",
         "src/robot_file/", "src/runtime/batch/", "src/runtime/plugin/", "src/text/", "src/xml/")
COMMENT = re.compile(r"(?<![:\"\w])//[/!]?<?\s?(.*)$")
INDIRECT = re.compile(r"(?:^|(?<=[.:;]\s))(?:What|Whatever|Of|That)\b(?!\s*::)")
TOLD = re.compile(r"\b(?:tells?|told|telling|anew)\b")


def plain_english(tree, path):
    """Yields what is not plain in the comments of a file."""
    before_ends = True
    for number, line in enumerate(tree.text(path).splitlines(), 1):
        comment = COMMENT.search(line)
        if not comment:
            before_ends = True
            continue
        text = comment[1].strip()
        found = INDIRECT.search(text)
        if found and (found.start() > 0 or before_ends):
            yield f"{path}:{number}: a sentence begins with {found[0]}: say the subject first, as in \"The lines that ...\""
        if TOLD.search(text):
            yield f"{path}:{number}: {TOLD.search(text)[0]}: report, show, distinguish or again is plainer"
        before_ends = not text or text.endswith((".", ":", ";")) or not line.lstrip().startswith("//")


def find(tree):
    findings = [f for p in tree.with_suffix(".cpp", ".hpp", ".idl") if p.startswith(PLAIN) for f in plain_english(tree, p)]
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
    ({"src/base/a.hpp": "/// What a list holds.\n"}, "src/base/a.hpp:1: a sentence begins with What"),
    ({"src/base/a.hpp": "int a;  ///< Of the list.\n"}, "begins with Of"),
    ({"src/text/a.cpp": "// A list. That\n// of the room.\n"}, "src/text/a.cpp:1: a sentence begins with That"),
    ({"src/xml/a.cpp": "// The list is told.\n"}, "src/xml/a.cpp:1: told"),
    ({"dev": "cd /ro" + "ot/x\n"}, "path of one machine"),
]
GOOD = [
    {"src/base/a.hpp": "/// A list of names, in the order\n/// Of their arrival\n", "src/hw/a.cpp": "// What is told.\n"},
    {"src/base/a.cpp": "auto text = \"https://a.b/What it tells\";\n"},
    {"src/a.cpp": "// todos los robots; /proc/self/maps; build/wo" + "rk/x; ${X}/ro" + "ot/x; </root>\n"},
    {"docs/a.md": "the socket is in /tmp/orca-<uid>/\n", "LICENSES/a.txt": "TO" + "DO\n"},
]
