// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <linux/filter.h>
#include <linux/seccomp.h>

#include <cerrno>
#include <cstdint>
#include <initializer_list>
#include <vector>

namespace orca {

/// A program by which the kernel decides about each system call (seccomp). Calls without a rule are allowed.
///
/// Thread contract: not synchronised.
class CallFilter {
 public:
  static constexpr std::uint32_t kAllow = SECCOMP_RET_ALLOW;
  static constexpr std::uint32_t kTrap = SECCOMP_RET_TRAP;                   ///< The thread gets SIGSYS.
  static constexpr std::uint32_t kRefuse = SECCOMP_RET_ERRNO | EPERM;        ///< The call fails with EPERM.
  static constexpr std::uint32_t kAsIfUnknown = SECCOMP_RET_ERRNO | ENOSYS;  ///< The call fails with ENOSYS.
  static constexpr std::uint32_t kAllBits = ~std::uint32_t{0};

  /// @param foreign  the verdict on calls in the form of another processor, such as those of 32 bits.
  explicit CallFilter(std::uint32_t foreign);

  /// Returns whether filters are known for this processor. Without, install() always fails.
  [[nodiscard]] static bool is_known_here();

  /// Decides about a call whatever its arguments are.
  /// @param call  its number, such as SYS_ptrace.
  void decide(int call, std::uint32_t verdict);
  /// Gives a call the verdict `otherwise` unless the bits `mask` of an argument have one of the values. Later rules say nothing
  /// of this call.
  void allow_only(int call, unsigned argument, std::uint32_t mask,
                  std::initializer_list<std::uint32_t> values, std::uint32_t otherwise);
  /// Gives a call the verdict if an argument has one of the values in its lower 32 bits.
  void decide_if(int call, unsigned argument, std::initializer_list<std::uint32_t> values,
                 std::uint32_t verdict);

  /// Filters the calls of the calling thread and of all that it starts, for good, also of programs that they run, which get no
  /// rights that this one does not have.
  /// @return false with errno.
  /// @thread  any; it makes system calls only, so that a child may call it between fork and exec.
  [[nodiscard]] bool install() const noexcept;

 private:
  void load(std::size_t offset);
  void load_argument(unsigned argument);
  void add(int code, std::uint32_t value);
  void add_jump(int test, std::uint32_t value, std::uint8_t if_true, std::uint8_t if_false);

  std::vector<sock_filter> code_;  // the last one allows
};

}  // namespace orca
