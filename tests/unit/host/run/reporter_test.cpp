// SPDX-License-Identifier: GPL-3.0-or-later
// The lines that the runtime writes about connections in trouble, and the results of missions that it reports.
#include "run/reporting/reporter.hpp"

#include <catch2/catch.hpp>

#include <cstdlib>

#include "executives.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/time.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;
using Lines = std::vector<std::string>;

namespace {

struct Log final : RunListener {
  void logged(log::Level level, std::string_view who, std::string_view text) override {
    CHECK(level == log::Level::warning);
    lines.push_back(std::string(who) + ": " + std::string(text));
  }
  void arrived(const idl::Arrived& arrived) override { results.push_back("arrived " + arrived.name()); }
  void goal_failed(const idl::GoalFailed& failed) override { results.push_back("failed " + failed.name()); }
  [[noreturn]] void abandon(const RunResult& /*result*/) override { std::abort(); }
  Lines lines;
  Lines results;
};

template <class Result>
ObjectRef result_of(std::uint64_t mission, const std::string& name, Duration stamp) {
  auto result = make_object<Result>();
  result->mission(mission);
  result->name() = name;
  result->stamp(to_time_value(TimePoint{stamp}));
  return ObjectLoan(std::move(result)).seal();
}

// Runs `body` in virtual time with a reporter and its log.
void with_reporter(const std::function<void(Executive&, Reporter&, Log&)>& body) {
  run_on(virtual_executives().front(), [&](Executive& executive) {
    Trace trace(executive);
    Log log;
    Reporter reporter(executive, trace, log, "test");
    body(executive, reporter, log);
  });
}

}  // namespace

TEST_CASE("trouble of a connection is a warning of the component that is concerned, with both ends",
          "[host][trouble]") {
  with_reporter([](Executive&, Reporter& reporter, Log& log) {
    reporter.trouble(LinkTrouble::dropped, "robot/avoid.motion", "robot/fuser.motion", "dropped 1");
    reporter.trouble(LinkTrouble::refused, "robot/fuser.base", "robot/base.motion", "refused: it is full");
    CHECK(log.lines == Lines{"robot/fuser: robot/avoid.motion to robot/fuser.motion: dropped 1",
                             "robot/fuser: robot/fuser.base to robot/base.motion: refused: it is full"});
  });
}

TEST_CASE("while the system is taken down, trouble of its connections is no news", "[host][trouble]") {
  with_reporter([](Executive&, Reporter& reporter, Log& log) {
    reporter.ignore_trouble();
    reporter.trouble(LinkTrouble::refused, "a.out", "c.in", "refused: the system is being stopped");
    CHECK(log.lines.empty());
  });
}

TEST_CASE("trouble of one connection is one line in 10 s, which says how many were left out",
          "[host][trouble]") {
  with_reporter([](Executive& executive, Reporter& reporter, Log& log) {
    const auto report = [&](const char* from) {
      reporter.trouble(LinkTrouble::refused, from, "c.in", "refused");
    };
    for (int i = 0; i < 3; ++i) report("a.out");
    report("b.out");
    CHECK(log.lines == Lines{"a: a.out to c.in: refused", "b: b.out to c.in: refused"});
    sleep(executive, 10s);
    report("a.out");
    report("b.out");
    sleep(executive, 1s);
    report("a.out");
    sleep(executive, 9s);
    report("a.out");
    CHECK(log.lines == Lines{"a: a.out to c.in: refused", "b: b.out to c.in: refused",
                             "a: a.out to c.in: refused (2 more such lines were left out before)",
                             "b: b.out to c.in: refused",
                             "a: a.out to c.in: refused (1 more such line was left out before)"});
  });
}

TEST_CASE("a result that a component passes on is reported once", "[host][missions]") {
  with_reporter([](Executive&, Reporter& reporter, Log& log) {
    reporter.pushed("goto", "ArrivedPush", result_of<idl::Arrived>(1, "shelf", 5s));
    reporter.pushed("porter", "ArrivedPush", result_of<idl::Arrived>(1, "shelf", 5s));
    reporter.pushed("goto", "GoalFailedPush", result_of<idl::GoalFailed>(2, "table", 9s));
    reporter.pushed("porter", "GoalFailedPush", result_of<idl::GoalFailed>(2, "table", 9s));
    CHECK(log.results == Lines{"arrived shelf", "failed table"});
  });
}

TEST_CASE("results of two missions, places or moments are two", "[host][missions]") {
  with_reporter([](Executive&, Reporter& reporter, Log& log) {
    reporter.pushed("goto", "ArrivedPush", result_of<idl::Arrived>(1, "shelf", 5s));
    reporter.pushed("goto", "ArrivedPush", result_of<idl::Arrived>(2, "shelf", 5s));
    reporter.pushed("goto", "ArrivedPush", result_of<idl::Arrived>(2, "table", 5s));
    reporter.pushed("goto", "ArrivedPush", result_of<idl::Arrived>(2, "table", 6s));
    CHECK(log.results.size() == 4);
  });
}
