# SPDX-License-Identifier: GPL-3.0-or-later
"""Test cases with the tag [data], [tool] or [quiet] run: their test has orca_add_optional_cases(TEST TAG) or
orca_add_quiet_cases(TEST), because orca_add_test() leaves such cases out. A test that returns early without saying "SKIPPED: " would count as passed."""
import posixpath
import re

CASE = re.compile(r"TEST_CASE\([^{;]*\[(data|tool|quiet)\]")
TEST = re.compile(r"^orca_add_test\(\s*(\w+)([^)]*)\)", re.MULTILINE)
SYSTEM_TEST = re.compile(r"^orca_add_system_test\((\w+)", re.MULTILINE)
OPTIONAL = re.compile(r"^orca_add_optional_cases\((\w+) (data|tool)\b", re.MULTILINE)
QUIET = re.compile(r"^orca_add_quiet_cases\((\w+)", re.MULTILINE)
EARLY_END = re.compile(r"\bWARN\(\s*\"(?:skipped|not tried)", re.IGNORECASE)


def tests_of_sources(tree, lists):
    """{source: test} of one CMakeLists.txt."""
    folder = posixpath.dirname(lists)
    text = tree.text(lists)
    sources = {f"{folder}/{name}_test.cpp": f"system_{name}_test" for name in SYSTEM_TEST.findall(text)}
    for name, words in TEST.findall(text):
        sources |= {f"{folder}/{word}": name for word in words.split() if word.endswith(".cpp")}
    return sources


def find(tree):
    tests, optional = {}, set()
    for lists in tree.with_suffix("CMakeLists.txt"):
        tests |= tests_of_sources(tree, lists)
        optional |= set(OPTIONAL.findall(tree.text(lists)))
        optional |= {(test, "quiet") for test in QUIET.findall(tree.text(lists))}
    findings = []
    for path in (p for p in tree.with_suffix(".cpp") if p.startswith("tests/")):
        text = tree.text(path)
        for match in CASE.finditer(text):
            if (tests.get(path), match[1]) not in optional:
                line = text.count("\n", 0, match.start()) + 1
                words = f"quiet_cases({tests.get(path)})" if match[1] == "quiet" else f"optional_cases({tests.get(path)} {match[1]})"
                findings.append(f"{path}:{line}: no ctest entry runs this [{match[1]}] case; write orca_add_{words}")
        for match in EARLY_END.finditer(text):
            findings.append(f"{path}:{text.count(chr(10), 0, match.start()) + 1}: a case that warns and returns counts as "
                            'passed; give it the tag [data] or [tool] and print "SKIPPED: REASON"')
    return findings


def _tree(case, lists):
    return {"tests/unit/a/b/a_test.cpp": case, "tests/unit/a/CMakeLists.txt": lists}


PLAIN = "orca_add_test(a_test\n  SOURCES b/a_test.cpp c.cpp\n  LINK orca::a)\n"
CASE_WITH_DATA = 'TEST_CASE("a map can be read",\n          "[a][data]") {\n}\n'
BAD = [
    (_tree(CASE_WITH_DATA, PLAIN), "tests/unit/a/b/a_test.cpp:1: no ctest entry runs this [data] case"),
    (_tree(CASE_WITH_DATA, PLAIN + "orca_add_optional_cases(a_test tool)\n"), "orca_add_optional_cases(a_test data)"),
    (_tree('TEST_CASE("a", "[a]") {\n  WARN("skipped: no map");\n', PLAIN), "a_test.cpp:2: a case that warns"),
    ({"tests/s/x_test.cpp": CASE_WITH_DATA, "tests/s/CMakeLists.txt": "orca_add_system_test(x 60)\n"},
     "orca_add_optional_cases(system_x_test data)"),
    ({"tests/s/x_test.cpp": CASE_WITH_DATA.replace("data", "quiet"),
      "tests/s/CMakeLists.txt": "orca_add_system_test(x)\norca_add_optional_cases(system_x_test data)\n"},
     "orca_add_quiet_cases(system_x_test)"),
]
GOOD = [
    _tree(CASE_WITH_DATA, PLAIN + "orca_add_optional_cases(a_test data LABELS unit)\n"),
    _tree('TEST_CASE("a", "[a]") { const int data[] = {1}; }\n', PLAIN),
    {"tests/s/x_test.cpp": CASE_WITH_DATA,
     "tests/s/CMakeLists.txt": "orca_add_system_test(x 60)\norca_add_optional_cases(system_x_test data)\n"},
    {"tests/s/x_test.cpp": CASE_WITH_DATA.replace("data", "quiet"),
     "tests/s/CMakeLists.txt": "orca_add_system_test(x 60)\norca_add_quiet_cases(system_x_test LABELS system)\n"},
]
