# SPDX-License-Identifier: LGPL-3.0-or-later
"""Orca from Python (docs/python.md): check and edit graphs, run them in virtual time, run experiments, read recordings, and try ideas
for components.

It drives the programs of an Orca that is installed or built; it is not a second implementation of anything they do.
"""
from .components import Component, Interrupted, Param, PushProxy, PushServer, QueryProxy, QueryServer, SendProxy, SendServer
from .graphs import Fault, Graph
from .objects import Object
from .programs import OrcaError
from .runs import Run, read_record, report, run, simulate
from .systems import System, check
from .table import Table

__all__ = ["Component", "Fault", "Graph", "Interrupted", "Object", "OrcaError", "Param", "PushProxy", "PushServer", "QueryProxy",
           "QueryServer", "Run", "SendProxy", "SendServer", "System", "Table", "check", "read_record", "report", "run", "simulate"]
