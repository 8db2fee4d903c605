# SPDX-License-Identifier: LGPL-3.0-or-later
"""Writes the C++ that describes IDL types: field visitors, and the table of object types."""

from pathlib import Path

from idl_model import Enum, IdlFile, Struct, layout_hash

HEAD = "// SPDX-License-Identifier: LGPL-3.0-or-later\n// Written by idl/tools/generate.py from the IDL files.\n"
PLACE = "orca/idl/generated"


def quoted(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def enum_reflection(enum: Enum) -> str:
    names = ", ".join(quoted(e) for e in enum.enumerators)
    return (
        f"template <>\nstruct EnumReflection<idl::{enum.name}> {{\n"
        f"  static constexpr std::string_view name = {quoted(enum.name)};\n"
        f"  static constexpr std::array<std::string_view, {len(enum.enumerators)}> names = {{{names}}};\n}};\n"
    )


def struct_reflection(struct: Struct) -> str:
    lines = []
    header = ", true" if struct.name == "OrcaObject" else ""
    if struct.base:
        base = f"idl::{struct.base.name}"
        lines.append(f"    Reflection<{base}>::fields(as_base<{base}>(object), visitor);")
    for field in struct.fields:
        info = f"FieldInfo{{{quoted(field.name)}, {quoted(field.unit)}{header}}}"
        lines.append(f"    visitor.field({info}, object.{field.name}());")
    body = "\n".join(lines)
    return (
        f"template <>\nstruct Reflection<idl::{struct.name}> {{\n"
        f"  static constexpr std::string_view name = {quoted(struct.name)};\n"
        f"  static constexpr std::size_t min_wire_size = {struct.wire_size};\n"
        f"  template <class Object, class Visitor>\n"
        f"  static void fields(Object& object, Visitor& visitor) {{\n{body}\n  }}\n}};\n"
    )


def reflection_header(file: IdlFile) -> str:
    stem = Path(file.name).stem
    parts = [HEAD, "#pragma once\n\n", '#include "orca/idl/reflection.hpp"\n', f'#include "{PLACE}/{stem}.h"\n']
    parts += [f'#include "{PLACE}/{Path(i.name).stem}.reflection.hpp"\n' for i in file.includes]
    parts.append("\nnamespace orca {\n\n")
    parts.append("\n".join([*map(enum_reflection, file.enums), *map(struct_reflection, file.structs)]))
    parts.append("\n}  // namespace orca\n")
    return "".join(parts)


def objects_of(file: IdlFile) -> list[Struct]:
    return [s for s in file.structs if s.travels]


def type_key(struct: Struct) -> str:
    return f"detail::object_type_of<idl::{struct.name}, 0x{layout_hash(struct.object_layout):016x}U>()"


def type_declaration(struct: Struct) -> str:
    """Declares a type. Its symbol contains the hash of its layout: users built for another layout do not load."""
    names = [f"idl::{struct.name}"] + ([f"Travelling<idl::{struct.name}>"] if struct.header else [])
    return f"template <>\nconst ObjectType& {type_key(struct)};\n" + "".join(
        f"template <>\ninline const ObjectType& object_type<{name}>() {{ return {type_key(struct)}; }}\n" for name in names
    )


def types_header(file: IdlFile) -> str:
    stem = Path(file.name).stem
    headers = ["orca/idl/object_type.hpp", "orca/idl/travelling.hpp", f"{PLACE}/{stem}.h"]
    parts = [HEAD, "#pragma once\n\n", *(f'#include "{header}"\n' for header in headers)]
    parts.append("\nnamespace orca {\n\n")
    parts += map(type_declaration, objects_of(file))
    parts.append("\n}  // namespace orca\n")
    return "".join(parts)


def type_definition(struct: Struct) -> str:
    name, layout = struct.name, struct.object_layout
    parent = f"&type_of_{struct.parent.name}" if struct.parent else "nullptr"
    return (
        f"constinit detail::Pool pool_of_{name}{{type_of_{name}}};\n"
        f"constinit const ObjectType type_of_{name} = detail::make_object_type<ObjectOf<idl::{name}>>(\n"
        f"    {quoted(layout)}, 0x{layout_hash(layout):016x}U, {parent}, pool_of_{name});\n"
    )


def type_table(files: list[IdlFile]) -> str:
    """Returns the one source file that defines every object type, sorted by name for searching."""
    stems = [Path(f.name).stem for f in files]
    structs = sorted((s for f in files for s in objects_of(f)), key=lambda s: s.name)
    parts = [HEAD, '#include "make_object_type.hpp"\n', '#include "pool.hpp"\n']
    parts += [f'#include "{PLACE}/{stem}.{kind}.hpp"\n' for stem in stems for kind in ("reflection", "types")]
    parts.append("\nnamespace orca {\nnamespace {\n\n")
    parts += [f"extern const ObjectType type_of_{s.name};\n" for s in structs]
    parts.append("\n" + "\n".join(map(type_definition, structs)))
    parts.append("\nconstexpr const ObjectType* kTypes[] = {\n")
    parts += [f"    &type_of_{s.name},\n" for s in structs]
    parts.append("};\n\n}  // namespace\n\n")
    for s in structs:
        parts.append(f"template <>\nconst ObjectType& {type_key(s)} {{ return type_of_{s.name}; }}\n")
    parts.append("\nstd::span<const ObjectType* const> object_types() { return kTypes; }\n\n}  // namespace orca\n")
    return "".join(parts)


def layouts_header(files: list[IdlFile]) -> str:
    """Returns the layouts that a plugin carries, so that an error can say what changed in a type since it was built."""
    structs = sorted((s for f in files for s in objects_of(f)), key=lambda s: s.name)
    texts = "\n".join(f"    {quoted(s.object_layout)} \"\\0\"" for s in structs)
    return (
        f"{HEAD}#pragma once\n\n#include <array>\n\nnamespace orca::detail {{\n\n"
        f"inline constexpr auto object_layouts = std::to_array(\n{texts});\n\n}}  // namespace orca::detail\n"
    )
