# SPDX-License-Identifier: GPL-3.0-or-later
"""Members marked ORCA_GUARDED_BY are used under their mutex only: clang proves it (-Wthread-safety).

It looks at the sources of classes with such a mark, those of one library together, with the include paths of a configured
build. It needs what that build generates, so it runs after it.
"""
import json
import os
import re
import shlex
import subprocess
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

CLANG = "clang++-14"
ROOT = Path(__file__).resolve().parents[2]
MARK = "ORCA_GUARDED_BY("
INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)
FINDING = re.compile(r"^(.*?):(\d+):\d+: (?:error|fatal error): (.*)$", re.MULTILINE)
HEADER = "src/base/include/orca/base/mutex.hpp"  # which defines the mark


def _database(root):
    for preset in ("release", "dev"):
        path = root / "build" / preset / "compile_commands.json"
        if path.exists():
            return path
    return None


def missing_tool():
    if subprocess.run(["which", CLANG], capture_output=True, check=False).returncode:
        return f"{CLANG} is not installed (apt-get install clang-14)"
    return None if _database(ROOT) else "there is no build yet; first: ./dev build"


def _flags(database):
    """Returns {source: flags} with the include paths and definitions of each source, also of those built as one unit."""
    flags = {}
    for entry in json.loads(database.read_text()):
        words = shlex.split(entry["command"])
        kept = [w for w in words if w.startswith(("-I", "-D"))]
        kept += ["-isystem" + after for word, after in zip(words, words[1:]) if word == "-isystem"]
        unit = Path(entry["file"])
        sources = INCLUDE.findall(unit.read_text()) if "Unity" in unit.parts and unit.exists() else [str(unit)]
        flags.update({source: tuple(kept) for source in sources})
    return flags


def _concerned(tree):
    """Returns the sources that have a mark, and for each header with one the source of its name, or one that includes it."""
    product = [p for p in tree.paths if p.startswith(("src/", "sim/", "idl/")) and p.endswith((".cpp", ".hpp"))]
    sources = [p for p in product if p.endswith(".cpp")]
    concerned = set()
    for marked in (p for p in product if MARK in tree.text(p) and p != HEADER):
        stem, name = Path(marked).stem, "/" + Path(marked).name
        users = [s for s in sources if any(("/" + i).endswith(name) for i in INCLUDE.findall(tree.text(s)))]
        own = [marked] if marked in sources else [s for s in users if Path(s).stem == stem] or users
        concerned.add(max(own, key=lambda s: len(os.path.commonprefix([s, marked])), default=marked))
    return sorted(concerned)


def _check(sources, flags, folder):
    unit = Path(tempfile.mkstemp(suffix=".cpp", dir=folder)[1])
    unit.write_text("".join(f'#include "{s}"\n' for s in sources))
    command = [CLANG, "-std=c++20", "-fsyntax-only", "-ferror-limit=0", "-Wno-everything", "-Wthread-safety",
               "-Werror=thread-safety", *flags, str(unit)]
    return subprocess.run(command, capture_output=True, text=True, check=False, cwd=ROOT).stderr


def _units(tree, folder):
    """Returns {name of a library: (sources, flags)}; made-up sources are written into the folder."""
    flags = {} if hasattr(tree, "files") else _flags(_database(tree.root))
    units = {}
    for path in _concerned(tree):
        if hasattr(tree, "files"):
            source = str(Path(folder) / path.replace("/", "_"))
            Path(source).write_text(tree.text(path))
            flags[source] = (f"-I{ROOT}/src/base/include",)
        else:
            source = str(tree.root.resolve() / path)
        if source in flags:  # else it belongs to an option that is off
            sources, words = units.setdefault(path.split("/")[1:2 + path.startswith("src/runtime")][-1], ([], {}))
            sources.append(source)
            words.update(dict.fromkeys(flags[source]))
    return units


def find(tree):
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(os.cpu_count()) as pool:
        texts = list(pool.map(lambda unit: _check(*unit, folder), _units(tree, folder).values()))
        root = folder if hasattr(tree, "files") else tree.root.resolve()
        found = [f"{os.path.relpath(m[1], root)}:{m[2]}: {m[3]}" for text in texts for m in FINDING.finditer(text)]
    return list(dict.fromkeys(found))


def _example(body):
    return {"src/a.cpp": '#include "orca/base/mutex.hpp"\nclass A {\n  orca::Mutex mutex_;\n'
                         "  int count_ ORCA_GUARDED_BY(mutex_) = 0;\n public:\n" + body + "\n};\n"}


BAD = [
    (_example("  int count() { return count_; }"), "src_a.cpp:6: reading variable 'count_' requires holding mutex 'mutex_'"),
    (_example("  void add() { orca::MutexLock lock(mutex_); lock.unlock(); ++count_; }"), "writing variable 'count_'"),
    (_example("  void add() ORCA_REQUIRES(mutex_) { ++count_; }\n  void both() { add(); }"), "calling function 'add'"),
    (_example("  void take() { mutex_.lock(); }"), "still held at the end of function"),
]
GOOD = [
    _example("  int count() { const orca::MutexLock lock(mutex_); return count_; }"),
    _example("  int count() {\n    if (!mutex_.try_lock()) return 0;\n"
             "    const orca::MutexLock lock(mutex_, std::adopt_lock);\n    return count_;\n  }"),
    _example("  int count() { orca::MutexLock lock(mutex_); lock.unlock(); lock.lock(); return count_; }"),
]
