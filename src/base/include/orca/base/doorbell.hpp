// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>

namespace orca {

/// A word in memory that several processes share, by which each of them can wake a sleeper in another. Zero is its
/// value before first use. One event owns it at a time; whatever an owner that was killed has left there, the next
/// one starts as if the bell had been rung.
using DoorbellWord = std::atomic<std::uint32_t>;
static_assert(DoorbellWord::is_always_lock_free && sizeof(DoorbellWord) == sizeof(std::uint32_t));

/// Notifies the event that owns the word, in whatever process it is. Costs a system call only if somebody sleeps.
/// @thread  any; also while no event owns the word.
void ring(DoorbellWord& word);

}  // namespace orca
