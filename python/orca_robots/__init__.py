# SPDX-License-Identifier: LGPL-3.0-or-later
"""Orca from Python (docs/python.md): check and edit graphs, run them in virtual time, run experiments, read recordings.

It drives the programs of an Orca that is installed or built; it is not a second implementation of anything they do.
"""
from .graphs import Fault, Graph, check
from .programs import OrcaError
from .runs import Run, read_record, report, run, simulate
from .table import Table

__all__ = ["Fault", "Graph", "OrcaError", "Run", "Table", "check", "read_record", "report", "run", "simulate"]
