// SPDX-License-Identifier: LGPL-3.0-or-later
#include "effects.hpp"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

namespace orca::plugin {
namespace {

#if defined(__x86_64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t kArchitecture = 0;  // unknown: no filter
#endif

constexpr std::uint32_t kTrap = SECCOMP_RET_TRAP;
constexpr std::uint32_t kAllow = SECCOMP_RET_ALLOW;
constexpr std::uint32_t kAsIfUnknown = SECCOMP_RET_ERRNO | ENOSYS;

// Calls that leave a trace whatever their arguments are.
constexpr int kForbidden[] = {
#if defined(__x86_64__)
    SYS_creat,
    SYS_mkdir,
    SYS_rmdir,
    SYS_unlink,
    SYS_rename,
    SYS_link,
    SYS_symlink,
    SYS_mknod,
    SYS_chmod,
    SYS_chown,
    SYS_lchown,
    SYS_utime,
    SYS_utimes,
    SYS_futimesat,
    SYS_fork,
    SYS_vfork,
#endif
    SYS_openat2,
    SYS_mkdirat,
    SYS_unlinkat,
    SYS_renameat,
    SYS_renameat2,
    SYS_linkat,
    SYS_symlinkat,
    SYS_mknodat,
    SYS_fchmod,
    SYS_fchmodat,
    SYS_fchown,
    SYS_fchownat,
    SYS_utimensat,
    SYS_truncate,
    SYS_setxattr,
    SYS_lsetxattr,
    SYS_fsetxattr,
    SYS_mount,
    SYS_umount2,
    SYS_shmget,
    SYS_semget,
    SYS_msgget,
    SYS_mq_open,
    SYS_mq_unlink,
    SYS_connect,
    SYS_bind,
    SYS_sendmsg,
    SYS_sendmmsg,
    SYS_execve,
    SYS_execveat,
    SYS_ptrace,
    SYS_tkill,
    SYS_rt_sigqueueinfo,
    SYS_rt_tgsigqueueinfo,
    SYS_pidfd_send_signal,
    SYS_process_vm_writev,
    SYS_io_uring_setup,
    SYS_clock_settime,
    SYS_settimeofday,
    SYS_sethostname,
    SYS_reboot};

// A program for the kernel that decides about each system call.
class Filter {
 public:
  Filter() {
    add(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, arch));
    add_jump(BPF_JEQ, kArchitecture, 1, 0);
    add(BPF_RET | BPF_K, kTrap);
    load_call();
  }

  void decide(int call, std::uint32_t verdict) {
    add_jump(BPF_JEQ, static_cast<std::uint32_t>(call), 0, 1);
    add(BPF_RET | BPF_K, verdict);
  }

  /// Forbids a call unless the bits `mask` of an argument have one of the values.
  void allow_only(int call, unsigned argument, std::uint32_t mask,
                  std::initializer_list<std::uint32_t> values) {
    const auto count = static_cast<std::uint8_t>(values.size());
    add_jump(BPF_JEQ, static_cast<std::uint32_t>(call), 0, static_cast<std::uint8_t>(count + 4));
    add(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offsetof(seccomp_data, args) + argument * 8));
    add(BPF_ALU | BPF_AND | BPF_K, mask);
    std::uint8_t left = count;
    for (const std::uint32_t value : values) add_jump(BPF_JEQ, value, left--, 0);
    add(BPF_RET | BPF_K, kTrap);
    add(BPF_RET | BPF_K, kAllow);
  }

  [[nodiscard]] bool install() {
    add(BPF_RET | BPF_K, kAllow);
    const sock_fprog program{static_cast<unsigned short>(code_.size()), code_.data()};
    return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
           syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, 0, &program) == 0;
  }

 private:
  void load_call() { add(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)); }
  void add(int code, std::size_t value) {
    code_.push_back({static_cast<std::uint16_t>(code), 0, 0, static_cast<std::uint32_t>(value)});
  }
  void add_jump(int test, std::uint32_t value, std::uint8_t if_true, std::uint8_t if_false) {
    code_.push_back({static_cast<std::uint16_t>(BPF_JMP | test | BPF_K), if_true, if_false, value});
  }

  std::vector<sock_filter> code_;
};

constexpr std::uint32_t kAllBits = ~std::uint32_t{0};
constexpr std::uint32_t kWriting = O_ACCMODE | O_CREAT | O_TRUNC;

void add_calls_with_arguments(Filter& filter) {
#if defined(__x86_64__)
  filter.allow_only(SYS_open, 1, kWriting, {O_RDONLY});
#endif
  filter.allow_only(SYS_openat, 2, kWriting, {O_RDONLY});
  filter.allow_only(SYS_clone, 0, CLONE_THREAD, {CLONE_THREAD});
  filter.decide(SYS_clone3, kAsIfUnknown);  // its arguments lie in memory; the C library then takes clone()
  filter.allow_only(SYS_sendto, 4, kAllBits, {0});  // an address
  filter.allow_only(SYS_ioctl, 1, kAllBits, {TCGETS, TIOCGWINSZ, FIONREAD, FIONBIO, FIOCLEX, FIONCLEX});
  const auto self = static_cast<std::uint32_t>(getpid());
  filter.allow_only(SYS_kill, 0, kAllBits, {self});
  filter.allow_only(SYS_tgkill, 0, kAllBits, {self});
}

void (*g_last_act)(int) = nullptr;

void on_forbidden(int /*signal*/, siginfo_t* info, void* /*context*/) {
  g_last_act(info->si_syscall);
  _exit(0);
}

}  // namespace

bool forbid_effects(void (*last_act)(int)) {
  if (kArchitecture == 0) return false;
  g_last_act = last_act;
  struct sigaction action {};
  action.sa_sigaction = on_forbidden;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK;
  if (sigaction(SIGSYS, &action, nullptr) != 0) return false;
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGSYS);
  sigprocmask(SIG_UNBLOCK, &set, nullptr);
  Filter filter;
  for (const int call : kForbidden) filter.decide(call, kTrap);
  add_calls_with_arguments(filter);
  return filter.install();
}

}  // namespace orca::plugin
