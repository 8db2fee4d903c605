# SPDX-License-Identifier: LGPL-3.0-or-later
"""Components written in Python. Their laps use the same ports as those in C++, in virtual time."""
import random

from .programs import OrcaError


class Interrupted(BaseException):
    """Raised by a wait when the component must leave its lap. Let it pass."""


class _Member:
    """A port or a parameter: declared in the class, used through the object."""

    def __set_name__(self, owner, name):
        self.name = name

    def __get__(self, component, owner):
        return self if component is None else component._bound(self)


class _Port(_Member):
    def __init__(self, type, optional=False, text=""):  # noqa: A002: the word of the layouts
        self.types, self.optional, self.text = (type, ""), optional, text

    def declared(self):
        return ["port", self.__class__.__name__, self.name, *self.types, "optional" if self.optional else "", self.text]


class _Bound:
    """A port of one object of a component."""

    def __init__(self, lap, port):
        self._lap, self._name, self._type = lap, port.name, port.types[0]


class PushProxy(_Port):
    """Receives the objects that a PushServer pushes: PushProxy("LaserRangeReadings")."""

    class Bound(_Bound):
        def get_update(self):
            """Returns the next new object, or the last one again; waits only before the first."""
            return self._lap.ask_object("get", self._name, "update", "")

        def get_update_wait(self, limit=None):
            """Waits for a new object, at most `limit` [s], and returns it; None when the time has passed."""
            return self._lap.ask_object("get", self._name, "wait", "" if limit is None else repr(float(limit)))

        def latest(self):
            """Returns the newest object, without waiting and without taking it; None before the first."""
            return self._lap.ask_object("get", self._name, "latest", "")

        def new_data_arrived(self):
            """Returns whether there is an object that was not taken yet."""
            return self._lap.ask("get", self._name, "new", "")[0] == b"1"

        def connected(self):
            """Returns whether the graph connects this port."""
            return self._lap.ask("get", self._name, "connected", "")[0] == b"1"


class PushServer(_Port):
    """Pushes objects to all subscribers: PushServer("MotionCommand")."""

    class Bound(_Bound):
        def push(self, *objects, **fields):
            """Pushes an object, or one with these fields: push(kind="NORMAL", speed=0.2)."""
            self._lap.ask("push", self._name, *self._lap.words(self._type, objects, fields))


class SendProxy(_Port):
    """Sends objects to one SendServer: SendProxy("GoalPoint")."""

    class Bound(_Bound):
        def send(self, *objects, **fields):
            """Sends an object. Raises OrcaError with the server's reason if it is refused."""
            self._lap.ask("send", self._name, *self._lap.words(self._type, objects, fields))


class QueryProxy(_Port):
    """Asks one QueryServer: QueryProxy("Ask", "Robot")."""

    def __init__(self, type, reply, optional=False, text=""):  # noqa: A002: the word of the layouts
        super().__init__(type, optional, text)
        self.types = (type, reply)

    class Bound(_Bound):
        def query(self, *objects, timeout=1.0, **fields):
            """Asks and waits for the answer, at most `timeout` [s]. Raises OrcaError if there is none."""
            return self._lap.ask_object("query", self._name, repr(float(timeout)), *self._lap.words(self._type, objects, fields))


class SendServer(_Port):
    """Takes objects that others send: with  order = SendServer("GoalPoint")  the method on_order(self, object) is called for each,
    between two laps. It returns nothing, or self.failed(reason) if it takes the object not."""

    def reply(self, _types, _answer):
        return ("again",)


class QueryServer(_Port):
    """Answers questions: with  robot = QueryServer("Ask", "Robot")  the method on_robot(self, question) is called for each, between
    two laps. It returns the answer, as an object or a dict of its fields, or self.failed(reason)."""

    def __init__(self, type, reply, text=""):  # noqa: A002: the word of the layouts
        super().__init__(type, True, text)
        self.types = (type, reply)

    def reply(self, types, answer):
        made = types.make(self.types[1], answer) if isinstance(answer, dict) else answer
        if made is None:
            raise TypeError(f"on_{self.name}() must return a {self.types[1]}, a dict of its fields, or self.failed(reason)")
        return ("reply", made._type, types.encode(made))


class Param(_Member):
    """A parameter: Param(0.5, unit="m", min=0). Its value, read through the object, is a bool, int, float or str in SI units."""

    def __init__(self, default, unit="", min=None, max=None, text=""):  # noqa: A002: the words of docs/components.md
        self.default, self.unit, self.text = default, unit, text
        self.range = ["" if limit is None else repr(float(limit)) for limit in (min, max)]

    def read(self, text):
        return text == "true" if isinstance(self.default, bool) else type(self.default)(text)

    def declared(self):
        written = str(self.default).lower() if isinstance(self.default, bool) else str(self.default)
        return ["param", self.name, type(self.default).__name__, written, self.unit, *self.range, self.text]


class Component:
    """The base class of components in Python. Ports and parameters are declared in the class; `type` is its name in a graph.

    work() does one lap. It may wait at ports, and returns nothing for another lap, self.done(), or self.failed(reason); an
    exception is a failure, with its traceback in the log. What starts a lap: `lap_on`, the name of a PushProxy, or `lap_every` [s],
    unless the graph says something else; without both, the next lap follows at once. Between two calls on ports a lap may
    compute for 2 s of real time; virtual time stands meanwhile.

    The thread of a component is its own: it may not use a System.
    """

    type = None
    lap_on = None
    lap_every = None

    def __init__(self, lap):
        self._lap = lap
        self._streams = {}
        self._of_name = {}
        self._values = {}

    def start(self):
        """Prepares for work, each time that a first client comes."""

    def work(self):
        """Does one lap."""
        raise NotImplementedError(f"{self.__class__.__name__} has no work()")

    def stop(self):
        """Ends the work, when nobody uses the component any more."""

    def done(self):
        """Ends the task well: return self.done()."""
        return ("done",)

    def failed(self, reason):
        """Ends the task badly: return self.failed("no way")."""
        return ("failed", reason)

    def now(self):
        """Returns the virtual time [s]."""
        return int(self._lap.ask("now")[0]) / 1e9

    def sleep(self, seconds):
        self._lap.ask("sleep", repr(float(seconds)))

    def random(self, name):
        """Returns a random.Random whose numbers depend on the run's seed, this component and `name` only."""
        if name not in self._streams:
            self._streams[name] = random.Random(int(self._lap.ask("random", name)[0]))
        return self._streams[name]

    def log(self, text, level="info"):
        """Writes to the log; level: "info", "warning" or "error"."""
        self._lap.ask("log", level, str(text))

    def _bound(self, member):
        if isinstance(member, Param):
            return self._values.get(member.name, member.default)
        if member.name not in self._of_name:
            self._of_name[member.name] = member.Bound(self._lap, member)
        return self._of_name[member.name]

    def _set_params(self, words):
        for name, text in zip(words[::2], words[1::2]):
            self._values[name] = getattr(self.__class__, name).read(text)

    @classmethod
    def declared(cls):
        """Returns the packets that describe this type."""
        if not cls.type:
            raise OrcaError(f'{cls.__name__} has no type: write  type = "my.{cls.__name__}"  into the class')
        trigger = ["on", cls.lap_on] if cls.lap_on else ["period", repr(float(cls.lap_every))] if cls.lap_every else ["", ""]
        members = {name: member for base in reversed(cls.__mro__) for name, member in vars(base).items()}
        return [["type", cls.type, *trigger], *(m.declared() for m in members.values() if isinstance(m, _Member))]
