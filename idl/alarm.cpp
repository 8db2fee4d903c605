// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cstddef>

#include "orca/idl/generated/system.reflection.hpp"
#include "orca/idl/system.hpp"

namespace orca {

std::string kind_text(idl::AlarmKind kind) {
  constexpr auto& kNames = EnumReflection<idl::AlarmKind>::names;
  const auto index = static_cast<std::size_t>(kind);
  return index < kNames.size() ? std::string(kNames[index]) : "unknown " + std::to_string(index);
}

std::string kind_text(const idl::Alarm& alarm) {
  return alarm.kind() == idl::OWN_KIND ? alarm.own_kind() : kind_text(alarm.kind());
}

}  // namespace orca
