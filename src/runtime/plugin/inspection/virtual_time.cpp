// SPDX-License-Identifier: LGPL-3.0-or-later
#include "virtual_time.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace orca::plugin {
namespace {

using Names = std::span<const std::string_view>;

constexpr auto kClocks = std::to_array<std::string_view>(
    {"adjtimex", "clock", "clock_adjtime", "clock_gettime", "ftime", "getitimer", "getloadavg", "getrusage",
     "gettimeofday", "ntp_adjtime", "ntp_gettime", "ntp_gettimex", "sysinfo", "time", "timer_gettime",
     "timerfd_gettime", "times", "timespec_get"});
constexpr auto kSleeps = std::to_array<std::string_view>(
    {"alarm", "clock_nanosleep", "nanosleep", "pause", "setitimer", "sigsuspend", "sigtimedwait", "sigwait",
     "sigwaitinfo", "sleep", "thrd_sleep", "timer_create", "timer_settime", "timerfd_create",
     "timerfd_settime", "ualarm", "usleep"});
constexpr auto kThreads =
    std::to_array<std::string_view>({"clone", "daemon", "fork", "popen", "posix_spawn", "posix_spawnp",
                                     "pthread_create", "system", "thrd_create", "vfork"});
constexpr auto kThreadWaits = std::to_array<std::string_view>(
    {"cnd_timedwait", "cnd_wait", "mtx_timedlock", "pthread_barrier_wait", "pthread_clockjoin_np",
     "pthread_cond_clockwait", "pthread_cond_timedwait", "pthread_cond_wait", "pthread_join",
     "pthread_mutex_clocklock", "pthread_mutex_timedlock", "pthread_timedjoin_np", "sem_clockwait",
     "sem_timedwait", "sem_wait", "thrd_join"});
constexpr auto kRandom =
    std::to_array<std::string_view>({"arc4random", "arc4random_buf", "arc4random_uniform",
                                     "drand48",    "drand48_r",      "erand48",
                                     "getentropy", "getrandom",      "initstate",
                                     "jrand48",    "lrand48",        "lrand48_r",
                                     "mkdtemp",    "mkostemp",       "mkstemp",
                                     "mktemp",     "mrand48",        "mrand48_r",
                                     "nrand48",    "rand",           "rand_r",
                                     "random",     "random_r",       "srand",
                                     "srand48",    "srandom",        "tempnam",
                                     "tmpfile",    "tmpnam"});
constexpr auto kIdentities = std::to_array<std::string_view>(
    {"get_nprocs", "get_nprocs_conf", "getauxval", "gethostid", "gethostname", "getpgrp", "getpid", "getppid",
     "getsid", "gettid", "pthread_self", "sched_getcpu", "uname"});
constexpr auto kSideDoors =
    std::to_array<std::string_view>({"dlmopen", "dlopen", "dlsym", "dlvsym", "syscall"});
constexpr auto kDeviceWaits =
    std::to_array<std::string_view>({"accept", "accept4", "epoll_pwait", "epoll_wait", "poll", "ppoll",
                                     "pselect", "recv", "recvfrom", "recvmsg", "select"});

// The first characters of the mangled names of C++ library members, as in g++'s library.
constexpr auto kCxxClocks = std::to_array<std::string_view>({"_ZNSt10filesystem15last_write_time",
                                                             "_ZNSt6chrono3_V212steady_clock3nowEv",
                                                             "_ZNSt6chrono3_V212system_clock3nowEv"});
constexpr auto kCxxSleeps = std::to_array<std::string_view>({"_ZNSt11this_thread11__sleep_for"});
constexpr auto kCxxThreads = std::to_array<std::string_view>({"_ZNSt6thread15_M_start_thread"});
constexpr auto kCxxThreadWaits = std::to_array<std::string_view>(
    {"_ZNSt18condition_variable4wait", "_ZNSt18condition_variable10__wait_until", "_ZNSt6thread4join",
     "_ZNSt28__atomic_futex_unsigned_base"});
constexpr auto kCxxRandom = std::to_array<std::string_view>({"_ZNSt13random_device"});
constexpr auto kCxxIdentities = std::to_array<std::string_view>({"_ZNSt6thread20hardware_concurrency"});

struct Rule {
  Names names;       ///< These names exactly.
  Names beginnings;  ///< All names that begin with one of these.
  UnfitSymbol unfit;
};

const std::array<Rule, 8> kRules{{
    {kClocks, kCxxClocks, {"reads the machine's clock", "now()"}},
    {kSleeps, kCxxSleeps, {"waits for the machine's clock", "sleep() or lap_every()"}},
    {kThreads,
     kCxxThreads,
     {"starts a thread or process of its own", "a component of its own for what must run concurrently"}},
    {kThreadWaits, kCxxThreadWaits, {"waits for another thread", "the blocking calls of a port"}},
    {kRandom, kCxxRandom, {"draws random numbers that the run's seed does not decide", "random(\"name\")"}},
    {kIdentities,
     kCxxIdentities,
     {"asks about the process or the machine", "name(), a parameter or random(\"name\")"}},
    {kSideDoors,
     {},
     {"can lead to functions that this check does not see", "the functions themselves, by their names"}},
    {kDeviceWaits,
     {},
     {"waits for a device",
      "a hardware container for devices, or say in the plugin that it needs the steady clock"}},
}};

bool matches(const Rule& rule, std::string_view symbol) {
  return std::ranges::find(rule.names, symbol) != rule.names.end() ||
         std::ranges::any_of(rule.beginnings,
                             [&](std::string_view start) { return symbol.starts_with(start); });
}

}  // namespace

std::optional<UnfitSymbol> unfit_for_virtual_time(std::string_view symbol) {
  for (const Rule& rule : kRules)
    if (matches(rule, symbol)) return rule.unfit;
  return std::nullopt;
}

bool starts_threads(std::string_view symbol) {
  return symbol == "pthread_create" || symbol == "thrd_create" || symbol == "clone" ||
         symbol.starts_with("_ZNSt6thread15_M_start_thread");
}

}  // namespace orca::plugin
