# SPDX-License-Identifier: GPL-3.0-or-later
"""Code in README.md and docs/ is code that tests run: a comment above each fenced block says where it comes from.

    <!-- region FILE NAME -->     the block equals the lines of FILE between the comments [NAME] and [/NAME]
    <!-- made of FILE -->         the block equals the template FILE as `orcactl new` makes it, by a command of the page
    <!-- read by FILE -->         the test FILE reads the page, and with it the block
    <!-- not run: REASON -->      the block is no code of a test, and why
Indentation that all lines of a region share is left out. Blocks of other languages, or of none, need no comment.
"""
import re
import textwrap

from tree import made

LANGUAGES = ("cpp", "xml", "cmake")
BLOCK = re.compile(r"(?:^<!-- ([^\n]*) -->\n\n?)?^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
REGION = re.compile(r"region (\S+) (\w+)")
MADE_OF = re.compile(r"made of (\S+)")
NEW = re.compile(r"^orcactl new \w+ (\w+)$", re.MULTILINE)
READ_BY = re.compile(r"read by (\S+)")
NOT_RUN = re.compile(r"not run: \S.*")


def region(text, name):
    """The lines between the two marks, without common indentation; None unless each mark is there once."""
    mark = r"^[ \t]*(?://|#|<!--) \[%s\](?: -->)?\n"
    pattern = mark % re.escape(name) + "(.*?)" + mark % re.escape("/" + name)
    found = re.findall(pattern, text, re.MULTILINE | re.DOTALL)
    return textwrap.dedent(found[0]) if len(found) == 1 else None


def _fault_of_region(tree, file, name, code):
    if not tree.exists(file):
        return f"there is no {file}"
    expected = region(tree.text(file), name)
    if expected is None:
        return f"{file} has no region [{name}] ... [/{name}], or several"
    return None if code == expected else f"the block differs from the region [{name}] of {file}; copy the region"


def _fault_of_reader(tree, file, page):
    if not tree.exists(file):
        return f"there is no {file}"
    return None if page in tree.text(file) else f"{file} does not name {page}, so it does not read it"


def _fault_of_template(tree, file, page, code):
    new = NEW.search(tree.text(page))
    if not tree.exists(file) or not new:
        return f"there is no {file}, or no line \"orcactl new KIND NAME\" in the page"
    return None if code == made(tree.text(file), new[1]) else f"the block differs from what orcactl new makes of {file}; copy that"


def fault(tree, page, comment, language, code):
    """What is wrong with one block, or None."""
    if match := REGION.fullmatch(comment):
        return _fault_of_region(tree, match[1], match[2], code)
    if match := MADE_OF.fullmatch(comment):
        return _fault_of_template(tree, match[1], page, code)
    if match := READ_BY.fullmatch(comment):
        return _fault_of_reader(tree, match[1], page)
    if language not in LANGUAGES or NOT_RUN.fullmatch(comment):
        return None
    return (f"a block of {language} without its source; write <!-- region FILE NAME -->, <!-- made of FILE -->, <!-- read by FILE --> or "
            "<!-- not run: REASON --> above it")


def find(tree):
    pages = [p for p in tree.with_suffix(".md") if re.fullmatch(r"README\.md|docs/[^/]+", p)]
    findings = []
    for page in pages:
        text = tree.text(page)
        for match in BLOCK.finditer(text):
            wrong = fault(tree, page, match[1] or "", match[2], match[3])
            if wrong:
                findings.append(f"{page}:{text.count(chr(10), 0, match.start()) + 1}: {wrong}")
    return findings


def _page(comment, language, code):
    return f"# Page\n\n{comment}\n```{language}\n{code}```\n"


_NEW = "orcactl new driver a_b\n"
SOURCE = "int a;\n  // [one]\n  int b;\n    int c;\n  // [/one]\n"
BAD = [
    ({"README.md": _page("", "cpp", "int b;\n")}, "README.md:4: a block of cpp without its source"),
    ({"docs/a.md": _page("<!-- other words -->", "xml", "<a/>\n")}, "docs/a.md:3: a block of xml"),
    ({"README.md": _page("<!-- not run: -->", "cmake", "a()\n")}, "a block of cmake"),
    ({"README.md": _page("<!-- region a.cpp one -->", "cpp", "int b;\n"), "a.cpp": SOURCE}, "differs from the region [one]"),
    ({"README.md": _page("<!-- region a.cpp two -->", "cpp", "int b;\n"), "a.cpp": SOURCE}, "has no region [two]"),
    ({"README.md": _page("<!-- region a.cpp one -->", "cpp", "int b;\n"), "a.cpp": SOURCE + SOURCE}, "or several"),
    ({"README.md": _page("<!-- region b.cpp one -->", "cpp", "int b;\n")}, "there is no b.cpp"),
    ({"docs/a.md": _page("<!-- read by b.cpp -->", "xml", "<a/>\n"), "b.cpp": "\n"}, "b.cpp does not name docs/a.md"),
    ({"docs/a.md": _NEW + _page("<!-- made of t/x -->", "cpp", "AB b_a;\n"), "t/x": "@CLASS@ @NAME@;\n"}, "differs from what orcactl new makes"),
    ({"docs/a.md": _page("<!-- made of t/x -->", "cpp", "AB a_b;\n"), "t/x": "@CLASS@ @NAME@;\n"}, "no line \"orcactl new"),
    ({"docs/a.md": _page("<!-- read by b.cpp -->", "xml", "<a/>\n")}, "there is no b.cpp"),
]
GOOD = [
    {"README.md": _page("<!-- region a.cpp one -->", "cpp", "int b;\n  int c;\n"), "a.cpp": SOURCE},
    {"docs/a.md": _page("<!-- region a.xml g -->\n", "xml", "<a/>\n"), "a.xml": "<!-- [g] -->\n<a/>\n<!-- [/g] -->\n"},
    {"docs/a.md": _page("<!-- region C.txt c -->", "cmake", "a()\n"), "C.txt": "# [c]\na()\n# [/c]\n"},
    {"docs/a.md": _page("<!-- read by b.cpp -->", "xml", "<a/>\n"), "b.cpp": 'open("docs/a.md")\n'},
    {"docs/a.md": _NEW + _page("<!-- made of t/x -->", "cpp", "AB a_b;\n"), "t/x": "@CLASS@ @NAME@;\n"},
    {"docs/a.md": _page("<!-- not run: it shows a fault -->", "cpp", "int int;\n")},
    {"docs/a.md": _page("", "", "./dev test\n"), "docs/adr/0001-a.md": _page("", "cpp", "int b;\n")},
]
