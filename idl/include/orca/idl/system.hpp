// SPDX-License-Identifier: LGPL-3.0-or-later
/// @file
/// Ask, ClientList, LogRecord, Alarm and its kind as text. idl/orca/system.idl gives the meaning, unit and frame of each field.
#pragma once

#include <string>

#include "orca/idl/generated/system.h"
#include "orca/idl/generated/system.types.hpp"
#include "orca/idl/object.hpp"

namespace orca {

/// Returns the kind of an alarm in capitals: "SIGNAL_MASK", the name of a component's own, or "unknown 99" for no kind.
/// @thread  pure function, as the next; any thread.
[[nodiscard]] std::string kind_text(const idl::Alarm& alarm);
[[nodiscard]] std::string kind_text(idl::AlarmKind kind);

}  // namespace orca
