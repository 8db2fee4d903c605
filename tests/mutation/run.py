#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""run.py [OPTION]...: would the tests notice?

Changes one comparison, constant, condition or return of src/base, src/patterns or src/runtime at a time, in a copy of the
sources, builds the tests of that module and runs them. A mutant that a test, the compiler's check of the whole or a time limit
notices is caught; the others survive and are listed. A survivor gets a test, or a line in equal.txt that says why no
test can tell it from the original.

  --count N      mutants that compile (default 150)
  --seed N       which ones (default 1). A change of the sources moves only the mutants of the lines it changes
  --only TEXT    only files whose path contains it
  --build DIR    where the copy and its build live (default build/mutation below the root); kept for the next run
  --jobs N       compilers and tests at a time (default: as many as processors)
  --share P      exit status 1 if fewer than P percent are caught (default 85)
  --trust        take for granted that the unchanged sources build and pass, as a run before has shown; saves half an hour
  --after FILE   what an earlier run printed: a mutant that it caught counts as caught, all others are tried
  --list         only list the mutants that would be tried

Exit status: 0 enough were caught, 1 too few were, 2 the unchanged sources do not build or pass.
"""
import argparse
import contextlib
import hashlib
import itertools
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

from mutants import mutants_of

ROOT = Path(__file__).resolve().parents[2]
COMPILE_LIMIT, TEST_LIMIT = 900, 600  # [s]; a hang counts as noticed
EQUAL = Path(__file__).with_name("equal.txt")


@dataclass(frozen=True)
class Stage:
    """Tests that are built and run together."""
    targets: tuple
    tests: tuple


@dataclass(frozen=True)
class Module:
    """Which tests answer for a folder. The later stages are built only for a mutant that the earlier ones let pass."""
    folder: str
    stages: tuple


def stage(*tests, also=()):
    return Stage(tests + tuple(also), tests)


_DEPLOYER = ("deployer", "orca_run")
MODULES = (
    Module("src/base/", (stage("base_test"), stage("patterns_contract_test"), stage("host_test"))),
    Module("src/patterns/", (stage("patterns_test", "patterns_frames_test", "patterns_shm_test"),
                             stage("patterns_contract_test"),
                             stage("patterns_dds_test", "patterns_dds_participant_test"),
                             stage("patterns_dds_leaving_test", "patterns_dds_processes_test"),
                             stage("patterns_allocation_test"))),
    Module("src/runtime/graph/", (stage("graph_test"), stage("plugin_faults_test"))),
    Module("src/runtime/plugin/", (stage("plugin_test"), stage("plugin_faults_test", "system_bad_plugins_test", also=_DEPLOYER))),
    Module("src/runtime/host/",
           (stage("host_test"),
            stage("system_phases_test", "system_graph_features_test", "system_scout_goto_test", "system_hooligan_test",
                  "system_signals_test", "system_bad_plugins_test", "plugin_faults_test", also=_DEPLOYER),
            stage("system_resume_test", "system_groups_test", "system_trading_test", "system_swap_test", also=_DEPLOYER))),
    Module("src/runtime/supervisor/",
           (stage("supervisor_test", "supervised_test"),
            stage("system_processes_test", "system_hosts_test", "system_orcactl_test", also=_DEPLOYER),
            stage("system_adoption_test", "system_apply_test", "system_rewire_test", "system_renew_test", also=_DEPLOYER))),
    Module("src/runtime/batch/",
           (stage("batch_test", "batch_statistics_test"), stage("system_simbatch_test", also=_DEPLOYER),
            stage("system_simbatch_diff_test", "system_simbatch_parts_test", also=_DEPLOYER))),
)


@dataclass
class Tally:
    caught: list = field(default_factory=list)
    survived: list = field(default_factory=list)
    equal: list = field(default_factory=list)
    not_compiled: int = 0

    def judged(self):
        return len(self.caught) + len(self.survived) + len(self.equal)

    def share(self):
        """Percent caught of those that a test could have noticed."""
        could = len(self.caught) + len(self.survived)
        return 100.0 * len(self.caught) / could if could else 100.0


def say(text):
    print(text, flush=True)


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
                                     usage=argparse.SUPPRESS)
    parser.add_argument("--count", type=int, default=150)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="")
    parser.add_argument("--build", type=Path, default=ROOT / "build/mutation")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--share", type=float, default=85.0)
    parser.add_argument("--trust", action="store_true")
    parser.add_argument("--after", type=Path)
    parser.add_argument("--list", action="store_true")
    return parser.parse_args()


def tracked_files():
    listing = subprocess.run(["git", "-C", str(ROOT), "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
                             capture_output=True, check=True, text=True).stdout
    return [name for name in listing.split("\0") if name and (ROOT / name).is_file()]


def module_of(path):
    return next((module for module in MODULES if path.startswith(module.folder)), None)


def shuffled(seed, path, source):
    """The mutants of a file as pairs (place in the order, mutant).

    A mutant's place depends on the seed and on its own line alone, not on how many others there are: whoever writes a test or
    changes a line meets the same mutants again, and what was measured before can be compared.
    """
    met = Counter()
    for mutant in mutants_of(path, source):
        text = without_line(mutant, source)
        met[text] += 1
        yield hashlib.sha256(f"{seed} {text} {met[text]}".encode()).digest(), mutant


def shuffled_mutants(seed, only):
    """Each module's mutants in a random order, one module after the other, so that small modules count as much as large.

    A module's order depends on no other module: runs with --only of each module together are a run of the whole.
    """
    of_module = {module: [] for module in MODULES}
    for path in sorted(tracked_files()):
        module = module_of(path)
        if module and only in path and path.endswith((".cpp", ".hpp")):
            of_module[module] += shuffled(seed, path, (ROOT / path).read_text())
    queues = [iter(sorted(mutants, key=lambda pair: pair[0])) for mutants in of_module.values()]
    for turn in itertools.zip_longest(*queues):
        yield from (pair[1] for pair in turn if pair)


def known_as_equal():
    """The mutants that no test can tell from the original; after " # " stands why."""
    lines = EQUAL.read_text().splitlines()
    return {line.split(" # ")[0] for line in lines if line.strip() and not line.startswith("#")}


def without_line(mutant, source):
    """A mutant's text as equal.txt compares it: line numbers move, so the line itself counts."""
    line = source.splitlines()[mutant.line - 1].split(" //")[0].strip()
    return f"{mutant.path}: {line}: {mutant.kind}: {mutant.old!r} -> {mutant.new!r}"


