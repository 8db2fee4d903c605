// SPDX-License-Identifier: LGPL-3.0-or-later
#include "effects.hpp"

#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>

#include "orca/base/system/call_filter.hpp"

namespace orca::plugin {
namespace {

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

constexpr std::uint32_t kWriting = O_ACCMODE | O_CREAT | O_TRUNC;

void add_calls_with_arguments(CallFilter& filter) {
  constexpr std::uint32_t kTrap = CallFilter::kTrap;
  constexpr std::uint32_t kAllBits = CallFilter::kAllBits;
#if defined(__x86_64__)
  filter.allow_only(SYS_open, 1, kWriting, {O_RDONLY}, kTrap);
#endif
  filter.allow_only(SYS_openat, 2, kWriting, {O_RDONLY}, kTrap);
  filter.allow_only(SYS_clone, 0, CLONE_THREAD, {CLONE_THREAD}, kTrap);
  filter.decide(SYS_clone3,
                CallFilter::kAsIfUnknown);  // its arguments lie in memory; the C library then takes clone()
  filter.allow_only(SYS_sendto, 4, kAllBits, {0}, kTrap);  // an address
  filter.allow_only(SYS_ioctl, 1, kAllBits, {TCGETS, TIOCGWINSZ, FIONREAD, FIONBIO, FIOCLEX, FIONCLEX},
                    kTrap);
  const auto self = static_cast<std::uint32_t>(getpid());
  filter.allow_only(SYS_kill, 0, kAllBits, {self}, kTrap);
  filter.allow_only(SYS_tgkill, 0, kAllBits, {self}, kTrap);
}

void (*g_last_act)(int) = nullptr;

void on_forbidden(int /*signal*/, siginfo_t* info, void* /*context*/) {
  g_last_act(info->si_syscall);
  _exit(0);
}

}  // namespace

bool forbid_effects(void (*last_act)(int)) {
  if (!CallFilter::is_known_here()) return false;
  g_last_act = last_act;
  struct sigaction action {};
  action.sa_sigaction = on_forbidden;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK;
  if (sigaction(SIGSYS, &action, nullptr) != 0) return false;
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGSYS);
  sigprocmask(SIG_UNBLOCK, &set, nullptr);
  CallFilter filter(CallFilter::kTrap);
  for (const int call : kForbidden) filter.decide(call, CallFilter::kTrap);
  add_calls_with_arguments(filter);
  return filter.install();
}

}  // namespace orca::plugin
