// SPDX-License-Identifier: LGPL-3.0-or-later
#include "processes/launch.hpp"

#include <fcntl.h>
#include <linux/capability.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>
#include <tuple>
#include <utility>

#include "orca/base/exhaustion.hpp"
#include "processes/confinement.hpp"

namespace orca::supervisor {
namespace {

constexpr int kPipeBytes = 1 << 20;  // what a process may print before somebody reads it
constexpr int kAboveAll = 10;        // descriptors from here on are in nobody's way in the child
constexpr int kExecFailed = 127;

// What can fail in the child before the new program runs.
enum class Step : int { descriptors, data_limit, processors, priority, confinement, exec };
struct StepFault {
  Step step;
  int reason;  // errno
};

// Everything that the child needs, made before fork(): the child may only make system calls.
struct Child {
  Descriptor input;    // its stdin
  Descriptor output;   // its stdout and stderr
  Descriptor channel;  // its end of the control channel
  Descriptor faults;   // takes StepFaults; closed by exec
  std::vector<Descriptor> kept;
  std::vector<char*> arguments;
  cpu_set_t processors;
};

[[noreturn]] void throw_system(int reason) { throw std::system_error(reason, std::generic_category()); }

Descriptor checked(int number) {
  if (number < 0) throw_system(errno);
  return Descriptor(number);
}

// A copy of a descriptor with a number that is in nobody's way. A limit below that number is EINVAL.
Descriptor above_all(int descriptor) {
  const int copy = fcntl(descriptor, F_DUPFD_CLOEXEC, kAboveAll);
  if (copy < 0) throw_system(errno == EINVAL ? EMFILE : errno);
  return Descriptor(copy);
}

// A pipe, both ends above the numbers that a child gives to its own descriptors.
std::pair<Descriptor, Descriptor> make_pipe(int flags) {
  int ends[2] = {-1, -1};
  if (pipe2(ends, O_CLOEXEC | flags) != 0) throw_system(errno);
  const Descriptor read_end(ends[0]);
  const Descriptor write_end(ends[1]);
  return {above_all(ends[0]), above_all(ends[1])};
}

cpu_set_t set_of(const std::vector<int>& processors) {
  cpu_set_t set;
  CPU_ZERO(&set);
  for (const int processor : processors)
    if (processor >= 0 && processor < CPU_SETSIZE) CPU_SET(static_cast<unsigned>(processor), &set);
  return set;
}

// The functions below run in the child, between fork and exec.

void report(const Child& child, Step step) {
  const StepFault fault{step, errno};
  if (write(child.faults.number(), &fault, sizeof fault) < 0) _exit(kExecFailed);
}

void reset_signals() {
  struct sigaction action {};
  action.sa_handler = SIG_DFL;
  for (int signal = 1; signal <= SIGRTMAX; ++signal) sigaction(signal, &action, nullptr);
  action.sa_handler = SIG_IGN;
  for (const int signal : {SIGINT, SIGQUIT, SIGHUP}) sigaction(signal, &action, nullptr);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
}

bool arrange_descriptors(const Child& child) {
  int next = static_cast<int>(kFirstKept);
  for (const Descriptor& kept : child.kept)
    if (dup2(kept.number(), next++) < 0) return false;
  return dup2(child.input.number(), STDIN_FILENO) >= 0 && dup2(child.output.number(), STDOUT_FILENO) >= 0 &&
         dup2(child.output.number(), STDERR_FILENO) >= 0 &&
         dup2(child.channel.number(), kChannelNumber) >= 0 &&
         close_range(static_cast<unsigned>(next), ~0U, CLOSE_RANGE_CLOEXEC) == 0;
}

void set_limits(const HostStart& start, const Child& child) {
  const rlimit data{start.data_limit.value_or(RLIM_INFINITY), start.data_limit.value_or(RLIM_INFINITY)};
  if (start.data_limit && setrlimit(RLIMIT_DATA, &data) != 0) report(child, Step::data_limit);
  if (!start.processors.empty() && sched_setaffinity(0, sizeof child.processors, &child.processors) != 0)
    report(child, Step::processors);
  const sched_param priority{start.priority};
  if (start.priority > 0 && sched_setscheduler(0, SCHED_FIFO, &priority) != 0) report(child, Step::priority);
}

// What no component needs, also where root runs the system: powers over the kernel and the machine's clock. Files, devices, networks and
// priorities stay with root. So does CAP_SYS_ADMIN, because a pseudo terminal keeps the exclusive mode of a driver that was
// killed.
constexpr int kGivenUp[] = {CAP_SYS_MODULE,   CAP_SYS_PTRACE,
                            CAP_SYS_BOOT,     CAP_SYS_CHROOT,
                            CAP_SYS_TIME,     CAP_MKNOD,
                            CAP_SETFCAP,      CAP_MAC_ADMIN,
                            CAP_MAC_OVERRIDE, CAP_AUDIT_CONTROL,
                            CAP_SYSLOG,       CAP_SETPCAP};  // the last one, without which the others
                                                             // could not go

// The program gets no rights that this one does not have, whatever it runs. A user who is not root has none of these to give up.
void give_up_rights() {
  (void)prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  for (const int capability : kGivenUp) (void)prctl(PR_CAPBSET_DROP, capability, 0, 0, 0);
}

[[noreturn]] void become(const HostStart& start, const Child& child, const Confinement& confinement) {
  reset_signals();
  if (arrange_descriptors(child)) {
    set_limits(start, child);
    give_up_rights();
    if (!confinement.enter()) report(child, Step::confinement);
    execv(start.program.c_str(), child.arguments.data());
    report(child, Step::exec);
  } else {
    report(child, Step::descriptors);
  }
  _exit(kExecFailed);
}

// Signals are blocked meanwhile: none that is sent at once reaches handlers of the supervisor in the child.
pid_t fork_and_become(const HostStart& start, const Child& child, const Confinement& confinement) {
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  const pid_t pid = fork();
  const int reason = errno;
  if (pid == 0) become(start, child, confinement);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (pid < 0) throw_system(reason);
  return pid;
}

std::string warning(const StepFault& fault) {
  const std::string reason = std::strerror(fault.reason);
  switch (fault.step) {
    case Step::data_limit: return "the memory limit is not in force: " + reason;
    case Step::processors: return "the processors are not those of the graph: " + reason;
    case Step::priority: return "the priority is not that of the graph: " + reason;
    case Step::confinement: return "what its components may do is not confined: " + reason;
    case Step::descriptors:
    case Step::exec: break;
  }
  return reason;
}

// Reads until the new program runs, or has failed to.
Status collect_faults(int faults, const HostStart& start, std::vector<std::string>& warnings) {
  StepFault fault{};
  for (ssize_t size = -1; size != 0;) {
    size = read(faults, &fault, sizeof fault);
    if (size < 0 && errno != EINTR) throw_system(errno);
    if (size <= 0) continue;
    if (fault.step == Step::exec || fault.step == Step::descriptors)
      return fail(Code::not_found, "cannot run " + start.program + ": " + warning(fault), start.name);
    warnings.push_back(warning(fault));
  }
  return ok();
}

// A descriptor for the child's stdin.
Descriptor make_input(bool shares_input) {
  if (shares_input && fcntl(STDIN_FILENO, F_GETFD) >= 0) return above_all(STDIN_FILENO);
  const Descriptor null = checked(open("/dev/null", O_RDONLY | O_CLOEXEC));
  return above_all(null.number());
}

Child make_child(const HostStart& start, const Descriptor& channel) {
  Child child{};
  child.input = make_input(start.shares_input);
  child.channel = above_all(channel.number());
  for (const std::string& argument : start.arguments)
    child.arguments.push_back(const_cast<char*>(argument.c_str()));
  child.arguments.push_back(nullptr);
  child.processors = set_of(start.processors);
  for (const int kept : start.kept) child.kept.push_back(above_all(kept));
  return child;
}

}  // namespace

Result<Launched> launch(const HostStart& start, const Descriptor& channel) {
  signal(SIGCHLD, SIG_DFL);  // if it were ignored, as a parent may have set it, no exit status would be kept
  Child child = make_child(start, channel);
  const Confinement confinement(start);
  Launched launched;
  std::tie(launched.output, child.output) = make_pipe(O_NONBLOCK);
  fcntl(launched.output.number(), F_SETPIPE_SZ, kPipeBytes);  // refused: then it has the usual size
  Descriptor faults;
  std::tie(faults, child.faults) = make_pipe(0);
  launched.pid = fork_and_become(start, child, confinement);
  child.faults.reset();
  launched.pidfd = Descriptor(static_cast<int>(syscall(SYS_pidfd_open, launched.pid, 0)));
  const int reason = errno;
  Status begun = collect_faults(faults.number(), start, launched.warnings);
  if (begun.ok() && launched.pidfd) return launched;
  kill(launched.pid, SIGKILL);
  waitpid(launched.pid, nullptr, 0);
  if (begun.ok()) throw_system(reason);
  return begun.error();
}

}  // namespace orca::supervisor
