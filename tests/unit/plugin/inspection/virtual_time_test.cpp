// SPDX-License-Identifier: GPL-3.0-or-later
// The symbols that a plugin uses decide whether it may run in virtual time; all of them are reported at once.
#include "inspection/virtual_time.hpp"

#include <set>

#include "../places.hpp"

using namespace orca;
using namespace orca::plugin;
using namespace orca::test;
using Catch::Contains;

namespace {

std::string virtual_time_faults_of(const std::string& plugin) {
  std::string all;
  const auto library = loaded(test_plugin(plugin));
  for (const std::string& fault : library->virtual_time_faults()) all += fault + "\n";
  return all;
}

}  // namespace

TEST_CASE("every shipped plugin may run in virtual time, except what a person or another program drives",
          "[plugin][virtual]") {
  const std::set<std::string> real_time_only{"player_server.so", "teleop.so"};
  for (const std::string& path : plugins_in(kShipped)) {
    CAPTURE(path);
    const auto library = loaded(path);
    const std::string file = path.substr(path.rfind('/') + 1);
    CHECK(library->virtual_time_faults().empty() == !real_time_only.contains(file));
  }
}

TEST_CASE("clocks, sleeps, threads, waits and random devices are named, each with what to use instead",
          "[plugin][virtual]") {
  const std::string faults = virtual_time_faults_of("test_clockwork");
  CHECK_THAT(
      faults,
      Contains("uses std::chrono::_V2::steady_clock::now, which reads the machine's clock; use now()"));
  CHECK_THAT(faults, Contains("std::chrono::_V2::system_clock::now"));
  CHECK_THAT(faults, Contains("uses time, which reads the machine's clock"));
  CHECK_THAT(faults,
             Contains("uses usleep, which waits for the machine's clock; use sleep() or lap_every()"));
  CHECK_THAT(faults, Contains("std::thread::_M_start_thread") && Contains("starts a thread"));
  CHECK_THAT(faults, Contains("std::condition_variable::wait") && Contains("the blocking calls of a port"));
  CHECK_THAT(faults, Contains("std::random_device") && Contains("use random(\"name\")"));
  CHECK_THAT(faults, Contains("uses getrandom") && Contains("uses rand,"));
}

TEST_CASE("a plugin that says that it needs the steady clock is believed, and the symbols do not matter",
          "[plugin][virtual]") {
  CHECK(virtual_time_faults_of("test_steady_only") ==
        "runs with the steady clock only (--clock steady): reads a joystick\n");
}

TEST_CASE("a plugin may allow itself one symbol, and no other", "[plugin][virtual]") {
  const std::string faults = virtual_time_faults_of("test_allowed");
  CHECK_THAT(faults, Contains("uses rand,"));
  CHECK_THAT(faults, !Contains("poll"));
}

TEST_CASE("only whole names count, not names that begin like them", "[plugin][virtual]") {
  CHECK(unfit_for_virtual_time("time"));
  CHECK(unfit_for_virtual_time("clock_gettime"));
  CHECK_FALSE(unfit_for_virtual_time("timegm"));
  CHECK_FALSE(unfit_for_virtual_time("pthread_mutex_lock"));
  CHECK_FALSE(unfit_for_virtual_time("_ZN4mine4timeEv"));
  CHECK_FALSE(unfit_for_virtual_time(""));
}

TEST_CASE("each function that starts a thread counts by itself, by its whole name", "[plugin][virtual]") {
  for (const std::string_view name : {"pthread_create", "thrd_create", "clone",
                                      "_ZNSt6thread15_M_start_threadESt10unique_ptrINS_6_StateE"}) {
    CAPTURE(name);
    CHECK(starts_threads(name));
    CHECK_FALSE(starts_threads("my_" + std::string(name)));
  }
  for (const std::string_view name : {"", "pthread_create_with", "clone3", "fork", "_ZNSt6thread4joinEv"}) {
    CAPTURE(name);
    CHECK_FALSE(starts_threads(name));
  }
}
