# SPDX-License-Identifier: LGPL-3.0-or-later
"""The content of an IDL file: types, fields, units, and the layout text that identifies an object type."""

from dataclasses import dataclass, field
from typing import Optional, Union

FNV_OFFSET = 0xCBF29CE484222325
FNV_PRIME = 0x100000001B3


class IdlError(Exception):
    """A mistake in an IDL file, with its place: "motion.idl:12: ..."."""


class Named:
    """What has a name: that of Orca's own types is one word, that of others begins with their module, "my.Glow"."""

    name: str

    @property
    def module(self) -> str:
        """The module of a type that is not Orca's own; empty: it is."""
        return self.name.rpartition(".")[0]

    @property
    def word(self) -> str:
        """The name without its module."""
        return self.name.rpartition(".")[2]

    @property
    def cpp(self) -> str:
        """The class in C++, as seen from namespace orca."""
        return f"::{self.module}::{self.word}" if self.module else f"idl::{self.name}"

    @property
    def full_cpp(self) -> str:
        """The class in C++, as seen from everywhere."""
        return f"::{self.module or 'orca::idl'}::{self.word}"


@dataclass(frozen=True)
class Primitive:
    """A built-in type of IDL, and the fewest bytes that a value takes on the wire (XCDR1)."""

    idl: str
    layout: str
    wire_size: int


PRIMITIVES = {
    p.idl: p
    for p in (
        Primitive("boolean", "bool", 1),
        Primitive("octet", "uint8", 1),
        Primitive("long", "int32", 4),
        Primitive("unsigned long", "uint32", 4),
        Primitive("long long", "int64", 8),
        Primitive("unsigned long long", "uint64", 8),
        Primitive("double", "double", 8),
        Primitive("string", "string", 4),
    )
}


@dataclass
class Enum(Named):
    name: str
    enumerators: list[str]
    text: str

    wire_size = 4

    @property
    def layout(self) -> str:
        return f"{self.name}({','.join(self.enumerators)})"


@dataclass
class Field:
    name: str
    type: Union[Primitive, Enum, "Struct"]
    unit: str
    text: str
    sequence: bool = False
    array: Optional[int] = None
    #: A sequence that is marked @bulk.
    bulk: bool = False

    @property
    def layout(self) -> str:
        kind = self.type.layout
        if self.sequence:
            kind = f"sequence<{kind}>"
        if self.array is not None:
            kind = f"{kind}[{self.array}]"
        return f"{self.name}:{kind}" + (f" {{{self.unit}}}" if self.unit else "")

    @property
    def wire_size(self) -> int:
        if self.sequence:
            return 4
        return self.type.wire_size * (self.array or 1)


@dataclass
class Struct(Named):
    name: str
    base: Optional["Struct"]
    text: str
    fields: list[Field] = field(default_factory=list)
    #: OrcaObject, for a plain struct that is marked @travels: it may be a part of others and an object of its own.
    header: Optional["Struct"] = None

    @property
    def all_fields(self) -> list[Field]:
        return (self.base.all_fields if self.base else []) + self.fields

    @property
    def parent(self) -> Optional["Struct"]:
        """The object type that this one extends; none if that is only OrcaObject."""
        return self.base if self.base is not None and self.base.travels else None

    @property
    def layout(self) -> str:
        """The layout as a part of others: base's fields first, nested types in full."""
        return self._layout(self.parent if self.is_object else None, self.all_fields)

    @property
    def object_layout(self) -> str:
        """All that two programs must agree on to exchange objects of this type: its parent, and all fields with the header's."""
        return self._layout(self.parent, (self.header.all_fields if self.header else []) + self.all_fields)

    def _layout(self, parent: Optional["Struct"], fields: list[Field]) -> str:
        head = f"{self.name}:{parent.name}" if parent else self.name
        return f"{head}{{{','.join(f.layout for f in fields)}}}"

    @property
    def text_names(self) -> list[str]:
        """The names on its XML element, where a struct that comes first has no element of its own (docs/objects.md)."""
        own = self.all_fields
        head = []
        if self.is_object:
            head = [f.name for f in own if f in self.root.fields]
            own = own[len(head):]
        first = own[0] if own else None
        if first and isinstance(first.type, Struct) and first.type.name != "TimeValue" and not first.sequence and first.array is None:
            return head + first.type.text_names + [f.name for f in own[1:]]
        return head + [f.name for f in own]

    @property
    def has_bulk(self) -> bool:
        """Whether it has fields marked @bulk, its own or those of its parts."""
        return any(f.bulk or (isinstance(f.type, Struct) and f.type.has_bulk) for f in self.all_fields)

    @property
    def root(self) -> "Struct":
        return self.base.root if self.base else self

    @property
    def wire_size(self) -> int:
        return sum(f.wire_size for f in self.all_fields)

    @property
    def is_object(self) -> bool:
        """Whether it holds a header itself: OrcaObject and the structs derived from it."""
        return self.name == "OrcaObject" or (self.base is not None and self.base.is_object)

    @property
    def travels(self) -> bool:
        """Whether it can be sent on its own."""
        return self.header is not None or (self.is_object and self.name != "OrcaObject")


@dataclass
class IdlFile:
    name: str
    includes: list["IdlFile"]
    enums: list[Enum]
    structs: list[Struct]
    #: The module that it declares types in; empty: Orca's own.
    module: str = ""
    #: The folder of the headers that are made of it, as #include lines name it.
    place: str = "orca/idl"


def layout_hash(layout: str) -> int:
    """Returns FNV-1a, 64 bits, over the text and a zero: the same value as orca::Fnv1a::add_text."""
    value = FNV_OFFSET
    for byte in layout.encode("ascii") + b"\0":
        value = ((value ^ byte) * FNV_PRIME) & 0xFFFFFFFFFFFFFFFF
    return value
