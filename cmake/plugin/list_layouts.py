#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Lists the layout of every type that crosses the plugin boundary, from the debug information of layout_probe.cpp.

Writes a header with a table, a line of text per type: its name and a hash of its size, bases, members with their
offsets and types, virtual functions with their places, and enumerators. The objects of idl/ are left out: each has
a hash of its own (object_layouts.hpp).

Usage: list_layouts.py --readelf READELF --object PROBE.o --out HEADER [--text FILE]
"""
import argparse
import re
import subprocess
import sys

DIE = re.compile(r"^ <(\d+)><([0-9a-f]+)>: Abbrev Number: \d+ \((DW_TAG_\w+)\)")
RECORDS = ("DW_TAG_class_type", "DW_TAG_structure_type", "DW_TAG_union_type")
WANTED = {"name", "byte_size", "type", "data_member_location", "declaration", "virtuality", "vtable_elem_location",
          "linkage_name", "const_value", "upper_bound", "artificial", "alignment", "external", "specification"}


class Die:
    def __init__(self, tag, parent):
        self.tag, self.parent, self.children, self.at = tag, parent, [], {}  # attributes in readelf's words

    def named(self, attribute, default=""):
        return value_of(self.at[attribute]) if attribute in self.at else default


def value_of(text):
    """The value in readelf's words: "(strp) (offset: 0x1): NAME", "(ref4) <0x2a>, NAME", "(data1) 8"."""
    text = re.sub(r"^\(\w+\) ", "", text.strip())
    text = re.sub(r"^\((?:indirect string|offset|alt indirect string)[^)]*\): ", "", text)
    return text.strip()


def read(lines):
    """The entries by offset, and those without a parent."""
    dies, roots, stack = {}, [], []
    die = None
    for line in lines:  # of which there are a million, so each is looked at by as little as it needs
        if line.startswith(" <"):
            start = DIE.match(line)
            if not start:  # the end of a list of children
                continue
            depth = int(start.group(1))
            del stack[depth:]
            die = Die(start.group(3), stack[-1] if stack else None)
            (stack[-1].children if stack else roots).append(die)
            stack.append(die)
            dies[start.group(2)] = die
            continue
        if die is None or not line.startswith("    <"):
            continue
        name, _, value = line[line.find("DW_AT_") + len("DW_AT_"):].partition(":")
        if name.rstrip() in WANTED:
            die.at[name.rstrip()] = value
    return dies, roots


def reference(text):
    return re.match(r"<0x([0-9a-f]+)>", text).group(1)


def scope_of(die):
    names = []
    while die is not None and die.tag != "DW_TAG_compile_unit":
        names.append(die.named("name", "(anonymous)") if die.tag != "DW_TAG_subprogram" else "(function)")
        die = die.parent
    return "::".join(reversed(names))


class Layouts:
    def __init__(self, dies):
        self.dies = dies

    def type_of(self, die):
        """The type that an entry refers to, in words that two builds share."""
        if "type" not in die.at:
            return "void"
        return self.words(self.dies[reference(die.named("type"))])

    def words(self, die):
        kind = die.tag.removeprefix("DW_TAG_").removesuffix("_type")
        if kind in ("typedef", "const", "volatile"):
            return self.type_of(die)
        if kind in ("pointer", "reference", "rvalue_reference", "ptr_to_member"):
            return kind  # what is behind it has its own line, if a plugin can see it
        if kind == "array":
            bounds = [child.named("upper_bound", "?") for child in die.children]
            return f"{self.type_of(die)}[{','.join(bounds)}]"
        if kind == "base":
            return f"{die.named('name')}:{die.named('byte_size')}"
        return f"{scope_of(die)}:{die.named('byte_size')}"

    def describe(self, die):
        parts = [f"size {die.named('byte_size')}"]
        if "alignment" in die.at:
            parts.append(f"aligned {die.named('alignment')}")
        for child in die.children:
            if child.tag == "DW_TAG_inheritance":
                parts.append(f"base {self.type_of(child)} at {child.named('data_member_location', '0')}")
            elif child.tag == "DW_TAG_member" and "external" not in child.at and "declaration" not in child.at:
                parts.append(f"{child.named('name')} {self.type_of(child)} at {child.named('data_member_location', '0')}")
            elif child.tag == "DW_TAG_enumerator":
                parts.append(f"{child.named('name')} = {child.named('const_value')}")
            elif child.tag == "DW_TAG_subprogram" and "virtuality" in child.at:
                place = re.search(r"(\d+)\)?$", child.named("vtable_elem_location", "0)")).group(1)
                parts.append(f"virtual {child.named('linkage_name', child.named('name'))} in place {place}")
        return "; ".join(parts)


def fnv1a(text):
    value = 0xCBF29CE484222325
    for byte in text.encode():
        value = (value ^ byte) * 0x100000001B3 & 0xFFFFFFFFFFFFFFFF
    return value


def crosses(die):
    """Whether it is a named type of Orca's, complete, and not one of the objects."""
    if die.tag not in (*RECORDS, "DW_TAG_enumeration_type") or "declaration" in die.at or "name" not in die.at:
        return False
    scope = scope_of(die)
    return (scope.startswith("orca::") and not scope.startswith("orca::idl::")
            and not re.search(r"\(anonymous\)|\(function\)|<lambda|Reflection<", scope))


def table_of(lines):
    """Qualified name -> description, of every type that crosses the boundary."""
    dies, _ = read(lines)
    layouts = Layouts(dies)
    return dict(sorted((scope_of(die), layouts.describe(die)) for die in dies.values() if crosses(die)))


def header_of(table):
    lines = [f"{name} {fnv1a(text):016x}" for name, text in table.items()]
    rows = "\n".join(f'    "{line}\\0"' for line in lines)
    total = fnv1a("".join(line + "\0" for line in lines))
    return ("// Made by cmake/plugin/list_layouts.py from the debug information of layout_probe.cpp.\n#pragma once\n\n"
            "#include <array>\n#include <cstdint>\n\nnamespace orca::detail {\n\n"
            "/// Name and hash of each type that crosses the plugin boundary, each ended by a zero.\n"
            f"inline constexpr auto plugin_layouts = std::to_array(\n{rows});\n\n"
            "/// FNV-1a of all these lines, each with its zero.\n"
            f"inline constexpr std::uint64_t plugin_layouts_hash = 0x{total:016x};\n\n}}  // namespace orca::detail\n")


def main():
    parser = argparse.ArgumentParser()
    for option in ("--readelf", "--object", "--out"):
        parser.add_argument(option, required=True)
    parser.add_argument("--text", help="where to write the descriptions, for people")
    arguments = parser.parse_args()
    dump = subprocess.run([arguments.readelf, "--debug-dump=info", "--wide", arguments.object], check=True,
                          capture_output=True, text=True, errors="replace").stdout
    table = table_of(dump.splitlines())
    if "orca::Component" not in table:
        sys.exit(f"{arguments.object}: its debug information describes no orca::Component; compile it with -g")
    with open(arguments.out, "w", encoding="utf-8") as out:
        out.write(header_of(table))
    if arguments.text:
        with open(arguments.text, "w", encoding="utf-8") as out:
            out.writelines(f"{name}: {text}\n" for name, text in table.items())


if __name__ == "__main__":
    main()
