// SPDX-License-Identifier: GPL-3.0-or-later
#include <dirent.h>
#include <fcntl.h>
#include <linux/bpf.h>
#include <linux/perf_event.h>
#include <sched.h>
#include <signal.h>
#include <spawn.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <map>
#include <set>
#include <string>

#include "orca/component.hpp"

extern char** environ;

namespace {

namespace fs = std::filesystem;

/// Tries once, from within a host process, what no component may do: to other processes of the system, to files outside its folders and
/// to the kernel. Each attempt is a line, "attack KIND NAME: refused" or "attack KIND NAME: NOT refused, ERROR". What is not refused does no
/// harm to anything but the system and the files of the test: arguments for the kernel are nonsense.
class Attacker final : public orca::Component {
 public:
  explicit Attacker(orca::ComponentHost& host) : Component(host) {
    lap_every(std::chrono::milliseconds(100));
  }

 private:
  orca::Status configure() override {
    stay_active(true);
    return orca::ok();
  }

  orca::Outcome work() override {
    if (done_) return orca::again();
    done_ = true;
    supervisor_ = getppid();
    for (const auto& [name, pid] : targets()) {
      attack_with_signals(name, pid);
      attack_memory(name, pid);
    }
    attack_files(*precious_);
    attack_kernel();
    attack_by_programs();
    log_info("attacks are over: " + std::to_string(count_));
    return orca::again();
  }

  // Notes an attempt that returns -1 with errno, as system calls do.
  void note(const std::string& kind, const std::string& name, long result) {
    const int reason = errno;
    ++count_;
    const bool is_refused = result == -1 && (reason == EPERM || reason == EACCES || reason == EXDEV ||
                                             (reason == ENOSYS && name == "clone3"));
    const std::string outcome =
        is_refused ? "refused" : "NOT refused, " + std::string(result == -1 ? std::strerror(reason) : "done");
    log_info("attack " + kind + " " + name + ": " + outcome);
  }

  // The supervisor and the other processes that it has started.
  std::map<std::string, pid_t> targets() const {
    std::map<std::string, pid_t> all{{"supervisor", supervisor_}};
    for (const fs::directory_entry& entry : fs::directory_iterator("/proc")) {
      const pid_t pid = std::atoi(entry.path().filename().c_str());
      std::string number, name, state;
      pid_t parent = 0;
      std::ifstream stat(entry.path() / "stat");
      if (pid > 0 && pid != getpid() && stat >> number >> name >> state >> parent && parent == supervisor_)
        all[name] = pid;
    }
    return all;
  }

  void attack_with_signals(const std::string& name, pid_t pid) {
    const int pidfd = static_cast<int>(syscall(SYS_pidfd_open, pid, 0));
    siginfo_t info{};
    info.si_code = SI_QUEUE;
    for (const int number : {0, SIGKILL, SIGSTOP, SIGTERM, SIGINT, SIGSEGV, SIGABRT, SIGUSR1, SIGCONT}) {
      const std::string what = name + " " + std::to_string(number);
      note("signal", "kill " + what, kill(pid, number));
      note("signal", "tgkill " + what, syscall(SYS_tgkill, pid, pid, number));
      note("signal", "tkill " + what, syscall(SYS_tkill, pid, number));
      note("signal", "sigqueue " + what, syscall(SYS_rt_sigqueueinfo, pid, number, &info));
      note("signal", "pidfd " + what, syscall(SYS_pidfd_send_signal, pidfd, number, nullptr, 0));
    }
    close(pidfd);
  }

