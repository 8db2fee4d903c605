// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>

namespace orca {

/// The id of one question or sent object of one client, valid until its answer has been taken.
using RequestId = std::uint64_t;
using QueryId = RequestId;
using SendId = RequestId;

}  // namespace orca
