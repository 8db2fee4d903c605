# SPDX-License-Identifier: LGPL-3.0-or-later
"""The programs of Orca: where they are, and how they are called."""
import pathlib
import shutil
import subprocess

# In a clone this file is in python/orca_robots; installed it is in lib/python3/dist-packages/orca_robots.
_HERE = pathlib.Path(__file__).resolve().parents
_OWN_FOLDERS = [_HERE[2] / "build" / "release" / "bin", *([_HERE[4] / "bin"] if len(_HERE) > 4 else [])]


class OrcaError(Exception):
    """What a program of Orca refused or could not finish, in its words."""


def find(program):
    """Returns the path of a program: the first in PATH, else the one that belongs to this package.

    Raises OrcaError if there is none.
    """
    found = shutil.which(program)
    for folder in _OWN_FOLDERS:
        found = found or shutil.which(program, path=str(folder))
    if not found:
        raise OrcaError(f"{program} is not found: install Orca (docs/install.md), or put the folder of its programs, "
                        "such as ORCA/build/release/bin, into PATH")
    return found


def call(program, *words, good=(0,)):
    """Runs a program to its end. Raises OrcaError with what it wrote to stderr unless its exit status is in `good`."""
    done = subprocess.run([find(program), *map(str, words)], stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if done.returncode not in good:
        raise OrcaError(done.stderr.strip() or f"{program} ended with status {done.returncode}")
    return done


def run_options(seed=None, set=None, profile=None, until=None, record=None):  # noqa: A002: the word of the command line
    """Returns the words of a command line for a run.

    @param set      values of arguments and parameters, {"avoid.margin": "5 cm"}.
    @param profile  one name, or several in a list.
    @param until    end of the run: seconds, or a text such as "2 min".
    @param record   a file as after --record.
    """
    words = [word for name, value in (set or {}).items() for word in ("--set", f"{name}={value}")]
    words += [word for name in ([profile] if isinstance(profile, str) else profile or ()) for word in ("--profile", name)]
    options = {"--seed": seed, "--until": f"{float(until)!r} s" if isinstance(until, (int, float)) else until, "--record": record}
    return words + [word for name, value in options.items() if value is not None for word in (name, str(value))]
