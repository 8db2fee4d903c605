# SPDX-License-Identifier: GPL-3.0-or-later
"""The targets of documents exist: links and their anchors, graphs that pages name, pages that sources name. Pages are short."""
import posixpath
import re

LINK = re.compile(r"(?<!!)\[[^\]\n]*(?:\n[^\]\n]+)?\]\(<?([^)>\s]+)>?\)|!\[[^\]\n]*\]\(<?([^)>\s]+)>?\)")
HEADING = re.compile(r"^#{1,6}\s+(.*?)\s*#*$", re.MULTILINE)
FENCE = re.compile(r"^(```|~~~).*?^\1", re.MULTILINE | re.DOTALL)
CODE = re.compile(r"`[^`\n]*`")
GRAPH = re.compile(r"(?<!/)\bgraphs/[\w./-]+?\.xml\b")
PAGE = re.compile(r"\bdocs/[\w./-]+?\.md\b")
MOST_LINES, MOST_LINES_OF_VERSION = 150, 30
LONGER = {"docs/acceptance.md": "a table of claims, for looking up one", "docs/adr/README.md": "a list of pages",
          "docs/states.md": "made from the tables of the runtime"}
SOURCES = (".cpp", ".hpp", ".idl", ".py", ".cmake", "CMakeLists.txt", ".xml", ".urdf", ".md")


def _blanked(match):
    return re.sub(r"[^\n]", " ", match[0])


def prose(text):
    """Returns the text with code blanked out; lines keep their numbers."""
    return CODE.sub(_blanked, FENCE.sub(_blanked, text))


def anchors(text):
    """Returns the anchors of a page's headings: lower case, no punctuation, hyphens for blanks."""
    heads = HEADING.findall(FENCE.sub(_blanked, text))
    plain = (re.sub(r"[`*]|\[([^\]]*)\]\([^)]*\)", lambda m: m[1] or "", h) for h in heads)
    return {re.sub(r"[^\w\- ]", "", h.lower()).strip().replace(" ", "-") for h in plain}


def _line(text, match):
    return text.count("\n", 0, match.start()) + 1


def fault_of_link(tree, page, target):
    if re.match(r"[a-z][a-z0-9+.-]*:", target):
        return None
    path, _, anchor = target.partition("#")
    file = posixpath.normpath(posixpath.join(posixpath.dirname(page), path)) if path else page
    if file.startswith("..") or not tree.exists(file):
        return f'link to "{target}": there is no {file}'
    if anchor and file.endswith(".md") and anchor not in anchors(tree.text(file)):
        near = ", ".join(sorted(anchors(tree.text(file))))
        return f'link to "{target}": {file} has no heading "{anchor}"; it has: {near}'
    return None


def _links(tree):
    for page in tree.with_suffix(".md"):
        text = prose(tree.text(page))
        for match in LINK.finditer(text):
            wrong = fault_of_link(tree, page, match[1] or match[2])
            if wrong:
                yield f"{page}:{_line(text, match)}: {wrong}"


def _named(tree, paths, pattern, kind):
    for path in paths:
        text = tree.text(path)
        for match in pattern.finditer(text):
            if not tree.exists(match[0]):
                yield f"{path}:{_line(text, match)}: names the {kind} {match[0]}, which does not exist"


def _long(tree):
    for page in tree.with_suffix(".md"):
        lines = tree.text(page).count("\n")
        if page.startswith("docs/") and lines > MOST_LINES and page not in LONGER:
            yield f"{page}:1: {lines} lines, more than {MOST_LINES}; split it by what a reader asks"


def _long_versions(tree):
    if tree.exists("CHANGELOG.md"):
        for section in re.split(r"^## ", tree.text("CHANGELOG.md"), flags=re.MULTILINE)[1:]:
            if section.rstrip("\n").count("\n") > MOST_LINES_OF_VERSION:
                yield f"CHANGELOG.md:1: the version {section.splitlines()[0]} has more than {MOST_LINES_OF_VERSION} lines; tell less"


def find(tree):
    """Finds pages that are too long, and missing targets, except names in capitals (docs/adr/NNNN-title.md, graphs/NAME.xml) and the reader's own (graphs/mine.xml)."""
    sources = [p for p in tree.with_suffix(*SOURCES) if not p.startswith(("tests/lint/", "tests/data/"))]
    graph = re.compile(GRAPH.pattern.replace("graphs/", "graphs/(?!(?:tasks/)?[A-Z]{3}|(?:my|mine)[.])"))
    page = re.compile(PAGE.pattern.replace("docs/", "docs/(?!(?:adr/)?[A-Z]{3})"))
    shown = [p for p in tree.with_suffix(".md") if not p.startswith(("templates/", "tests/"))]
    findings = [*_long(tree), *_long_versions(tree), *_links(tree), *_named(tree, shown, graph, "graph"), *_named(tree, sources, page, "page")]
    return list(dict.fromkeys(findings))


BAD = [
    ({"docs/a.md": "[a link of\ntwo lines](#none)\n"}, 'has no heading "none"'),
    ({"CHANGELOG.md": "# Changes\n## 2\n" + "* a\n" * 31 + "## 1\n"}, "the version 2 has more than 30 lines"),
    ({"docs/a.md": "a\n" * 151}, "docs/a.md:1: 151 lines"),
    ({"README.md": "see [a](docs/none.md)\n"}, "README.md:1: link"),
    ({"README.md": "\n[a](docs/a.md#two)\n", "docs/a.md": "# One\n"}, 'has no heading "two"; it has: one'),
    ({"docs/a.md": "![picture](../none.png)\n"}, "there is no none.png"),
    ({"docs/a.md": "[out](../../a.md)\n", "a.md": ""}, "there is no ../a.md"),
    ({"README.md": "```\n./dev run graphs/none.xml\n```\n"}, "README.md:2: names the graph graphs/none.xml"),
    ({"src/components/a/README.md": "`deployer graphs/none.xml`\n"}, "README.md:1: names the graph graphs/none.xml"),
    ({"src/a.cpp": "/// @source docs/none.md, eq. 3\n"}, "src/a.cpp:1: names the page docs/none.md"),
]
GOOD = [
    {"CHANGELOG.md": "# Changes\n## 2\n" + "* a\n" * 30 + "\n## 1\n" + "* a\n" * 30},
    {"docs/a.md": "a\n" * 150, "docs/acceptance.md": "a\n" * 151},
    {"README.md": "[a](docs/a.md#one-and-two) `[b](c)` [d](https://example.org) [e](#here)\n# Here\n",
     "docs/a.md": "# One, and `two`\n[up](../README.md)\n"},
    {"README.md": "./dev run graphs/NAME.xml; graphs/a.xml; graphs/mine.xml\n", "graphs/a.xml": "<graph/>"},
    {"docs/adr/0004-x.md": "# x\n", "cmake/a.cmake": "# see docs/adr/0004-x.md and docs/adr/NNNN-title.md\n"},
    {"README.md": "```\n[no](link.md)\n```\n"},
    {"README.md": "see tests/data/graphs/a.xml\n", "tests/data/graphs/a.xml": "<graph/>"},
]
