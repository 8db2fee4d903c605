# SPDX-License-Identifier: GPL-3.0-or-later
"""The commands of the first pages are right: graphs and experiments pass --check, programs have the commands that are named.

docs_questions.py BUILD_FOLDER PAGE...
"""
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

TREE = pathlib.Path(__file__).resolve().parents[1]
CODE = re.compile(r"`([^`]+)`")
PROGRAM = re.compile(r"^(?:build/release/bin/|\./)?(dev run|deployer|simbatch|orcactl|hwprobe)( .*)?$", re.DOTALL)


def commands(page):
    """Yields (line, program, words) of each command that a page shows in single back-ticks."""
    for match in CODE.finditer(page):
        found = PROGRAM.match(match[1])
        if found:
            yield page.count("\n", 0, match.start()) + 1, found[1], shlex.split(found[2] or "")


def run(build, program, *words):
    """Returns (exit status, output) of a program that is started in the tree."""
    done = subprocess.run([build / "bin" / program, *words], cwd=TREE, capture_output=True, text=True, timeout=60)
    return done.returncode, done.stdout + done.stderr


def knows_command(build, program, command):
    """Returns whether the help of a program lists a command."""
    listed = run(build, program, "--help")[1].partition("\nCommands\n")[2].partition("\n\n")[0]
    return re.search(rf"^  {re.escape(command)}\b", listed, re.MULTILINE) is not None


def fault(build, program, words):
    """Returns what is wrong with a command; nothing if it is right, or has words in capitals, which stand for any."""
    if not words or words[0].startswith("-") or any(word.isupper() for word in words):
        return None
    if program == "orcactl" or (program == "simbatch" and not words[0].endswith(".xml")):
        return None if knows_command(build, program, words[0]) else f"{program} has no command {words[0]}"
    if program == "hwprobe":
        return None
    with tempfile.TemporaryDirectory() as folder:  # --check writes nothing, but looks whether it could
        words = [f"{folder}/{word}" if before == "--record" else word for before, word in zip(["", *words], words)]
        status, said = run(build, "simbatch" if program == "simbatch" else "deployer", *words, "--check")
    return f"ended with {status}: {said}" if status != 0 else None


def main(build, *pages):
    build = pathlib.Path(build).resolve()
    shown = [(page, *command) for page in pages for command in commands(pathlib.Path(page).read_text())]
    faults = [f"{page}:{line}: {program} {' '.join(words)}: {wrong}" for page, line, program, words in shown
              if (wrong := fault(build, program, words))]
    for program, words in (("dev run", ["graphs/none.xml"]), ("deployer", ["graphs/scout_goto.xml", "--set", "none=1"]),
                           ("simbatch", ["sim/experiments/none.xml"]), ("orcactl", ["none"]), ("simbatch", ["none"])):
        if not fault(build, program, words):
            faults.append(f"this check is blind: it finds {program} {' '.join(words)} right")
    if len(shown) < 30:
        faults.append(f"only {len(shown)} commands found")
    print("\n".join([*faults, f"{len(shown)} commands on {len(pages)} pages"]))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
