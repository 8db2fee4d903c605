#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Gives the commands of a page, one after the other, and compares what it shows of what they print.

    tests/system/pages_test.py BUILD PAGE.md...    BUILD stands for the folder build/release of the pages
    tests/system/pages_test.py BUILD --slow        those that have commands which take long
    tests/system/pages_test.py BUILD               the form of all pages, the commands in their text, and that this test finds what is wrong

The reader is in a folder that has the files of the tree, and what the commands write. A system that a page starts without an end runs on
"at another terminal" until the page starts one in a later block, or ends.
"""
import contextlib
import itertools
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import lesson
from lesson import Learner, Wrong
sys.path.insert(0, str(lesson.TREE / "tests/lint"))
from page_commands import BLOCK, COMMAND, ONLY_CHECKED, SLOW, TREE, UNTIL_INTERRUPTED, WITHOUT_FILES, Checker, commands_of, is_only_checked, is_system, matches
from tree import Tree

LONGEST_START = 20   # [s] until a system answers
LONGEST_END = 20     # [s] from Ctrl-C to the end
SETTLED = 1.0        # [s] after which it has a first scan and pose
WATCHED = 2.5        # [s] after which a command that goes on gets Ctrl-C
INLINE = re.compile(r"`([^`\n]+)`")
DEV = f'''#!/bin/sh
case "$1" in
  run) shift; exec "$(dirname "$0")/build/release/bin/deployer" "$@" ;;
  --help) exec {TREE}/dev "$@" ;;
  *) echo "./dev $1 is for no test"; exit 1 ;;
esac
'''


class Block:
    """A block of a page, with the comment above it."""

    def __init__(self, page, match):
        self.comment, self.language, self.text = match[1] or "", match[2], match[3]
        self.line = page.count("\n", 0, match.start()) + 1
        self.begin, self.end = match.span()


def blocks_of(page):
    return [Block(page, match) for match in BLOCK.finditer(page)]


def given_here(block):
    """Returns whether this test gives the commands of a block."""
    return block.language == "sh" and not block.comment.startswith("read by")


class Reader(Learner):
    """Somebody who gives the commands of a page."""

    def __init__(self, build, folder, slow=False):
        super().__init__(build, folder)
        self.slow, self.checker = slow, Checker(build, self.folder)
        self.files = contextlib.ExitStack()
        self.systems = []  # that run at another terminal
        self.options, self.longest = "set -e", 1800 if slow else 120
        self.environment.update(HOME=str(self.folder))
        for file in TREE.iterdir():
            if file.name not in ("build", "dev", ".git"):
                (self.folder / file.name).symlink_to(file)
        (self.folder / "dev").write_text(DEV)
        (self.folder / "dev").chmod(0o755)
        (self.folder / "build").mkdir()
        (self.folder / "build/release").symlink_to(self.build)

    def read(self, page):
        """Gives all commands of the text of a page. Raises Wrong with all that is not as the page says."""
        shown_at, faults = None, []
        try:
            for block in blocks_of(page):
                with self.faults_to(faults, f"line {block.line}: "):
                    if given_here(block):
                        self.give_all(block)
                        shown_at = block.end
                    elif block.language == "text" and shown_at is not None and not page[shown_at:block.begin].strip():
                        self.printed(block)
            with self.faults_to(faults):
                self.end_systems()
        finally:
            self.end()
            self.files.close()
        if faults:
            raise Wrong("\n".join(faults))

    @contextlib.contextmanager
    def faults_to(self, faults, begin=""):
        try:
            yield
        except Wrong as wrong:
            faults.append(f"{begin}{wrong}")

    def give_all(self, block):
        commands, said = commands_of(block.text), ""
        meanwhile = re.match("while (.*)", block.comment)
        if meanwhile or any(is_system(command) for command in commands):
            self.end_systems()
        if meanwhile:
            self.give(meanwhile[1])
        faults = []
        for command in commands:
            self.said = ""
            with self.faults_to(faults):
                self.give(command)
            said += self.said
        self.said = said
        if faults:
            raise Wrong("\n".join(faults))

    def give(self, command):
        if is_only_checked(command, self.slow):
            if fault := self.checker.fault(command):
                raise Wrong(f"{command}: {fault}")
        elif matches(command, UNTIL_INTERRUPTED):
            self.watch(command)
        elif is_system(command):
            self.start(command)
        else:
            self.finish(command)

    def finish(self, command):
        """Gives a command and waits for its end."""
        try:
            self.run(lesson.Block("run", command + "\n", 0))
        except Wrong as wrong:
            raise Wrong("\n".join([str(wrong), *(f"meanwhile, {system.args[-1]}:\n{self.output_of(system)}" for system in self.systems)])) from None

    def popen(self, command):
        out = tempfile.TemporaryFile("w+")
        shell = subprocess.Popen(["bash", "-o", "pipefail", "-c", command], cwd=self.within, env=self.environment, stdin=subprocess.PIPE,
                                 stdout=out, stderr=subprocess.STDOUT, start_new_session=True)
        shell.out = out
        self.files.enter_context(out)
        self.files.enter_context(shell.stdin)
        self.shells.append(shell.pid)
        return shell

    def output_of(self, shell):
        shell.out.seek(0)
        return self.plain(shell.out.read())

    def watch(self, command):
        """Gives a command, and Ctrl-C after some seconds."""
        shell = self.popen(command)
        with contextlib.suppress(subprocess.TimeoutExpired):
            shell.wait(WATCHED)
            raise Wrong(f"{command} has ended with {shell.returncode}, which it should not before Ctrl-C:\n{self.output_of(shell)}")
        self.interrupt(shell, 0)
        self.said = self.output_of(shell)

    def interrupt(self, shell, *allowed):
        """Gives Ctrl-C, after which a program ends by the signal or with one of these exit statuses."""
        with contextlib.suppress(ProcessLookupError):
            os.killpg(shell.pid, signal.SIGINT)
        try:
            status = shell.wait(LONGEST_END)
        except subprocess.TimeoutExpired:
            raise Wrong(f"{shell.args[-1]} has not ended {LONGEST_END} s after Ctrl-C:\n{self.output_of(shell)}") from None
        if status not in (*allowed, -signal.SIGINT, 128 + signal.SIGINT):
            raise Wrong(f"{shell.args[-1]} ended with {status}:\n{self.output_of(shell)}")

    def running(self):
        """Returns the names of the systems that answer and whose components have come up."""
        return {socket.stem for socket in (self.folder / ".sockets/orca").glob("*.sock") if self.is_up(socket.stem)}

    def is_up(self, system):
        ps = subprocess.run([self.build / "bin/orcactl", "--system", system, "ps", "--json"], env=self.environment, capture_output=True, text=True)
        return ps.returncode == 0 and not any(component["state"] in ("INIT", "STARTS") for component in json.loads(ps.stdout))

    def start(self, command):
        """Starts a system, and waits until it answers."""
        before, system = self.running(), self.popen(command)
        self.systems.append(system)
        deadline = time.monotonic() + LONGEST_START
        while not self.running() - before:
            if system.poll() is not None or time.monotonic() > deadline:
                raise Wrong(f"{command} has not come up (exit status {system.poll()}):\n{self.output_of(system)}")
            time.sleep(0.1)
        time.sleep(SETTLED)

    def end_systems(self):
        for system in self.systems:
            if system.poll() != -signal.SIGKILL:  # pkill -9 of the page
                self.interrupt(system, 0, 1)  # 1: a goal was not reached
        self.systems = []


def read(text, build, slow=False):
    """Gives the commands of the text of a page, in a new folder."""
    with tempfile.TemporaryDirectory(prefix="orca_page_", ignore_cleanup_errors=True) as folder:
        Reader(build, folder, slow).read(text)


def pages():
    """Returns all pages, from the top folder: neither lessons, which lessons_test.py reads, nor what `orcactl new` makes, nor what tells of the past."""
    return [page for page in Tree(TREE).with_suffix(".md") if not re.match("docs/lessons/|docs/adr/|docs/barn/|templates/|tests/|CHANGELOG", page)]


def text_of(page):
    return (TREE / page).read_text(encoding="utf-8")


def commands_in(page):
    """Returns the commands of a page that this test gives or checks."""
    return [command for block in blocks_of(text_of(page)) if given_here(block) for command in commands_of(block.text)]


def inline_commands(text):
    """Yields (line, command) of the commands that stand in the text of a page."""
    prose = BLOCK.sub(lambda match: "\n" * match[0].count("\n"), text)
    for match in INLINE.finditer(prose):
        if COMMAND.match(match[1]):
            yield prose.count("\n", 0, match.start()) + 1, match[1].removeprefix("$ ")


class Pages(unittest.TestCase):
    build = None

    def test_commands_are_in_blocks_that_are_read(self):
        for page in pages():
            for block in blocks_of(text_of(page)):
                if block.language != "sh" and not block.comment.startswith("read by"):
                    self.assertIsNone(COMMAND.match(block.text), f"{page}:{block.line}: commands are in a block of sh")
                elif block.comment.startswith("read by"):
                    test = block.comment.split()[-1]
                    self.assertIn(page, text_of(test), f"{page}:{block.line}: {test} does not read it")

    def test_each_page_with_commands_is_read(self):
        """CMake finds them when it configures."""
        self.assertEqual(sorted(os.environ["ORCA_PAGES"].split()), sorted(page for page in pages() if "\n```sh\n" in text_of(page)))

    def test_each_entry_of_the_lists_is_a_command_of_a_page(self):
        commands = [command for page in pages() for command in commands_in(page)]
        self.assertGreater(len(commands), 100)
        for pattern in (*UNTIL_INTERRUPTED, *SLOW, *itertools.chain(*ONLY_CHECKED.values(), *WITHOUT_FILES.values())):
            self.assertTrue(any(matches(command, [pattern]) for command in commands), f"no page has a command {pattern}")

    def test_commands_in_the_text_of_pages_are_right(self):
        checker, found, faults = Checker(self.build), 0, []
        for page in pages():
            for line, command in inline_commands(text_of(page)):
                found += 1
                if fault := checker.fault(command):
                    faults.append(f"{page}:{line}: {command}: {fault}")
        self.assertFalse(faults, "\n".join(faults))
        self.assertGreater(found, 200)

    def test_a_wrong_command_is_found(self):
        checker = Checker(self.build)
        for command, fault in (("./dev run graphs/none.xml", "there is no graphs/none.xml"), ("orcactl none", "no command none"),
                               ("deployer graphs/scout_goto.xml --set none=1", "ended with 2"), ("simbatch none x", "no command none"),
                               ("simbatch sim/experiments/none.xml", "there is no"), ("orcactl echo a.b --none", "no option --none"),
                               ("./dev none", "no command none"), ("deployer 'a", "bash cannot read it"), ("hwprobe --none", "no option --none")):
            with self.subTest(command=command):
                self.assertIn(fault, checker.fault(command) or "")
        for command in ("./dev run graphs/scout_goto.xml --clock virtual | cat", "orcactl --system NAME ps", "simbatch join DIR --out x",
                        "deployer graphs/mine.xml", "gdb --args deployer"):
            self.assertIsNone(checker.fault(command), command)


RIGHT = """# A page
<!-- while deployer graphs/scout_goto.xml --hold -->
```sh
orcactl get command.rounds    # it is one
deployer --describe Odometry | grep -c angle
```

