# SPDX-License-Identifier: GPL-3.0-or-later
"""C++ files have the layout that clang-format 14 gives them by the rules in the tree's .clang-format."""
import re
import shutil
import subprocess
from pathlib import Path

TOOL = "clang-format-14"
STYLE = Path(__file__).resolve().parents[2] / ".clang-format"


def missing_tool():
    return None if shutil.which(TOOL) else f"{TOOL} is not installed; ./dev setup installs it"


def _first_fault(path, text):
    """Returns path:line of the first place that clang-format would change, or None. The path shows the own header."""
    command = [TOOL, f"--style=file:{STYLE}", f"--assume-filename={path}", "--dry-run", "-Werror"]
    run = subprocess.run(command, input=text, text=True, capture_output=True)
    if run.returncode == 0:
        return None
    place = re.match(r".*?:\d+:", run.stderr)
    return f"{place[0] if place else path + ':'} not laid out by the rules; {TOOL} -i {path} corrects it"


def find(tree):
    faults = (_first_fault(path, tree.text(path)) for path in tree.with_suffix(".cpp", ".hpp", ".h"))
    return [f for f in faults if f]


BAD = [
    ({"a.cpp": "int  main( ) { return 0 ; }\n"}, "a.cpp:1: not laid out"),
    ({"a.hpp": "struct A {\n    int* a;\n};\n"}, "a.hpp:1"),
]
GOOD = [{"a.cpp": "int main() { return 0; }\n", "a.hpp": "#pragma once\n\nstruct A {\n  int* a;\n};\n"}]
