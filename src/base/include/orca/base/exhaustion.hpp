// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <exception>

#include "orca/base/result.hpp"

namespace orca {

/// Exhaustion: the system gives this process no more memory, threads, processes or descriptors. Nobody near the
/// place can do anything about it, so it travels as an exception: std::bad_alloc, or std::system_error with the
/// system's number.

/// The sentence for people about lack of memory, with what to do.
inline constexpr const char* kNoMemoryText =
    "the system gives no more memory; end other programs, or raise the limit of this one (ulimit -v)";

/// Throws std::system_error if the number, from errno, means exhaustion. Otherwise it does nothing.
/// @thread  any.
void throw_if_exhausted(int error_number);

/// Returns the sentence for people if the exception means exhaustion, with what to do; null if it means something
/// else. It allocates nothing.
/// @thread  any.
[[nodiscard]] const char* exhaustion_text(const std::exception_ptr& thrown) noexcept;

/// Calls a function that returns a Status or a Result, where exhaustion is no reason to give everything up.
/// @errors  those of the function; unavailable, with the sentence for people, for exhaustion. Other exceptions pass.
/// @thread  as the function.
template <class Function>
auto contain_exhaustion(const Function& function) -> decltype(function()) {
  try {
    return function();
  } catch (...) {
    const char* const text = exhaustion_text(std::current_exception());
    if (text == nullptr) throw;
    return fail(Code::unavailable, text);
  }
}

}  // namespace orca
