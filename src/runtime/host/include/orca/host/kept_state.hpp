// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "orca/component/state.hpp"

namespace orca::host {

/// What a component has saved of its state.
struct KeptState {
  StateTag tag;
  std::vector<std::byte> bytes;

  friend bool operator==(const KeptState&, const KeptState&) = default;
};

/// States by component.
using KeptStates = std::map<std::string, KeptState>;

/// A function that keeps the last state of a component outside this process. It must not block.
using StateSink = std::function<void(const std::string& component, const KeptState& state)>;

}  // namespace orca::host
