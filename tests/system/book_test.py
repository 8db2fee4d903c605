#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""`./dev docs` builds the book without a warning, and what is wrong in pages and headers would be noticed.

    tests/system/book_test.py BUILD
"""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

TREE = pathlib.Path(__file__).resolve().parents[2]
SKIPPED = 77
BOOK = TREE / "build/docs"
ENTRANCES = ("start/student.html", "start/engineer.html", "start/researcher.html", "from-ros2.html")


def missing():
    """Returns why the book cannot be built here; nothing if it can."""
    lacking = [name for name in ("mkdocs", "doxygen") if not shutil.which(name)]
    if not pathlib.Path("/usr/share/mkdocs/themes/material").is_dir():
        lacking.append("mkdocs-material")
    if lacking:
        return f"{', '.join(lacking)} not installed; ./dev docs installs them"
    return None if BUILD == TREE / "build/release" else "./dev docs builds preset release, which this is not"


class Book(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        done = subprocess.run([TREE / "dev", "docs"], capture_output=True, text=True, stdin=subprocess.DEVNULL)
        cls.status, cls.said, cls.last = done.returncode, done.stderr, done.stdout.strip()

    def test_the_book_is_built_and_its_first_page_is_said(self):
        self.assertEqual(self.status, 0, self.said)
        self.assertEqual(self.last, str(BOOK / "index.html"))

    def test_the_first_page_leads_to_four_entrances_by_kind_of_user(self):
        page = (BOOK / "index.html").read_text()
        for entrance in ENTRANCES:
            self.assertIn(f'href="{entrance}"', page)
            self.assertTrue((BOOK / entrance).exists())

    def test_it_is_searched_and_has_each_type_object_and_command(self):
        found = {entry["location"] for entry in json.loads((BOOK / "search/search_index.json").read_text())["docs"]}
        for place in ("reference/components.html#orcagoto", "reference/drivers.html#orcahwp2os", "reference/objects.html#motioncommand",
                      "reference/programs.html#orcactl-estop", "components/goto.html"):
            self.assertIn(place, found)
        types = json.loads(subprocess.run([BUILD / "bin/deployer", "--types", "--json"], capture_output=True, check=True).stdout)
        for shipped in types:
            page = "components" if shipped["kind"] == "component" else "drivers"
            self.assertIn(f"reference/{page}.html#{shipped['type'].lower().replace('.', '')}", found)

    def test_the_names_on_the_first_page_of_the_reference_lead_to_classes_and_functions(self):
        page = (BOOK / "api/index.html").read_text()
        self.assertGreater(len(re.findall(r'<a class="el" href="[^"]*"[^>]*>orca::', page)), 20)
        self.assertEqual(re.findall(r"orca::[\w:]+", re.sub(r"<a [^>]*>.*?</a>", "", page)), [])


class Faults(unittest.TestCase):
    """What would make ./dev docs fail."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="orca_book_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def test_a_link_or_anchor_that_leads_nowhere_is_found_and_so_is_a_script_of_the_network(self):
        (self.folder / "b.html").write_text('<h1 id="here">B</h1>')
        (self.folder / "a.html").write_text('<a href="b.html#here">1</a><a href="c.html">2</a><a href="b.html#there">3</a>'
                                            '<a href="https://example.org">4</a><script src="https://example.org/a.js"></script>')
        faults = site_links.faults(self.folder)
        self.assertEqual(faults, ["a.html: link to c.html: there is no such file", "a.html: link to b.html#there: there is no such anchor",
                                  "a.html: loads https://example.org/a.js from the network"])

    def test_a_comment_about_a_parameter_that_is_not_there_is_an_error(self):
        header = self.folder / "a.hpp"
        header.write_text("/// @file\n\n/// Adds.\n/// @param c  one of them.\nint add(int a, int /*b*/);\n")
        self.assertFalse(build.make_api([header], self.folder / "wrong"))
        header.write_text("/// @file\n\n/// Adds.\n/// @param b  one of them.\nint add(int a, int /*b*/);\n")
        self.assertTrue(build.make_api([header], self.folder / "right"))

    def test_a_page_that_no_entry_names_is_in_the_book_once(self):
        nav = ["index.md", {"Some": ["a/*.md", "b.md"]}, {"None": "c/*.md"}, {"More": "*.md"}]
        self.assertEqual(build.whole_nav(nav, ["a/1.md", "a/2.md", "b.md", "d.md", "index.md"]),
                         ["index.md", {"Some": ["a/1.md", "a/2.md", "b.md"]}, {"More": ["d.md"]}])

    def test_links_are_led_to_the_places_of_the_book(self):
        for path, text in {"README.md": "[a](docs/PAGE.md#x) `[b](c)`\n", "CONTRIBUTING.md": "", "CHANGELOG.md": "", "LICENSE.md": "",
                           "docs/PAGE.md": "# X\n[up](../README.md) [s](../src/components/go/go.cpp) [c](../src/components/go/README.md) [d](../sim)\n",
                           "src/components/go/README.md": "", "src/components/go/go.cpp": "", "sim/a": ""}.items():
            (self.folder / path).parent.mkdir(parents=True, exist_ok=True)
            (self.folder / path).write_text(text)
        staging.stage(self.folder, self.folder / "out")
        self.assertEqual((self.folder / "out/readme.md").read_text(), "[a](PAGE.md#x) `[b](c)`\n")
        self.assertEqual((self.folder / "out/PAGE.md").read_text(),
                         "# X\n[up](readme.md) [s](files/src/components/go/go.cpp) [c](components/go.md) d\n")
        self.assertTrue((self.folder / "out/files/src/components/go/go.cpp").exists())


if __name__ == "__main__":
    BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
    if missing():
        print(f"SKIPPED: {missing()}")
        sys.exit(SKIPPED)
    sys.path.insert(0, str(TREE / "docs/book"))
    import build  # noqa: E402: it needs mkdocs
    import site_links  # noqa: E402
    import staging  # noqa: E402
    unittest.main()
