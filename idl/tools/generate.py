#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Generates C++ from IDL files: runs fastddsgen and writes the reflection of every type beside its output.

generate.py --fastddsgen PROGRAM --out DIR FILE.idl...                              all of Orca's own files
generate.py --fastddsgen PROGRAM --out DIR --library NAME --orca DIR FILE.idl...    those of a library of object types

A library's files may #include Orca's, which lie in --orca. Its headers are included as "NAME/FILE.hpp".
Files whose text did not change keep their time stamp, so that an edit of one IDL file rebuilds only its users.
"""

import argparse
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import emit_cpp
from idl_model import IdlError, IdlFile
from idl_parser import load_files


def write_if_changed(path: Path, text: str):
    if not path.exists() or path.read_text() != text:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


def run_fastddsgen(program: str, sources: list[Path], kinds: int, out: Path, change=lambda text: text):
    """Runs fastddsgen once for all files: it writes included files again, so separate runs would race.

    Of each file `kinds` pairs of source and header are taken over: the classes, and what Fast DDS needs of them.
    """
    with tempfile.TemporaryDirectory(dir=out) as scratch:
        # Without -t, runs at the same time share their preprocessed files if these have one name.
        own = Path(scratch) / "preprocessed"
        own.mkdir()
        command = [program, "-replace", "-cs", "-t", str(own), "-d", scratch, *(s.name for s in sources)]
        run = subprocess.run(command, cwd=sources[0].parent, capture_output=True, text=True)
        for source in sources:
            generated = sorted(Path(scratch).glob(f"{source.stem}.*")) + sorted(
                Path(scratch).glob(f"{source.stem}PubSubTypes.*"))
            if run.returncode != 0 or len(generated) != 4:
                raise IdlError(f"{source.name}:1: fastddsgen failed:\n{run.stdout}{run.stderr}")
            for path in generated[:2 * kinds]:
                # fastddsgen writes the hash codes of its own Java objects into comments, and they differ in
                # each run.
                stable = re.sub(r"[ \t]*// m_\w+ com\.eprosima\.\S+\n", "", path.read_text())
                write_if_changed(out / path.name, change(stable))


def write_headers(files: list[IdlFile], out: Path):
    for file in files:
        stem = Path(file.name).stem
        write_if_changed(out / f"{stem}.reflection.hpp", emit_cpp.reflection_header(file))
        write_if_changed(out / f"{stem}.types.hpp", emit_cpp.types_header(file))


def write_orca(program: str, sources: list[Path], out: Path):
    files = load_files(sources)
    write_headers(files, out)
    write_if_changed(out / "object_types.cpp", emit_cpp.type_table(files))
    write_if_changed(out / "object_layouts.hpp", emit_cpp.layouts_header(files))
    run_fastddsgen(program, sources, 2, out)


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


def write_library(program: str, sources: list[Path], orca: Path, out: Path):
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

    def with_places(text: str) -> str:
        """Lets the classes find each other: fastddsgen takes them all for neighbours."""
        def place(match):
            place = name if f"{match[1]}.idl" in [file.name for file in own] else "orca/idl"
            return f'#include "{place}/generated/{match[1]}.h"'
        return re.sub(r'#include "(\w+)\.h"', place, text)

    with tempfile.TemporaryDirectory(dir=out) as together:
        for source in [*orca.glob("*.idl"), *sources]:
            shutil.copy(source, together)
        run_fastddsgen(program, [Path(together) / source.name for source in sources], 1, out / "generated", with_places)


def main() -> int:
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("--fastddsgen", required=True)
    options.add_argument("--out", required=True, type=Path)
    options.add_argument("--library")
    options.add_argument("--orca", type=Path)
    options.add_argument("sources", nargs="+", type=Path)
    arguments = options.parse_args()
    out = arguments.out / arguments.library if arguments.library else arguments.out
    (out / "generated" if arguments.library else out).mkdir(parents=True, exist_ok=True)
    try:
        if arguments.library:
            write_library(arguments.fastddsgen, arguments.sources, arguments.orca, out)
        else:
            write_orca(arguments.fastddsgen, arguments.sources, out)
    except IdlError as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
