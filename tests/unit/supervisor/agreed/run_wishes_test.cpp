// SPDX-License-Identifier: GPL-3.0-or-later
#include "agreed/run_wishes.hpp"

#include <catch2/catch.hpp>

using namespace orca;
using namespace orca::supervisor;

TEST_CASE("the wishes for a run arrive at a host process as they were", "[supervisor][wishes]") {
  RunWishes wishes;
  wishes.seed = 18'446'744'073'709'551'615U;
  wishes.log_level = log::Level::debug;
  wishes.epoch = Duration(-7);
  wishes.run = "12345";
  wishes.failures = {{"dewey/avoid", host::Failure::slow, 20s}, {"goto", host::Failure::throws, Duration{0}}};
  wishes.start = TimePoint(5s);
  wishes.executor = Backend::baton;
  wishes.outputs.trace_file = "trace";
  wishes.outputs.trace_values = true;
  wishes.outputs.looks_on = true;
  wishes.outputs.recordings = {{"a.csv", {"goto.path", "base.odometry"}}, {"b.csv", {"fuser.base"}}};
  wishes.outputs.picture = {"run.svg", host::View::film, {host::Layer::sonar, host::Layer::places}};
  const auto read = read_wishes(to_pairs(wishes));
  REQUIRE(read);
  CHECK(read->seed == wishes.seed);
  CHECK(read->log_level == wishes.log_level);
  CHECK(read->epoch == wishes.epoch);
  CHECK(read->start == wishes.start);
  CHECK(read->executor == wishes.executor);
  CHECK(read->outputs.trace_file == "trace");
  CHECK(read->outputs.trace_values);
  CHECK(read->outputs.looks_on);
  REQUIRE(read->outputs.recordings.size() == 2);
  CHECK(read->outputs.recordings[0].file == "a.csv");
  CHECK(read->outputs.recordings[0].ports == std::vector<std::string>{"goto.path", "base.odometry"});
  CHECK(read->outputs.recordings[1].ports == std::vector<std::string>{"fuser.base"});
  CHECK(read->outputs.picture.file == "run.svg");
  CHECK(read->outputs.picture.view == host::View::film);
  CHECK(read->outputs.picture.hidden == wishes.outputs.picture.hidden);
  CHECK(read->run == wishes.run);
  REQUIRE(read->failures.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(read->failures[i].component == wishes.failures[i].component);
    CHECK(read->failures[i].failure == wishes.failures[i].failure);
    CHECK(read->failures[i].at == wishes.failures[i].at);
  }
}

TEST_CASE("a wish that nobody can have written is refused by its name", "[supervisor][wishes]") {
  const auto [name, value] = GENERATE(table<std::string, std::string>({{"sead", "1"},
                                                                       {"seed", "-1"},
                                                                       {"seed", "1x"},
                                                                       {"seed", ""},
                                                                       {"log", "9"},
                                                                       {"log", "-1"},
                                                                       {"epoch", "soon"},
                                                                       {"start", ""},
                                                                       {"executor", "3"},
                                                                       {"values", "yes"},
                                                                       {"port", "goto.path"},
                                                                       {"view", "all"},
                                                                       {"hide", "roof"},
                                                                       {"fail", "avoid"},
                                                                       {"fail", "dances 1 avoid"},
                                                                       {"fail", "slow x avoid"}}));
  const auto read = read_wishes({{name, value}});
  REQUIRE_FALSE(read);
  CHECK(read.error().code == Code::data_loss);
  CHECK(read.error().message == "the option \"" + name + "\" of the run cannot be \"" + value + "\"");
}
