# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/acceptance.md has one line per claim. Each ends with the one command, in single back-ticks, that proves it."""
import re

PAGE = "docs/acceptance.md"
COMMAND = re.compile(r"(?<!`)`([^`]+)`(?!`)")
REMARK = re.compile(r"<!--.*?-->", re.DOTALL)


def fault(claim):
    commands = COMMAND.findall(claim)
    if "``" in claim:
        return "single back-ticks only, around the command"
    if len(commands) != 1:
        return f"one command in back-ticks expected, found {len(commands)}"
    if not claim.rstrip(" .").endswith("`"):
        return "the claim comes first, the command last"
    if len(COMMAND.sub("", claim).strip(" .:-*|")) < 3:
        return "a command without a claim"
    return None


def find(tree):
    if not tree.exists(PAGE):
        return [f"{PAGE}:1: there is no such page; each claim about Orca needs a line there"]
    text = REMARK.sub(lambda m: re.sub(r"[^\n]", "", m[0]), tree.text(PAGE))
    claims = [(n, line) for n, line in enumerate(text.splitlines(), 1) if line.strip() and not line.startswith("#")]
    return [f"{PAGE}:{n}: {wrong}: {line}" for n, line in claims for wrong in [fault(line)] if wrong]


BAD = [
    ({}, "there is no such page"),
    ({PAGE: "# A\n\n* It works.\n"}, f"{PAGE}:3: one command"),
    ({PAGE: "* It `works`: `./dev test`\n"}, "found 2"),
    ({PAGE: "* It works: ``./dev test``\n"}, "single back-ticks only"),
    ({PAGE: "* `./dev test` shows that it works\n"}, "the command last"),
    ({PAGE: "* `./dev test`\n"}, "without a claim"),
]
GOOD = [{PAGE: "# Claims\n<!-- how to\nread them -->\n\n* It works: `./dev test unit`\n- And well. `./dev bench`.\n"}]
