// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

/// The one header that the author of a hardware plugin includes, besides the objects that the endpoints
/// deliver.

#include "orca/component/manifest.hpp"
#include "orca/hw/container.hpp"

/// Registers a class of this source file as a hardware type. It is used once per file, at the end.
#define ORCA_HARDWARE(Class, type_name)                                                        \
  ORCA_DETAIL_TYPE_ENTRY(                                                                      \
      {::orca::PluginKind::hardware, type_name,                                                \
       ::orca::detail::create<Class, ::orca::hw::HardwareContainer, ::orca::hw::HardwareHost>, \
       ::orca::detail::destroy<::orca::hw::HardwareContainer>})
