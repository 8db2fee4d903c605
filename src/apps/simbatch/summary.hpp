// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <string>
#include <vector>

#include "orca/batch/store.hpp"

namespace orca::simbatch {

/// Returns what results come to, for people: how often each variant succeeds, with an interval over worlds and seeds; and for
/// each two variants whether they differ in that, by the runs with the same world and seed (McNemar's test, Holm's correction over all
/// pairs, hierarchical bootstrap).
/// @param rows  ordered by variant, world and seed.
[[nodiscard]] std::string summary_text(const std::vector<batch::Row>& rows);

}  // namespace orca::simbatch
