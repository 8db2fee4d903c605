#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Generates C++ from IDL files: the class of every type, its reflection, and the table of all types.

generate.py --out DIR FILE.idl...                              all of Orca's own files
generate.py --out DIR --library NAME --orca DIR FILE.idl...    those of a library of object types

A library's files may #include Orca's, which lie in --orca. Its headers are included as "NAME/FILE.hpp".
Files whose text did not change keep their time stamp, so that an edit of one IDL file rebuilds only its users.
"""

import argparse
import sys
from pathlib import Path

import emit_cpp
from idl_model import IdlError, IdlFile
from idl_parser import load_files


def write_if_changed(path: Path, text: str):
    if not path.exists() or path.read_text() != text:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


def write_headers(files: list[IdlFile], out: Path):
    for file in files:
        stem = Path(file.name).stem
        write_if_changed(out / f"{stem}.h", emit_cpp.classes_header(file))
        write_if_changed(out / f"{stem}.reflection.hpp", emit_cpp.reflection_header(file))
        write_if_changed(out / f"{stem}.types.hpp", emit_cpp.types_header(file))


def write_orca(sources: list[Path], out: Path):
    files = load_files(sources)
    write_headers(files, out)
    write_if_changed(out / "object_types.cpp", emit_cpp.type_table(files))
    write_if_changed(out / "object_layouts.hpp", emit_cpp.layouts_header(files))


def check_library(own: list[IdlFile]):
    for file in own:
        if not file.module:
            raise IdlError(f"{file.name}:1: module orca is for Orca's own types: write module my {{ ... }};, with a name of yours for my")
        if file.module != own[0].module:
            raise IdlError(f"{file.name}:1: it declares module {file.module}, and {own[0].name} module {own[0].module}; the files of one "
                           "library share a module, whose name is before their types'")
    if not any(emit_cpp.objects_of(file) for file in own):
        raise IdlError(f"{own[0].name}:1: no struct derives from orca::idl::OrcaObject, so there is no object type; write "
                       "struct NAME : orca::idl::OrcaObject { ... };")


def own_files(sources: list[Path], orca: Path) -> list[IdlFile]:
    """Parses the files of a library, and returns them without Orca's."""
    for n, source in enumerate(sources):
        if (orca / source.name).exists():
            raise IdlError(f"{source.name}:1: Orca has a file of this name; give yours another one")
        if source.name in [earlier.name for earlier in sources[:n]]:
            raise IdlError(f"{source.name}:1: two files of the library have this name")
        if not source.exists():
            raise IdlError(f"{source}:1: there is no such file")
    names = [source.name for source in sources]
    files = load_files(sources, orca)
    for file in files:
        if not (orca / file.name).exists() and file.name not in names:
            raise IdlError(f"{file.name}:1: it is included, but not among the FILES of orca_generate_idl()")
    return [file for file in files if file.name in names]


def write_library(sources: list[Path], orca: Path, out: Path):
    name = out.name
    own = own_files(sources, orca)
    check_library(own)
    for file in own:
        file.place = name
        write_if_changed(out / f"{Path(file.name).stem}.hpp", emit_cpp.public_header(file))
    write_headers(own, out / "generated")
    write_if_changed(out / "generated/object_types.cpp", emit_cpp.library_source(own))
    write_if_changed(out / "generated/object_layouts.cpp", emit_cpp.layouts_source(own))
    write_if_changed(out / f"generated/{name}.types", emit_cpp.types_list(own))


def main() -> int:
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("--out", required=True, type=Path)
    options.add_argument("--library")
    options.add_argument("--orca", type=Path)
    options.add_argument("sources", nargs="+", type=Path)
    arguments = options.parse_args()
    out = arguments.out / arguments.library if arguments.library else arguments.out
    (out / "generated" if arguments.library else out).mkdir(parents=True, exist_ok=True)
    try:
        if arguments.library:
            write_library(arguments.sources, arguments.orca, out)
        else:
            write_orca(arguments.sources, out)
    except IdlError as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
