# SPDX-License-Identifier: GPL-3.0-or-later
"""Includes point down only (layers.py), and each third-party library shows in the layers that may know it."""
import posixpath
import re

from layers import LAYERS, LIBRARY_HEADERS

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.MULTILINE)
SOURCES = (".cpp", ".hpp", ".h", ".c")


def layer_of_file(path):
    """The layer whose folder is the longest beginning of the path; src/runtime/base/log means log.cpp and log/ alike."""
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
    """The folder that a file of a layer without siblings must stay in: src/components/NAME."""
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


def fault_of_private_include(layer, path, header, tree):
    """A private header lies beside its user or elsewhere in the same layer, never in another one."""
    target = posixpath.normpath(posixpath.join(posixpath.dirname(path), header))
    if not tree.exists(target):
        return None
    owner = layer_of_file(target)
    base_parts = {"base", "log", "executive"}
    same = owner is layer or {layer.name, owner.name if owner else ""} <= base_parts
    if not same:
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


def find(tree):
    findings = []
    for path in tree.with_suffix(*SOURCES):
        layer = layer_of_file(path)
        if layer is None:
            if path.startswith(("src/", "sim/", "idl/")):
                findings.append(f"{path}:1: this folder belongs to no layer; name it in tests/lint/layers.py")
            continue
        text = tree.text(path)
        for match in INCLUDE.finditer(text):
            wrong = fault(layer, path, match[1], match[2], tree)
            if wrong:
                findings.append(f"{path}:{text.count(chr(10), 0, match.start()) + 1}: {wrong}")
    return findings


def _one(path, line):
    return {path: f"#pragma once\n{line}\n"}


BAD = [
    (_one("src/runtime/base/include/orca/base/x.hpp", '#include "orca/patterns/push.hpp"'), "x.hpp:2: layer base"),
    (_one("src/components/avoid/avoid.cpp", '#include "orca/graph/graph.hpp"'), "layer components must not include"),
    (_one("src/components/avoid/avoid.cpp", '#include "orca/patterns/dds/link.hpp"'), "of layer patterns_dds"),
    (_one("src/runtime/graph/load.cpp", '#include "orca/plugin/plugin.hpp"'), "layer graph must not include"),
    (_one("src/runtime/graph/load.cpp", "#include <tinyxml2.h>"), "(tinyxml2); allowed: fmt"),
    (_one("src/runtime/component/include/orca/component/x.hpp", "#include <Eigen/Core>"), "public headers of layer"),
    (_one("src/runtime/component/include/orca/component.hpp", "#  include <spdlog/spdlog.h>"), "(spdlog)"),
    (_one("src/runtime/base/result.cpp", "#include <spdlog/spdlog.h>"), "(spdlog)"),
    (_one("src/patterns/push.cpp", "#include <fastdds/dds/topic/Topic.hpp>"), "(fastdds)"),
    (_one("src/hw/nomad/driver.cpp", '#include "btBulletDynamicsCommon.h"'), "(bullet)"),
    (_one("sim/world/x.cpp", '#include "orca/host/host.hpp"'), "layer sim must not include"),
    (_one("src/patterns/push.cpp", '#include "orca/unheard/of.hpp"'), "belongs to no layer"),
    (_one("src/newfolder/x.cpp", ""), "this folder belongs to no layer"),
    ({"src/components/a/a.cpp": '#include "../b/b.hpp"\n', "src/components/b/b.hpp": "\n"}, "belongs to a sibling"),
    ({"src/hw/a/a.cpp": '#include "../b/codec.hpp"\n', "src/hw/b/codec.hpp": "\n"}, "belongs to a sibling"),
    ({"src/patterns/a.cpp": '#include "../runtime/base/b.hpp"\n', "src/runtime/base/b.hpp": "\n"}, "private header of base"),
]
GOOD = [
    _one("src/runtime/base/log.cpp", "#include <spdlog/spdlog.h>"),
    _one("src/runtime/base/executive/fiber.cpp", "#include <boost/context/fiber.hpp>"),
    _one("src/components/avoid/avoid.cpp", '#include "orca/component.hpp"\n#include <Eigen/Core>\n#include <vector>'),
    _one("src/hw/api/x.cpp", '#include "orca/hardware.hpp"\n#include "orca/hw/byte_link.hpp"\n#include "orca/idl/time.hpp"'),
    _one("src/patterns/dds/link.cpp", '#include <fastdds/dds/topic/Topic.hpp>\n#include "orca/patterns/push.hpp"'),
    _one("tests/unit/x_test.cpp", '#include <catch2/catch.hpp>\n#include "orca/graph/graph.hpp"'),
    {"src/components/a/a.cpp": '#include "algorithm.hpp"\n', "src/components/a/algorithm.hpp": "\n"},
    {"src/runtime/base/executive/a.cpp": '#include "../b.hpp"\n', "src/runtime/base/b.hpp": "\n"},
]
