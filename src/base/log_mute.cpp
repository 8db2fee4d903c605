// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/log_mute.hpp"

#include <atomic>

namespace orca::log {
namespace {

std::atomic<bool> g_muted{false};

}  // namespace

void mute() { g_muted = true; }
bool is_muted() { return g_muted; }

}  // namespace orca::log
