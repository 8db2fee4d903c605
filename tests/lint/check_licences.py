# SPDX-License-Identifier: GPL-3.0-or-later
"""Each source file names its licence on top, and it is the one that LICENSE.md gives to its folder."""
import posixpath
import re

LGPL, GPL = "LGPL-3.0-or-later", "GPL-3.0-or-later"
EXCEPTION = "LICENSES/Orca-plugin-exception.txt"

# The longest matching prefix decides.
LICENCE_OF_FOLDER = {
    "": LGPL, "dev": GPL, ".ci/": GPL, "src/apps/": GPL, "tests/": GPL, "bench/": GPL, "web/": GPL,
}
SOURCES = (".cpp", ".hpp", ".h", ".c", ".idl", ".py", ".el", ".sh", ".cmake", "CMakeLists.txt", ".js", ".mjs", ".css", ".html")
DATA = (".xml", ".xsd", ".rnc", ".urdf")  # either licence; those in tests/ are bad on purpose or compared byte by byte
LINE = re.compile(r"SPDX-License-Identifier: *([^\s*<>]+)")


def wanted(path):
    folder = max((f for f in LICENCE_OF_FOLDER if path.startswith(f)), key=len)
    if path.startswith(("tests/data/", "templates/")):  # the latter become files of whoever calls orcactl new
        return None
    if path.endswith(DATA):
        return None if path.startswith("tests/") else {LGPL, GPL}
    if path.endswith((".cmake", "CMakeLists.txt")):
        return {LGPL, LICENCE_OF_FOLDER[folder]}
    return {LICENCE_OF_FOLDER[folder]}


def is_source(tree, path):
    if path.startswith("LICENSES/"):
        return False
    if path.endswith(SOURCES + DATA):
        return True
    return not posixpath.splitext(path)[1] and tree.text(path).startswith("#!")


def fault(tree, path, wanted_licences):
    top = "\n".join(tree.text(path).splitlines()[:4])
    found = LINE.search(top)
    choice = " or ".join(sorted(wanted_licences))
    if not found:
        return f"no licence on top; expected the line SPDX-License-Identifier: {choice}"
    if found[1] not in wanted_licences:
        return f"licence {found[1]}, expected {choice} (LICENSE.md says which folder has which)"
    is_program = path.startswith(("src/apps/", "web/")) and path.endswith((".cpp", ".hpp", ".js"))
    if is_program and EXCEPTION not in top:
        return f"no notice of the plugin exception on top; expected the line: Additional permission: {EXCEPTION}"
    return None


def find(tree):
    findings = []
    for path in tree.paths:
        licences = wanted(path) if is_source(tree, path) else None
        wrong = fault(tree, path, licences) if licences else None
        if wrong:
            findings.append(f"{path}:1: {wrong}")
    return findings


def _head(licence, mark="//"):
    return f"{mark} SPDX-License-Identifier: {licence}\n"


BAD = [
    ({"src/base/x.cpp": "int x;\n"}, "no licence on top"),
    ({"src/base/x.hpp": _head(GPL)}, "expected LGPL-3.0-or-later"),
    ({"tests/unit/x_test.cpp": _head(LGPL)}, "expected GPL-3.0-or-later"),
    ({"src/apps/deployer/main.cpp": _head(LGPL)}, "expected GPL-3.0-or-later"),
    ({"src/apps/deployer/main.cpp": _head(GPL)}, "no notice of the plugin exception"),
    ({"src/runtime/x.cpp": _head("MIT")}, "licence MIT"),
    ({"graphs/a.xml": "<graph/>\n"}, "no licence on top"),
    ({"dev": "#!/bin/bash\necho\n"}, "dev:1: no licence on top"),
    ({"src/x.cpp": "\n" * 10 + _head(LGPL)}, "no licence on top"),
]
GOOD = [
    {"src/base/x.cpp": _head(LGPL), "tests/unit/x_test.cpp": _head(GPL), "README.md": "# Orca\n"},
    {"dev": "#!/bin/bash\n" + _head(GPL, "#"), "tests/CMakeLists.txt": _head(LGPL, "#"), "tests/data/bad.xml": "<"},
    {"src/apps/deployer/main.cpp": _head(GPL) + f"// Additional permission: {EXCEPTION}\n"},
    {"graphs/a.xml": f'<?xml version="1.0"?>\n<!-- {_head(LGPL, "").strip()} -->\n<graph/>\n'},
]
