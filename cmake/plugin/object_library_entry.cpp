// SPDX-License-Identifier: LGPL-3.0-or-later
// Added to every library of object types by orca_generate_idl(). It marks the library as one, and keeps the layouts that it was built
// with, so that a loader with other layouts can report what has changed.
#include "orca/component/generated/plugin_layouts.hpp"

extern "C" {
[[gnu::visibility("default")]] extern const int orca_object_library;
const int orca_object_library = 1;
}

namespace {

[[gnu::section("orca_plugin_layouts"), gnu::used, gnu::retain]] constexpr auto plugin_layouts =
    orca::detail::plugin_layouts;

}  // namespace