```text
...
command ... 1 ...
1
```

```sh
orcactl hz base.OdometryPush
```
"""


class Reading(unittest.TestCase):
    """The test fails where a page is wrong."""
    build = None

    def test_a_page_that_is_right_is_read(self):
        read(RIGHT, self.build)

    def test_whatever_is_wrong_in_a_page_is_found(self):
        for right, wrong, says in (("orcactl get command.rounds", "orcactl get command.none", "line 2: .*ended with 1"),
                                   ("orcactl get command.rounds", "false", "ended with 1"),
                                   ("grep -c angle", "grep -c none", "ended with 1"),
                                   ("text\n...\ncommand ... 1 ...\n1", "text\n...\n2", "line 8: shows other lines"),
                                   ("deployer graphs/scout_goto.xml --hold", "deployer graphs/none.xml", "has not come up"),
                                   ("orcactl hz base.OdometryPush", "orcactl hz base.none", "before Ctrl-C")):
            with self.subTest(wrong=wrong):
                self.assertEqual(RIGHT.count(right), 1)
                with self.assertRaisesRegex(Wrong, f"(?s){says}"):
                    read(RIGHT.replace(right, wrong), self.build)


def as_alone():
    """Goes on with a network and processes of its own, so that nothing is heard of what else runs on this machine, nor killed."""
    user = [] if os.geteuid() == 0 else ["--map-root-user"]
    alone = ["unshare", *user, "--net", "--pid", "--fork", "--kill-child", "--mount-proc", "sh", "-c", 'ip link set lo up && "$@"; exit $?', "sh"]
    if "ORCA_ALONE" in os.environ:
        return
    if subprocess.run([*alone, "true"], capture_output=True).returncode != 0:
        print("SKIPPED: this system gives no user processes of its own, and pages kill processes by their name")
        sys.exit(77)
    os.environ["ORCA_ALONE"] = "yes"
    os.execvp(alone[0], [*alone, sys.executable, "-B", *sys.argv])


def main(build, shown, slow):
    """Returns the exit status."""
    status = 0
    for page in shown:
        try:
            read(text_of(page), build, slow)
        except Wrong as wrong:
            print(f"{page}:\n{wrong}")
            status = 1
    return status


if __name__ == "__main__":
    as_alone()
    build_folder = pathlib.Path(sys.argv[1]).resolve()
    if sys.argv[2:] == ["--slow"]:
        sys.exit(main(build_folder, [page for page in pages() if any(matches(command, SLOW) for command in commands_in(page))], slow=True))
    if sys.argv[2:]:
        sys.exit(main(build_folder, sys.argv[2:], slow=False))
    Pages.build = Reading.build = build_folder
    unittest.main(argv=sys.argv[:1])
