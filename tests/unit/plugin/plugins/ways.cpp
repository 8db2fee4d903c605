// SPDX-License-Identifier: GPL-3.0-or-later
// Every way to the machine's time, chance and identity that can be seen in a plugin's file.
#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/random.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/sysinfo.h>
#include <sys/time.h>
#include <sys/timerfd.h>
#include <sys/times.h>
#include <sys/timex.h>
#include <unistd.h>

#if defined(__x86_64__)
#include <immintrin.h>
#include <x86intrin.h>
#endif

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <mutex>
#include <random>
#include <string>
#include <thread>

#include "orca/component.hpp"

namespace {

template <class T>
long first_of(T value) {
  return static_cast<long>(value);
}

long wait_for_a_thread() {
  std::mutex mutex;
  std::unique_lock lock(mutex);
  std::condition_variable().wait(lock);
  return 0;
}

#if defined(__x86_64__)
long count_cycles() { return first_of(__rdtsc()); }
long count_cycles_in_order() {
  unsigned processor = 0;
  return first_of(__rdtscp(&processor));
}
[[gnu::target("rdrnd")]] long draw_in_hardware() {
  unsigned long long drawn = 0;
  return _rdrand64_step(&drawn) + first_of(drawn);
}
[[gnu::target("rdseed")]] long seed_in_hardware() {
  unsigned long long drawn = 0;
  return _rdseed64_step(&drawn) + first_of(drawn);
}
#endif

using Way = long (*)();

template <class T>
T filled() {
  T value{};
  return value;
}

constexpr auto kWays = std::to_array<Way>({
  [] { return first_of(time(nullptr)); },
      [] {
        auto now = filled<timespec>();
        return clock_gettime(CLOCK_MONOTONIC, &now) + now.tv_nsec;
      },
      [] {
        auto now = filled<timeval>();
        return gettimeofday(&now, nullptr) + now.tv_usec;
      },
      [] { return first_of(clock()); },
      [] {
        auto now = filled<tms>();
        return first_of(times(&now));
      },
      [] {
        auto now = filled<timespec>();
        return timespec_get(&now, TIME_UTC) + now.tv_nsec;
      },
      [] { return first_of(std::chrono::steady_clock::now().time_since_epoch().count()); },
      [] { return first_of(std::chrono::system_clock::now().time_since_epoch().count()); },
      [] {
        auto used = filled<rusage>();
        return getrusage(RUSAGE_SELF, &used) + used.ru_utime.tv_usec;
      },
      [] {
        auto state = filled<timex>();
        return adjtimex(&state) + state.time.tv_usec;
      },
      [] {
        struct sysinfo state {};
        return sysinfo(&state) + state.uptime;
      },
      [] {
        auto left = filled<itimerval>();
        return getitimer(ITIMER_REAL, &left) + left.it_value.tv_usec;
      },
      [] { return first_of(usleep(1)); },
      [] {
        std::this_thread::sleep_for(std::chrono::nanoseconds(1));
        return 0L;
      },
      [] { return first_of(timerfd_create(CLOCK_MONOTONIC, 0)); },
      [] {
        std::thread([] {}).detach();
        return 0L;
      },
      [] { return first_of(fork()); }, [] { return first_of(fgetc(popen("date", "r"))); },
      [] { return first_of(std::system("sleep 1")); }, wait_for_a_thread, [] { return first_of(rand()); },
      [] { return first_of(drand48()); },
      [] {
        long drawn = 0;
        return getrandom(&drawn, sizeof drawn, 0) + drawn;
      },
      [] {
        long drawn = 0;
        return getentropy(&drawn, sizeof drawn) + drawn;
      },
      [] { return first_of(std::random_device()()); },
      [] {
        char name[] = "/tmp/XXXXXX";
        return mkstemp(name) + first_of(name[5]);
      },
      [] { return first_of(std::ifstream("/dev/urandom").get()); },
      [] { return first_of(open(std::string("/dev/random").c_str(), O_RDONLY | O_CLOEXEC)); },
      [] { return first_of(fgetc(fopen("/proc/uptime", "re"))); }, [] { return first_of(getpid()); },
      [] { return first_of(std::hash<std::thread::id>()(std::this_thread::get_id())); },
      [] {
        char name[64] = {};
        return gethostname(name, sizeof name) + first_of(name[0]);
      },
      [] { return first_of(sched_getcpu()); }, [] { return first_of(std::thread::hardware_concurrency()); },
      [] { return first_of(std::filesystem::last_write_time("/tmp").time_since_epoch().count()); },
      [] { return reinterpret_cast<long (*)(long*)>(dlsym(RTLD_DEFAULT, "time"))(nullptr); },
      [] { return syscall(SYS_getpid); }, [] { return first_of(poll(nullptr, 0, 1)); },
      [] {
        char got = 0;
        return recv(0, &got, 1, 0) + got;
      },
#if defined(__x86_64__)
      count_cycles, count_cycles_in_order, draw_in_hardware, seed_in_hardware,
#endif
});

class Prober final : public orca::Component {
 public:
  using Component::Component;
  orca::Outcome work() override {
    long sum = 0;
    for (const Way way : kWays) sum += way();
    return sum == 0 ? orca::again() : orca::done();
  }
};

}  // namespace

ORCA_COMPONENT(Prober, "test.Prober")
