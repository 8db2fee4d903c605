# SPDX-License-Identifier: GPL-3.0-or-later
"""The lists of objects, components, drivers and helpers in docs/ are those of the sources.

    python3 -B tests/lint/check_lists.py --write .     writes them anew
"""
import re
import sys

from tree import Tree

STRUCT = re.compile(r"((?:^///[^\n]*\n)+)struct (\w+)(?: : (\w+))? \{", re.MULTILINE)
TYPE = re.compile(r"^ORCA_(COMPONENT|HARDWARE)\((\w+), \"([\w.]+)\"\)", re.MULTILINE)
FIRST_COMMENT = re.compile(r"((?:^ *///[^\n]*\n)+) *(?:template|class|struct|enum|using|inline|constexpr|\[\[|namespace|\w)", re.MULTILINE)
LIST = re.compile(r"(<!-- list of (\w+); made by tests/lint/check_lists.py -->\n).*?(<!-- end of list -->)", re.DOTALL)
PAGES = {"docs/all-objects.md": ["objects"], "docs/components.md": ["components", "drivers"], "docs/helpers.md": ["helpers"]}
HELPERS = ("src/component_api/include/", "src/patterns/include/orca/patterns/", "src/geometry/", "src/navigation/include/",
           "src/testing/include/", "src/text/include/", "src/hw/framing/include/", "src/hw/driver/include/", "src/hw/api/include/",
           "src/base/include/orca/base/portable_math.hpp", "src/base/include/orca/base/result.hpp",
           "src/base/include/orca/base/random.hpp", "src/base/include/orca/base/time.hpp")


def sentence(comment):
    """Returns the first sentence of a comment, without the mark of each line."""
    text = " ".join(" ".join(line.strip().lstrip("/") for line in comment.strip().splitlines()).split())
    return re.split(r"[.:](?= [A-Z@]|$)| @", text)[0].strip().replace("|", "\\|") + "."


def structs(tree):
    """Returns {name: (base, comment, path)} of all IDL files."""
    return {m[2]: (m[3], m[1], path) for path in tree.with_suffix(".idl") for m in STRUCT.finditer(tree.text(path))}


def objects(tree):
    known = structs(tree)

    def travels(name):
        base, comment, _ = known[name]
        return "@travels" in comment or (base is not None and (base == "OrcaObject" or (base in known and travels(base))))

    rows = [(path, name, sentence(comment), base) for name, (base, comment, path) in known.items() if travels(name)]
    for path, name, text, base in sorted(rows):
        article = "An" if (base or "")[:1] in ("A", "E", "I", "O") else "A"
        kind = f" {article} {base}." if base not in (None, "OrcaObject") else ""
        yield f"| `{name}` | {text}{kind} | [{path.rsplit('/', 1)[1]}](../{path}) |"


def types(tree, kind):
    for path in tree.with_suffix(".cpp"):
        if not path.startswith(("src/", "sim/")):
            continue
        text = tree.text(path)
        for match in TYPE.finditer(text):
            comment = re.search(r"((?:^///[^\n]*\n)+)class " + match[2] + r"\b", text, re.MULTILINE)
            if match[1] == kind:
                yield match[3], sentence(comment[1]) if comment else "", path


def components(tree):
    for name, text, path in sorted(types(tree, "COMPONENT")):
        folder = path.rsplit("/", 1)[0]
        where = f"{folder}/README.md" if tree.exists(f"{folder}/README.md") else path
        yield f"| [`{name}`](../{where}) | {text} |"


def drivers(tree):
    for name, text, path in sorted(types(tree, "HARDWARE")):
        yield f"| [`{name}`](../{path}) | {text} |"


def helpers(tree):
    for path in tree.with_suffix(".hpp"):
        if path.startswith(HELPERS) and "/include/" in path and "/endpoints/" not in path:
            comment = FIRST_COMMENT.search(tree.text(path))
            if comment:
                yield f"| [`{path.split('/include/')[1]}`](../{path}) | {sentence(comment[1])} |"


HEADS = {"objects": "| object | what it is | declared in |\n|---|---|---|", "components": "| type | what it is |\n|---|---|",
         "drivers": "| type | what it is |\n|---|---|", "helpers": "| header | it begins with |\n|---|---|"}
ROWS = {"objects": objects, "components": components, "drivers": drivers, "helpers": helpers}


def made_anew(tree, page):
    """Returns the text of a page with its lists made from the sources."""
    return LIST.sub(lambda m: m[1] + HEADS[m[2]] + "\n" + "".join(row + "\n" for row in ROWS[m[2]](tree)) + m[3], tree.text(page))


def find(tree):
    findings = []
    for page, names in PAGES.items():
        if not tree.exists(page):
            continue
        text = tree.text(page)
        there = [m[2] for m in LIST.finditer(text)]
        findings += [f"{page}:1: the list of {name} is missing" for name in names if name not in there]
        if made_anew(tree, page) != text:
            findings.append(f"{page}:1: a list is not that of the sources; write it with "
                            "\"python3 -B tests/lint/check_lists.py --write .\"")
    return findings


_IDL = "module orca {\n/// A question. More of it.\nstruct Ask : OrcaObject {\n};\n/// A part.\nstruct Part {\n};\n/// A place.\n/// @travels\nstruct Place {\n};\n"
_PAGE = ("<!-- list of objects; made by tests/lint/check_lists.py -->\n| object | what it is | declared in |\n|---|---|---|\n"
         "| `Ask` | A question. | [a.idl](../idl/a.idl) |\n%s<!-- end of list -->\n")
_PLACE = "| `Place` | A place. | [a.idl](../idl/a.idl) |\n"
BAD = [({"idl/a.idl": _IDL, "docs/all-objects.md": _PAGE % ""}, "not that of the sources"),
       ({"idl/a.idl": _IDL, "docs/all-objects.md": "no list"}, "the list of objects is missing"),
       ({"src/a/a.cpp": "/// A cook.\nclass A {};\nORCA_COMPONENT(A, \"my.A\")\n",
         "docs/components.md": "<!-- list of components; made by tests/lint/check_lists.py -->\n<!-- end of list -->"}, "not that of the sources")]
GOOD = [{"idl/a.idl": _IDL, "docs/all-objects.md": _PAGE % _PLACE}]

if __name__ == "__main__":
    if len(sys.argv) != 3 or sys.argv[1] != "--write":
        sys.exit(__doc__)
    whole = Tree(sys.argv[2])
    for page_of_lists in PAGES:
        text_now = made_anew(whole, page_of_lists)
        (whole.root / page_of_lists).write_text(text_now, encoding="utf-8")
