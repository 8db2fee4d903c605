# SPDX-License-Identifier: GPL-3.0-or-later
"""What enters simulated states, readings and decisions is computed with orca/base/portable_math.hpp, because the C library's
functions round differently on other machines (docs/adr/0047-own-functions.md). Exact ones, such as std::sqrt, are free.
Rotations of Bullet and Eigen that are made from an angle call the C library's as well."""
import re

NAMES = ("sin|cos|tan|asin|acos|atan|atan2|sinh|cosh|tanh|asinh|acosh|atanh|exp|exp2|expm1|log|log2|log10|log1p|pow|cbrt|hypot"
         "|erf|erfc|tgamma|lgamma|sincos")
CALL = re.compile(rf"(?:\bstd::|(?<![\w:.>])::)(?:{NAMES})[fl]?\s*\(|(?<![\w:.>~])(?:sin|cos|tan|atan2|sincos|pow)[fl]?\((?!\))")
LIBRARIES = re.compile(r"\bbt(?:Sin|Cos|Tan|Asin|Acos|Atan2?|Exp|Log|Pow)\(|\bbtQuaternion\(btVector3|\bAngleAxis[df]?\b|\bRotation2D[df]?\b"
                       r"|\.(?:setEulerZYX|setEuler|setRPY|setFromRPY)\(")
FOLDERS = ("src/", "sim/")
FREE = ("src/runtime/host/picture/",  # drawings enter no state
        "src/base/math/", "src/base/include/orca/base/portable_math.hpp")
COMMENT = re.compile(r"//.*")


def find(tree):
    findings = []
    for path in tree.with_suffix(".cpp", ".hpp"):
        if not path.startswith(FOLDERS) or path.startswith(FREE):
            continue
        for number, line in enumerate(tree.text(path).splitlines(), 1):
            code = COMMENT.sub("", line)
            call = CALL.search(code) or LIBRARIES.search(code)
            if call:
                findings.append(f"{path}:{number}: {call[0]} gives other bits on other machines; use orca::portable")
    return findings


BAD = [
    ({"sim/a.cpp": "double y = std::sin(x);\n"}, "sim/a.cpp:1: std::sin("),
    ({"src/components/a/a.cpp": "\nauto r = std::hypot (x, y);\n"}, "src/components/a/a.cpp:2"),
    ({"src/geometry/a.hpp": "return cos(yaw);\n"}, "cos("),
    ({"sim/a.cpp": "return ::expf(x);\n"}, "::expf("),
    ({"sim/a.cpp": "btQuaternion q = btQuaternion(btVector3(0, 0, 1), yaw);\n"}, "btQuaternion("),
    ({"src/geometry/a.cpp": "using Eigen::AngleAxisd;\n"}, "AngleAxisd"),
    ({"sim/a.cpp": "return std::pow(x, 2.0);\n"}, "std::pow("),
]
GOOD = [
    {"sim/a.cpp": "portable::sin(x) + std::sqrt(y) + std::fmod(a, b) + std::remainder(a, b) + log(text);  // std::sin(x)\n"},
    {"src/runtime/host/picture/a.cpp": "std::sin(x);\n", "tests/a.cpp": "std::sin(x);\n", "src/base/math/a.cpp": "cos(x);\n"},
    {"sim/a.hpp": "at.sin / at.cos; X.cos(); hook::tan(x); [[nodiscard]] double basin(double x); btQuaternion(x, y, z, w);\n"},
]
