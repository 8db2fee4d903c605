# SPDX-License-Identifier: LGPL-3.0-or-later
"""Writes the C++ of IDL types: their classes, field visitors, and the table of object types."""

import re
from pathlib import Path

from idl_model import Enum, Field, IdlFile, Primitive, Struct, layout_hash

HEAD = "// SPDX-License-Identifier: LGPL-3.0-or-later\n// Written by idl/tools/generate.py from the IDL files.\n"


def quoted(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def enum_reflection(enum: Enum) -> str:
    names = ", ".join(quoted(e) for e in enum.enumerators)
    return (
        f"template <>\nstruct EnumReflection<{enum.cpp}> {{\n"
        f"  static constexpr std::string_view name = {quoted(enum.name)};\n"
        f"  static constexpr std::array<std::string_view, {len(enum.enumerators)}> names = {{{names}}};\n}};\n"
    )


def struct_reflection(struct: Struct) -> str:
    lines = []
    header = ", true" if struct.name == "OrcaObject" else ""
    if struct.base:
        base = struct.base.cpp
        lines.append(f"    Reflection<{base}>::fields(as_base<{base}>(object), visitor);")
    for field in struct.fields:
        info = f"FieldInfo{{{quoted(field.name)}, {quoted(field.unit)}{header}}}"
        lines.append(f"    visitor.field({info}, object.{field.name}());")
    body = "\n".join(lines)
    return (
        f"template <>\nstruct Reflection<{struct.cpp}> {{\n"
        f"  static constexpr std::string_view name = {quoted(struct.name)};\n"
        f"  static constexpr std::size_t min_wire_size = {struct.wire_size};\n"
        f"  static constexpr bool has_bulk = {str(struct.has_bulk).lower()};\n"
        f"  template <class Object, class Visitor>\n"
        f"  static void fields(Object& object, Visitor& visitor) {{\n{body}\n  }}\n}};\n"
    )


NUMBERS = {"bool": "bool", "uint8": "std::uint8_t", "int32": "std::int32_t", "uint32": "std::uint32_t", "int64": "std::int64_t",
           "uint64": "std::uint64_t", "double": "double", "string": "std::string"}


def cpp_type(field: Field) -> str:
    """Returns the C++ type of a field."""
    kind = NUMBERS[field.type.layout] if isinstance(field.type, Primitive) else field.type.full_cpp
    if field.array is not None:
        return f"std::array<{kind}, {field.array}>"
    if field.sequence:
        return f"::orca::Bulk<{kind}>" if field.bulk else f"std::vector<{kind}>"
    return kind


def accessors(field: Field) -> str:
    """Returns what reads, changes and sets a field. A single number or enumerator is returned by value."""
    kind, name = cpp_type(field), field.name
    is_small = not field.sequence and field.array is None and (isinstance(field.type, Enum) or kind in NUMBERS.values() and kind != "std::string")
    returned = kind if is_small else f"const {kind}&"
    text = f"  {returned} {name}() const {{ return m_{name}; }}\n  {kind}& {name}() {{ return m_{name}; }}\n"
    if is_small:
        return text + f"  void {name}({kind} value) {{ m_{name} = value; }}\n"
    return text + (f"  void {name}(const {kind}& value) {{ m_{name} = value; }}\n"
                   f"  void {name}({kind}&& value) {{ m_{name} = std::move(value); }}\n")


def class_of(struct: Struct) -> str:
    base = f" : public {struct.base.full_cpp}" if struct.base else ""
    return (f"class {struct.word}{base} {{\n public:\n" + "\n".join(map(accessors, struct.fields)) +
            f"\n  bool operator==(const {struct.word}&) const = default;\n\n private:\n" +
            "".join(f"  {cpp_type(f)} m_{f.name}{{}};\n" for f in struct.fields) + "};\n")


def enum_of(enum: Enum) -> str:
    return f"enum {enum.word} : std::uint32_t {{ {', '.join(enum.enumerators)} }};\n"


def classes_header(file: IdlFile) -> str:
    """Returns the classes of the structs: plain values, with the accessors that the IDL-to-C++ mapping of DDS has."""
    space = file.module or "orca::idl"
    parts = [HEAD, "#pragma once\n\n"]
    parts += [f"#include <{name}>\n" for name in ("array", "cstdint", "string", "utility", "vector")]
    parts.append('\n#include "orca/idl/bulk.hpp"\n')
    parts += [f'#include "{i.place}/generated/{Path(i.name).stem}.h"\n' for i in file.includes]
    parts.append(f"\nnamespace {space} {{\n\n")
    parts.append("\n".join([*map(enum_of, file.enums), *map(class_of, file.structs)]))
    parts.append(f"\n}}  // namespace {space}\n")
    return "".join(parts)


def reflection_header(file: IdlFile) -> str:
    stem = Path(file.name).stem
    parts = [HEAD, "#pragma once\n\n", '#include "orca/idl/reflection.hpp"\n', f'#include "{file.place}/generated/{stem}.h"\n']
    parts += [f'#include "{i.place}/generated/{Path(i.name).stem}.reflection.hpp"\n' for i in file.includes]
    parts.append("\nnamespace orca {\n\n")
    parts.append("\n".join([*map(enum_reflection, file.enums), *map(struct_reflection, file.structs)]))
    parts.append("\n}  // namespace orca\n")
    return "".join(parts)


def objects_of(file: IdlFile) -> list[Struct]:
    return [s for s in file.structs if s.travels]


def type_key(struct: Struct) -> str:
    return f"detail::object_type_of<{struct.cpp}, 0x{layout_hash(struct.object_layout):016x}U>()"


def type_declaration(struct: Struct) -> str:
    """Declares a type. Its symbol contains the hash of its layout: users built for another layout do not load."""
    names = [struct.cpp] + ([f"Travelling<{struct.cpp}>"] if struct.header else [])
    return f"template <>\nconst ObjectType& {type_key(struct)};\n" + "".join(
        f"template <>\ninline const ObjectType& object_type<{name}>() {{ return {type_key(struct)}; }}\n" for name in names
    )


def types_header(file: IdlFile) -> str:
    stem = Path(file.name).stem
    headers = ["orca/idl/object_type.hpp", "orca/idl/travelling.hpp", f"{file.place}/generated/{stem}.h"]
    parts = [HEAD, "#pragma once\n\n", *(f'#include "{header}"\n' for header in headers)]
    parts.append("\nnamespace orca {\n\n")
    parts += map(type_declaration, objects_of(file))
    parts.append("\n}  // namespace orca\n")
    return "".join(parts)


def type_definition(struct: Struct) -> str:
    """Defines a type. One that extends a type of another library is made when its library is loaded, all others by the compiler."""
    name, layout, parent, when = struct.word, struct.object_layout, "nullptr", "constinit "
    if struct.parent:
        is_near = struct.parent.module == struct.module
        parent = f"&type_of_{struct.parent.word}" if is_near else f"&{type_key(struct.parent)}"
        when = when if is_near else ""
    return (
        f"constinit detail::Pool pool_of_{name}{{type_of_{name}}};\n"
        f"{when}const ObjectType type_of_{name} = detail::make_object_type<ObjectOf<{struct.cpp}>>(\n"
        f"    {quoted(layout)}, 0x{layout_hash(layout):016x}U, {parent}, pool_of_{name});\n"
    )


def definitions(files: list[IdlFile], structs: list[Struct], headers: list[str]) -> str:
    """Returns the begin of a source file that defines object types, and kTypes, which lists them."""
    parts = [HEAD, *(f'#include "{header}"\n' for header in ["orca/idl/make_object_type.hpp", *headers])]
    for file in files:
        parts += [f'#include "{file.place}/generated/{Path(file.name).stem}.{kind}.hpp"\n' for kind in ("reflection", "types")]
    parts.append("\nnamespace orca {\nnamespace {\n\n")
    parts += [f"extern const ObjectType type_of_{s.word};\n" for s in structs]
    parts.append("\n" + "\n".join(map(type_definition, structs)))
    parts.append("\nconstexpr const ObjectType* kTypes[] = {\n")
    parts += [f"    &type_of_{s.word},\n" for s in structs]
    parts.append("};\n\n}  // namespace\n\n")
    for s in structs:
        parts.append(f"template <>\nconst ObjectType& {type_key(s)} {{ return type_of_{s.word}; }}\n")
    return "".join(parts)


def part_key(part) -> str:
    return f"detail::part_layout<{part.cpp}, 0x{layout_hash(part.layout):016x}U>()"


def type_table(files: list[IdlFile]) -> str:
    """Returns the one source file of liborca_idl.so that defines every object type, sorted by name for searching."""
    structs = sorted((s for f in files for s in objects_of(f)), key=lambda s: s.name)
    of_parts = [part for f in files for part in (*f.enums, *f.structs)]
    parts = [definitions(files, structs, ["orca/idl/object_library.hpp", "orca/idl/pool.hpp", "own_types.hpp"])]
    parts.append("\nnamespace {\n\nconstexpr std::string_view kParts[] = {\n")
    parts += [f"    {quoted(part.layout)},\n" for part in of_parts]
    parts.append("};\n\n}  // namespace\n\n")
    for i, part in enumerate(of_parts):
        parts.append(f"template <>\nstd::string_view {part_key(part)} {{ return kParts[{i}]; }}\n")
    parts.append("\nnamespace detail {\n\nstd::span<const ObjectType* const> own_object_types() { return kTypes; }\n"
                 "std::span<const std::string_view> own_part_layouts() { return kParts; }\n\n}  // namespace detail\n}  // namespace orca\n")
    return "".join(parts)


def orca_parts_of(files: list[IdlFile]) -> list:
    """Returns the types of Orca's own IDL files that the files' structs extend or hold themselves, OrcaObject always."""
    used = {}
    for struct in (s for f in files for s in f.structs):
        root = struct.header or struct.root
        for part in (root, struct.base, *(f.type for f in struct.fields)):
            if part is not None and hasattr(part, "cpp") and not part.module:
                used[part.name] = part
    return [used[name] for name in sorted(used)]


def library_source(files: list[IdlFile]) -> str:
    """Returns the source file of a library of object types that are not Orca's own."""
    structs = sorted((s for f in files for s in objects_of(f)), key=lambda s: s.name)
    needed = "".join(f"    {part_key(part)},\n" for part in orca_parts_of(files))
    return (
        definitions(files, structs, ["orca/idl/object_library.hpp", "orca/idl/pool.hpp"]) +
        "\nnamespace {\n\n// Refers to the layouts of Orca's own types that these were built with.\n"
        f"[[maybe_unused]] const std::string_view g_needed[] = {{\n{needed}}};\n"
        "[[maybe_unused]] const bool g_known = detail::add_object_types(kTypes);\n\n}  // namespace\n}  // namespace orca\n"
    )


def public_header(file: IdlFile) -> str:
    """Returns what components include to use a file's types."""
    stem = Path(file.name).stem
    headers = [f"{file.place}/generated/{stem}.h", f"{file.place}/generated/{stem}.types.hpp", "orca/idl/object.hpp",
               *(f"{i.place}/{Path(i.name).stem}.hpp" for i in file.includes)]
    return f"{HEAD}#pragma once\n\n" + "".join(f'#include "{header}"\n' for header in dict.fromkeys(headers))


def layouts_source(files: list[IdlFile]) -> str:
    """Returns what a library of object types and its users carry, to say what changed in a type since they were built."""
    structs = sorted((s for f in files for s in objects_of(f)), key=lambda s: s.name)
    texts = "\n".join(f"    {quoted(s.object_layout)} \"\\0\"" for s in structs)
    return (
        f"{HEAD}#include <array>\n\nnamespace {{\n\n[[gnu::section(\"orca_layouts\"), gnu::used, gnu::retain]] constexpr auto layouts =\n"
        f"    std::to_array(\n{texts});\n\n}}  // namespace\n"
    )


def sentence_of(text: str) -> str:
    """Returns the first sentence of a comment, as cmake/plugin/write_types.cmake does for components."""
    return re.split(r"[.:] (?=[A-Z@])", text)[0].rstrip(".: ") + "."


def types_list(files: list[IdlFile]) -> str:
    """Returns the list that lies beside a library of object types."""
    structs = sorted((s for f in files for s in objects_of(f)), key=lambda s: s.name)
    return "".join(f"object {s.name} {sentence_of(s.text)}\n" for s in structs)


def layouts_header(files: list[IdlFile]) -> str:
    """Returns the layouts that a plugin carries, so that an error can say what changed in a type since it was built."""
    structs = sorted((s for f in files for s in objects_of(f)), key=lambda s: s.name)
    texts = "\n".join(f"    {quoted(s.object_layout)} \"\\0\"" for s in structs)
    return (
        f"{HEAD}#pragma once\n\n#include <array>\n\nnamespace orca::detail {{\n\n"
        f"inline constexpr auto object_layouts = std::to_array(\n{texts});\n\n}}  // namespace orca::detail\n"
    )