  void attack_memory(const std::string& name, pid_t pid) {
    char byte = 0;
    const iovec here{&byte, 1};
    const iovec there{reinterpret_cast<void*>(this), 1};
    const int pidfd = static_cast<int>(syscall(SYS_pidfd_open, pid, 0));
    const rlimit tiny{0, 0};
    note("memory", "ptrace attach " + name, ptrace(PTRACE_ATTACH, pid, nullptr, nullptr));
    note("memory", "ptrace seize " + name, ptrace(PTRACE_SEIZE, pid, nullptr, nullptr));
    note("memory", "read " + name, process_vm_readv(pid, &here, 1, &there, 1, 0));
    note("memory", "write " + name, process_vm_writev(pid, &here, 1, &there, 1, 0));
    note("memory", "take descriptor of " + name, syscall(SYS_pidfd_getfd, pidfd, 3, 0));
    note("memory", "advise " + name, syscall(SYS_process_madvise, pidfd, &there, 1, MADV_COLD, 0));
    note("call", "limit " + name, prlimit(pid, RLIMIT_NOFILE, &tiny, nullptr));
    close(pidfd);
    const std::string process = "/proc/" + std::to_string(pid) + "/";
    for (const char* const file : {"mem", "maps", "environ", "fd/1", "fd/3", "oom_score_adj"})
      note("memory", "open " + std::string(file) + " of " + name, open((process + file).c_str(), O_RDWR));
  }

  void attack_files(const std::string& folder) {
    const std::string file = folder + "/precious";
    const std::string other = folder + "/other";
    const std::string mine = "/tmp/orca_attacker_" + std::to_string(getpid());
    close(open(mine.c_str(), O_CREAT | O_WRONLY, 0600));
    for (const auto& [name, flags] : std::map<std::string, int>{{"write", O_WRONLY},
                                                                {"read and write", O_RDWR},
                                                                {"append", O_WRONLY | O_APPEND},
                                                                {"empty", O_WRONLY | O_TRUNC},
                                                                {"empty by reading", O_RDONLY | O_TRUNC}}) {
      note("file", name, open(file.c_str(), flags));
      note("file", name + " by /proc", open(("/proc/self/root" + file).c_str(), flags));
    }
    const std::string link = mine + "_link";
    note("file", "write by a link",
         symlink(file.c_str(), link.c_str()) == 0 ? open(link.c_str(), O_WRONLY) : 0);
    note("file", "second name", ::link(file.c_str(), (mine + "_name").c_str()));
    note("file", "second name of mine", ::link(mine.c_str(), other.c_str()));
    note("file", "truncate", truncate(file.c_str(), 0));
    note("file", "remove", unlink(file.c_str()));
    note("file", "move away", rename(file.c_str(), (mine + "_moved").c_str()));
    note("file", "rename", rename(file.c_str(), other.c_str()));
    note("file", "replace", rename(mine.c_str(), file.c_str()));
    note("file", "exchange", syscall(SYS_renameat2, AT_FDCWD, mine.c_str(), AT_FDCWD, file.c_str(), 2));
    note("file", "make", open(other.c_str(), O_CREAT | O_WRONLY, 0600));
    note("file", "make without a name", open(folder.c_str(), O_TMPFILE | O_WRONLY, 0600));
    note("file", "make a folder", mkdir(other.c_str(), 0700));
    note("file", "remove a folder", rmdir((folder + "/empty").c_str()));
    note("file", "make a link", symlink("/etc", other.c_str()));
    note("file", "make a pipe", mkfifo(other.c_str(), 0600));
    note("file", "make a device", mknod(other.c_str(), S_IFCHR | 0600, 0x103));
    note("file", "make a socket", bind_at(other));
    const std::string home = std::getenv("HOME") != nullptr ? std::getenv("HOME") : "/root";
    for (const std::string& place :
         {home + "/.orca_attacker", std::string("/etc/orca_attacker"), std::string("/usr/lib/orca_attacker"),
          std::string("/var/tmp/orca_attacker"), fs::read_symlink("/proc/self/exe").string() + "_attacker"})
      note("file", "make " + place, open(place.c_str(), O_CREAT | O_EXCL | O_WRONLY, 0600));
    note("file", "write /proc/sys", open("/proc/sys/kernel/core_pattern", O_WRONLY));
    note("file", "write /etc/passwd", open("/etc/passwd", O_WRONLY | O_APPEND));
    for (const char* const ending : {"", "_link", "_name", "_moved"}) unlink((mine + ending).c_str());
  }

  static long bind_at(const std::string& path) {
    sockaddr_un address{AF_UNIX, {}};
    std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
    const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const int result = bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address);
    const int reason = errno;
    close(socket);
    errno = reason;
    return result;
  }

