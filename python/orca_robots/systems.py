# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs that a program steps, and components in Python that take part in them."""
import json
import socket
import subprocess
import tempfile

from .graphs import Fault
from .guests import Guests, PacketLine, ended
from .programs import OrcaError, find, run_options
from .runs import read_run


class System:
    """A run of a graph in virtual time that this program lets pass in steps, and looks into.

        with orca.System("graphs/scout_goto.xml", seed=1) as system:
            system.step(10)
            print(system.latest("base.OdometryPush").x)
        print(system.result.trace_hash)

    The same steps and settings give the same run, to the last bit; what is only looked at changes nothing. At the end of the block
    the run is stopped, unless it is over before, and `result` has what came of it, a Run.

    @param components  classes derived from Component, for the types that the graph names.
    @param options     seed, set, profile, until, record: see programs.run_options().
    Raises OrcaError with all that is wrong with the graph.
    """

    def __init__(self, graph, components=(), **options):
        self.result = None
        self._guests = Guests(components)
        here, there = socket.socketpair()
        self._line = PacketLine(here)
        self._out, self._log = tempfile.TemporaryFile("w+"), tempfile.TemporaryFile("w+")
        sockets = (self._guests.socket_there.fileno(), there.fileno())
        words = [find("deployer"), str(graph), "--clock", "virtual", "--guest", "%d,%d" % sockets, *run_options(**options)]
        self._deployer = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=self._out, stderr=self._log, pass_fds=sockets)
        there.close()
        if not self._guests.serve() or self._asks("begin") is None:
            self.close()
            raise OrcaError(self.result.log.strip())

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    @property
    def is_over(self):
        """Whether the run has come to its end by itself."""
        return self.result is not None or self._deployer.poll() is not None

    def step(self, seconds):
        """Lets virtual time pass, as fast as the machine can, and returns the time of the run [s].

        Returns None if the run has come to its end meanwhile: `result` says what has come of it.
        """
        words = self._asks("step", str(round(seconds * 1e9)))
        if words is None:
            self.close()
            return None
        return int(words[0]) / 1e9

    def latest(self, port):
        """Returns the newest object that has left a component through a port, such as "base.OdometryPush"; None before the first.

        Raises OrcaError if there is no such port.
        """
        words = self._asks("latest", port)
        return self._guests.types.decode(words[0].decode(), words[1]) if words else None

    def set(self, name, value):
        """Sets a parameter between two laps: set("avoid.margin", "5 cm"). Raises OrcaError with the component's reason."""
        component, _, param = name.rpartition(".")
        if self._asks("set", component, param, str(value)) is None:
            raise OrcaError("the run is over")

    def run(self):
        """Lets the run come to the end that the graph names, or to `until`, and returns its result."""
        while self.step(10) is not None:
            pass
        self.close()
        return self.result

    def close(self):
        """Stops the run."""
        if self.result is not None:
            return
        self._line.close()  # a deployer that nobody steps any more stops the robot and ends
        status = self._deployer.wait()
        self._guests.close()
        texts = []
        for file in (self._out, self._log):
            file.seek(0)
            texts.append(file.read())
            file.close()
        self.result = read_run(*texts, status == 0)

    def _asks(self, *words):
        """Returns the answer; None if the run is over."""
        if self.result is not None:
            return None
        self._line.send(*words)
        answer = self._line.receive()
        return None if answer is None or answer[0] == b"over" else ended(answer)


def check(graph, components=(), set=None, profile=None):  # noqa: A002: the word of the command line
    """Returns all that is wrong with a graph file, as `deployer --check` finds it; nothing if it may run.

    @param components  classes derived from Component, for the types that the graph names.
    Raises OrcaError if the deployer is not found.
    """
    guests = Guests(components)
    number = guests.socket_there.fileno()
    words = [find("deployer"), str(graph), "--check", "--json", "--guest", str(number), *run_options(set=set, profile=profile)]
    with subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          pass_fds=[number]) as deployer:
        guests.serve()
        out, log = deployer.communicate()
    guests.close()
    if not out:
        raise OrcaError(log.strip())
    return [Fault(**message) for message in json.loads(out)["messages"]]
