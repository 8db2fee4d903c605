# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/acceptance.md has one line per claim, of at most 100 characters, and the one command, in single back-ticks, that
proves it. A figure that was measured stands in the table, with the day and the command."""
import re

PAGE = "docs/acceptance.md"
COMMAND = re.compile(r"(?<!`)`([^`]+)`(?!`)")
DAY = re.compile(r"\b20\d\d-\d\d-\d\d\b")
LONGEST = 100
REMARK = re.compile(r"<!--.*?-->", re.DOTALL)


def fault(claim):
    commands = COMMAND.findall(claim)
    if "``" in claim:
        return "single back-ticks only, around the command"
    if len(commands) != 1:
        return f"one command in back-ticks expected, found {len(commands)}"
    if not claim.rstrip(" .").endswith("`"):
        return "the claim comes first, the command last"
    words = COMMAND.sub("", claim).strip(" .:-*|")
    if len(words) < 3:
        return "a command without a claim"
    if len(words) > LONGEST:
        return f"a claim of {len(words)} characters; at most {LONGEST}"
    if DAY.search(words):
        return "what was measured on a day goes into the table of figures"
    return None


def fault_of_figure(row):
    cells = [cell.strip() for cell in row.strip("| ").split(" | ")]
    if len(cells) != 4 or not DAY.fullmatch(cells[2]) or not COMMAND.fullmatch(cells[3]):
        return "four columns expected: figure, measured, day as 2026-11-28, and one command in back-ticks"
    return None


def find(tree):
    if not tree.exists(PAGE):
        return [f"{PAGE}:1: there is no such page; each claim about Orca needs a line there"]
    text = REMARK.sub(lambda m: re.sub(r"[^\n]", "", m[0]), tree.text(PAGE))
    lines = list(enumerate(text.splitlines(), 1))
    claims = [(n, line, fault(line)) for n, line in lines if line.startswith(("*", "-", "+"))]
    figures = [(n, line, fault_of_figure(line)) for n, line in lines if line.startswith("|")][2:]
    return [f"{PAGE}:{n}: {wrong}: {line}" for n, line, wrong in claims + figures if wrong]


BAD = [
    ({}, "there is no such page"),
    ({PAGE: "# A\n\n* It works.\n"}, f"{PAGE}:3: one command"),
    ({PAGE: "* It `works`: `./dev test`\n"}, "found 2"),
    ({PAGE: "* It works: ``./dev test``\n"}, "single back-ticks only"),
    ({PAGE: "* `./dev test` shows that it works\n"}, "the command last"),
    ({PAGE: "* `./dev test`\n"}, "without a claim"),
    ({PAGE: f"* It {'really ' * 20}works: `./dev test`\n"}, "at most 100"),
    ({PAGE: "* It took 3 s on 2026-11-28: `./dev test`\n"}, "goes into the table"),
    ({PAGE: "| a | b | c | d |\n|---|---|---|---|\n| suite | 9 min | `./dev test` | 2026-11-28 |\n"}, "four columns"),
]
GOOD = [{PAGE: "# Claims\n<!-- how to\nread them -->\nAfter `./dev build`.\n* It works: `./dev test unit`\n- And well. `./dev bench`.\n"
               "| a | b | c | d |\n|---|---|---|---|\n| suite | 9 min | 2026-11-28 | `./dev test` |\n"}]
