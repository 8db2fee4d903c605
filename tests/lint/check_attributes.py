# SPDX-License-Identifier: GPL-3.0-or-later
"""Each attribute of the graph language has a user that ships: a graph, an experiment, or a graph of a lesson."""
import re
import xml.etree.ElementTree as ElementTree

SCHEMA = "graphs/orca-graph.xsd"
XS = "{http://www.w3.org/2001/XMLSchema}"
START_TAG = re.compile(r"<(\w+)((?:\s+\w+=\"[^\"]*\")+)")
WRITTEN_BY_ORCA = {("graph", "expanded")}  # by deployer --print and orcactl graph, for diff and apply


def declared(schema):
    """Returns the pairs (element, attribute) of the language."""
    return {(kind.get("name").split("_in_")[0], attribute.get("name"))
            for kind in ElementTree.fromstring(schema.encode()).findall(f"{XS}complexType")
            for attribute in kind.findall(f"{XS}attribute")}


def used(text):
    """Returns the pairs that a text holds outside of comments."""
    text = re.sub(r"<!--.*?-->", "", text, flags=re.DOTALL)
    return {(tag[1], name) for tag in START_TAG.finditer(text) for name in re.findall(r"(\w+)=", tag[2])}


def find(tree):
    if SCHEMA not in tree.paths:
        return [f"{SCHEMA}: is not there"]
    shipped = [path for path in tree.paths
               if re.match(r"graphs/\w+\.xml$|sim/experiments/.*\.xml$|docs/lessons/.*\.md$", path)]
    unused = declared(tree.text(SCHEMA)) - WRITTEN_BY_ORCA - set().union(*(used(tree.text(path)) for path in shipped))
    return [f"{SCHEMA}: <{element} {attribute}=\"...\">: no shipped graph uses it; write one that needs it, or delete it"
            for element, attribute in sorted(unused)]


_SCHEMA = """<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema"><xs:complexType name="connect">
<xs:attribute name="from" use="required"><xs:annotation/></xs:attribute><xs:attribute name="queue"/>
</xs:complexType></xs:schema>"""
BAD = [
    ({SCHEMA: _SCHEMA, "graphs/a.xml": '<connect from="a.b"/>'}, "<connect queue="),
    ({SCHEMA: _SCHEMA, "graphs/a.xml": '<connect from="a.b"/><!-- <connect queue="1"/> -->'}, "<connect queue="),
    ({SCHEMA: _SCHEMA, "graphs/a.xml": '<connect from="a.b"/><port queue="1"/>'}, "<connect queue="),
    ({SCHEMA: _SCHEMA, "graphs/a.xml": '<connect from="a.b"/>', "docs/graph.md": '<connect queue="1"/>'}, "<connect queue="),
    ({"graphs/a.xml": ""}, "is not there"),
]
GOOD = [
    {SCHEMA: _SCHEMA, "graphs/a.xml": '<connect from="a.b"\n queue="1"/>'},
    {SCHEMA: _SCHEMA, "graphs/a.xml": '<connect from="a.b"/>', "docs/lessons/01_hello.md": '<connect queue="4"/>'},
]
