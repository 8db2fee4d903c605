# SPDX-License-Identifier: GPL-3.0-or-later
"""A page of docs/lessons, and a reader who does what it says in an empty folder.

A page is text with blocks between ``` lines. What a block is, the reader sees, and so does the test:

    `NAME`:               ends the line above: the block is the file NAME, which is written
    `NAME`, as made:      ends the line above: the file NAME is there already, and holds just this
    `NAME`, in part:      the same, and holds this among other things
    ```sh                 commands for bash, given in the folder to which those before have gone; the last and all others succeed
    ```text               below commands: what they print, stdout and stderr as they come, from the first line to the last

In a ```text block `...` stands for what differs from run to run or is left out: within a line for any characters, alone in a line for
any lines. A line that is too long for the page ends with `\`, and goes on in the next. Commands without such a block below may print anything. <!-- not run: REASON --> above a block: nobody gives these commands.
"""
import contextlib
import dataclasses
import os
import pathlib
import re
import signal
import subprocess
import tempfile

TREE = pathlib.Path(__file__).resolve().parents[2]
MOST_LINES, MOST_COLUMNS, MOST_CODE = 150, 100, 60
BLOCK = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
FILE = re.compile(r"`([\w./-]+)`(, as made|, in part)?:$")
NOT_RUN = re.compile(r"<!-- not run: \S.* -->")
NO_CODE = re.compile(r"^$|//|#(?!include|!)|<!--.*-->$|(cmake_minimum_required|project|find_package)\(")
LONGEST = 300  # [s] that one block of commands may take


class Wrong(Exception):
    """What a page says is not so."""


@dataclasses.dataclass
class Block:
    kind: str  # write, compare, contain, run, printed
    text: str
    line: int  # of the page, where it begins
    file: str = ""


def blocks_of(page):
    """Returns the blocks of a page, in their order."""
    found = []
    for match in BLOCK.finditer(page):
        above = page[:match.start()].rstrip("\n").rsplit("\n", 1)[-1]
        line = page.count("\n", 0, match.start()) + 1
        name = FILE.search(above)
        if NOT_RUN.fullmatch(above):
            continue
        if match[1] == "sh":
            found.append(Block("run", match[2], line))
        elif name:
            kind = {None: "write", ", as made": "compare", ", in part": "contain"}[name[2]]
            found.append(Block(kind, match[2], line, name[1]))
        elif match[1] == "text" and found and found[-1].kind == "run":
            found.append(Block("printed", match[2], line))
        else:
            raise Wrong(f"line {line}: a block of {match[1] or 'nothing'} that is no file, no commands, and not what commands print")
    return found


def lines_of_code(blocks):
    """Returns how many lines the reader writes: those of all files, without blank ones, comments and those with which each CMakeLists.txt
    begins."""
    lines = [line.strip() for block in blocks if block.kind == "write" for line in block.text.splitlines()]
    return sum(not NO_CODE.match(line) for line in lines)


def form_of(page, blocks):
    """Raises Wrong for a page that is too long or too wide, or has too much code."""
    lines = page.splitlines()
    if len(lines) > MOST_LINES:
        raise Wrong(f"{len(lines)} lines; at most {MOST_LINES}")
    for number, line in enumerate(lines, 1):
        if len(line) > MOST_COLUMNS:
            raise Wrong(f"line {number}: {len(line)} columns; at most {MOST_COLUMNS}")
    if lines_of_code(blocks) > MOST_CODE:
        raise Wrong(f"{lines_of_code(blocks)} lines of code; at most {MOST_CODE}")


def is_so(shown, printed):
    """Returns whether lines are those that a page shows, with `...` in it."""
    places = {0}  # where in the printed lines the shown ones so far may end
    for line in shown:
        if line.strip() == "...":
            places = set(range(min(places), len(printed) + 1)) if places else places
        else:
            like = re.compile(".*".join(re.escape(part) for part in line.split("...")))
            places = {place + 1 for place in places if place < len(printed) and like.fullmatch(printed[place])}
    return len(printed) in places


class Learner:
    """Somebody who follows a page in an empty folder, with a build of Orca."""

    def __init__(self, build, folder):
        self.build, self.folder = pathlib.Path(build), pathlib.Path(folder).resolve()
        self.within = self.folder  # where the commands have gone to
        self.said = ""             # what the last commands have printed
        self.options, self.longest = "set -e -o pipefail", LONGEST
        self.shells = []           # their process groups, which live on while they have something in the background
        sockets = self.folder / ".sockets"
        sockets.mkdir(mode=0o700)
        self.environment = dict(os.environ, ORCA=str(build), PATH=f"{build}/bin:{os.environ['PATH']}", LC_ALL="C.UTF-8",
                                XDG_RUNTIME_DIR=str(sockets))

    def follow(self, blocks):
        """Does what all blocks say. Raises Wrong where that is not so."""
        try:
            for block in blocks:
                try:
                    getattr(self, block.kind)(block)
                except Wrong as wrong:
                    raise Wrong(f"line {block.line}: {wrong}") from None
        finally:
            self.end()

    def end(self):
        """Ends what the commands have left running."""
        for group in self.shells:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(group, signal.SIGKILL)

    def write(self, block):
        file = self.within / block.file
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(block.text)

    def made(self, block):
        file = self.within / block.file
        if not file.exists():
            raise Wrong(f"nothing has made {block.file}")
        return self.plain(file.read_text())

    def compare(self, block):
        if self.made(block) != block.text:
            raise Wrong(f"{block.file} was made otherwise:\n{self.made(block)}")

    def contain(self, block):
        if block.text not in self.made(block):
            raise Wrong(f"{block.file} holds no such lines:\n{self.made(block)}")

    def run(self, block):
        with tempfile.TemporaryFile("w+") as out, tempfile.NamedTemporaryFile("r") as place:
            script = f"{self.options}\n{block.text}pwd >{place.name}\n"
            shell = subprocess.Popen(["bash", "-c", script], cwd=self.within, env=self.environment, stdin=subprocess.DEVNULL, stdout=out,
                                     stderr=subprocess.STDOUT, start_new_session=True)
            self.shells.append(shell.pid)
            try:
                shell.wait(self.longest)
            except subprocess.TimeoutExpired:
                raise Wrong(f"the commands have not ended after {self.longest} s:\n{block.text}") from None
            out.seek(0)
            self.said = self.plain(out.read())
            if shell.returncode != 0:
                raise Wrong(f"{block.text}ended with {shell.returncode}:\n{self.said}")
            self.within = pathlib.Path(place.read().strip())

    def printed(self, block):
        shown = re.sub(r" \\\n *", " ", block.text).splitlines()
        if all(line.strip() == "..." for line in shown):
            raise Wrong("shows nothing of what is printed")
        if not is_so(shown, self.said.splitlines()):
            raise Wrong(f"shows other lines than those that were printed:\n{self.said}")

    def plain(self, text):
        """Returns a text with the places of a reader instead of those of this run."""
        for place, name in ((self.build, "~/orca/build/release"), (self.folder, "~/lesson"), (TREE, "~/orca")):
            text = text.replace(str(place), name)
        return text
