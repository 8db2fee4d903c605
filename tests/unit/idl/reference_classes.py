#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the classes that fastddsgen makes of Orca's IDL files, in namespace reference, and lists which is which.

reference_classes.py FASTDDSGEN TOOLS OUT FILE.idl...    writes FILE.h, FILE.cxx, FILEPubSubTypes.h and .cxx, and reference.hpp, into OUT
"""

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path


def main() -> int:
    program, tools, out = sys.argv[1], sys.argv[2], Path(sys.argv[3])
    sources = [Path(name) for name in sys.argv[4:]]
    sys.path.insert(0, tools)
    from idl_parser import load_files  # of the tools that are tested

    out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=out) as scratch:
        for source in sources:
            text = source.read_text().replace("module orca {", "module reference {")
            (Path(scratch) / source.name).write_text(text)
        # Without -t, runs at the same time share their preprocessed files if these have one name.
        own = Path(scratch) / "preprocessed"
        own.mkdir()
        command = [program, "-replace", "-cs", "-t", str(own), "-d", scratch, *(s.name for s in sources)]
        subprocess.run(command, cwd=scratch, check=True, stdout=subprocess.DEVNULL)
        for source in sources:
            for ending in (".h", ".cxx", "PubSubTypes.h", "PubSubTypes.cxx"):
                made = Path(scratch) / (source.stem + ending)
                made.write_text(re.sub(r'#include "(\w+\.h)"', r'#include "reference/\1"', made.read_text()))
                shutil.copy(made, out / made.name)
    lines = ["// SPDX-License-Identifier: LGPL-3.0-or-later", "// Written by reference_classes.py.", "#pragma once", ""]
    lines += [f'#include "reference/{source.stem}.h"' for source in sources]
    lines += ["", "namespace orca::test {", "", "template <class T>", "struct ReferenceOf;", ""]
    for file in load_files(sources):
        lines += [f"template <>\nstruct ReferenceOf<orca::idl::{s.word}> {{ using Type = ::reference::idl::{s.word}; }};" for s in file.structs]
    lines += ["", "}  // namespace orca::test", ""]
    (out / "reference.hpp").write_text("\n".join(lines))
    return 0


if __name__ == "__main__":
    sys.exit(main())
