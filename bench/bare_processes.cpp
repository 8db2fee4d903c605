// SPDX-License-Identifier: GPL-3.0-or-later
#include "bare_processes.hpp"

#include <linux/futex.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <cstring>
#include <new>

#include "comparison.hpp"

namespace orca::bench {
namespace {

constexpr std::size_t kPlaces = 4;

void futex(std::atomic<std::uint32_t>& word, int operation, std::uint32_t value) {
  syscall(SYS_futex, &word, operation, value, nullptr, nullptr, 0);
}

}  // namespace

// Places for a few messages follow it.
struct BareProcessPair::Ring {
  alignas(64) std::atomic<std::uint32_t> put{0};     // the reader sleeps on it
  alignas(64) std::atomic<std::uint32_t> asleep{0};  // written by the reader only
  std::atomic<std::uint32_t> taken{0};
  std::byte* places() { return reinterpret_cast<std::byte*>(this + 1); }
};

BareProcessPair::BareProcessPair(std::size_t size) : size_(size), sent_(size), received_(size) {
  const std::size_t of_ring = sizeof(Ring) + kPlaces * size_ + 4096;
  memory_ = mmap(nullptr, 2 * of_ring, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  there_ = new (memory_) Ring;
  back_ = new (static_cast<std::byte*>(memory_) + of_ring / 64 * 64) Ring;
  child_ = fork();
  if (child_ == 0) echo();
}

BareProcessPair::~BareProcessPair() {
  kill(child_, SIGKILL);
  waitpid(child_, nullptr, 0);
  munmap(memory_, 2 * (sizeof(Ring) + kPlaces * size_ + 4096));
}

void BareProcessPair::put(Ring& ring, const std::vector<std::byte>& from) const {
  const std::uint32_t place = ring.put.load(std::memory_order_relaxed);
  std::memcpy(ring.places() + place % kPlaces * size_, from.data(), size_);
  ring.put.store(place + 1, std::memory_order_seq_cst);
  if (ring.asleep.load(std::memory_order_seq_cst) != 0) futex(ring.put, FUTEX_WAKE, 1);
}

void BareProcessPair::take(Ring& ring, std::vector<std::byte>& to) const {
  const std::uint32_t place = ring.taken.load(std::memory_order_relaxed);
  if (ring.put.load(std::memory_order_acquire) == place) {
    ring.asleep.store(1, std::memory_order_seq_cst);
    while (ring.put.load(std::memory_order_seq_cst) == place) futex(ring.put, FUTEX_WAIT, place);
    ring.asleep.store(0, std::memory_order_relaxed);
  }
  std::memcpy(to.data(), ring.places() + place % kPlaces * size_, size_);
  ring.taken.store(place + 1, std::memory_order_release);
}

void BareProcessPair::echo() {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (;;) {
    take(*there_, received_);
    put(*back_, sent_);
  }
}

double BareProcessPair::time(int round_trips) {
  return time_per_operation(2 * round_trips, [&] {
    for (int i = 0; i < round_trips; ++i) {
      put(*there_, sent_);
      take(*back_, received_);
      benchmark::DoNotOptimize(received_.data());
    }
  });
}

}  // namespace orca::bench
