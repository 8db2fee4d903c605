#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The ports and parameters in the components' READMEs are what the plugins say of themselves.

    tests/unit/components/readme_test.py BUILD [--write]

A README holds `<!-- deployer --describe NAME.so -->` and below it, in a fenced block, what that command prints. With
--write the blocks are brought up to date.
"""
import argparse
import pathlib
import re
import subprocess
import sys

TREE = pathlib.Path(__file__).resolve().parents[3]
BLOCK = re.compile(r"(<!-- deployer --describe (\w+\.so) -->\n\n?```\w*\n)(.*?)(```)", re.DOTALL)


def described(build, plugin):
    """Without the heading, which tells where the file is and which version built it."""
    text = subprocess.run([build / "bin/deployer", "--describe", build / "plugins" / plugin],
                          capture_output=True, text=True, check=True).stdout
    return text.split("\n\n", 1)[1]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--write", action="store_true")
    args = parser.parse_args()
    blocks = 0
    stale = []
    for readme in sorted(TREE.glob("src/components/*/README.md")):
        text = readme.read_text()
        blocks += len(BLOCK.findall(text))
        fresh = BLOCK.sub(lambda m: m[1] + described(args.build, m[2]) + m[4], text)
        if fresh == text:
            continue
        stale.append(readme)
        if args.write:
            readme.write_text(fresh)
    for readme in stale:
        print(f"{readme.relative_to(TREE)}: {'brought up to date' if args.write else 'differs from --describe'}")
    print(f"{blocks} descriptions in READMEs compared")
    return 0 if blocks >= 11 and (args.write or not stale) else 1


if __name__ == "__main__":
    sys.exit(main())
