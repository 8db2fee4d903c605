// SPDX-License-Identifier: GPL-3.0-or-later
// A plugin whose manifest was built for another runtime.
#include "orca/component/manifest.hpp"

extern "C" {
[[gnu::visibility("default")]] extern const orca::Manifest orca_plugin_manifest;
const orca::Manifest orca_plugin_manifest{TEST_ABI_VERSION, TEST_MANIFEST_SIZE, 0, "test", nullptr, nullptr};
}
