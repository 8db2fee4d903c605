# SPDX-License-Identifier: GPL-3.0-or-later
"""C++ files have the layout that clang-format 14 gives them by the rules in the tree's .clang-format."""
import re
import shutil
import subprocess
import tempfile
from pathlib import Path

from tree import made

TOOL = "clang-format-14"
TOGETHER = 200  # Files of one call, whose names fit into a command line.
STYLE = Path(__file__).resolve().parents[2] / ".clang-format"


def missing_tool():
    return None if shutil.which(TOOL) else f"{TOOL} is not installed; ./dev setup installs it"


def _faults(folder, paths):
    """Returns the first place of each of these files that clang-format would change, as path:line."""
    command = [TOOL, f"--style=file:{STYLE}", "--dry-run", "-Werror", *paths]
    run = subprocess.run(command, cwd=folder, text=True, capture_output=True)
    places = re.findall(r"^(.+?):(\d+):\d+: error:", run.stderr, re.MULTILINE)
    if run.returncode != 0 and not places:
        return [f"{TOOL} failed: {run.stderr.strip()}"]
    first = dict(reversed(places))
    return [f"{path}:{first[path]}: not laid out by the rules; {TOOL} -i {path} corrects it" for path in sorted(first)]


def find(tree):
    """Writes the files out, because to start the tool once for each of them takes ten times as long as its work."""
    paths = list(tree.with_suffix(".cpp", ".hpp", ".h"))
    with tempfile.TemporaryDirectory() as folder:
        for path in paths:
            copy = Path(folder, path)
            copy.parent.mkdir(parents=True, exist_ok=True)
            text = tree.text(path)
            copy.write_text(made(text, "owl") if path.startswith("templates/") else text, encoding="utf-8")
        return [fault for i in range(0, len(paths), TOGETHER) for fault in _faults(folder, paths[i : i + TOGETHER])]


BAD = [
    ({"a.cpp": "int  main( ) { return 0 ; }\n"}, "a.cpp:1: not laid out"),
    ({"a.hpp": "struct A {\n    int* a;\n};\n"}, "a.hpp:1"),
]
GOOD = [{"a.cpp": "int main() { return 0; }\n", "a.hpp": "#pragma once\n\nstruct A {\n  int* a;\n};\n"}]
