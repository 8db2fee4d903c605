// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "crypto.hpp"
#include "orca/keys/permit.hpp"

namespace orca::keys {

/// Returns the rules for all participants of a system, as DDS Security wants them (DDS Security 1.1, 9.4.1.2): nobody
/// without a certificate, everything encrypted.
[[nodiscard]] std::string governance();

/// Returns what one participant may do (DDS Security 1.1, 9.4.1.3).
/// @param subject  the whole name of its certificate.
[[nodiscard]] std::string permissions(const std::string& subject, const Permit& permit, const Span& span);

}  // namespace orca::keys
