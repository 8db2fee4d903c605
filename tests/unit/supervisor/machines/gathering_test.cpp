// SPDX-License-Identifier: GPL-3.0-or-later
// Several machines that come up, are lost, come back and end together, over a network that loses, delays and parts them.
#include "machines/gathering.hpp"
#include "machines/neighbours.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "machines_in_a_network.hpp"

using namespace orca;
using namespace orca::supervisor;
using namespace orca::test;
using Catch::Contains;

namespace {

constexpr auto kGoOn = graph::OnLoss::go_on;
constexpr auto kStop = graph::OnLoss::stop;
constexpr Duration kPatient = 3s;  // where three of ten states are lost

}  // namespace

TEST_CASE("machines started in any order begin together, their components one after the other",
          "[supervisor][machines]") {
  std::mt19937 random(17);
  for (unsigned seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    System system(chain(kStop, kPatient), seed, 0.3, 150ms);
    Words names{"base", "brain", "eye"};
    std::ranges::shuffle(names, random);
    for (const std::string& name : names) {
      system.start(name);
      system.pass(std::chrono::milliseconds(random() % 600));
    }
    REQUIRE(system.passes_until([&] { return system.all_work(); }, 20s));
    CHECK(system.configured == kOrder);
    system.pass(500ms);
    for (const std::string& name : names) CHECK(system.at(name).gathering.missing().empty());
  }
}

TEST_CASE("without loss all machines begin within a moment", "[supervisor][machines]") {
  System system(chain());
  system.start_all();
  REQUIRE(system.passes_until([&] { return system.all_work(); }, 2s));
  CHECK(abs(system.at("base").began - system.at("eye").began) <= 50ms);
}

TEST_CASE("a machine that waits knows for whom", "[supervisor][machines]") {
  System system(chain());
  Machine& base = system.start("base");
  system.pass(1s);
  CHECK(base.gathering.missing() == Words{"brain", "eye"});
  system.start("eye");
  system.pass(1s);
  CHECK(base.gathering.missing() == Words{"brain"});
  CHECK(base.told("machine eye is there"));
  CHECK(base.phase() == idl::MACHINE_GATHERING);
  CHECK(system.configured.empty());
}

TEST_CASE("a machine that goes while others wait is waited for again", "[supervisor][machines]") {
  System system(chain());
  Machine& base = system.start("base");
  system.start("eye");
  system.pass(500ms);
  system.kill("eye");
  system.pass(2s);
  CHECK(base.gathering.missing() == Words{"brain", "eye"});
  CHECK_FALSE(base.lost("eye"));
  system.start("eye");
  system.start("brain");
  CHECK(system.passes_until([&] { return system.all_work(); }, 5s));
}

TEST_CASE("the end on one machine reaches all", "[supervisor][machines]") {
  const auto end =
      GENERATE(idl::MACHINE_FINISHED, idl::MACHINE_TIME_IS_UP, idl::MACHINE_STOPPED, idl::MACHINE_FAILED);
  System system(chain(kStop, kPatient), 4, 0.3, 150ms);
  system.start_all();
  REQUIRE(system.passes_until([&] { return system.all_work(); }, 20s));
  system.at("brain").gathering.end(end, "enough");
  REQUIRE(system.passes_until([&] { return system.all_are(idl::MACHINE_ENDED); }, 3s));
  for (const std::string name : {"base", "eye"}) {
    REQUIRE(system.at(name).gathering.verdict());
    CHECK(system.at(name).gathering.verdict()->end == end);
    CHECK_THAT(system.at(name).gathering.verdict()->why, Contains("enough"));
    CHECK_FALSE(system.at(name).lost("brain"));
  }
  CHECK(system.passes_until([&] { return system.at("brain").gathering.have_all_ended(); }, 3s));
}

TEST_CASE("a machine that cannot start ends the start of all", "[supervisor][machines]") {
  System system(chain());
  system.start_all();
  REQUIRE(system.passes_until([&] { return system.at("eye").phase() == idl::MACHINE_BUILDING; }, 5s));
  system.at("eye").gathering.end(idl::MACHINE_NOT_STARTED, "no camera");
  system.pass(500ms);
  CHECK(system.at("base").gathering.verdict()->end == idl::MACHINE_NOT_STARTED);
  CHECK(system.at("base").gathering.verdict()->why == "machine eye has ended the run: no camera");
}

TEST_CASE("the run is done when all machines say so", "[supervisor][machines]") {
  System system(chain());
  system.start_all();
  REQUIRE(system.passes_until([&] { return system.all_work(); }, 2s));
  system.at("base").gathering.set_done(true);
  system.at("brain").gathering.set_done(true);
  system.pass(500ms);
  CHECK_FALSE(system.at("base").gathering.are_all_done());
  system.at("eye").gathering.set_done(true);
  system.pass(500ms);
  CHECK(system.at("base").gathering.are_all_done());
}

