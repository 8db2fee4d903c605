// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>

#include "orca/batch/experiment.hpp"
#include "orca/xml/attributes.hpp"
#include "orca/xml/reporter.hpp"

namespace orca::batch {

/// Reads a <tune>; nothing if it is wrong, which is reported.
[[nodiscard]] std::optional<SettingRange> read_range(const xml::Attributes& element);

/// Reports each world of the tuner in which variants are compared, too. Two worlds are the same if they name the same file, with the
/// same number if it has one, or if all their settings are equal.
void check_held_out(const Experiment& experiment, xml::Reporter& reporter);

}  // namespace orca::batch