class Workshop:
    """A copy of the sources and its build."""

    def __init__(self, folder, jobs):
        self.sources, self.build, self.jobs = folder / "sources", folder / "build", jobs
        self.changed = folder / "changed.txt"  # names the source that is mutated at present
        self.log = folder / "last.log"  # what the last build or test has said
        # Systems of others on this machine may have the names of those that are tested.
        self.runtime = tempfile.TemporaryDirectory(prefix="orca-mutation-")

    def prepare(self):
        killed_at = self.changed.read_text() if self.changed.exists() else ""  # its object may be that of a mutant
        for name in tracked_files():
            target = self.sources / name
            text = (ROOT / name).read_bytes()
            # What has not changed is not compiled anew.
            if name == killed_at or not target.exists() or target.read_bytes() != text:
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_bytes(text)
                shutil.copymode(ROOT / name, target)
        subprocess.run(["cmake", "-S", str(self.sources), "-B", str(self.build), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                        "-DCMAKE_CXX_FLAGS_RELEASE=-O1", "-DCMAKE_LINK_DEPENDS_NO_SHARED=ON"],
                       check=True, stdout=subprocess.DEVNULL)

    def compiles(self, targets, limit=COMPILE_LIMIT):
        command = ["cmake", "--build", str(self.build), "-j", str(self.jobs), "--target", *targets]
        return self._run(command, limit) == 0

    def passes(self, tests):
        names = "^(" + "|".join(tests) + ")$"
        command = ["ctest", "--test-dir", str(self.build), "-R", names, "--stop-on-failure", "--timeout", str(TEST_LIMIT),
                   "-j", str(self.jobs), "--no-tests=error", "--output-on-failure"]
        return self._run(command, TEST_LIMIT * len(tests)) == 0

    def noticed_by(self):
        """The tests that the last run has seen fail, each with how: a time limit on a busy machine is a weak witness."""
        failed = re.findall(r"\d+ - (\w+) \(([^)]+)\)", self.log.read_text(errors="replace"))
        return ", ".join(f"{test} ({how})" for test, how in failed) or "its tests, which did not end in time"

    def _run(self, command, limit):
        with self.log.open("wb") as log:
            process = subprocess.Popen(command, stdout=log, stderr=log, stdin=subprocess.DEVNULL, start_new_session=True,
                                       env={**os.environ, "XDG_RUNTIME_DIR": self.runtime.name})
        try:
            return process.wait(limit)
        except subprocess.TimeoutExpired:
            return None
        finally:  # also when this program is interrupted: nobody may compile a mutant after its source was put back
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()

    def try_out(self, mutant):
        """"not compiled", "caught" or "survived"."""
        module, place = module_of(mutant.path), self.sources / mutant.path
        original = place.read_text()
        self.changed.write_text(mutant.path)
        place.write_text(mutant.applied_to(original))
        try:
            for stage in module.stages:
                if not self.compiles(stage.targets):
                    return "not compiled"
                if not self.passes(stage.tests):
                    return "caught"
            return "survived"
        finally:
            place.write_text(original)
            self.changed.unlink()


