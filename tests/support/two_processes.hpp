// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <new>
#include <utility>

#include "orca/patterns/shm/shm_edges.hpp"
#include "peer.hpp"

namespace orca::test {

/// A page that this process shares with those that it forks: the doorbells of both sides.
struct RunPage {
  DoorbellWord parent{0};
  DoorbellWord child{0};
};

class SharedPage {
 public:
  SharedPage()
      : page_(*new (mmap(nullptr, sizeof(RunPage), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0))
                  RunPage) {}
  ~SharedPage() { munmap(&page_, sizeof(RunPage)); }
  SharedPage(const SharedPage&) = delete;
  SharedPage& operator=(const SharedPage&) = delete;
  RunPage* operator->() { return &page_; }

 private:
  RunPage& page_;
};

/// Another process, which runs `body` on an executive of its own. The destructor kills it.
/// @pre  this process has one thread.
class OtherProcess {
 public:
  explicit OtherProcess(const std::function<void(Executive&)>& body) : pid_(fork()) {
    if (pid_ != 0) return;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const auto executive = make_executive({}).value();
    executive->run([&] { body(*executive); });
    _exit(0);
  }
  ~OtherProcess() { kill_now(); }
  OtherProcess(const OtherProcess&) = delete;
  OtherProcess& operator=(const OtherProcess&) = delete;

  void kill_now() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    waitpid(std::exchange(pid_, -1), nullptr, 0);
  }
  /// Waits until it has ended.
  /// @return its exit status; -1 if a signal ended it.
  int join() {
    int status = 0;
    waitpid(std::exchange(pid_, -1), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  pid_t pid_;
};

inline RingSegment map(const MemoryFile& file) { return RingSegment::map(file.descriptor()).value(); }

/// Lets the task that calls it act for a peer until it is killed: it handles everything that arrives.
[[noreturn]] inline void serve_for_ever(Peer& peer) {
  peer.open();
  for (;;)
    if (!peer.handle_one()) peer.strand().pause_until(kForever);
}

}  // namespace orca::test
