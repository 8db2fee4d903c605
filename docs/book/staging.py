# SPDX-License-Identifier: LGPL-3.0-or-later
"""The pages of the tree as the book has them: each in its place, with links that lead to the places of the others."""
import pathlib
import posixpath
import re
import shutil
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tests/lint"))
import check_docs  # noqa: E402: which links there are, the test of links says

FILES = "files"  # the folder of the book with files that are no pages: sources, pictures
OUTSIDE = re.compile(r"[a-z][a-z0-9+.-]*:|#")
TOP = {"README.md": "readme.md", "CONTRIBUTING.md": "contributing.md", "CHANGELOG.md": "changelog.md", "LICENSE.md": "license.md"}
FOLDERS = ("docs/book",)  # of docs/, which are not pages


def place(path):
    """Returns where the book has a page: README.md, docs/..., a component's or a library's; none for other files."""
    if path in TOP:
        return TOP[path]
    if path == "docs/README.md":
        return "index.md"
    if path.startswith("docs/") and path.endswith(".md"):
        return path.removeprefix("docs/").replace("README.md", "index.md")
    component = re.fullmatch(r"src/components/(\w+)/README\.md", path)
    library = re.fullmatch(r"(?:src/)?(\w+)/README\.md", path)
    return f"components/{component[1]}.md" if component else f"libraries/{library[1]}.md" if library else None


def pages(tree):
    """Returns {path in the tree: place in the book}."""
    found = [*TOP, *(p.relative_to(tree).as_posix() for folder in ("docs", "src", "idl") for p in (tree / folder).rglob("*.md"))]
    return {path: place(path) for path in found if place(path) and not path.startswith(FOLDERS)}


def target_in_book(tree, known, page, target, needed):
    """Returns what a link leads to in the book, seen from the page's place; None: to no file. Adds what is to be copied to `needed`."""
    path, mark, anchor = target.partition("#")
    file = posixpath.normpath(posixpath.join(posixpath.dirname(page), path))
    if (tree / file).is_dir():
        if f"{file}/README.md" not in known:
            return None
        file += "/README.md"
    if file not in known:
        needed.add(file)
    there = known.get(file) or f"{FILES}/{file}"
    return posixpath.relpath(there, posixpath.dirname(known[page]) or ".") + mark + anchor


def rewritten(tree, known, page, needed):
    """Returns the text of a page with the links of its prose led to the places in the book."""
    text = (tree / page).read_text(encoding="utf-8")
    made, last = [], 0
    for match in check_docs.LINK.finditer(check_docs.prose(text)):
        target = match[1] or match[2]
        if OUTSIDE.match(target):
            continue
        there = target_in_book(tree, known, page, target, needed)
        begin, end = match.span(1 if match[1] else 2)
        if there is None:
            label = text[match.start() + 1:match.end()].split("](")[0]
            made += [text[last:match.start()], label]
        else:
            made += [text[last:begin], there, text[end:match.end()]]
        last = match.end()
    return "".join(made) + text[last:]


def stage(tree, out):
    """Writes the pages of the tree, and the files that they link, to a folder for mkdocs."""
    known = pages(tree)
    needed = set()
    for page, there in known.items():
        file = out / there
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(rewritten(tree, known, page, needed), encoding="utf-8")
    for path in sorted(needed):
        copy = out / FILES / path
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(tree / path, copy)