def judge_unchanged(workshop, only):
    """Exits when the unchanged sources fail: then nothing could be learnt."""
    for module in MODULES:
        if only and not any(only in path for path in tracked_files() if module_of(path) is module):
            continue
        for stage in module.stages:
            say(f"unchanged: building and running {', '.join(stage.tests)}")
            # The first build may take any time: it compiles all that the tests need.
            built = workshop.compiles(stage.targets, limit=None)
            fault = None if built and workshop.passes(stage.tests) else "pass" if built else "build"
            if fault:
                say(f"the unchanged {module.folder} does not {fault}; see {workshop.log}")
                sys.exit(2)


def caught_in(printed):
    """The mutants that an earlier run has caught, by their text."""
    return set(re.findall(r"^\[\d+/\d+\] caught +\d+ s  (.*)$", printed, re.MULTILINE))


def judge(workshop, mutants, count, caught_before=frozenset()):
    tally, equal = Tally(), known_as_equal()
    for mutant in mutants:
        if tally.judged() == count:
            break
        began = time.monotonic()
        if without_line(mutant, (ROOT / mutant.path).read_text()) in equal:
            verdict = "equal"
        elif mutant.text() in caught_before:
            verdict = "caught"
        else:
            verdict = workshop.try_out(mutant)
        if verdict == "not compiled":
            tally.not_compiled += 1
            continue
        {"caught": tally.caught, "survived": tally.survived, "equal": tally.equal}[verdict].append(mutant)
        say(f"[{tally.judged()}/{count}] {verdict:8} {time.monotonic() - began:5.0f} s  {mutant.text()}")
        if verdict == "caught" and mutant.text() not in caught_before:
            say(f"    by {workshop.noticed_by()}")
    return tally


def report(tally):
    say(f"\n{tally.judged()} mutants: {len(tally.caught)} caught, {len(tally.survived)} survived, {len(tally.equal)} known as "
        f"equal; {tally.not_compiled} more did not compile. Caught: {tally.share():.1f} %")
    for mutant in tally.survived:
        say(f"survived: {mutant.text()}")


def main():
    options = parse_arguments()
    mutants = shuffled_mutants(options.seed, options.only)
    if options.list:
        for mutant, _ in zip(mutants, range(options.count)):
            say(mutant.text())
        return 0
    workshop = Workshop(options.build, options.jobs)
    workshop.prepare()
    if not options.trust:
        judge_unchanged(workshop, options.only)
    tally = judge(workshop, mutants, options.count, caught_in(options.after.read_text()) if options.after else ())
    report(tally)
    return 0 if tally.share() >= options.share else 1


if __name__ == "__main__":
    sys.exit(main())
