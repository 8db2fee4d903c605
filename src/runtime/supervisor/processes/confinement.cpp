// SPDX-License-Identifier: LGPL-3.0-or-later
#include "processes/confinement.hpp"

#include <fcntl.h>
#include <linux/landlock.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include "orca/base/exhaustion.hpp"
#include "orca/base/files/own_folder.hpp"
#include "orca/supervisor/confinement_gaps.hpp"

namespace orca::supervisor {
namespace {

// ---- seccomp

// Powers over the kernel, over other processes and over the name spaces of the system. EPERM is what a user without these rights gets
// as well, so that libraries know it.
constexpr int kRefused[] = {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    SYS_ptrace,  // leaks are found with it
    SYS_personality,
#endif
#if defined(__x86_64__)
    SYS_ioperm,
    SYS_iopl,
    SYS_uselib,
    SYS_create_module,
    SYS_kexec_file_load,
#endif
    SYS_process_vm_writev,
    SYS_process_madvise,
    SYS_pidfd_getfd,
    SYS_kcmp,
    SYS_mount,
    SYS_umount2,
    SYS_pivot_root,
    SYS_chroot,
    SYS_move_mount,
    SYS_open_tree,
    SYS_fsopen,
    SYS_fsconfig,
    SYS_fsmount,
    SYS_fspick,
    SYS_mount_setattr,
    SYS_open_by_handle_at,
    SYS_unshare,
    SYS_setns,
    SYS_init_module,
    SYS_finit_module,
    SYS_delete_module,
    SYS_kexec_load,
    SYS_reboot,
    SYS_swapon,
    SYS_swapoff,
    SYS_acct,
    SYS_quotactl,
    SYS_syslog,
    SYS_sethostname,
    SYS_setdomainname,
    SYS_settimeofday,
    SYS_clock_settime,
    SYS_bpf,
    SYS_perf_event_open,
    SYS_userfaultfd,
    SYS_io_uring_setup,
    SYS_io_uring_enter,
    SYS_io_uring_register,
    SYS_add_key,
    SYS_request_key,
    SYS_keyctl};

constexpr std::uint32_t kNewSpaces =
    CLONE_NEWNS | CLONE_NEWCGROUP | CLONE_NEWUTS | CLONE_NEWIPC | CLONE_NEWUSER | CLONE_NEWPID | CLONE_NEWNET;

CallFilter call_filter() {
  CallFilter filter(CallFilter::kRefuse);
  for (const int call : kRefused) filter.decide(call, CallFilter::kRefuse);
  filter.allow_only(SYS_clone, 0, kNewSpaces, {0}, CallFilter::kRefuse);
  filter.decide(SYS_clone3, CallFilter::kAsIfUnknown);  // as clone(), but the flags are in memory
  filter.decide_if(SYS_ioctl, 1, {TIOCSTI, TIOCLINUX}, CallFilter::kRefuse);  // they type into a terminal
  filter.allow_only(SYS_prlimit64, 0, CallFilter::kAllBits, {0},
                    CallFilter::kRefuse);  // limits of other processes
  return filter;
}

// ---- Landlock. Debian 12's header ends before the parts that newer kernels have.

struct RulesetAttributes {
  std::uint64_t files;
  std::uint64_t network;
  std::uint64_t scoped;
};
constexpr std::uint64_t kSignals = 1U << 1;      // LANDLOCK_SCOPE_SIGNAL
constexpr std::uint64_t kTruncate = 1ULL << 14;  // LANDLOCK_ACCESS_FS_TRUNCATE
constexpr int kWithMoves = 2;                    // the versions that have them
constexpr int kWithTruncate = 3;
constexpr int kWithSignals = 6;

constexpr std::uint64_t kMakeOrRemove =
    LANDLOCK_ACCESS_FS_REMOVE_DIR | LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_MAKE_CHAR |
    LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_MAKE_REG | LANDLOCK_ACCESS_FS_MAKE_SOCK |
    LANDLOCK_ACCESS_FS_MAKE_FIFO | LANDLOCK_ACCESS_FS_MAKE_BLOCK | LANDLOCK_ACCESS_FS_MAKE_SYM;
constexpr std::uint64_t kWrite = LANDLOCK_ACCESS_FS_WRITE_FILE | kTruncate;
constexpr std::uint64_t kEverything = kWrite | kMakeOrRemove | LANDLOCK_ACCESS_FS_REFER;

int landlock_version() {
  return static_cast<int>(syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION));
}

std::uint64_t known_rights(int version) {
  std::uint64_t rights = kEverything;
  if (version < kWithMoves) rights &= ~std::uint64_t{LANDLOCK_ACCESS_FS_REFER};
  if (version < kWithTruncate) rights &= ~kTruncate;
  return rights;
}

// Gives rights to a file, or to a folder and all below it. Refused, such as for a pipe, nobody needs them.
void add_rule(int rules, int place, std::uint64_t rights) noexcept {
  const landlock_path_beneath_attr rule{rights, place};
  (void)syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
}

class Rules {
 public:
  explicit Rules(int version) : known_(known_rights(version)) {
    const RulesetAttributes attributes{known_, 0, version < kWithSignals ? 0 : kSignals};
    rules_ =
        Descriptor(static_cast<int>(syscall(SYS_landlock_create_ruleset, &attributes, sizeof attributes, 0)));
  }

