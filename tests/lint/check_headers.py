# SPDX-License-Identifier: GPL-3.0-or-later
"""Headers begin with #pragma once; public ones lie in <module>/include/orca/, where CMake compiles each one alone."""
import re

USING = re.compile(r"\busing namespace (?![\w:]*literals;)")
PUBLIC = re.compile(r"/include/orca/")


def find(tree):
    findings = []
    for path in tree.with_suffix(".hpp", ".h"):
        code = re.sub(r"//[^\n]*|/\*.*?\*/", "", tree.text(path), flags=re.DOTALL).lstrip()
        if not code.startswith("#pragma once"):
            findings.append(f"{path}:1: the first line of code must be #pragma once")
        if "/include/" in path and not PUBLIC.search(path):
            findings.append(f"{path}:1: public headers lie in <module>/include/orca/")
        if PUBLIC.search(path) and USING.search(code):
            findings.append(f"{path}:1: a public header must not say using namespace: that affects all its users")
    return findings


BAD = [
    ({"a.hpp": "// why\nint a;\n"}, "must be #pragma once"),
    ({"a.hpp": "int a;\n#pragma once\n"}, "must be #pragma once"),
    ({"src/base/include/base/a.hpp": "#pragma once\n"}, "lie in <module>/include/orca/"),
    ({"src/x/include/orca/x/a.hpp": "#pragma once\nusing namespace std;\n"}, "must not say using namespace"),
]
GOOD = [{"a.hpp": "/* x */ #pragma once\n",
         "src/x/include/orca/x/a.hpp": "// SPDX\n#pragma once\nusing std::string;\nusing namespace std::chrono_literals;\n"}]
