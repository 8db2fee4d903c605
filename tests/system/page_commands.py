# SPDX-License-Identifier: GPL-3.0-or-later
"""The commands of the pages, and which of them no test gives.

Commands are in ```sh blocks; a ```text block right below shows what they print (lesson.py says how). Comments above a block:

    <!-- while COMMAND -->    this system runs meanwhile, where the page starts none
    <!-- read by FILE -->     that test gives the commands
"""
import fnmatch
import functools
import itertools
import pathlib
import re
import shlex
import subprocess

TREE = pathlib.Path(__file__).resolve().parents[2]
PROGRAMS = ("deployer", "orcactl", "simbatch", "orcaview", "hwprobe")
BLOCK = re.compile(r"(?:^<!-- ([^\n]*) -->\n\n?)?^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
COMMAND = re.compile(rf"(?:\$ )?(?:build/release/bin/|\./)?(?:dev|sudo|gdb|cmake|pkill|{'|'.join(PROGRAMS)}) [\w./-]")
ENDS = re.compile(r"[|&>]|2>|.*;$")  # a word that ends the first program of a command
INSTEAD_OF_RUNNING = {"--check", "--print", "--list-ports", "--dot", "--mermaid", "--diff", "--types", "--describe", "--schema", "--rnc", "--help", "--version"}

# Commands that go on until Ctrl-C. The test gives it after some seconds.
UNTIL_INTERRUPTED = ("*--watch", "orcactl log --follow *", "orcactl echo *Push", "orcactl hz *", "orcactl latency avoid.odometry",
                     "orcactl latency --from * --to wheels", "orcactl record *.mcap", "orcactl go * --wait", "orcaview*")

# Commands that are only checked, and why.
ONLY_CHECKED = {
    "the tests themselves": ("./dev quick", "./dev test", "./dev nightly"),
    "it builds for minutes, and other tests use the build": ("./dev build", "./dev docs", "./dev package"),
    "it changes the machine; packages_test.py and installation_test.py install Orca": ("sudo *", "echo *| sudo tee *"),
    "it fetches what pip builds with; python_test.py installs the package": ("python3 -m venv *",),
    "a debugger waits for its user": ("gdb *",),
    "it needs the reader's component, which debugging.md has from a lesson, and an instrumented build": ("cmake -G Ninja *", "cmake --build build*", "ORCA/*"),
    "it needs a device": ("*--profile real*", "hwprobe", "hwprobe /dev/tty*"),
    "it needs a drive with a laser; calibrate_test.cpp makes one": ("orcactl calibrate *",),
    "it needs another machine or user": ("*--machine *", "rsync *", "orcactl --of *", "*--allow *", "orcactl machines", "orcactl team"),
    "it needs a cluster; slurm_test.py makes one": ("simbatch submit *",),
    "it answers a question, and nothing is asked": ("orcactl tasks yes",),
    "it needs a batch that was begun": ("orcaview --batch *",),
    "it needs a time of day at which something went wrong": ("orcactl bag cut *",),
}

# The same, and their files are missing.
WITHOUT_FILES = {
    "it needs the reader's own file": ("orcactl apply my.xml", "orcactl apply with_log.xml", "*--change with_vfh.xml@20s"),
    "it needs public data": ("deployer *intel_log*", "orcactl *intel_log*", "deployer *localize_log*", "orcactl bag * drive*"),
}

# The same, but ./dev nightly runs them.
SLOW = ("simbatch *", "*pioneer_slam.xml*until 450s")


def matches(command, patterns):
    return any(fnmatch.fnmatchcase(command.removeprefix("build/release/bin/"), pattern) for pattern in patterns)


def lacks_files(command):
    return matches(command, itertools.chain(*WITHOUT_FILES.values()))


def is_only_checked(command, slow):
    """Returns whether a command is checked and not given, in ./dev test or, where `slow`, in ./dev nightly."""
    return lacks_files(command) or matches(command, itertools.chain(*ONLY_CHECKED.values())) or (not slow and matches(command, SLOW))


def commands_of(script):
    """Returns the commands of a ```sh block: one in each line, without the remark that ends it."""
    lines = (re.sub(r"(^|\s+)# .*$", "", line).strip() for line in script.replace("\\\n", " ").splitlines())
    return [re.sub(r"\s+", " ", line) for line in lines if line]


def words_of(command):
    """Returns the words of the first program of a command."""
    try:
        words = shlex.split(command)  # a quotation may hold what ends a command elsewhere
    except ValueError:
        words = command.split()
    words = list(itertools.takewhile(lambda word: not ENDS.match(word), words))
    return [words[0].removeprefix("build/release/bin/"), *words[1:]]


def is_system(command):
    """Returns whether a command starts a system that goes on while the reader gives other commands."""
    words = words_of(command)
    if words[0] != "deployer" and words[:2] != ["./dev", "run"]:
        return False
    in_virtual_time = "virtual" in words and "--pace" not in words and "--view" not in words
    return not in_virtual_time and "--until" not in words and not INSTEAD_OF_RUNNING & set(words)


class Checker:
    """Says what is wrong with commands without giving them."""

    def __init__(self, build, folder=TREE):
        self.bin, self.folder = pathlib.Path(build).resolve() / "bin", folder

    @functools.lru_cache(maxsize=None)
    def said(self, program, *words):
        """Returns (exit status, output) of a program."""
        path = TREE / "dev" if program == "./dev" else self.bin / program
        done = subprocess.run([path, *words], cwd=self.folder, capture_output=True, text=True, timeout=60)
        return done.returncode, done.stdout + done.stderr

    def fault(self, command):
        """Returns what is wrong with a command; None if nothing is. Words in capitals stand for any; folders and files with no folder
        of the tree in their name are the reader's own."""
        if subprocess.run(["bash", "-n", "-c", command], capture_output=True).returncode != 0:
            return "bash cannot read it"
        program, *words = words_of(command)
        for word in words:
            if re.match(r"(graphs|sim|docs|tests)/", word) and not re.search("my|mine|[A-Z]{2}", word) and not (TREE / word).exists():
                return f"there is no {word}"
        if program not in PROGRAMS and program != "./dev":
            return None
        fault = self.fault_of_words(program, words) or self.fault_of_options(program, words)
        return fault or (None if lacks_files(command) else self.fault_of_input(program, words))

    def fault_of_words(self, program, words):
        command = words[0] if words else ""
        subcommand = program in ("orcactl", "./dev") or (program == "simbatch" and re.fullmatch("[a-z]+", command))
        if not subcommand or not command or command.startswith("-") or command.isupper():
            return None
        known = re.search(rf"^  (?:\./dev )?{re.escape(command)}\b", self.said(program, "--help")[1], re.MULTILINE)
        return None if known else f"{program} has no command {command}"

    def fault_of_options(self, program, words):
        help_text = self.said(program, "--help")[1]
        if program == "./dev" and words[0] == "bench":
            return None  # they are those of Google's library
        if program == "./dev" and words[0] == "run":
            help_text = self.said("deployer", "--help")[1]
        elif words and re.fullmatch("[a-z]+", words[0]):
            help_text += self.said(program, words[0], "--help")[1]
        unknown = [word for word in words if re.match("--[a-z]", word) and not re.search(rf"{re.escape(word)}\b", help_text)]
        return f"{program} has no option {unknown[0]}" if unknown else None

    def fault_of_input(self, program, words):
        """Has the program check the graph or experiment of a command, if it is in the tree and the command runs it."""
        if program == "./dev":
            program, words = "deployer", words[1:]
        files = [word for word in words[:1] if word.endswith(".xml") and (TREE / word).exists()]
        if program not in ("deployer", "simbatch") or not files or any(re.search(r"\b[A-Z]{2,}\b", word) for word in words):
            return None
        words = [word for before, word in zip(["", *words], words) if "--record" not in (before, word)]
        status, said = self.said(program, *words, *(() if INSTEAD_OF_RUNNING & set(words) else ("--check",)))
        return f"ended with {status}: {said}" if status != 0 else None
