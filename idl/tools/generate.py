#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Generates C++ from all IDL files: runs fastddsgen and writes the reflection of every type beside its output.

generate.py --fastddsgen PROGRAM --out DIR FILE.idl...
Files whose text did not change keep their time stamp, so that an edit of one IDL file rebuilds only its users.
"""

import argparse
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import emit_cpp
from idl_model import IdlError
from idl_parser import load_files


def write_if_changed(path: Path, text: str):
    if not path.exists() or path.read_text() != text:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


def run_fastddsgen(program: str, sources: list[Path], out: Path):
    """Runs fastddsgen once for all files: it writes included files again, so separate runs would race."""
    with tempfile.TemporaryDirectory(dir=out) as scratch:
        command = [program, "-replace", "-cs", "-d", scratch, *(s.name for s in sources)]
        run = subprocess.run(command, cwd=sources[0].parent, capture_output=True, text=True)
        for source in sources:
            generated = sorted(Path(scratch).glob(f"{source.stem}.*")) + sorted(
                Path(scratch).glob(f"{source.stem}PubSubTypes.*"))
            if run.returncode != 0 or len(generated) != 4:
                raise IdlError(f"{source.name}:1: fastddsgen failed:\n{run.stdout}{run.stderr}")
            for path in generated:
                # fastddsgen writes the hash codes of its own Java objects into comments, and they differ in
                # each run.
                stable = re.sub(r"[ \t]*// m_\w+ com\.eprosima\.\S+\n", "", path.read_text())
                write_if_changed(out / path.name, stable)


def write_reflection(sources: list[Path], out: Path):
    files = load_files(sources)
    for file in files:
        stem = Path(file.name).stem
        write_if_changed(out / f"{stem}.reflection.hpp", emit_cpp.reflection_header(file))
        write_if_changed(out / f"{stem}.types.hpp", emit_cpp.types_header(file))
    write_if_changed(out / "object_types.cpp", emit_cpp.type_table(files))
    write_if_changed(out / "object_layouts.hpp", emit_cpp.layouts_header(files))


def main() -> int:
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("--fastddsgen", required=True)
    options.add_argument("--out", required=True, type=Path)
    options.add_argument("sources", nargs="+", type=Path)
    arguments = options.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    try:
        write_reflection(arguments.sources, arguments.out)
        run_fastddsgen(arguments.fastddsgen, arguments.sources, arguments.out)
    except IdlError as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
