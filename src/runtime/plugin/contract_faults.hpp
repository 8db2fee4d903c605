// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orca/base/contract.hpp"

namespace orca::plugin {

/// Returns what is wrong with the ports and parameters that a type declares, each as a sentence that says what to do:
/// names that are there twice or that a graph cannot write, units that do not exist, defaults outside their range.
[[nodiscard]] std::vector<std::string> faults_of(const Contract& contract);

}  // namespace orca::plugin
