// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/time.hpp"

namespace orca::host {

/// The ways in which a component can be made to fail on purpose.
enum class Failure {
  silent,  ///< It does nothing any more: no lap and no handler. What its hardware pushes by itself goes on.
  throws,  ///< Its next lap or handler throws.
  hang,    ///< Its next lap or handler does not return while the run lasts.
  slow,    ///< Each lap and handler begins nine of its periods late; 0.9 s if it has no period.
};

/// Returns the failure that people call by this name; nothing if there is none.
[[nodiscard]] std::optional<Failure> failure_from(std::string_view name);
[[nodiscard]] const std::vector<std::string>& failure_names();

/// A failure on purpose, to see what the rest of the system makes of it.
struct PlannedFailure {
  std::string component;  ///< Its name in the graph.
  Failure failure = Failure::silent;
  Duration at{0};  ///< When it begins [s after the components began to work].
};

}  // namespace orca::host
