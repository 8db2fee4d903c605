# SPDX-License-Identifier: LGPL-3.0-or-later
"""The other end of `deployer --guest`: packets, and the threads on which components in Python do their laps."""
import queue
import socket
import struct
import threading
import traceback

from .components import Interrupted
from .objects import Object, Types
from .programs import OrcaError

_VERSION = "1"  # as in src/apps/deployer/guest/guest_types.cpp


class PacketLine:
    """A socket that carries packets: lists of words, of text or of bytes."""

    def __init__(self, end):
        self._end, self._stream = end, end.makefile("rb")

    def send(self, *words):
        parts = [word.encode() if isinstance(word, str) else word for word in words]
        body = b"".join(struct.pack("<I", len(part)) + part for part in parts)
        try:
            self._end.sendall(struct.pack("<I", len(body)) + body)
        except OSError:
            pass  # the deployer is gone: receive() finds that

    def receive(self):
        """Returns the next packet; None when the deployer is gone."""
        try:
            head = self._stream.read(4)
            body = self._stream.read(struct.unpack("<I", head)[0]) if len(head) == 4 else b""
        except OSError:
            body = b""
        words, at = [], 0
        while at < len(body):
            length, = struct.unpack_from("<I", body, at)
            words.append(body[at + 4:at + 4 + length])
            at += 4 + length
        return words or None

    def close(self):
        self._stream.close()
        self._end.close()


def ended(words):
    """Returns the words after "ok". Raises what another first word says."""
    word = words[0].decode() if words else "over"
    if word == "interrupted":
        raise Interrupted
    if word == "over":
        raise OrcaError("the run is over")
    if word == "error":
        raise OrcaError(words[1].decode())
    return words[1:]


def _word(word):
    return word if isinstance(word, (str, bytes)) else str(word)


class Lap:
    """What an object of a component asks of the run, and the thread on which it works."""

    def __init__(self, line, types, name, component_class):
        self._line, self._types, self._said = line, types, queue.SimpleQueue()
        self._class, self._component = component_class, None
        self.thread = threading.Thread(target=self._serve, name=name, daemon=True)
        self.thread.start()

    def hear(self, words):
        """Hands on what was said to this object: a call, an answer, or None at the end."""
        self._said.put(words)

    def ask(self, *words):
        self._line.send(*words)
        return ended(self._said.get())

    def ask_object(self, *words):
        found = self.ask(*words)
        return self._types.decode(found[0].decode(), found[1]) if found else None

    def words(self, type_name, objects, fields):
        """Returns an object as words: the one that is given, or a new one with these fields."""
        made = objects[0] if objects else self._types.make(type_name, fields)
        if not isinstance(made, Object) or (objects and (fields or len(objects) > 1)):
            raise TypeError(f"a {type_name}, or fields of one, are expected here")
        return [made._type, self._types.encode(made)]

    def _serve(self):
        while (words := self._said.get()) is not None:
            self._line.send(*self._call(words[0].decode(), words[1:]))

    def _call(self, hook, more):
        try:
            if self._component is None:
                self._component = self._class(self)
            if hook == "handle":
                return self._handle(more[0].decode(), self._types.decode(more[1].decode(), more[2]))
            if hook in ("start", "params"):
                self._component._set_params([word.decode() for word in more])
            last = None if hook == "params" else getattr(self._component, hook)()
            return tuple(map(_word, last)) if isinstance(last, tuple) else ("again",)
        except Interrupted:
            return ("again",)
        except BaseException as error:  # noqa: BLE001: whatever it is, sys.exit() too, it is the component's failure
            return ("raised", traceback.format_exception_only(type(error), error)[-1].strip(), traceback.format_exc())

    def _handle(self, port, taken):
        answer = getattr(self._component, f"on_{port}")(taken)
        return answer if isinstance(answer, tuple) else getattr(type(self._component), port).reply(self._types, answer)


class Guests:
    """The component types of this program, and their objects in one run of the deployer.

    `socket_there` is the end that the deployer gets. serve() when it has it.
    """

    def __init__(self, component_classes):
        self._hello = [packet for one in component_classes for packet in one.declared()]
        self._classes = {one.type: one for one in component_classes}
        if len(self._classes) < len(component_classes):
            raise OrcaError("two of the components have the same type; give each class a type of its own")
        here, self.socket_there = socket.socketpair()
        self._line, self._laps = PacketLine(here), {}
        self.types = None

    def serve(self):
        """Says which types there are, and lets objects of them work. Returns false if the deployer has not taken them."""
        self.socket_there.close()
        self._line.send("guest", _VERSION)
        for packet in self._hello:
            self._line.send(*packet)
        self._line.send("ready")
        words = self._line.receive()
        if words is None or words[0] != b"layouts":
            return False
        texts = [word.decode() for word in words[1:]]
        self.types = Types(zip(texts[::2], texts[1::2]))
        self._thread = threading.Thread(target=self._distribute, name="guests", daemon=True)
        self._thread.start()
        return True

    def close(self):
        """Lets all laps end; the deployer has ended before."""
        if self.types is not None:
            self._thread.join()
        self._line.close()

    def _distribute(self):
        while (words := self._line.receive()) is not None:
            if words[0] == b"call":
                name, kind = words[1].decode(), words[2].decode()
                if name not in self._laps:
                    self._laps[name] = Lap(self._line, self.types, name, self._classes[kind])
                self._laps[name].hear(words[3:])
            else:
                self._laps[words[1].decode()].hear([words[0], *words[2:]])
        for lap in self._laps.values():
            lap.hear(None)
