#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""run.py CHECK ROOT: proves that the check CHECK can fail, then looks for its findings in the tree at ROOT.

A check is a module check_CHECK.py with
  find(tree) -> [text]       the findings, each with path:line
  BAD   [(files, text)]      made-up trees for which find() must report a finding that contains text
  GOOD  [files]              made-up trees for which it must report nothing
  missing_tool() -> text     optional: the reason why the check cannot run on this machine
Exit status: 0 clean, 1 findings or a check that does not work, 77 skipped.
"""
import importlib
import sys

from tree import MadeUpTree, Tree

SKIPPED = 77


def faults_of_check(check):
    """Reports errors of the check itself, found with its own examples."""
    faults = []
    for files, expected in check.BAD:
        findings = check.find(MadeUpTree(files))
        if not any(expected in f for f in findings):
            faults.append(f"the check is blind: expected a finding with {expected!r} in {files}, got {findings}")
    for files in check.GOOD:
        faults += [f"the check is wrong: it reports {f!r} in the good {files}" for f in check.find(MadeUpTree(files))]
    return faults


def main(name, root):
    check = importlib.import_module(f"check_{name}")
    reason = check.missing_tool() if hasattr(check, "missing_tool") else None
    if reason:
        print(f"{name}: skipped: {reason}")
        return SKIPPED
    problems = faults_of_check(check)
    tree = Tree(root)
    problems += check.find(tree)
    for problem in problems:
        print(problem)
    print(f"{name}: {len(problems)} findings in {len(tree.paths)} files "
          f"({len(check.BAD)} bad and {len(check.GOOD)} good examples tried)")
    return 1 if problems else 0


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1], sys.argv[2]))
