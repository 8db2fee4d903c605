#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds a plugin against changed copies of the tree.

What is private to endpoints, their queues and the host must change no byte of it. What plugins compile in must change
its table of layouts, and the loader must then refuse it with the type's name and both hashes.
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

INCLUDES = ("src/component_api", "src/patterns", "src/geometry", "src/base", "idl", "src/hw/api")
PLUGIN = "src/components/motion_command_fuser/motion_command_fuser.cpp"
ROOTS = ("orca/component.hpp", "orca/hardware.hpp", "orca/hw/server.hpp")
API = "src/component_api/include/orca/component"
PORTS = "src/patterns/include/orca/patterns"
MEMBER = "  int added_ = 0;\n"
VIRTUAL = "  virtual void added() {}\n"

# File, the text in front of which a member is added.
INSIDE = (
    (f"{PORTS}/endpoints/endpoint.hpp", "  PortContract contract_;\n"),
    (f"{PORTS}/endpoints/push_server_endpoint.hpp", "  std::atomic<std::size_t> subscribers_{0};\n"),
    (f"{PORTS}/endpoints/push_edge.hpp", "  std::uint32_t first_ ORCA_GUARDED_BY(mutex_) = 0;\n"),
    (f"{PORTS}/endpoints/request_client.hpp", "  Pending pending_;\n"),
    (f"{PORTS}/endpoints/send_server_endpoint.hpp", "  std::deque<Accepted> waiting_ ORCA_GUARDED_BY(mutex_);\n"),
    ("src/runtime/host/run/component/parts/port_set.hpp", "  PortHome& home_;\n"),
)

# The type that changes, file, the text in front of which something is added, what is added.
ACROSS = (
    ("orca::Param<double>", f"{API}/param.hpp", "  T value_;\n", MEMBER),
    ("orca::Component", f"{API}/component.hpp", "  ComponentHost& host_;\n", MEMBER),
    ("orca::PushServerHandle", f"{PORTS}/push.hpp", "  Endpoint* endpoint_ = nullptr;\n", MEMBER),
    ("orca::Component", f"{API}/component.hpp", "  virtual void stop() {}\n", VIRTUAL),
    ("orca::PortOwner", f"{PORTS}/port_owner.hpp",
     "  virtual void declare_port(PortDeclaration declaration) = 0;\n", VIRTUAL),
    ("orca::ComponentHost", f"{API}/host.hpp", "  virtual void stay_active(bool active) = 0;\n", VIRTUAL),
)

COMPONENT = """#include "orca/component.hpp"
namespace {
class Old final : public orca::Component {
 public:
  using Component::Component;
  orca::Outcome work() override { return orca::done(); }
};
}  // namespace
ORCA_COMPONENT(Old, "test.Old")
"""

# The compiler cache, if there is one. CMake reads the same variable.
LAUNCHER = os.environ.get("CMAKE_CXX_COMPILER_LAUNCHER", "").split()

failures = []


def expect(holds, text):
    print(("ok: " if holds else "FAILED: ") + text)
    if not holds:
        failures.append(text)


class Tree:
    """A copy of the tree's headers that may be changed."""

    def __init__(self, options, root):
        self.options, self.root = options, root
        for folder in ("src", "idl", "cmake/plugin"):
            shutil.copytree(options.source / folder, root / folder,
                            ignore=lambda _, names: [n for n in names if n.endswith((".md", ".txt", ".xml"))])

    def add(self, path, before, text):
        """Adds a text in front of the first place of another one."""
        content = (self.root / path).read_text(encoding="utf-8")
        if before not in content:
            sys.exit(f"{path} has no line {before!r} any more; correct this test")
        (self.root / path).write_text(content.replace(before, text + before, 1), encoding="utf-8")

    def restore(self, path):
        shutil.copy(self.options.source / path, self.root / path)

    def compile(self, source, out, *more):
        flags = [f"-I{self.root / folder / 'include'}" for folder in INCLUDES]
        subprocess.run([*LAUNCHER, self.options.compiler, "-std=c++20", "-fPIC", "-fvisibility=hidden", "-DORCA_BUILD_ID=\"test\"",
                        f"-ffile-prefix-map={self.root}=.", *flags, "-isystem", self.options.build / "idl/include", *more,
                        "-c", source, "-o", out], check=True, cwd=self.root)
        return out

    def layouts(self):
        """Type -> hash, from the same steps as the build's."""
        is_clang = "clang" in subprocess.run([self.options.compiler, "--version"], check=True, capture_output=True,
                                             text=True).stdout
        probe = self.compile("cmake/plugin/layout_probe.cpp", self.root / "probe.o", "-O0", "-g2", "-gdwarf-4",
                             "-fno-eliminate-unused-debug-types",
                             "-fstandalone-debug" if is_clang else "-femit-class-debug-always")
        header = self.root / "generated/orca/component/generated/plugin_layouts.hpp"
        header.parent.mkdir(parents=True, exist_ok=True)
        subprocess.run([sys.executable, "-B", "cmake/plugin/list_layouts.py", "--readelf", self.options.readelf,
                        "--object", probe, "--out", header], check=True, cwd=self.root)
        return read_layouts(header)

    def plugin(self):
        """A plugin with the table of the last layouts()."""
        (self.root / "old.cpp").write_text(COMPONENT, encoding="utf-8")
        entry = self.compile("cmake/plugin/plugin_entry.cpp", self.root / "entry.o", f"-I{self.root / 'generated'}")
        component = self.root / "old.o"
        if not component.exists():
            self.compile("old.cpp", component, "-fno-gnu-unique")
        out = self.root / "old.so"
        subprocess.run([self.options.compiler, "-shared", "-o", out, entry, component,
                        f"-Wl,--version-script={self.root / 'cmake/plugin/plugin.map'}"], check=True)
        return out


