// SPDX-License-Identifier: GPL-3.0-or-later
// The ways in which a plugin can make a run depend on the machine: those that its file shows, and those that
// it does not. docs/plugins.md lists the latter.
#include "../places.hpp"
#include "inspection/plugin_file.hpp"
#include "inspection/virtual_time.hpp"

using namespace orca;
using namespace orca::plugin;
using namespace orca::test;

namespace {

struct Way {
  const char* what;
  const char* fault;  // the beginning of what is said of it
};

const std::vector<Way> kWays {
  {"the time of day in seconds", "uses time, which reads the machine's clock"},
      {"a clock of POSIX", "uses clock_gettime, which reads"},
      {"the time of day in microseconds", "uses gettimeofday, which reads"},
      {"the processor time of C", "uses clock, which reads"},
      {"the processor time of POSIX", "uses times, which reads"},
      {"the time of C11", "uses timespec_get, which reads"},
      {"the steady clock of C++", "uses std::chrono::_V2::steady_clock::now, which reads"},
      {"the system clock of C++", "uses std::chrono::_V2::system_clock::now, which reads"},
      {"the processor time used", "uses getrusage, which reads"},
      {"the state of the clock's adjustment", "uses adjtimex, which reads"},
      {"the time since the machine started", "uses sysinfo, which reads"},
      {"the time that a timer has left", "uses getitimer, which reads"},
      {"the time of a file in C++", "uses std::filesystem::last_write_time, which reads"},
      {"a short sleep", "uses usleep, which waits for the machine's clock"},
      {"a sleep of C++", "uses nanosleep, which waits"},
      {"a timer with a descriptor", "uses timerfd_create, which waits"},
      {"a thread", "uses std::thread::_M_start_thread, which starts a thread"},
      {"a copy of the process", "uses fork, which starts a thread or process"},
      {"a program with a pipe", "uses popen, which starts a thread or process"},
      {"a program", "uses system, which starts a thread or process"},
      {"a wait for another thread", "uses std::condition_variable::wait, which waits for another thread"},
      {"random numbers of C", "uses rand, which draws random numbers"},
      {"random numbers of POSIX", "uses drand48, which draws"},
      {"random numbers of the kernel", "uses getrandom, which draws"},
      {"random numbers of BSD", "uses getentropy, which draws"},
      {"random numbers of C++", "uses std::random_device::_M_getval, which draws"},
      {"a random file name", "uses mkstemp, which draws"},
      {"the random device as a stream", "uses /dev/urandom, which draws"},
      {"the random device as a descriptor", "uses /dev/random, which draws"},
      {"the kernel's files about the process", "uses /proc/, which asks about the process or the machine"},
      {"the number of the process", "uses getpid, which asks"},
      {"the identity of the thread", "uses pthread_self, which asks"},
      {"the name of the machine", "uses gethostname, which asks"},
      {"the present processor", "uses sched_getcpu, which asks"},
      {"the number of processors", "uses std::thread::hardware_concurrency, which asks"},
      {"a function by its name at run time", "uses dlsym, which can lead to functions"},
      {"a system call by its number", "uses syscall, which can lead to functions"},
      {"a device with a time-out", "uses poll, which waits for a device"},
      {"the network", "uses recv, which waits for a device"},
#if defined(__x86_64__)
      {"the processor's counter of cycles", "uses rdtsc, which reads"},
      {"the same in order", "uses rdtscp, which reads"},
      {"random numbers of the processor", "uses rdrand, which draws"},
      {"random seeds of the processor", "uses rdseed, which draws"},
#endif
};

std::vector<std::string> faults_of_ways(const std::string& plugin) {
  const Result<PluginFile> file = PluginFile::read(test_plugin(plugin));
  REQUIRE(file);
  return file->virtual_time_faults();
}

}  // namespace

TEST_CASE("each way to time, chance and identity that a plugin's file shows is named", "[plugin][virtual]") {
  const std::vector<std::string> faults = faults_of_ways("test_ways");
  for (const Way& way : kWays) {
    CAPTURE(way.what, way.fault);
    CHECK(
        std::ranges::any_of(faults, [&](const std::string& fault) { return fault.starts_with(way.fault); }));
  }
  CHECK(kWays.size() >= 39);
}

// Whoever closes one of these ways moves it to the table above, and takes it off the list of limits.
TEST_CASE("the ways that a plugin's file does not show are not named", "[plugin][virtual]") {
  const std::vector<std::string> faults = faults_of_ways("test_unseen_ways");
  CHECK(faults == std::vector<std::string>{});
}

TEST_CASE("what ordinary plugins need may be used in virtual time", "[plugin][virtual]") {
  for (const char* name : {"open", "close", "read", "write", "fopen", "fstat", "access", "pthread_mutex_lock",
                           "pthread_once", "malloc", "memcpy", "gzopen", "snprintf", "getenv", "strerror",
                           "sin", "_ZNSt10filesystem6statusERKNS_7__cxx114pathERSt10error_code"}) {
    CAPTURE(name);
    CHECK_FALSE(unfit_for_virtual_time(name));
  }
}
