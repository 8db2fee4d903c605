// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cfenv>
#include <cstdint>

namespace orca::host {

#if defined(__x86_64__)

/// Returns how this thread computes: rounding, traps and the treatment of tiny numbers, without the flags
/// that every computation sets. It is faster than fegetenv().
/// @source  Intel 64 and IA-32 Architectures Software Developer's Manual, vol. 1, 8.1.5 and 10.2.3.
inline std::uint32_t floating_point_control() {
  std::uint16_t x87 = 0;
  asm volatile("fnstcw %0" : "=m"(x87));
  constexpr std::uint32_t kFlags = 0x3f;
  return (__builtin_ia32_stmxcsr() & ~kFlags) | static_cast<std::uint32_t>(x87) << 16;
}

inline void set_floating_point_control(std::uint32_t control) {
  const auto x87 = static_cast<std::uint16_t>(control >> 16);
  asm volatile("fldcw %0" : : "m"(x87));
  __builtin_ia32_ldmxcsr(control & 0xffffU);
}

#else

/// Returns how this thread rounds. There is no portable way to see more on other processors.
inline std::uint32_t floating_point_control() { return static_cast<std::uint32_t>(std::fegetround()); }
inline void set_floating_point_control(std::uint32_t control) { std::fesetround(static_cast<int>(control)); }

#endif

}  // namespace orca::host