  void allow(const std::string& path, std::uint64_t rights) {
    const Descriptor place(open(path.c_str(), O_PATH | O_CLOEXEC));
    if (place)
      allow(place.number(), rights);
    else
      throw_if_exhausted(errno);
  }
  void allow(int place, std::uint64_t rights) {
    struct stat facts {};
    const bool is_folder = fstat(place, &facts) == 0 && S_ISDIR(facts.st_mode);
    add_rule(rules_.number(), place, rights & known_ & (is_folder ? kEverything : kWrite));
  }
  [[nodiscard]] Descriptor take() { return std::move(rules_); }

 private:
  const std::uint64_t known_;
  Descriptor rules_;
};

Descriptor landlock_rules(const HostStart& start) {
  const int version = landlock_version();
  if (version < 1) return {};
  Rules rules(version);
  rules.allow("/dev", kWrite);
  rules.allow("/sys", kWrite);
  rules.allow("/dev/shm", kEverything);
  rules.allow("/tmp", kEverything);
  if (const char* const temporary = std::getenv("TMPDIR")) rules.allow(temporary, kEverything);
  // Meeting places and lines of emulated devices.
  if (const Result<OwnFolder> own = OwnFolder::open()) rules.allow(own->path(), kEverything);
  if (const Result<OwnFolder> kept = OwnFolder::make_for_components()) rules.allow(kept->path(), kEverything);
  for (const std::string& place : start.writable) rules.allow(place, kEverything);
  for (const int descriptor : start.kept) rules.allow(descriptor, kWrite);
  return rules.take();
}

}  // namespace

Confinement::Confinement(const HostStart& start) : calls_(call_filter()), rules_(landlock_rules(start)) {}

bool Confinement::enter() const noexcept {
  if (rules_) {
    const int self = open("/proc/self", O_PATH | O_CLOEXEC);  // for the names of its threads
    add_rule(rules_.number(), self, LANDLOCK_ACCESS_FS_WRITE_FILE);
    if (self >= 0) close(self);
    if (syscall(SYS_landlock_restrict_self, rules_.number(), 0) != 0) return false;
  }
  return !CallFilter::is_known_here() || calls_.install();
}

std::string confinement_gaps() {
  const int version = landlock_version();
  std::string gaps;
  const auto add = [&gaps](const char* gap) { gaps += (gaps.empty() ? "" : ", ") + std::string(gap); };
  if (!CallFilter::is_known_here()) add("calls of the kernel that no component needs");
  if (version < 1) add("writing files anywhere, debugging other processes");
  if (version >= 1 && version < kWithTruncate) add("emptying files anywhere");
  if (version < kWithSignals) add("signals to other processes of this user");
  return gaps;
}

}  // namespace orca::supervisor
