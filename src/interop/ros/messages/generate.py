#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Writes C++ from messages.txt: a struct per message of ROS 2, its reflection, and the table of descriptions.

generate.py messages.txt OUT_FOLDER       messages.hpp and message_table.inc
generate.py messages.txt --idl OUT_FILE   the same types for a DDS program, named as ROS 2 names them there
"""

import re
import sys
from dataclasses import dataclass
from pathlib import Path

# By the name in a .msg: the C++ type, the IDL type, and the fewest bytes that a value takes on the wire.
PRIMITIVES = {
    "bool": ("bool", "boolean", 1),
    "byte": ("std::uint8_t", "octet", 1),
    "int8": ("std::int8_t", "octet", 1),
    "uint8": ("std::uint8_t", "octet", 1),
    "int32": ("std::int32_t", "long", 4),
    "uint32": ("std::uint32_t", "unsigned long", 4),
    "uint64": ("std::uint64_t", "unsigned long long", 8),
    "float32": ("float", "float", 4),
    "float64": ("double", "double", 8),
    "string": ("std::string", "string", 4),
}
HEAD = "// SPDX-License-Identifier: LGPL-3.0-or-later\n// Written by generate.py from messages.txt.\n"


@dataclass
class Field:
    type: str
    suffix: str  # "", "[]" or "[36]"
    name: str


@dataclass
class Message:
    name: str  # "sensor_msgs/LaserScan"
    type_hash: str
    fields: list

    @property
    def package(self) -> str:
        return self.name.split("/")[0]

    @property
    def short(self) -> str:
        return self.name.split("/")[1]


class Mistake(Exception):
    pass


def read(path: Path) -> list[Message]:
    messages: dict[str, Message] = {}
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        words = line.split()
        if not line.startswith(" "):
            messages[words[0]] = Message(words[0], words[1] if len(words) > 1 else "", [])
            continue
        match = re.fullmatch(r"([\w/]+)(\[\d*\])?", words[0])
        if len(words) != 2 or not match or not messages:
            raise Mistake(f"{path.name}:{number}: expected '  type name'")
        if match.group(1) not in PRIMITIVES and match.group(1) not in messages:
            raise Mistake(f"{path.name}:{number}: '{match.group(1)}' is not declared before")
        list(messages.values())[-1].fields.append(Field(match.group(1), match.group(2) or "", words[1]))
    return list(messages.values())


def cpp_type(field: Field) -> str:
    element = PRIMITIVES[field.type][0] if field.type in PRIMITIVES else field.type.replace("/", "::")
    if field.suffix == "[]":
        return f"std::vector<{element}>"
    if field.suffix:
        return f"std::array<{element}, {field.suffix[1:-1]}>"
    return element


def wire_size(message: Message, messages: dict) -> int:
    size = 0
    for field in message.fields:
        one = PRIMITIVES[field.type][2] if field.type in PRIMITIVES else wire_size(messages[field.type], messages)
        size += 4 if field.suffix == "[]" else one * int(field.suffix[1:-1] or 1) if field.suffix else one
    return size


def struct(message: Message) -> str:
    fields = "".join(f"  {cpp_type(f)} {f.name}{{}};\n" for f in message.fields)
    return (f"namespace {message.package} {{\nstruct {message.short} {{\n{fields}"
            f"  friend bool operator==(const {message.short}&, const {message.short}&) = default;\n}};\n}}\n")


def reflection(message: Message, messages: dict) -> str:
    visits = "".join(f'    visitor.field(FieldInfo{{"{f.name}", ""}}, object.{f.name});\n' for f in message.fields)
    return (
        f"template <>\nstruct Reflection<ros::{message.package}::{message.short}> {{\n"
        f'  static constexpr std::string_view name = "{message.package}/msg/{message.short}";\n'
        f"  static constexpr std::size_t min_wire_size = {wire_size(message, messages)};\n"
        f"  template <class Object, class Visitor>\n  static void fields(Object& object, Visitor& visitor) {{\n{visits}  }}\n}};\n")


def header(messages: list[Message]) -> str:
    by_name = {m.name: m for m in messages}
    includes = "".join(f"#include <{i}>\n" for i in ("array", "cstdint", "string", "tuple", "vector"))
    all_types = ",\n               ".join(f"{m.package}::{m.short}" for m in messages)
    return (f"{HEAD}#pragma once\n\n{includes}\n#include \"orca/idl/reflection.hpp\"\n\nnamespace orca::ros {{\n\n"
            + "\n".join(map(struct, messages))
            + f"\n/// All of them, for what treats them alike.\nusing Messages =\n    std::tuple<{all_types}>;\n\n}}  // namespace orca::ros\n\n"
            + "namespace orca {\n\n" + "\n".join(reflection(m, by_name) for m in messages) + "\n}  // namespace orca\n")


def own_definition(message: Message) -> str:
    return "".join(f"{f.type}{f.suffix} {f.name}\n" for f in message.fields)


def definition(message: Message, messages: dict) -> str:
    """Returns the text of a .msg with those of all that it holds, as bags and viewers expect it."""
    text, known = own_definition(message), set()

    def append_parts(part: Message):
        nonlocal text
        for field in part.fields:
            if field.type in PRIMITIVES or field.type in known:
                continue
            known.add(field.type)
            text += f"{'=' * 80}\nMSG: {field.type}\n{own_definition(messages[field.type])}"
            append_parts(messages[field.type])

    append_parts(message)
    return text


def table(messages: list[Message]) -> str:
    by_name = {m.name: m for m in messages}
    rows = []
    for m in messages:
        lines = "\n".join(f'     "{line}\\n"' for line in definition(m, by_name).splitlines())
        rows.append(f'    {{"{m.package}/msg/{m.short}",\n{lines},\n     "{m.type_hash}"}},\n')
    return HEAD + "".join(rows)


def idl(messages: list[Message]) -> str:
    parts = []
    for m in messages:
        fields = ""
        for f in m.fields:
            package, _, short = f.type.partition("/")
            element = PRIMITIVES[f.type][1] if f.type in PRIMITIVES else f"{package}::msg::dds_::{short}_"
            declared = f"sequence<{element}> {f.name}" if f.suffix == "[]" else f"{element} {f.name}{f.suffix}"
            fields += f"  {declared};\n"
        parts.append(f"module {m.package} {{ module msg {{ module dds_ {{\n@final struct {m.short}_ {{\n{fields}}};\n}}; }}; }};\n")
    return "// Written by generate.py from messages.txt.\n" + "\n".join(parts)


def write_if_changed(path: Path, text: str):
    if not path.exists() or path.read_text() != text:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


def main() -> int:
    try:
        messages = read(Path(sys.argv[1]))
    except Mistake as mistake:
        print(mistake, file=sys.stderr)
        return 1
    if sys.argv[2] == "--idl":
        write_if_changed(Path(sys.argv[3]), idl(messages))
    else:
        write_if_changed(Path(sys.argv[2]) / "messages.hpp", header(messages))
        write_if_changed(Path(sys.argv[2]) / "message_table.inc", table(messages))
    return 0


if __name__ == "__main__":
    sys.exit(main())
