# SPDX-License-Identifier: GPL-3.0-or-later
"""Includes point down only (layers.py), and each third-party library is used only in the layers that may use it."""
import collections
import posixpath
import re

from layers import LAYERS, LIBRARY_HEADERS

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.MULTILINE)
SOURCES = (".cpp", ".hpp", ".h", ".c")
MOST_FILES = 30
# The beginnings and ends of namespaces, and classes at the start of a line: Orca's sources do not indent namespaces.
SCOPE = re.compile(
    r"^namespace (?P<open>[\w:]+) \{$|^(?P<close>\}  // namespace [\w:]+)$"
    r"|^(?:enum )?(?:class|struct) (?:alignas\(\w+\) )?(?P<name>\w+)(?: final)?[^;{\n]*(?P<end>[;{]?)", re.MULTILINE)


def layer_of_file(path):
    """Returns the layer of a public header, or that with the longest folder; src/base/log means both log.cpp and log/."""
    if "/include/orca/" in path:
        return layer_of_header(path.split("/include/")[1])

    def match(layer):
        return max((len(f) for f in layer.folders if re.match(re.escape(f) + r"[/.]", path)), default=0)
    best = max(LAYERS, key=match)
    return best if match(best) else None


def layer_of_header(header):
    def match(layer):
        return max((len(h) for h in layer.headers if header.startswith(h)), default=0)
    best = max(LAYERS, key=match)
    return best if match(best) else None


def library_of(header):
    return next((name for name, starts in LIBRARY_HEADERS.items() if header.startswith(starts)), None)


def unit_of(layer, path):
    """Returns the folder that a file of a layer without siblings must stay in: src/components/NAME."""
    folder = max((f for f in layer.folders if path.startswith(f)), key=len)
    return "/".join(path.split("/")[: folder.count("/") + 2])


def fault_of_orca_include(layer, header):
    target = layer_of_header(header)
    if target is None:
        return f'"{header}" belongs to no layer; name its folder in tests/lint/layers.py'
    if target is layer or target.name in layer.may:
        return None
    return f'layer {layer.name} must not include "{header}" of layer {target.name}; it may use: {", ".join(layer.may)}'


def fault_of_library(layer, path, header, library):
    public = "/include/orca/" in path
    allowed = layer.public_libraries if public else layer.libraries
    if library in allowed:
        return None
    place = "public headers" if public else "files"
    return f'{place} of layer {layer.name} must not include <{header}> ({library}); allowed: {", ".join(allowed) or "none"}'


def target_of_private_include(layer, path, header, tree):
    """Returns the path of a private header: beside the file that includes it, or in another room of its module."""
    starts = [posixpath.dirname(path)] + ([layer.module] if layer.module else [])
    candidates = [posixpath.normpath(posixpath.join(start, header)) for start in starts]
    return next((c for c in candidates if tree.exists(c)), None)


def may_include_private(layer, owner):
    """Returns whether a layer may see the owner's private headers: a lower room of its module, or a part of base."""
    base_parts = {"base", "log", "executive"}
    if owner is layer or {layer.name, owner.name} <= base_parts:
        return True
    return bool(layer.module) and owner.module == layer.module and owner.name in layer.may


def fault_of_private_include(layer, path, header, tree):
    """Reports a private header that is neither in the same layer nor in a lower room of the same module."""
    target = target_of_private_include(layer, path, header, tree)
    if target is None:
        return None
    owner = layer_of_file(target)
    if owner is None or not may_include_private(layer, owner):
        return f'"{header}" is a private header of {owner.name if owner else target}; include a public one ("orca/...")'
    if not layer.siblings and unit_of(layer, target) != unit_of(layer, path):
        return f'"{header}" belongs to a sibling ({unit_of(layer, target)}); siblings of {layer.name} do not know each other'
    return None


def fault(layer, path, quote, header, tree):
    if header.startswith("orca/"):
        return fault_of_orca_include(layer, header)
    library = library_of(header)
    if library:
        return fault_of_library(layer, path, header, library)
    return fault_of_private_include(layer, path, header, tree) if quote == '"' else None


def declared_names(text):
    """Yields (qualified name, offset, whether it is defined) of each class, struct and enum at namespace level."""
    namespaces = []
    for match in SCOPE.finditer(text):
        if match["open"] is not None:
            namespaces.append(match["open"])
        elif match["close"] is not None:
            namespaces = namespaces[:-1]
        else:
            yield "::".join((*namespaces, match["name"])), match.start(), match["end"] != ";"


def owners_of_names(tree):
    """Maps each qualified name to the layer that defines it, for all headers in the table."""
    owners = {}
    for path in tree.with_suffix(".hpp", ".h"):
        layer = layer_of_file(path)
        if layer is not None:
            owners.update((name, layer) for name, _, defined in declared_names(tree.text(path)) if defined)
    return owners


def faults_of_declarations(layer, text, owners):
    """Yields (offset, fault) of each declared name of a layer above: a declaration depends on it as an include does."""
    for name, offset, defined in declared_names(text):
        owner = owners.get(name)
        if not defined and owner is not None and owner is not layer and owner.name not in layer.may:
            yield offset, f'layer {layer.name} must not declare "{name}" of layer {owner.name}'


