# SPDX-License-Identifier: GPL-3.0-or-later
"""Which folder may include what. This table is the law; check_layers.py carries it out.

A layer owns `folders` (the longest match decides) and the public headers under `headers`. It may include its own headers
and those of the layers that `may` names. `libraries` are third-party libraries that its private files may use, and
`public_libraries` those that its public headers may show. Folders outside the table (tests/, bench/) may include anything.
"""
from dataclasses import dataclass


@dataclass(frozen=True)
class Layer:
    name: str
    folders: tuple
    headers: tuple = ()
    may: tuple = ()
    libraries: tuple = ()
    public_libraries: tuple = ()
    siblings: bool = True  # may its subfolders see each other?


COMPONENT = ("component", "patterns", "idl", "base")
DEVICE = ("hw_api", *COMPONENT)

LAYERS = (
    Layer("base", ("src/runtime/base",), ("orca/base/",), libraries=("fmt",)),
    Layer("log", ("src/runtime/base/log",), (), ("base",), ("spdlog", "fmt")),
    Layer("executive", ("src/runtime/base/executive",), (), ("base",), ("boost",)),
    Layer("idl", ("idl",), ("orca/idl/",), ("base",), ("fastcdr",), ("fastcdr",)),
    Layer("xml", ("src/runtime/xml",), ("orca/xml/",), ("base",), ("tinyxml2", "fmt")),
    Layer("text", ("src/runtime/text",), ("orca/text/",), ("idl", "xml", "base")),
    Layer("geometry", ("src/runtime/geometry",), ("orca/geometry/",), ("idl", "base"), ("eigen",)),
    Layer("patterns", ("src/patterns",), ("orca/patterns/",), ("idl", "base"), ("fmt",)),
    Layer("patterns_local", ("src/patterns/local",), ("orca/patterns/local/",), ("patterns", "idl", "base"), ("fmt",)),
    Layer("patterns_dds", ("src/patterns/dds",), ("orca/patterns/dds/",), ("patterns", "idl", "base"),
          ("fastdds", "fastcdr", "fmt")),
    Layer("component", ("src/runtime/component", "cmake/plugin"), ("orca/component.hpp", "orca/component/"),
          ("patterns", "idl", "base"), ("fmt",)),
    Layer("hw_api", ("src/hw/api",), ("orca/hw/", "orca/hardware.hpp"), COMPONENT, ("fmt",)),
    Layer("graph", ("src/runtime/graph",), ("orca/graph/",), ("xml", "base"), ("fmt",)),
    Layer("plugin", ("src/runtime/plugin",), ("orca/plugin/",), DEVICE, ("fmt",)),
    Layer("device", ("src/hw",), (), ("geometry", *DEVICE), ("fmt",), siblings=False),
    Layer("avoidance", ("src/components/avoidance",), ("orca/avoidance/",), COMPONENT),
    Layer("components", ("src/components",), (), ("avoidance", "geometry", *DEVICE), ("eigen", "fcl", "fmt"),
          siblings=False),
    Layer("sim", ("sim",), ("orca/sim/",), ("geometry", "xml", *DEVICE),
          ("bullet", "urdfdom", "eigen", "png", "zlib", "fmt")),
    Layer("host", ("src/runtime/host",), ("orca/host/",),
          ("graph", "plugin", "text", "xml", "patterns_local", "patterns_dds", *DEVICE), ("cairo", "fmt")),
    Layer("apps", ("src/apps",), (), ("host", "graph", "plugin", "text", "xml", *DEVICE), ("fmt",)),
)

# Library -> how its headers begin. A header that no line names (the standard library, POSIX) is free for all.
LIBRARY_HEADERS = {
    "spdlog": ("spdlog/",),
    "fmt": ("fmt/",),
    "fastdds": ("fastdds/", "fastrtps/"),
    "fastcdr": ("fastcdr/",),
    "tinyxml2": ("tinyxml2.h",),
    "eigen": ("Eigen/", "unsupported/Eigen/"),
    "fcl": ("fcl/", "ccd/"),
    "bullet": ("bullet/", "btBullet", "LinearMath/", "BulletCollision/", "BulletDynamics/", "BulletSoftBody/"),
    "urdfdom": ("urdf_parser/", "urdf_model/", "urdf_exception/", "urdf_world/", "urdf_sensor/"),
    "boost": ("boost/",),
    "png": ("png.h", "libpng"),
    "zlib": ("zlib.h",),
    "cairo": ("cairo",),
    "catch2": ("catch2/",),
    "benchmark": ("benchmark/",),
}
