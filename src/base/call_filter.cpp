// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/system/call_filter.hpp"

#include <linux/audit.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstddef>

namespace orca {
namespace {

#if defined(__x86_64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t kArchitecture = 0;  // unknown: no filter
#endif
constexpr std::uint32_t kX32 =
    0x40000000;  // numbers of calls from here on are another form of those of x86-64

}  // namespace

CallFilter::CallFilter(std::uint32_t foreign) : code_{{BPF_RET | BPF_K, 0, 0, kAllow}} {
  load(offsetof(seccomp_data, arch));
  add_jump(BPF_JEQ, kArchitecture, 1, 0);
  add(BPF_RET | BPF_K, foreign);
  load(offsetof(seccomp_data, nr));
  add_jump(BPF_JGE, kX32, 0, 1);
  add(BPF_RET | BPF_K, foreign);
}

bool CallFilter::is_known_here() { return kArchitecture != 0; }

void CallFilter::decide(int call, std::uint32_t verdict) {
  add_jump(BPF_JEQ, static_cast<std::uint32_t>(call), 0, 1);
  add(BPF_RET | BPF_K, verdict);
}

void CallFilter::allow_only(int call, unsigned argument, std::uint32_t mask,
                            std::initializer_list<std::uint32_t> values, std::uint32_t otherwise) {
  const auto count = static_cast<std::uint8_t>(values.size());
  add_jump(BPF_JEQ, static_cast<std::uint32_t>(call), 0, static_cast<std::uint8_t>(count + 4));
  load_argument(argument);
  add(BPF_ALU | BPF_AND | BPF_K, mask);
  std::uint8_t left = count;
  for (const std::uint32_t value : values) add_jump(BPF_JEQ, value, left--, 0);
  add(BPF_RET | BPF_K, otherwise);
  add(BPF_RET | BPF_K, kAllow);
}

void CallFilter::decide_if(int call, unsigned argument, std::initializer_list<std::uint32_t> values,
                           std::uint32_t verdict) {
  const auto count = static_cast<std::uint8_t>(values.size());
  add_jump(BPF_JEQ, static_cast<std::uint32_t>(call), 0, static_cast<std::uint8_t>(count + 3));
  load_argument(argument);
  std::uint8_t left = count;
  for (const std::uint32_t value : values) add_jump(BPF_JEQ, value, left--, 0);
  add(BPF_RET | BPF_K, kAllow);
  add(BPF_RET | BPF_K, verdict);
}

bool CallFilter::install() const noexcept {
  const sock_fprog program{static_cast<unsigned short>(code_.size()), const_cast<sock_filter*>(code_.data())};
  if (kArchitecture == 0) errno = ENOSYS;
  return kArchitecture != 0 && prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, 0, &program) == 0;
}

void CallFilter::load(std::size_t offset) {
  add(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset));
}

// The lower half: both processors keep it first.
void CallFilter::load_argument(unsigned argument) { load(offsetof(seccomp_data, args) + argument * 8); }

void CallFilter::add(int code, std::uint32_t value) {
  code_.insert(code_.end() - 1, {static_cast<std::uint16_t>(code), 0, 0, value});
}

void CallFilter::add_jump(int test, std::uint32_t value, std::uint8_t if_true, std::uint8_t if_false) {
  code_.insert(code_.end() - 1,
               {static_cast<std::uint16_t>(BPF_JMP | test | BPF_K), if_true, if_false, value});
}

}  // namespace orca
