# SPDX-License-Identifier: LGPL-3.0-or-later
"""The content of an IDL file: types, fields, units, and the layout text that identifies an object type."""

from dataclasses import dataclass, field
from typing import Optional, Union

FNV_OFFSET = 0xCBF29CE484222325
FNV_PRIME = 0x100000001B3


class IdlError(Exception):
    """A mistake in an IDL file, with its place: "motion.idl:12: ..."."""


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
class Enum:
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
class Struct:
    name: str
    base: Optional["Struct"]
    text: str
    fields: list[Field] = field(default_factory=list)

    @property
    def all_fields(self) -> list[Field]:
        return (self.base.all_fields if self.base else []) + self.fields

    @property
    def parent(self) -> Optional["Struct"]:
        """The object type that this one extends; none if that is only OrcaObject."""
        return self.base if self.base is not None and self.base.is_object and self.base.name != "OrcaObject" else None

    @property
    def layout(self) -> str:
        """All that two programs must agree on to exchange this type: its parent, base's fields first, nested types in full."""
        head = f"{self.name}:{self.parent.name}" if self.parent else self.name
        return f"{head}{{{','.join(f.layout for f in self.all_fields)}}}"

    @property
    def wire_size(self) -> int:
        return sum(f.wire_size for f in self.all_fields)

    @property
    def is_object(self) -> bool:
        """Whether it can be sent on its own: OrcaObject and the structs derived from it."""
        return self.name == "OrcaObject" or (self.base is not None and self.base.is_object)


@dataclass
class IdlFile:
    name: str
    includes: list["IdlFile"]
    enums: list[Enum]
    structs: list[Struct]


def layout_hash(layout: str) -> int:
    """Returns FNV-1a, 64 bits, over the text and a zero: the same value as orca::Fnv1a::add_text."""
    value = FNV_OFFSET
    for byte in layout.encode("ascii") + b"\0":
        value = ((value ^ byte) * FNV_PRIME) & 0xFFFFFFFFFFFFFFFF
    return value
