# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs, experiments and recordings, made and read by the programs of Orca."""
import dataclasses
import pathlib

from .programs import call, run_options
from .table import Table


@dataclasses.dataclass(frozen=True)
class Run:
    """What a run in virtual time has come to. Two runs with the same trace_hash are the same to the last bit."""

    ended_well: bool  # false: something failed while it ran; the log says what
    arrived: list     # (goal, x [m], y [m], t [s])
    failed: list      # (goal, reason)
    contacts: list    # (what the robot has touched, t [s])
    trace_hash: str   # 16 hexadecimal digits
    log: str


def run(graph, **options):
    """Runs a graph file in virtual time to its end, as `deployer --clock virtual` does, and returns a Run.

    @param options  seed, set, profile, until, record: see programs.run_options().
    Raises OrcaError if it does not start.
    """
    done = call("deployer", graph, "--clock", "virtual", *run_options(**options), good=(0, 1))
    return read_run(done.stdout, done.stderr, done.returncode == 0)


def read_run(out, log, ended_well):
    """Reads what the deployer has written to stdout."""
    lines = [line.split(" ") for line in out.splitlines()]
    return Run(ended_well=ended_well,
               arrived=[(line[1], *map(float, line[2:5])) for line in lines if line[0] == "arrived"],
               failed=[(line[1], " ".join(line[2:])) for line in lines if line[0] == "failed"],
               contacts=[(line[1], float(line[2])) for line in lines if line[0] == "contact"],
               trace_hash=next((line[1] for line in lines if line[0] == "trace-hash"), ""), log=log)


def simulate(experiment, out=None, jobs=None, resume=False):
    """Makes all runs of an experiment file, as `simbatch` does, and returns a Table with a row for each of them.

    @param out     folder of the results; without it NAME.batch in the present folder. report(out) reads the comparison there.
    @param jobs    runs at a time; without it as many as there are processors.
    @param resume  whether results that the folder holds already are kept.
    Raises OrcaError with all that is wrong with the experiment.
    """
    folder = str(out or pathlib.Path(experiment).stem + ".batch")
    words = ["--out", folder, *(["--jobs", jobs] if jobs else []), *(["--resume"] if resume else [])]
    call("simbatch", experiment, *words)
    return Table.of_csv(call("simbatch", "export", folder).stdout)


def report(folder):
    """Returns the comparison of a batch, as text in Markdown, with intervals and what is established."""
    return (pathlib.Path(folder) / "report.md").read_text(encoding="utf-8")


def read_record(file, *ports):
    """Reads a recording (MCAP), or what passed some of its ports, as a Table: stamp [s], port, and each field of the objects.

    Raises OrcaError if it cannot be read; `orcactl bag recover` repairs what was cut off.
    """
    return Table.of_csv(call("orcactl", "bag", "csv", file, *ports).stdout)
