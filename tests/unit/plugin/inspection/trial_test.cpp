// SPDX-License-Identifier: GPL-3.0-or-later
// Code that is tried out in a copy of the process cannot harm this process.
#include "inspection/trial.hpp"

#include <signal.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include <cstdlib>
#include <exception>
#include <stdexcept>

using namespace orca;
using namespace orca::plugin;
using Catch::Contains;

namespace {

using Step = std::function<void(const std::string&)>;

std::string death(const std::function<void()>& deed) {
  const Status status = survives_trial(
      [&](const Step& step) {
        step("the first step");
        step("the deed");
        deed();
      },
      2s);
  return status.ok() ? "" : status.error().text();
}

void no_way_out() { throw std::runtime_error("no way out"); }

}  // namespace

TEST_CASE("a function that returns or throws survives its trial", "[plugin][trial]") {
  CHECK(survives_trial([](const Step&) {}, 2s).ok());
  CHECK(survives_trial([](const Step&) { throw std::runtime_error("no harm"); }, 2s).ok());
}

TEST_CASE("the end of the copied process is reported with the step that it was at", "[plugin][trial]") {
  CHECK_THAT(death([] { std::abort(); }), Contains("the deed ended the process with the signal ABRT"));
  CHECK_THAT(death([] { raise(SIGKILL); }), Contains("the deed") && Contains("KILL"));
  CHECK_THAT(death([] { _exit(3); }), Contains("the deed ended the process with exit(3)"));
  CHECK_THAT(death([]() noexcept { no_way_out(); }),
             Contains("the deed threw std::runtime_error: no way out, which nothing can catch there"));
}

TEST_CASE("a function that does not return is ended at its limit", "[plugin][trial]") {
  CHECK_THAT(death([] { pause(); }), Contains("the deed did not return within 2 s"));
}

TEST_CASE("a trial changes nothing in this process", "[plugin][trial]") {
  int value = 1;
  CHECK(survives_trial([&](const Step&) { value = 2; }, 2s).ok());
  CHECK(value == 1);
}
