// SPDX-License-Identifier: LGPL-3.0-or-later
// Added to every plugin by orca_add_component(). It exports the table of the plugin's types. It also keeps
// the layouts that the plugin was built with, of the objects and of all else that crosses the plugin boundary,
// so that a loader with other layouts can report what has changed.
#include "orca/component/generated/plugin_layouts.hpp"
#include "orca/component/manifest.hpp"
#include "orca/idl/generated/object_layouts.hpp"

extern "C" {
// Set by the linker: the bounds of the section in which ORCA_COMPONENT and ORCA_HARDWARE collect their
// entries.
[[gnu::visibility("hidden")]] extern const orca::TypeEntry* const __start_orca_types[];
[[gnu::visibility("hidden")]] extern const orca::TypeEntry* const __stop_orca_types[];

[[gnu::visibility("default")]] extern const orca::Manifest orca_plugin_manifest;
const orca::Manifest orca_plugin_manifest{
    orca::kAbiVersion, sizeof(orca::Manifest), orca::detail::plugin_layouts_hash,
    ORCA_BUILD_ID,     __start_orca_types,     __stop_orca_types};
}

namespace {

[[gnu::section("orca_layouts"), gnu::used, gnu::retain]] constexpr auto layouts =
    orca::detail::object_layouts;
[[gnu::section("orca_plugin_layouts"), gnu::used, gnu::retain]] constexpr auto plugin_layouts =
    orca::detail::plugin_layouts;

}  // namespace
