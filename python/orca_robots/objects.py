# SPDX-License-Identifier: LGPL-3.0-or-later
"""Objects that travel between components, in Python: read and written as XCDR1 by the layouts that the deployer gives."""
import dataclasses
import re
import struct

_NUMBERS = {"bool": "?", "octet": "B", "uint8": "B", "int32": "i", "uint32": "I", "int64": "q", "uint64": "Q", "double": "d"}


class Object:
    """An object of any type: its fields are attributes, in SI units. Structs within are Objects, lists are lists.

    Ports return them, and make them of fields: a field that is not given has its default (0, False, "", the first word).
    """

    def __init__(self, type_name, fields):
        self.__dict__.update(_type=type_name, **fields)

    def __repr__(self):
        shown = ", ".join(f"{name}={value!r}" for name, value in self._fields().items() if name not in HEADER)
        return f"{self._type}({shown})"

    def __eq__(self, other):
        return isinstance(other, Object) and self.__dict__ == other.__dict__

    def __setattr__(self, name, value):
        if name not in self.__dict__:
            raise AttributeError(f"{self._type} has no field {name!r}; it has: {', '.join(self._fields())}")
        self.__dict__[name] = value

    def _fields(self):
        return {name: value for name, value in self.__dict__.items() if name != "_type"}


# Set by the framework in each object that is sent.
HEADER = ("creation_time", "origin", "origin_port", "seq", "mission", "cause")


@dataclasses.dataclass
class _Kind:
    name: str              # of a number: its code for struct; of a list: of what; else the type's name
    shape: str             # "number", "text", "enum", "struct", "sequence" or "array"
    parts: object = None   # of an enum: its words; of a struct: (name, kind) pairs; of a list: the kind of its elements
    count: int = 0         # of an array

    def default(self):
        if self.shape == "struct":
            return Object(self.name, {name: kind.default() for name, kind in self.parts})
        if self.shape in ("array", "sequence"):
            return [self.parts.default() for _ in range(self.count)]
        if self.shape == "enum":
            return self.parts[0]
        return "" if self.shape == "text" else {"d": 0.0, "?": False}.get(self.name, 0)


class _LayoutReader:
    """Reads `Name:Parent{field:type {unit},...}`, where a type may be such a text itself."""

    def __init__(self, text):
        self._text, self._at = text, 0

    def read(self):
        name = self._match(r"\w+")
        if name == "sequence":
            self._match("<")
            kind = _Kind("sequence", "sequence", self.read())
            self._match(">")
        elif name == "string":
            kind = _Kind(name, "text")
        elif name in _NUMBERS:
            kind = _Kind(_NUMBERS[name], "number")
        elif self._sees("("):
            kind = _Kind(name, "enum", self._match(r"\([^)]*\)")[1:-1].split(","))
        else:
            kind = _Kind(name, "struct", self._fields())
        while self._sees("["):
            kind = _Kind("array", "array", kind, int(self._match(r"\[\d+\]")[1:-1]))
        return kind

    def _fields(self):
        self._match(r"(:\w+)?\{")
        fields = []
        while not self._sees("}"):
            name = self._match(r"\w+:")[:-1]
            fields.append((name, self.read()))
            self._match(r"( \{[^}]*\})?,?")  # a unit
        self._match("}")
        return fields

    def _sees(self, text):
        return self._text.startswith(text, self._at)

    def _match(self, pattern):
        found = re.compile(pattern).match(self._text, self._at)
        if not found:
            raise ValueError(f"a layout that cannot be read, at {self._text[self._at:self._at + 40]!r}")
        self._at = found.end()
        return found[0]


class Types:
    """The object types of an Orca, by their names."""

    def __init__(self, layouts):
        self._layouts, self._kinds = dict(layouts), {}

    def kind(self, name):
        if name not in self._kinds:
            if name not in self._layouts:
                raise TypeError(f"there is no object type {name!r}; docs/all-objects.md lists them")
            self._kinds[name] = _LayoutReader(self._layouts[name]).read()
        return self._kinds[name]

    def make(self, name, fields):
        """Returns an object with these fields; all others have their defaults. A dict stands for a struct."""
        made = self.kind(name).default()
        for field, value in fields.items():
            setattr(made, field, value)
        return made

    def encode(self, made):
        """Returns an Object as XCDR1. Raises TypeError or ValueError with the field that cannot be written."""
        out = bytearray()
        _write(out, self.kind(made._type), made, made._type)
        return bytes(out)

    def decode(self, name, data):
        return _read(data, 0, self.kind(name))[0]


def _aligned(at, size):
    return -(-at // size) * size


def _write(out, kind, value, path):
    try:
        _WRITERS[kind.shape](out, kind, value, path)
    except (struct.error, AttributeError) as error:
        raise TypeError(f"{path} cannot be {value!r}: {error}") from None


def _write_number(out, kind, value, _path, code=None):
    packer = struct.Struct("<" + (code or kind.name))
    out.extend(bytes(_aligned(len(out), packer.size) - len(out)))
    out.extend(packer.pack(value))


def _write_text(out, kind, value, path):
    data = value.encode() + b"\0"
    _write_number(out, kind, len(data), path, "I")
    out.extend(data)


def _write_enum(out, kind, value, path):
    if value not in kind.parts:
        raise ValueError(f"{path} cannot be {value!r}; it is one of {', '.join(kind.parts)}")
    _write_number(out, kind, kind.parts.index(value), path, "I")


def _write_struct(out, kind, value, path):
    fields = value if isinstance(value, dict) else value._fields()
    unknown = set(fields) - {name for name, _ in kind.parts}
    if unknown:
        raise TypeError(f"{path} has no field {unknown.pop()!r}; it has: {', '.join(name for name, _ in kind.parts)}")
    for name, part in kind.parts:
        _write(out, part, fields[name] if name in fields else part.default(), f"{path}.{name}")


def _write_list(out, kind, value, path):
    if kind.shape == "sequence":
        _write_number(out, kind, len(value), path, "I")
    elif len(value) != kind.count:
        raise ValueError(f"{path} has {kind.count} elements, not {len(value)}")
    for i, element in enumerate(value):
        _write(out, kind.parts, element, f"{path}[{i}]")


_WRITERS = {"number": _write_number, "text": _write_text, "enum": _write_enum, "struct": _write_struct,
            "sequence": _write_list, "array": _write_list}


def _read_number(data, at, code):
    unpacker = struct.Struct("<" + code)
    at = _aligned(at, unpacker.size)
    return unpacker.unpack_from(data, at)[0], at + unpacker.size


def _read(data, at, kind):
    """Returns a value, and where the next one begins."""
    if kind.shape == "number":
        return _read_number(data, at, kind.name)
    if kind.shape == "struct":
        fields = {}
        for name, part in kind.parts:
            fields[name], at = _read(data, at, part)
        return Object(kind.name, fields), at
    if kind.shape == "array":
        return _read_list(data, at, kind.parts, kind.count)
    number, at = _read_number(data, at, "I")
    if kind.shape == "enum":
        return kind.parts[number], at
    if kind.shape == "text":
        return data[at:at + number - 1].decode(errors="replace"), at + number
    return _read_list(data, at, kind.parts, number)


def _read_list(data, at, kind, count):
    if kind.shape == "number" and count:  # all at once: scans are long
        size = struct.calcsize(kind.name)
        at = _aligned(at, size)
        return list(struct.unpack_from(f"<{count}{kind.name}", data, at)), at + count * size
    values = []
    for _ in range(count):
        value, at = _read(data, at, kind)
        values.append(value)
    return values, at