  // Without a filter these fail, too, but otherwise: with EFAULT, EINVAL or the like.
  void attack_kernel() {
    const std::map<std::string, long> calls{{"mount", SYS_mount},
                                            {"umount2", SYS_umount2},
                                            {"pivot_root", SYS_pivot_root},
                                            {"chroot", SYS_chroot},
                                            {"move_mount", SYS_move_mount},
                                            {"open_tree", SYS_open_tree},
                                            {"fsopen", SYS_fsopen},
                                            {"fsconfig", SYS_fsconfig},
                                            {"fsmount", SYS_fsmount},
                                            {"fspick", SYS_fspick},
                                            {"mount_setattr", SYS_mount_setattr},
                                            {"open_by_handle_at", SYS_open_by_handle_at},
                                            {"init_module", SYS_init_module},
                                            {"finit_module", SYS_finit_module},
                                            {"delete_module", SYS_delete_module},
                                            {"kexec_load", SYS_kexec_load},
                                            {"reboot", SYS_reboot},
                                            {"swapon", SYS_swapon},
                                            {"swapoff", SYS_swapoff},
                                            {"quotactl", SYS_quotactl},
                                            {"syslog", SYS_syslog},
                                            {"bpf", SYS_bpf},
                                            {"perf_event_open", SYS_perf_event_open},
                                            {"userfaultfd", SYS_userfaultfd},
                                            {"io_uring_setup", SYS_io_uring_setup},
                                            {"io_uring_enter", SYS_io_uring_enter},
                                            {"io_uring_register", SYS_io_uring_register},
                                            {"add_key", SYS_add_key},
                                            {"request_key", SYS_request_key},
                                            {"keyctl", SYS_keyctl},
                                            {"settimeofday", SYS_settimeofday},
                                            {"clock_settime", SYS_clock_settime},
                                            {"sethostname", SYS_sethostname},
                                            {"setdomainname", SYS_setdomainname},
                                            {"setns", SYS_setns},
                                            {"kcmp", SYS_kcmp},
                                            {"clone3", SYS_clone3}};
    constexpr long kNonsense = -1;
    for (const auto& [name, number] : calls)
      note("call", name,
           syscall(static_cast<int>(number), kNonsense, kNonsense, kNonsense, kNonsense, kNonsense));
    for (const int space :
         {CLONE_NEWUSER, CLONE_NEWNS, CLONE_NEWNET, CLONE_NEWPID, CLONE_NEWIPC, CLONE_NEWUTS}) {
      note("call", "unshare " + std::to_string(space), unshare(space));
      note("call", "clone " + std::to_string(space), syscall(SYS_clone, space | kInvalid, 0, 0, 0, 0));
    }
    char letter = 'x';
    note("call", "type into the terminal", ioctl(STDIN_FILENO, TIOCSTI, &letter));
    note("call", "type by selection", ioctl(STDIN_FILENO, TIOCLINUX, &letter));
  }

  // What it starts is confined as well.
  void attack_by_programs() {
    const std::string file = *precious_ + "/precious";
    const std::string supervisor = std::to_string(supervisor_);
    for (const std::string& command : std::initializer_list<std::string>{
             "kill -9 " + supervisor, "kill -STOP " + supervisor, "echo x > " + file, "rm -f " + file,
             "mv " + file + " /tmp", "unshare -r true", "mount -t tmpfs none /mnt"})
      note("program", command, run(command) == 0 ? 0 : -1);
  }

  // Runs a command of the shell. errno is EPERM if it ends with an error.
  static int run(const std::string& command) {
    std::string quiet = "{ " + command + "; } 2>/dev/null";
    char shell[] = "/bin/sh";
    char option[] = "-c";
    char* const arguments[] = {shell, option, quiet.data(), nullptr};
    pid_t child = -1;
    int status = 1;
    if (posix_spawn(&child, shell, nullptr, nullptr, arguments, environ) == 0) waitpid(child, &status, 0);
    errno = EPERM;
    return status;
  }

  static constexpr int kInvalid = CLONE_THREAD;  // which needs other flags, so that nothing is made

  orca::Param<std::string> precious_{*this, "precious", "", {.text = "A folder that is not its own."}};
  pid_t supervisor_ = -1;
  int count_ = 0;
  bool done_ = false;
};

}  // namespace

ORCA_COMPONENT(Attacker, "test.Attacker")
