# SPDX-License-Identifier: LGPL-3.0-or-later
"""The pages of the book that are made from programs, plugins and IDL files: types with ports and parameters, objects, options."""
import html
import json
import pathlib
import re
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "idl/tools"))
import idl_parser  # noqa: E402

PROGRAMS = ("deployer", "orcactl", "orcaview", "simbatch", "hwprobe")


def cell(text):
    """Returns a text as it stands in a cell of a table: what looks like a tag is none, except in code, where Markdown sees to that."""
    parts = re.split(r"(`[^`]*`)", str(text).replace("|", "\\|").replace("\n", " "))
    return "".join(part if part.startswith("`") else html.escape(part, quote=False) for part in parts)


def table(head, rows):
    """Returns a table; nothing without rows."""
    lines = [head, ["---"] * len(head), *rows] if rows else []
    return "".join("| " + " | ".join(line) + " |\n" for line in lines) + ("\n" if rows else "")


# ------------------------------------------------------------------------------------------------------------ types


def object_link(contract):
    return f"[{contract['name']}](objects.md#{contract['name'].lower()})"


def port_row(port):
    carries = object_link(port["type"]) + (f" → {object_link(port['reply'])}" if "reply" in port else "")
    needed = "required" if port["required"] else ""
    return [f"`{port['name']}{'[]' if port['many'] else ''}`", f"{port['pattern']} {port['role']}", carries, needed, cell(port["text"])]


def default_of(param):
    value = param["default"]
    if isinstance(value, list):
        value = "; ".join(map(str, value))
    return f"`{value} {param['unit']}`".replace(" `", "`") if value != "" else ""


def param_row(param):
    limits = [f"from {param['min']:g}" if "min" in param else "", f"to {param['max']:g}" if "max" in param else "",
              "one of " + ", ".join(param["choices"]) if "choices" in param else "", "fixed" if param["fixed"] else ""]
    return [f"`{param['name']}`", default_of(param), cell(", ".join(filter(None, limits))), cell(param["text"])]


def type_section(contract, listed, tree):
    """Returns the section of a type that is listed so: {type, kind, file, text}."""
    folder = pathlib.Path(listed["file"]).stem
    has_page = (tree / f"src/components/{folder}/README.md").exists()
    more = f" [More](../components/{folder}.md)." if has_page else ""
    return (f"## {contract['type']}\n\n{cell(listed['text'])}{more}\n\n"
            + table(["port", "kind", "object", "needed", "what it is for"], [port_row(p) for p in contract["ports"]])
            + table(["parameter", "default", "range", "what it is for"], [param_row(p) for p in contract["parameters"]]))


def asked(program, *words):
    run = subprocess.run([program, *words], capture_output=True, text=True)
    if run.returncode != 0:
        raise RuntimeError(f"{program} {' '.join(words)}: {run.stderr}")
    return run.stdout


def types_page(tree, build, kind, title):
    """Returns the page of all components or all drivers, as their plugins describe them."""
    deployer = build / "bin/deployer"
    listed = {t["type"]: t for t in json.loads(asked(deployer, "--types", "--json")) if t["kind"] == kind}
    described = [json.loads(asked(deployer, "--describe", name, "--json"))["types"] for name in sorted(listed)]
    sections = [type_section(contract, listed[contract["type"]], tree) for types in described for contract in types]
    return f"# {title}\n\nAs `deployer --describe TYPE` prints them. Numbers are in SI units.\n\n" + "".join(sections)


# ---------------------------------------------------------------------------------------------------------- objects


def field_type(field, linked):
    name = getattr(field.type, "idl", None) or field.type.name
    name = f"[{name}](#{name.lower()})" if name in linked else name
    return f"list of {name}" if field.sequence else f"{name}[{field.array}]" if field.array else name


def struct_section(struct, linked):
    base = f" Has all fields of [{struct.base.name}](#{struct.base.name.lower()})." if struct.base else ""
    rows = [[f"`{f.name}`", field_type(f, linked), cell(f.unit), cell(f.text)] for f in struct.fields]
    return f"## {struct.name}\n\n{cell(struct.text)}{base}\n\n" + table(["field", "type", "unit", "meaning"], rows)


def objects_page(tree):
    """Returns the page of all types of idl/orca with their fields."""
    files = idl_parser.load_files(sorted((tree / "idl/orca").glob("*.idl")))
    structs = sorted((s for file in files for s in file.structs), key=lambda s: s.name)
    enums = sorted((e for file in files for e in file.enums), key=lambda e: e.name)
    linked = {t.name for t in [*structs, *enums]}
    return ("# Objects and their fields\n\nAs `idl/orca/*.idl` declares them. [Their text form](../objects.md) is what graphs, "
            "recordings and `orcactl` show.\n\n" + "".join(struct_section(s, linked) for s in structs)
            + "".join(f"## {e.name}\n\n{cell(e.text)} One of: {', '.join(f'`{n}`' for n in e.enumerators)}.\n\n" for e in enums))


# --------------------------------------------------------------------------------------------------------- programs


def commands_of(help_text):
    """Returns the commands that the help of a program lists under "Commands"."""
    part = re.search(r"^Commands:?\n(.*?)(?:^\S|\Z)", help_text, re.MULTILINE | re.DOTALL)
    return list(dict.fromkeys(re.findall(r"^  ([a-z]+)\b", part[1], re.MULTILINE))) if part else []


def programs_page(build):
    """Returns the page of the options of all programs."""
    made = "# Programs and their options\n\nAs `PROGRAM --help` prints them; `PROGRAM --man` is the same as a man page.\n\n"
    for name in PROGRAMS:
        text = asked(build / "bin" / name, "--help")
        made += f"## {name}\n\n```text\n{text}```\n\n"
        for command in commands_of(text):
            made += f"### {name} {command}\n\n```text\n{asked(build / 'bin' / name, command, '--help')}```\n\n"
    return made


INDEX = """# Reference

Made from the programs, plugins and headers of this very build.

* [Components](components.md) and [drivers](drivers.md): their ports and parameters.
* [Objects](objects.md): the fields of all that travels.
* [Programs](programs.md): commands and options.
* [C++](../api/index.html): classes and functions for components, drivers and programs.
"""


def write_pages(tree, build, out):
    """Writes the pages to out/reference."""
    folder = out / "reference"
    folder.mkdir(parents=True)
    (folder / "index.md").write_text(INDEX)
    (folder / "components.md").write_text(types_page(tree, build, "component", "Components: ports and parameters"))
    (folder / "drivers.md").write_text(types_page(tree, build, "hardware", "Drivers and other hardware: ports and parameters"))
    (folder / "objects.md").write_text(objects_page(tree))
    (folder / "programs.md").write_text(programs_page(build))
