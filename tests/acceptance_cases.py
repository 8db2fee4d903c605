# SPDX-License-Identifier: GPL-3.0-or-later
"""The test cases that a page names exist: a pattern that matches none would pass and show nothing.

acceptance_cases.py BUILD_FOLDER PAGE...
"""
import pathlib
import re
import subprocess
import sys

COMMAND = re.compile(r"build/release/tests/(\w+_test)((?: \"[^\"]*\")*)")
PART = re.compile(r"(?:\\.|[^,\\])+")


def patterns(page):
    """(line number, program, pattern) of each pattern that a command of the page gives to a test program."""
    for number, line in enumerate(page.splitlines(), 1):
        for program, words in COMMAND.findall(line):
            parts = [part for word in re.findall(r'"([^"]*)"', words) for part in PART.findall(word)]
            yield from ((number, program, part) for part in parts or ["*"])


def matches(program, pattern):
    listed = subprocess.run([program, "--list-test-names-only", pattern], capture_output=True, text=True, check=False)
    return bool(listed.stdout.strip())


def main(build, *pages):
    tests = pathlib.Path(build) / "tests"
    faults = []
    checked = [(page, *named) for page in pages for named in patterns(pathlib.Path(page).read_text())]
    for page, number, program, pattern in checked:
        if not (tests / program).exists():
            faults.append(f"{page}:{number}: there is no test program {program}")
        elif not matches(tests / program, pattern):
            faults.append(f"{page}:{number}: {program} has no test case that matches {pattern}")
    some_program = next(tests / program for _, _, program, _ in checked)
    if matches(some_program, "surely no test case is named like this"):
        faults.append("this check cannot fail")
    print("\n".join(faults) or f"{len(checked)} patterns match test cases")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