def read_layouts(header):
    lines = re.findall(r'^    "(.+) ([0-9a-f]{16})\\0"', header.read_text(encoding="utf-8"), re.MULTILINE)
    return dict(lines)


def reachable(tree):
    """The public headers of Orca that the roots include, directly or not."""
    found, left = {}, list(ROOTS)
    while left:
        name = left.pop()
        places = [tree.root / folder / "include" / name for folder in INCLUDES]
        path = next((place for place in places if place.exists()), None)
        if name in found or path is None:  # generated headers hold objects, which have hashes of their own
            continue
        found[name] = path.read_text(encoding="utf-8")
        left += re.findall(r'#include "(orca/[^"]+)"', found[name])
    return found


def unlisted(tree, layouts):
    """The classes in reachable headers of which the table has nothing."""
    listed = {re.sub(r"<.*", "", name).split("::")[-1] for name in layouts}
    define = re.compile(r"^(?:class|struct|union) (?:alignas\(\w+\) )?(\w+)(?: final)?(?: :[^;{]*)? ?\{", re.MULTILINE)
    return sorted(f"{header}: {name}" for header, text in reachable(tree).items() for name in define.findall(text)
                  if name not in listed)


def check_inside(tree):
    before = tree.compile(PLUGIN, tree.root / "plugin.o", "-O1").read_bytes()
    layouts = tree.layouts()
    for path, place in INSIDE:
        tree.add(path, place, MEMBER)
    after = tree.compile(PLUGIN, tree.root / "plugin.o", "-O1").read_bytes()
    expect(before == after, "private members of endpoints, queues and host change no byte of a plugin")
    expect(tree.layouts() == layouts, "and no layout that plugins depend on")
    for path, _ in INSIDE:
        tree.restore(path)


def describe(options, plugin):
    result = subprocess.run([options.deployer, "--describe", plugin], capture_output=True, text=True)
    return result.returncode, result.stdout + result.stderr


def check_across(tree, options):
    ours = read_layouts(options.build / "layouts/include/orca/component/generated/plugin_layouts.hpp")
    expect(tree.layouts() == ours, "a copy of the tree has the layouts of the build")
    expect("other layouts" not in describe(options, tree.plugin())[1], "a plugin with the same layouts fits")
    for name, path, place, text in ACROSS:
        tree.add(path, place, text)
        theirs = tree.layouts()
        status, words = describe(options, tree.plugin())
        expect(status != 0 and f"{name} ({theirs[name]} in the plugin, {ours[name]} in this Orca)" in words,
               f"with {text.strip()!r} in {name} the plugin is refused, with type and hashes: {words.strip()[:200]}")
        tree.restore(path)


def check_completeness(tree):
    expect(unlisted(tree, tree.layouts()) == [], f"each class that a plugin can reach is listed: "
                                                 f"{unlisted(tree, tree.layouts())}")
    path = f"{API}/outcome.hpp"
    tree.add(path, "struct [[nodiscard]] Outcome", "struct Fresh {\n  int value;\n};\n")
    tree.add(path, "struct [[nodiscard]] Outcome", "template <class T>\nstruct FreshTemplate {\n  T value;\n};\n")
    layouts = tree.layouts()
    expect("orca::Fresh" in layouts, "a new class is listed without anybody's doing")
    expect(unlisted(tree, layouts) == ["orca/component/outcome.hpp: FreshTemplate"],
           "a new class template that layout_probe.cpp does not name is noticed")
    tree.restore(path)


def main():
    parser = argparse.ArgumentParser()
    for option in ("--source", "--build", "--compiler", "--readelf", "--deployer"):
        parser.add_argument(option, required=True, type=Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        tree = Tree(options, Path(folder).resolve())
        check_inside(tree)
        check_across(tree, options)
        check_completeness(tree)
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
