// SPDX-License-Identifier: GPL-3.0-or-later
// The jobs of a supervisor, with a clock by hand and a process that the test plays.
#include "members/conductor.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <stdexcept>
#include <thread>

#include "staged_process.hpp"

using namespace orca;
using namespace orca::supervisor;
using orca::test::StagedProcess;
using Words = std::vector<std::string>;

namespace {

constexpr Moment kNow = Moment(10s);

}  // namespace

TEST_CASE("a job runs at once until it waits, and goes on when that is so", "[supervisor][conductor]") {
  Conductor conductor{[] {}};
  Words said;
  bool is_there = false;
  conductor.run([&] {
    conductor.begin("job", [&] {
      said.emplace_back("begins");
      said.emplace_back(conductor.wait([&] { return is_there; }) ? "is there" : "is not");
    });
    said.emplace_back("waits");
    conductor.go_on(kNow);
    CHECK(said == Words{"begins", "waits"});
    is_there = true;
    conductor.go_on(kNow);
    CHECK(said == Words{"begins", "waits", "is there"});
  });
}

TEST_CASE("a wait ends at its deadline, and not before", "[supervisor][conductor]") {
  Conductor conductor{[] {}};
  std::optional<bool> came;
  conductor.run([&] {
    conductor.begin("job", [&] { came = conductor.wait([] { return false; }, kNow + 1s); });
    conductor.go_on(kNow + 999ms);
    CHECK_FALSE(came.has_value());
    conductor.go_on(kNow + 1s);
    CHECK(came == false);
  });
}

TEST_CASE("what one job does lets another one go on in the same turn", "[supervisor][conductor]") {
  Conductor conductor{[] {}};
  int done = 0;
  conductor.run([&] {
    conductor.begin("last", [&] {
      conductor.wait([&] { return done == 2; });
      ++done;
    });
    conductor.begin("second", [&] {
      conductor.wait([&] { return done == 1; });
      conductor.begin("inner", [&] { conductor.wait([&] { return done == 3; }); });
      ++done;
    });
    conductor.go_on(kNow);
    CHECK(done == 0);
    done = 1;
    conductor.go_on(kNow);
    CHECK(done == 3);
  });
}

TEST_CASE("the end of the loop ends all waits, present and later ones", "[supervisor][conductor]") {
  Conductor conductor{[] {}};
  std::vector<bool> came;
  conductor.run([&] {
    conductor.begin("job", [&] {
      for (int i = 0; i < 2; ++i) came.push_back(conductor.wait([] { return false; }));
    });
    CHECK(came.empty());
  });
  CHECK(came == std::vector<bool>{false, false});
}

TEST_CASE("what a job throws, the loop throws, and what the loop throws, run() does",
          "[supervisor][conductor]") {
  Conductor conductor{[] {}};
  bool goes_on = false;
  bool has_ended = false;
  const auto loop = [&] {
    conductor.begin("other", [&] {
      conductor.wait([] { return false; });
      has_ended = true;
    });
    conductor.begin("job", [&] {
      conductor.wait([&] { return goes_on; });
      throw std::runtime_error("no memory");
    });
    goes_on = true;
    conductor.go_on(kNow);
    FAIL("go_on() has returned");
  };
  CHECK_THROWS_WITH(conductor.run(loop), "no memory");
  CHECK(has_ended);
}

TEST_CASE("the loop itself cannot wait", "[supervisor][conductor]") {
  Conductor conductor{[] {}};
  CHECK_THROWS_AS(conductor.run([&] { conductor.wait([] { return false; }); }), std::logic_error);
}

TEST_CASE("a job waits for the answer of a process, or its end", "[supervisor][conductor]") {
  Conductor conductor{[] {}};
  StagedProcess process("main");
  process.start();
  std::optional<std::optional<Answer>> answer;
  conductor.run([&] {
    conductor.begin("job", [&] { answer = conductor.ask(process.member(), Build{}); });
    conductor.go_on(kNow);
    REQUIRE(process.hears<Build>());
    CHECK_FALSE(answer.has_value());
    SECTION("its answer") {
      process.answer(fail(Code::unavailable, "no device"));
      conductor.go_on(kNow);
      REQUIRE((answer && *answer));
      CHECK((*answer)->outcome.error().message == "no device");
    }
    SECTION("its end") {
      process.end();
      conductor.go_on(kNow);
      REQUIRE(answer.has_value());
      CHECK_FALSE(answer->has_value());
    }
  });
}

TEST_CASE("what takes long runs on a thread of its own while a job waits, and is given up at the end",
          "[supervisor][conductor]") {
  std::atomic<bool> is_awake{false};
  Conductor conductor([&] { is_awake = true; });
  Words said;
  conductor.run([&] {
    conductor.begin("quick", [&] {
      conductor.run_aside("quick", [&](const auto& give_up) { said.push_back(give_up() ? "late" : "done"); });
      said.emplace_back("goes on");
    });
    while (!is_awake) std::this_thread::yield();
    conductor.go_on(kNow);
    CHECK(said == Words{"done", "goes on"});
    conductor.begin("endless", [&] {
      conductor.run_aside("endless", [](const std::function<bool()>& give_up) {
        while (!give_up()) std::this_thread::yield();
        throw std::runtime_error("given up");
      });
      FAIL("what was thrown is lost");
    });
  });
}
