# SPDX-License-Identifier: LGPL-3.0-or-later
"""Graphs: what is wrong with them, and how they are changed."""
import dataclasses
import re
import xml.etree.ElementTree as ET


@dataclasses.dataclass(frozen=True)
class Fault:
    """Something wrong in a graph or an experiment. Line and column count from 1; 0: it has no place in a file."""

    severity: str  # "error" or "warning"
    code: str      # docs/errors.md
    file: str
    line: int
    column: int
    message: str

    def __str__(self):
        return f"{self.file}:{self.line}:{self.column}: {self.severity} {self.code}: {self.message}"


class Graph:
    """A graph file that is changed and written again. Comments stay, places of line breaks within tags do not.

    Relative paths in a graph start at its file: write() it into the folder from which it was read, or give absolute ones.
    """

    def __init__(self, file):
        self.file = str(file)
        builder = ET.TreeBuilder(insert_comments=True)
        self._root = ET.parse(file, ET.XMLParser(target=builder)).getroot()
        with open(file, encoding="utf-8") as text:
            self._head = re.split(r"<(?=[A-Za-z])", re.sub(r"<!--.*?-->", lambda it: it[0].replace("<", "\0"), text.read(), flags=re.DOTALL))[0]
        self._head = self._head.replace("\0", "<")

    @property
    def components(self):
        """The components by their names, with their types. Those of profiles and included files are not among them."""
        return {element.get("name"): element.get("type") for element in self._root.findall("component")}

    def set(self, component, param, value):
        """Sets a parameter of a component or hardware of this file, as text with its unit: ("avoid", "margin", "5 cm")."""
        owner = self._named(component)
        known = next((one for one in owner.findall("param") if one.get("name") == param), None)
        (ET.SubElement(owner, "param", name=param) if known is None else known).set("value", str(value))

    def add(self, name, type, **attributes):  # noqa: A002: the word of a graph
        """Adds a component; attributes as in a graph: add("avoid", "orca.SonarAvoid", period="0.1 s")."""
        ET.SubElement(self._root, "component", name=name, type=type, **attributes)

    def remove(self, name):
        """Removes a component of this file, and all connections of it."""
        self._root.remove(self._named(name))
        for parent in [self._root, *self._root.findall("profile")]:
            for edge in parent.findall("connect"):
                if name in (edge.get("from", "").split(".")[0], edge.get("to", "").split(".")[0]):
                    parent.remove(edge)

    def connect(self, start, end, **attributes):
        """Connects a port with another: connect("base.SonarRangeReadingsPush", "avoid.sonar", queue="4")."""
        ET.SubElement(self._root, "connect", {"from": start, "to": end, **attributes})

    def write(self, file):
        """Writes the graph into a file, and returns the file's name."""
        ET.indent(self._root)
        with open(file, "w", encoding="utf-8") as text:
            text.write(self._head + ET.tostring(self._root, encoding="unicode") + "\n")
        return str(file)

    def _named(self, name):
        found = [element for element in self._root if element.get("name") == name and element.tag in ("component", "hardware")]
        if not found:
            raise KeyError(f"{self.file} has no component {name!r}; it has: {', '.join(self.components)}")
        return found[0]