TEST_CASE("a cut is noticed on both sides, and its end too", "[supervisor][machines]") {
  System system(chain(kGoOn));
  system.start_all();
  REQUIRE(system.passes_until([&] { return system.all_work(); }, 2s));
  system.network.part("eye", true);
  system.pass(900ms);
  CHECK_FALSE(system.at("base").lost("eye"));
  system.pass(350ms);
  CHECK(system.at("base").lost("eye"));
  CHECK(system.at("eye").lost("base"));
  CHECK(system.at("eye").lost("brain"));
  CHECK_FALSE(system.at("base").lost("brain"));
  system.pass(5s);
  system.network.part("eye", false);
  system.pass(500ms);
  CHECK(system.at("base").told("machine eye is heard again"));
  CHECK(system.at("base").is_back("eye"));
  CHECK_FALSE(system.at("base").is_back("brain"));
  CHECK(system.at("eye").told("machine base is heard again"));
  CHECK(system.all_work());
}

TEST_CASE("the loss of a machine that is needed ends the run", "[supervisor][machines]") {
  System system(chain());
  system.start_all();
  REQUIRE(system.passes_until([&] { return system.all_work(); }, 2s));
  system.kill("eye");
  REQUIRE(system.passes_until([&] { return system.all_are(idl::MACHINE_ENDED); }, 2s));
  CHECK(system.at("base").gathering.verdict()->end == idl::MACHINE_FAILED);
  CHECK_THAT(system.at("base").gathering.verdict()->why, Contains("machine eye"));
  CHECK(system.at("base").told("machine eye was not heard for 1 s, so the run ends"));
}

TEST_CASE("a machine that was started again is taken in", "[supervisor][machines]") {
  const Duration pause = GENERATE(0ms, 100ms, 3s);
  const double loss = GENERATE(0.0, 0.3);
  System system(chain(kGoOn, loss > 0.0 ? kPatient : 1s), 3, loss, loss > 0.0 ? 150ms : 0ms);
  system.start_all();
  REQUIRE(system.passes_until([&] { return system.all_work(); }, 20s));
  system.configured.clear();
  system.kill("base");
  system.pass(pause);
  system.start("base");
  REQUIRE(system.passes_until([&] { return system.all_work(); }, 20s));
  CHECK(system.configured == Words{"b", "d"});
  CHECK(system.at("eye").told("machine base was started again"));
  if (pause > 1s && loss == 0.0) {
    CHECK(system.at("eye").lost("base"));
    CHECK(system.at("eye").is_back("base"));
  }
}

TEST_CASE("a machine that fails to start again does not end those that go on", "[supervisor][machines]") {
  System system(chain(kGoOn));
  system.start_all();
  REQUIRE(system.passes_until([&] { return system.all_work(); }, 2s));
  system.kill("eye");
  system.pass(300ms);
  system.start("eye");
  system.pass(300ms);
  system.at("eye").gathering.end(idl::MACHINE_NOT_STARTED, "no camera");
  system.pass(500ms);
  CHECK(system.at("base").phase() == idl::MACHINE_WORKING);
  CHECK(system.at("base").told("machine eye could not start: no camera; the others go on"));
  system.start("eye");
  CHECK(system.passes_until([&] { return system.all_work(); }, 5s));
}

TEST_CASE("what an earlier run still says ends nothing", "[supervisor][machines]") {
  System system(chain());
  system.start_all();
  REQUIRE(system.passes_until([&] { return system.all_work(); }, 2s));
  system.at("base").gathering.end(idl::MACHINE_STOPPED, "");
  system.pass(200ms);
  Machine& eye = system.start("eye");  // while the others still say that they have ended
  system.pass(1s);
  CHECK(eye.phase() == idl::MACHINE_GATHERING);
  CHECK_FALSE(eye.gathering.verdict());
  system.start("base");
  system.start("brain");
  CHECK(system.passes_until([&] { return system.all_work(); }, 5s));
}

TEST_CASE("a clock that was set back keeps no machine out", "[supervisor][machines]") {
  Gathering base(chain(kGoOn), "base", 10);
  Gathering eye(chain(kGoOn), "eye", 10);
  Gathering eye_again(chain(kGoOn), "eye", 9);
  idl::MachineState state = eye.state();
  state.seq(1);
  base.hear(state, kStart);
  state = eye_again.state();
  state.seq(1);
  base.hear(state, kStart + 500ms);
  CHECK(base.state().heard().at(0).run() == 10);
  base.look(kStart + 1100ms);
  base.hear(state, kStart + 1200ms);
  CHECK(base.state().heard().at(0).run() == 9);
}

