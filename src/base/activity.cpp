// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/activity.hpp"

#include <utility>

namespace orca {

[[gnu::tls_model("initial-exec")]] static thread_local const Activity* t_current = nullptr;

Activity::Activity(const char* who, Hook hook, const void* code, const char* port) noexcept
    : who_(who), hook_(hook), code_(code), port_(port), outer_(std::exchange(t_current, this)) {}

Activity::~Activity() { t_current = outer_; }

const Activity* Activity::current() noexcept { return t_current; }

void ActivityKeeper::keep() noexcept { kept_ = t_current; }

void ActivityKeeper::restore() const noexcept { t_current = kept_; }

}  // namespace orca
