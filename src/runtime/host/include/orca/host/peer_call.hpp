// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "orca/component/host.hpp"

namespace orca::host {

/// An order of a component about another one, on its way to who carries it out. A plain value.
struct PeerCall {
  std::string by;            ///< The component that orders.
  std::uint64_t number = 0;  ///< Of the order, among those of the component.
  PeerSetting setting;
};

}  // namespace orca::host
