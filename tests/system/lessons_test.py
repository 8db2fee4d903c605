#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Does what a page of docs/lessons says, in an empty folder, and compares all that the page shows.

    tests/system/lessons_test.py BUILD PAGE.md...    these pages; BUILD stands for the folder build/release of the pages
    tests/system/lessons_test.py                     the form of all pages, the way to them, and that this test finds what is wrong
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from lesson import TREE, Learner, Wrong, blocks_of, form_of, is_so, lines_of_code

LESSONS = TREE / "docs/lessons"
LINK = re.compile(r"\]\(([^)#\s]+)")
ROW = re.compile(r"^\| (\d\d) \| \[[^\]]+\]\((?P<page>[\w.-]+)\) \|.*\| (?P<code>\d+) \|$", re.MULTILINE)


def follow(text, build="nowhere"):
    """Follows the text of a page in an empty folder."""
    with tempfile.TemporaryDirectory(prefix="orca_lesson_") as folder:
        Learner(build, folder).follow(blocks_of(text))


class Pages(unittest.TestCase):
    def test_no_page_is_too_long_too_wide_or_has_too_much_code(self):
        pages = sorted(LESSONS.glob("*.md"))
        self.assertGreater(len(pages), 10)
        for page in pages:
            with self.subTest(page=page.name):
                text = page.read_text()
                form_of(text, blocks_of(text))

    def test_readme_leads_to_each_lesson_in_two_clicks(self):
        def links(page):
            return {(page.parent / target).resolve() for target in LINK.findall(page.read_text())}
        first = links(TREE / "README.md")
        self.assertIn(LESSONS / "README.md", first)
        self.assertLessEqual(set(LESSONS.glob("*.md")), first | links(LESSONS / "README.md"))

    def test_the_list_of_lessons_counts_their_lines(self):
        rows = {row["page"]: int(row["code"]) for row in ROW.finditer((LESSONS / "README.md").read_text())}
        pages = {page.name: lines_of_code(blocks_of(page.read_text())) for page in LESSONS.glob("[0-9]*.md")}
        self.assertEqual(rows, pages)

    def test_the_smallest_component_is_as_small_as_its_page_says(self):
        page = (LESSONS / "01_hello.md").read_text()
        files = {block.file: lines_of_code([block]) for block in blocks_of(page) if block.kind == "write"}
        self.assertEqual(files, {"hello.cpp": 13, "CMakeLists.txt": 1, "hello.xml": 3})
        self.assertIn("13 lines of code, 1 of build after those with which each project begins, and 3 of graph.", " ".join(page.split()))


RIGHT = r"""# A page

Write `one.txt`:

```xml
<a/>
<!-- nothing -->
```

```sh
mkdir x && cp one.txt x && cd x
echo made > two.txt
```

What it holds is in `two.txt`, as made:

```cpp
made
```

```sh
cat one.txt
pwd
grep b one.txt || echo "exit status $?" >&2
```

```text
<a/>
...
~/.../x
exit \
  status 1
```

<!-- not run: it is the reader's own folder -->
```sh
false
```
"""


class Checker(unittest.TestCase):
    """The test fails where a page is wrong."""

    def test_a_page_that_is_right_is_followed(self):
        follow(RIGHT)
        self.assertEqual(lines_of_code(blocks_of(RIGHT)), 1)

    def test_whatever_is_wrong_in_a_page_is_found(self):
        for right, wrong, says in (("<a/>\n<!--", "<b/>\n<!--", "line 27: shows other lines"),
                                   ("cat one.txt", "cat two.txt", "shows other lines"),
                                   ("cat one.txt", "cat three.txt", "(?s)line 21: .*ended with 1"),
                                   ("exit \\\n  status 1\n```", "```", "shows other lines"),
                                   ("  status 1\n```", "  status 2\n```", "line 27: shows other lines"),
                                   ("  status 1\n```", "  status 1\nmore\n```", "shows other lines"),
                                   ("pwd\n", "pwd\nsleep 0 &\nfalse\n", "ended with 1"),
                                   ("```cpp\nmade", "```cpp\nmode", "line 17: two.txt was made otherwise"),
                                   ("echo made > two.txt\n", "", "nothing has made two.txt"),
                                   ("`one.txt`:", "this:", "line 5: a block of xml that is no file"),
                                   ("<a/>\n...\n~/.../x\nexit \\\n  status 1\n", "...\n", "shows nothing"),
                                   ("exit \\\n  status 1", "exit\n  status 1", "shows other lines")):
            with self.subTest(wrong=wrong):
                self.assertEqual(RIGHT.count(right), 1)
                with self.assertRaisesRegex(Wrong, says):
                    follow(RIGHT.replace(right, wrong))

    def test_dots_stand_for_characters_and_lines_and_nothing_else(self):
        for shown, printed, expected in (("a...c", "abc", True), ("a...c", "ac", True), ("a...c", "abd", False), ("a.c", "abc", False),
                                         ("a\n...\nc", "a\nc", True), ("a\n...\nc", "a\nb\nb\nc", True), ("a\n...", "b", False),
                                         ("...\nc", "a\nc\nc", True), ("a\n...\nb\n...\nc", "a\nx\nc", False), ("", "a", False)):
            with self.subTest(shown=shown, printed=printed):
                self.assertEqual(is_so(shown.splitlines(), printed.splitlines()), expected)

    def test_a_page_of_the_wrong_form_is_found(self):
        for page, says in (("x\n" * 151, "151 lines"), ("x" * 101, "line 1: 101 columns"), ("`a`:\n\n```cpp\n" + "x;\n" * 61 + "```\n", "61 lines of code")):
            with self.assertRaisesRegex(Wrong, says):
                form_of(page, blocks_of(page))


def with_own_network():
    """Goes on with a network of its own, in which there is nothing but the loopback interface, so that a lesson does not hear what else
    runs on this machine. Where the system gives none, it goes on as it is."""
    user = [] if os.geteuid() == 0 else ["--map-root-user"]
    alone = ["unshare", *user, "--net", "sh", "-c", 'ip link set lo up && exec "$@"', "sh"]
    if "ORCA_OWN_NETWORK" in os.environ or subprocess.run([*alone, "true"], capture_output=True).returncode != 0:
        return
    os.environ["ORCA_OWN_NETWORK"] = "yes"
    os.execvp(alone[0], [*alone, sys.executable, "-B", *sys.argv])


def follow_pages(build, pages):
    """Returns the exit status."""
    for page in pages:
        try:
            follow((LESSONS / page).read_text(), pathlib.Path(build).resolve())
        except Wrong as wrong:
            print(f"docs/lessons/{page}: {wrong}")
            return 1
    return 0


if __name__ == "__main__":
    if len(sys.argv) > 2:
        with_own_network()
        sys.exit(follow_pages(sys.argv[1], sys.argv[2:]))
    unittest.main()
