// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cstddef>

#include "orca/idl/generated/system.reflection.hpp"
#include "orca/idl/system.hpp"

namespace orca {

std::string kind_text(idl::AlarmKind kind) {
  return std::string(EnumReflection<idl::AlarmKind>::names.at(static_cast<std::size_t>(kind)));
}

std::string kind_text(const idl::Alarm& alarm) {
  return alarm.kind() == idl::OWN_KIND ? alarm.own_kind() : kind_text(alarm.kind());
}

}  // namespace orca
