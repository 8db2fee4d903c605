#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs a test with a program that may be missing: then the test is skipped, and says why.

    tests/support/if_installed.py PROGRAM ARGUMENT...
"""
import os
import shutil
import sys

SKIPPED = 77

if shutil.which(sys.argv[1]) is None:
    print(f"SKIPPED: {sys.argv[1]} is not installed; ./dev setup installs it")
    sys.exit(SKIPPED)
os.execvp(sys.argv[1], sys.argv[1:])