TEST_CASE("a late state does not undo a later one, and is no sign of life", "[supervisor][machines]") {
  Gathering base(chain(kGoOn), "base", 1);
  Gathering eye(chain(kGoOn), "eye", 1);
  idl::MachineState early = eye.state();
  early.seq(1);
  eye.enter(idl::MACHINE_WORKING);
  idl::MachineState late = eye.state();
  late.seq(2);
  base.enter(idl::MACHINE_WORKING);
  base.hear(late, kStart);
  base.hear(early, kStart + 900ms);
  base.hear(late, kStart + 900ms);
  base.look(kStart + 1100ms);
  const auto news = base.take_news();
  CHECK(std::ranges::count(news, Gathering::News::Kind::lost, &Gathering::News::kind) == 1);
}

TEST_CASE("machines with different graphs refuse each other before anything starts",
          "[supervisor][machines]") {
  System system(chain());
  graph::Graph other = chain();
  other.components[0].priority = 5;
  Machine& base = system.start("base");
  Machine& eye = system.start("eye", other);
  system.pass(500ms);
  for (const Machine* machine : {&base, &eye}) {
    REQUIRE(machine->gathering.verdict());
    CHECK(machine->gathering.verdict()->end == idl::MACHINE_NOT_STARTED);
    CHECK_THAT(machine->gathering.verdict()->why,
               Contains("machine base") && Contains("machine eye") && Contains("different graphs"));
  }
}

TEST_CASE("a machine that refuses another's graph stays until the other knows", "[supervisor][machines]") {
  graph::Graph other = chain();
  other.components[0].priority = 5;
  Gathering base(chain(), "base", 1);
  Gathering eye(other, "eye", 1);
  base.hear(eye.state(), kStart);
  REQUIRE(base.verdict());
  base.end(base.verdict()->end, base.verdict()->why);
  CHECK_FALSE(base.have_all_ended());
  base.hear(eye.state(), kStart + 100ms);
  CHECK_FALSE(base.have_all_ended());
  eye.hear(base.state(), kStart + 200ms);
  REQUIRE(eye.verdict());
  base.hear(eye.state(), kStart + 200ms);
  CHECK(base.have_all_ended());
}

TEST_CASE("a machine with another graph does not disturb those that work", "[supervisor][machines]") {
  System system(chain(kGoOn));
  system.start_all();
  REQUIRE(system.passes_until([&] { return system.all_work(); }, 2s));
  system.kill("eye");
  graph::Graph other = chain(kGoOn);
  other.components[0].priority = 5;
  Machine& eye = system.start("eye", other);
  system.pass(500ms);
  CHECK(eye.gathering.verdict()->end == idl::MACHINE_NOT_STARTED);
  CHECK(system.at("base").phase() == idl::MACHINE_WORKING);
  CHECK(
      system.at("base").told("machine base and machine eye run different graphs, so machine eye stays out"));
}

TEST_CASE("of two deployers for one machine the earlier one stays", "[supervisor][machines]") {
  Gathering first(chain(), "base", 1);
  Gathering second(chain(), "base", 2);
  for (int i = 0; i < 2; ++i) {
    CHECK_FALSE(second.verdict());
    first.hear(second.state(), kStart);
    second.hear(first.state(), kStart);
  }
  CHECK_FALSE(first.verdict());
  REQUIRE(second.verdict());
  CHECK(second.verdict()->end == idl::MACHINE_NOT_STARTED);
  CHECK_THAT(second.verdict()->why, Contains("another deployer"));
}

TEST_CASE("a deployer that works is not ended by another one for its machine", "[supervisor][machines]") {
  Gathering first(chain(), "base", 9);
  Gathering second(chain(), "base", 2);  // its clock was set back
  first.enter(idl::MACHINE_WORKING);
  for (int i = 0; i < 2; ++i) {
    first.hear(second.state(), kStart);
    second.hear(first.state(), kStart);
  }
  CHECK_FALSE(first.verdict());
  CHECK(second.verdict());
}

TEST_CASE("the state of a machine that the graph does not have is ignored", "[supervisor][machines]") {
  Gathering base(chain(), "base", 1);
  idl::MachineState state = Gathering(chain(), "eye", 1).state();
  state.origin("moon");
  base.hear(state, kStart);
  CHECK(base.state().heard().empty());
}

TEST_CASE("a machine on which nothing runs is not waited for", "[supervisor][machines]") {
  graph::Graph graph = chain();
  graph.machines.push_back({.name = "spare"});
  CHECK(Gathering(graph, "base", 1).missing() == Words{"brain", "eye"});
}

TEST_CASE("a run ends here in the way that another machine says", "[supervisor][machines]") {
  using host::RunOutcome;
  CHECK(outcome_of(idl::MACHINE_FINISHED) == RunOutcome::finished);
  CHECK(outcome_of(idl::MACHINE_TIME_IS_UP) == RunOutcome::time_is_up);
  CHECK(outcome_of(idl::MACHINE_STOPPED) == RunOutcome::stopped);
  CHECK(outcome_of(idl::MACHINE_NOT_STARTED) == RunOutcome::not_started);
  CHECK(outcome_of(idl::MACHINE_FAILED) == RunOutcome::failed);
}