def faults_of_file(layer, path, text, owners, tree):
    for match in INCLUDE.finditer(text):
        yield match.start(), fault(layer, path, match[1], match[2], tree)
    yield from faults_of_declarations(layer, text, owners)


def crowded_folders(tree):
    """Reports folders with more source files than a reader can keep in mind."""
    folders = collections.Counter(posixpath.dirname(path) for path in tree.with_suffix(*SOURCES) if layer_of_file(path))
    return [f"{folder}:1: {count} source files, at most {MOST_FILES}; give its rooms folders of their own"
            for folder, count in sorted(folders.items()) if count > MOST_FILES]


def find(tree):
    findings = crowded_folders(tree)
    owners = owners_of_names(tree)
    for path in tree.with_suffix(*SOURCES):
        layer = layer_of_file(path)
        if layer is None:
            if path.startswith(("src/", "sim/", "idl/")):
                findings.append(f"{path}:1: this folder belongs to no layer; name it in tests/lint/layers.py")
            continue
        text = tree.text(path)
        findings += [f"{path}:{text.count(chr(10), 0, offset) + 1}: {wrong}"
                     for offset, wrong in faults_of_file(layer, path, text, owners, tree) if wrong]
    return findings


def _one(path, line):
    return {path: f"#pragma once\n{line}\n"}


def _declared(path, declaration, owner, definition):
    return {path: f"#pragma once\n{declaration}\n", owner: f"#pragma once\n{definition}\n"}


def _arrow(module, room, target):
    return {f"src/runtime/{module}/{room}/a.cpp": f'#include "{target}/b.hpp"\n', f"src/runtime/{module}/{target}/b.hpp": "\n"}


