#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Makes one book of README.md, docs/ and the pages of components, with the reference beside it. `./dev docs` calls it.

    docs/book/build.py BUILD OUT

BUILD is a build folder with the programs and plugins, whose ports, parameters and options are printed. The book goes to OUT, which is
made anew, and what it is made of to OUT-source. Exit status 1 if anything is warned of or a link leads nowhere.
"""
import fnmatch
import logging
import pathlib
import re
import shutil
import subprocess
import sys

import mkdocs.commands.build
import mkdocs.config
import mkdocs.exceptions
import yaml

import reference
import site_links
import staging

HERE = pathlib.Path(__file__).resolve().parent
TREE = HERE.parents[1]
HEADER = re.compile(r'"([^"\s]+\.hpp)"')


def slug(heading, _separator):
    """Returns the anchor of a heading as GitHub makes it, so that links of pages hold in both places."""
    return re.sub(r"[^\w\- ]", "", heading.lower()).strip().replace(" ", "-")


def public_headers(build):
    """Returns the headers that `cmake --install` puts into the package orca-dev, without the generated ones."""
    listed = (build / "OrcaTargets.cmake").read_text()
    return sorted({path for path in HEADER.findall(listed) if pathlib.Path(path).is_relative_to(TREE / "src")})


def make_api(headers, out):
    """Writes the reference of headers. Returns whether nothing was warned of."""
    out.mkdir(parents=True)
    settings = [(HERE / "Doxyfile").read_text(), f'OUTPUT_DIRECTORY = "{out}"', f'STRIP_FROM_PATH = "{TREE}"',
                f'USE_MDFILE_AS_MAINPAGE = "{HERE}/api.md"',
                *(f'INPUT += "{path}"' for path in [HERE / "api.md", *headers])]
    run = subprocess.run(["doxygen", "-"], input="\n".join(settings), text=True, capture_output=True)
    sys.stderr.write(run.stderr)
    return run.returncode == 0


def inside_of(entry):
    """Returns a part, page or pattern of nav without its title."""
    return next(iter(entry.values())) if isinstance(entry, dict) else entry


def leaves(entries):
    """Yields the pages and patterns that entries of nav name."""
    for entry in entries:
        inside = inside_of(entry)
        yield from leaves(inside) if isinstance(inside, list) else [inside]


def whole_nav(nav, pages):
    """Returns nav with pages instead of patterns. A pattern stands for those that no other entry names and no pattern before it took."""
    named = set(leaves(nav))
    left = [page for page in pages if page not in named]

    def taken(pattern):
        found = fnmatch.filter(left, pattern)
        left[:] = [page for page in left if page not in found]
        return found

    def expanded(entries):
        made = []
        for entry in entries:
            inside = inside_of(entry)
            if isinstance(inside, str) and "*" not in inside:
                made.append(entry)
                continue
            found = expanded(inside) if isinstance(inside, list) else taken(inside)
            if found:
                made += [{next(iter(entry)): found}] if isinstance(entry, dict) else found
        return made

    return expanded(nav)


def make_book(source, out):
    """Runs mkdocs. Returns whether nothing was warned of."""
    logging.basicConfig(format="%(levelname)s: %(message)s", level=logging.WARNING)
    settings = yaml.safe_load((HERE / "mkdocs.yml").read_text())
    found = sorted(source.rglob("*.md"), key=lambda page: (page.parent, page.name != "index.md", page.name))
    pages = [page.relative_to(source).as_posix() for page in found]
    config = mkdocs.config.load_config(config_file=str(HERE / "mkdocs.yml"), docs_dir=str(source), site_dir=str(out),
                                       nav=whole_nav(settings["nav"], pages))
    config["mdx_configs"].setdefault("toc", {})["slugify"] = slug
    try:
        mkdocs.commands.build.build(config)
    except mkdocs.exceptions.Abort as reason:
        print(reason, file=sys.stderr)
        return False
    return True


def main(build, out):
    source = out.with_name(out.name + "-source")
    for folder in (source, out):
        shutil.rmtree(folder, ignore_errors=True)
    staging.stage(TREE, source)
    reference.write_pages(TREE, build, source)
    good = make_api(public_headers(build), source / "api")
    good = make_book(source, out) and good
    faults = site_links.faults(out)
    print("\n".join(faults), file=sys.stderr)
    return 0 if good and not faults else 1


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(*(pathlib.Path(argument).resolve() for argument in sys.argv[1:])))
