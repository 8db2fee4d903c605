// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A library to be preloaded: the time of day is ahead by so many seconds as the environment variable ORCA_TEST_CLOCK_AHEAD
/// says, so that programs on one computer can be on machines whose clocks differ. The system's steady clock stays.
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <cstdlib>

extern "C" int clock_gettime(clockid_t clock, timespec* time) noexcept {
  const long outcome = syscall(SYS_clock_gettime, clock, time);
  static const char* const kAhead = std::getenv("ORCA_TEST_CLOCK_AHEAD");
  if (clock == CLOCK_REALTIME && outcome == 0 && kAhead != nullptr) time->tv_sec += std::atol(kAhead);
  return static_cast<int>(outcome);
}