# (module, layer of the target, room, target): a wrong arrow out of each room that has rooms above it.
ARROWS_UP = [
    ("host", "host_run", "containment", "run"),
    ("host", "host_reporting", "run/recording", "run/reporting"),
    ("host", "host_component", "run/reporting", "run/component"),
    ("host", "host_component_state", "run/component/parts", "run/component/state"),
    ("host", "host_component", "run/component/state", "run/component"),
    ("host", "host_system", "run/component", "run/system"),
    ("host", "host_system", "run/hardware", "run/system"),
    ("host", "host_trial", "run/system", "run/trial"),
    ("host", "host_swap", "run/trial", "run/swap"),
    ("host", "host_part", "run/swap", "run/part"),
    ("host", "host_run", "run/part", "run"),
    ("host", "host_run", "run/judging", "run"),
    ("supervisor", "supervisor_processes", "channel", "processes"),
    ("supervisor", "supervisor_members", "processes", "members"),
    ("supervisor", "supervisor_members", "agreed", "members"),
    ("supervisor", "supervisor_members", "hosted", "members"),
    ("supervisor", "supervisor_hosted", "members", "hosted"),
    ("supervisor", "supervisor_control", "members", "control"),
    ("supervisor", "supervisor_run", "members", "run"),
    ("supervisor", "supervisor_applying", "control", "applying"),
    ("supervisor", "supervisor_run", "control", "run"),
    ("supervisor", "supervisor_run", "machines", "run"),
    ("supervisor", "supervisor_control", "starting", "control"),
    ("supervisor", "supervisor_run", "starting", "run"),
    ("supervisor", "supervisor_run", "applying", "run"),
    ("batch", "batch_results", "measures", "results"),
    ("batch", "batch_experiment", "results", "experiment"),
    ("batch", "batch_making", "experiment", "making"),
    ("batch", "batch_running", "report", "running"),
    ("batch", "batch_comparing", "making", "comparing"),
    ("batch", "batch_running", "comparing", "running"),
    ("batch", "batch_running", "checking", "running"),
    ("batch", "batch_checking", "running", "checking"),
]
BAD = [
    (_one("src/base/include/orca/base/x.hpp", '#include "orca/patterns/push.hpp"'), "x.hpp:2: layer base"),
    (_one("src/components/avoid/avoid.cpp", '#include "orca/graph/graph.hpp"'), "layer components must not include"),
    (_one("src/components/avoid/avoid.cpp", '#include "orca/patterns/dds/link.hpp"'), "of layer patterns_dds"),
    (_one("src/runtime/graph/load.cpp", '#include "orca/plugin/plugin.hpp"'), "layer graph must not include"),
    (_one("src/runtime/graph/load.cpp", "#include <tinyxml2.h>"), "(tinyxml2); allowed: fmt"),
    (_one("src/component_api/include/orca/component/x.hpp", "#include <Eigen/Core>"), "public headers of layer"),
    (_one("src/component_api/include/orca/component.hpp", "#  include <spdlog/spdlog.h>"), "(spdlog)"),
    (_one("src/base/result.cpp", "#include <spdlog/spdlog.h>"), "(spdlog)"),
    (_one("src/patterns/push.cpp", "#include <fastdds/dds/topic/Topic.hpp>"), "(fastdds)"),
    (_one("src/hw/nomad/driver.cpp", '#include "btBulletDynamicsCommon.h"'), "(bullet)"),
    (_one("sim/world/x.cpp", '#include "orca/host/host.hpp"'), "layer sim_world must not include"),
    (_one("sim/rays/x.cpp", '#include "orca/sim/world.hpp"'), "layer sim_rays must not include"),
    (_one("sim/world/x.cpp", "#include <png.h>"), "(png)"),
    # A public header belongs to the room that makes what it promises.
    (_one("src/runtime/supervisor/run/include/orca/supervisor/outputs.hpp", '#include "orca/supervisor/supervised_run.hpp"'),
     "layer supervisor_starting must not include"),
    (_one("src/runtime/host/run/system/x.cpp", '#include "orca/host/hosted_part.hpp"'), "of layer host_part"),
    (_one("src/patterns/push.cpp", '#include "orca/unheard/of.hpp"'), "belongs to no layer"),
    (_one("src/newfolder/x.cpp", ""), "this folder belongs to no layer"),
    ({"src/components/a/a.cpp": '#include "../b/b.hpp"\n', "src/components/b/b.hpp": "\n"}, "belongs to a sibling"),
    ({"src/hw/a/a.cpp": '#include "../b/codec.hpp"\n', "src/hw/b/codec.hpp": "\n"}, "belongs to a sibling"),
    ({"src/patterns/a.cpp": '#include "../base/b.hpp"\n', "src/base/b.hpp": "\n"}, "private header of base"),
    # Between rooms of one module.
    ({"src/runtime/graph/reading/a.cpp": '#include "checking/b.hpp"\n', "src/runtime/graph/checking/b.hpp": "\n"},
     "private header of graph_checking"),
    *((_arrow(module, *arrow), f"private header of {layer}") for module, layer, *arrow in ARROWS_UP),
    ({"sim/model/a.hpp": '#include "rays/b.hpp"\n', "sim/rays/b.hpp": "\n"}, "private header of sim_rays"),
    ({"src/runtime/plugin/inspection/a.cpp": '#include "../b.hpp"\n', "src/runtime/plugin/b.hpp": "\n"},
     "private header of plugin"),
    # A forward declaration depends on a layer above as an include does.
    (_declared("src/component_api/include/orca/component/x.hpp", "namespace orca::hw {\nclass Container;\n}  // namespace orca::hw",
               "src/hw/api/include/orca/hw/c.hpp", "namespace orca::hw {\n\nclass Container : public Base {"),
     'must not declare "orca::hw::Container" of layer hw_api'),
    (_declared("sim/model/x.hpp", "namespace orca::sim {\nstruct Ray;\n}  // namespace orca::sim",
               "sim/rays/ray.hpp", "namespace orca::sim {\nstruct Ray {\n"), 'must not declare "orca::sim::Ray" of layer sim_rays'),
    ({f"src/xml/f{i}.cpp": "\n" for i in range(31)}, "31 source files, at most 30"),
]
GOOD = [
    _one("src/base/log.cpp", "#include <spdlog/spdlog.h>"),
    _one("src/base/executive/fiber.cpp", "#include <boost/context/fiber.hpp>"),
    _one("src/components/avoid/avoid.cpp", '#include "orca/component.hpp"\n#include <Eigen/Core>\n#include <vector>'),
    _one("src/hw/api/x.cpp", '#include "orca/hardware.hpp"\n#include "orca/hw/byte_link.hpp"\n#include "orca/idl/time.hpp"'),
    _one("src/patterns/dds/backend/link.cpp", '#include <fastdds/dds/topic/Topic.hpp>\n#include "orca/patterns/endpoints/links.hpp"'),
    _one("tests/unit/x_test.cpp", '#include <catch2/catch.hpp>\n#include "orca/graph/graph.hpp"'),
    {"src/components/a/a.cpp": '#include "algorithm.hpp"\n', "src/components/a/algorithm.hpp": "\n"},
    {"src/base/executive/a.cpp": '#include "../b.hpp"\n', "src/base/b.hpp": "\n"},
    {"src/runtime/graph/checking/a.cpp": '#include "reading/b.hpp"\n', "src/runtime/graph/reading/b.hpp": "\n"},
    _arrow("supervisor", "run", "members"),
    _arrow("host", "run/swap", "run/trial"),
    _arrow("batch", "comparing", "making"),
    {"sim/world/a.cpp": '#include "rays/b.hpp"\n', "sim/rays/b.hpp": "\n"},
    _declared("src/component_api/include/orca/component/x.hpp", "namespace orca {\nclass Strand;\n}  // namespace orca",
              "src/base/include/orca/base/strand.hpp", "namespace orca {\n\nclass Strand final {"),
    # Another class with that name.
    _declared("sim/model/x.hpp", "namespace orca::sim {\nclass Layer;\n}  // namespace orca::sim",
              "src/runtime/host/picture/l.hpp", "namespace orca::host {\nclass Layer {\n"),
    {f"src/xml/f{i}.cpp": "\n" for i in range(30)},
]
