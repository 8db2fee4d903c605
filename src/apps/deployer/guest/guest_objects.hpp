// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include "orca/base/contract.hpp"
#include "orca/base/result.hpp"
#include "orca/idl/object.hpp"
#include "packet_line.hpp"

namespace orca::guest {

// Objects as words of a packet: the name of the type, and the object as XCDR1.

/// Returns "ok" and an object; "ok" alone if there is none.
[[nodiscard]] Packet packet_of(const ObjectRef& object);

/// Returns "error" and the reason.
[[nodiscard]] inline Packet packet_of(const Error& error) { return {"error", error.message}; }

/// Reads an object of a type, or of one derived from it.
/// @errors  invalid_argument, data_loss.
[[nodiscard]] Result<ObjectLoan> object_of(const Packet& words, const TypeId& wanted);

}  // namespace orca::guest
