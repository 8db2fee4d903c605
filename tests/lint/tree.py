# SPDX-License-Identifier: GPL-3.0-or-later
"""The files that a check looks at: those of the repository, or a few made-up ones that show what the check finds."""
import os
import subprocess
from pathlib import Path


class Tree:
    """Paths from the root (with /) and their text, read on demand. Not thread-safe."""

    def __init__(self, root):
        self.root = Path(root)
        self.paths = sorted(_listed_by_git(self.root) or _walked(self.root))

    def text(self, path):
        """Returns the text of a file. Bytes that are not UTF-8 are replaced, so binary files do no harm."""
        return (self.root / path).read_text(encoding="utf-8", errors="replace")

    def exists(self, path):
        """Returns whether there is a file or a folder with this path."""
        return (self.root / path).exists()

    def with_suffix(self, *suffixes):
        return [p for p in self.paths if p.endswith(suffixes)]


class MadeUpTree(Tree):
    """A tree of files that exist only in memory: {path: text}."""

    def __init__(self, files):
        self.files = files
        self.paths = sorted(files)

    def text(self, path):
        return self.files[path]

    def exists(self, path):
        return any(p == path or p.startswith(path.rstrip("/") + "/") for p in self.files)


def made(text, name):
    """Returns the text of a template as `orcactl new KIND NAME` makes it, of an Orca that was built in ~/orca."""
    own = "".join(part[:1].upper() + part[1:] for part in name.split("_"))
    for mark, value in (("@NAME@", name), ("@CLASS@", own), ("@TYPE@", f"my.{own}"), ("@ORCA@", "~/orca/build/release/share/orca"),
                        ("@BIN@", "~/orca/build/release/bin")):
        text = text.replace(mark, value)
    return text


def _listed_by_git(root):
    """Returns tracked files and new ones that are not ignored; empty outside a git work tree (a source archive)."""
    command = ["git", "-C", str(root), "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    try:
        listing = subprocess.run(command, capture_output=True, check=True).stdout.decode()
    except (OSError, subprocess.CalledProcessError):
        return []
    return [p for p in set(listing.split("\0")) if p and (root / p).is_file()]


def _walked(root):
    paths = []
    for folder, subfolders, names in os.walk(root):
        subfolders[:] = [s for s in subfolders if s not in ("build", ".git", "__pycache__")]
        paths += [(Path(folder) / n).relative_to(root).as_posix() for n in names]
    return paths
