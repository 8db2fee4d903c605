# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/limitations.md has twenty limits at most, and each ends with the test that fails when it is a limit no more.

That the tests exist is found by docs_acceptance_cases, which has the programs."""
import re

PAGE = "docs/limitations.md"
MOST = 20
TEST = re.compile(r": `build/release/tests/\w+_test \"[^\"`]+\"`$")


def find(tree):
    if not tree.exists(PAGE):
        return [f"{PAGE}:1: there is no such page"]
    limits = [(n, line) for n, line in enumerate(tree.text(PAGE).splitlines(), 1) if line.startswith("* ")]
    findings = [f"{PAGE}:{n}: the limit does not end with a test, as : `build/release/tests/a_test \"a title*\"`"
                for n, line in limits if not TEST.search(line)]
    if len(limits) > MOST:
        findings.append(f"{PAGE}:{limits[MOST][0]}: limit {MOST + 1}; the page has {MOST} at most, others stand where they matter")
    return findings


_LIMIT = '* **Memory** is nobody\'s: `build/release/tests/a_test "memory*"`\n'
BAD = [
    ({}, "there is no such page"),
    ({PAGE: "# Limits\n* It cannot fly.\n"}, f"{PAGE}:2: the limit does not end with a test"),
    ({PAGE: "* It cannot fly: `./dev test`\n"}, "does not end with a test"),
    ({PAGE: _LIMIT * 21}, f"{PAGE}:21: limit 21"),
]
GOOD = [{PAGE: "# Limits\nHonest.\n" + _LIMIT * 20}]
