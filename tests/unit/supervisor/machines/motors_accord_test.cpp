// SPDX-License-Identifier: GPL-3.0-or-later
// The emergency stop of several machines, as each of them knows it, on a network that loses what is said.
#include "machines/motors_accord.hpp"

#include <catch2/catch.hpp>

#include <memory>
#include <random>

using namespace orca;
using supervisor::MotorsAccord;

namespace {

const std::vector<std::string> kAccordNames{"base", "brain", "eye"};

// A machine that carries out at once what it is to.
struct AccordOf {
  explicit AccordOf(const std::string& called) : name(called), accord(called, others_of(called)) {}
  static std::vector<std::string> others_of(const std::string& name) {
    std::vector<std::string> others = kAccordNames;
    std::erase(others, name);
    return others;
  }
  void obey() {
    const auto order = accord.take_order();
    if (!order) return;
    const bool was_held = std::exchange(is_held, order->holds);
    accord.note(order->number, order->holds || was_held ? idl::MOTORS_OBEYED : idl::MOTORS_IDLE);
  }
  [[nodiscard]] idl::MachineState says() const {
    idl::MachineState state;
    state.origin(name);
    accord.fill(state);
    return state;
  }
  [[nodiscard]] bool has_all_confirmed() const {
    const auto words = accord.words();
    return std::ranges::all_of(words, [](const auto& word) {
      return word.outcome == idl::MOTORS_OBEYED || word.outcome == idl::MOTORS_IDLE;
    });
  }

  std::string name;
  MotorsAccord accord;
  bool is_held = false;
  bool is_gathering = false;
};

struct Accords {
  Accords() {
    for (const std::string& name : kAccordNames) machines.push_back(std::make_unique<AccordOf>(name));
  }
  AccordOf& at(std::size_t machine) { return *machines[machine]; }
  // Everybody says something once; of that, a share is lost.
  void talk(double loss = 0.0) {
    for (const auto& from : machines)
      for (const auto& to : machines) {
        if (from == to || std::uniform_real_distribution(0.0, 1.0)(random) < loss) continue;
        to->accord.hear(from->says(), to->is_gathering);
        to->obey();
      }
  }
  void order(std::size_t machine, bool holds) {
    at(machine).accord.order(holds);
    at(machine).obey();
  }
  void replace(std::size_t machine) {
    machines[machine] = std::make_unique<AccordOf>(kAccordNames[machine]);
    at(machine).is_gathering = true;
  }
  [[nodiscard]] bool are_held(bool held) const {
    return std::ranges::all_of(machines, [&](const auto& machine) { return machine->is_held == held; });
  }

  std::vector<std::unique_ptr<AccordOf>> machines;
  std::mt19937 random{1};
};

}  // namespace

TEST_CASE("an order about the motors reaches all machines from any of them, whatever the network loses",
          "[supervisor][machines]") {
  Accords system;
  bool holds = false;
  for (int i = 0; i < 300; ++i) {
    const std::size_t machine = system.random() % kAccordNames.size();
    holds = !holds;
    system.order(machine, holds);
    CHECK_FALSE(system.at(machine).has_all_confirmed());
    int rounds = 0;
    while (!system.at(machine).has_all_confirmed()) {
      system.talk(0.7);
      REQUIRE(++rounds < 200);
    }
    CHECK(system.are_held(holds));
  }
}

TEST_CASE("of a stop and a release at one time on two machines the stop counts", "[supervisor][machines]") {
  Accords system;
  system.order(0, true);
  system.talk();
  system.order(1, false);
  system.order(2, true);
  system.talk();
  system.talk();
  CHECK(system.are_held(true));
}

TEST_CASE("a machine that is started anew takes over a stop", "[supervisor][machines]") {
  Accords system;
  system.order(0, true);
  system.talk();
  system.replace(1);
  system.talk();
  CHECK(system.at(1).is_held);
}

TEST_CASE("a machine that starts with its motors held holds all, whatever was released before",
          "[supervisor][machines]") {
  Accords system;
  for (const bool holds : {true, false, true, false}) {
    system.order(0, holds);
    system.talk();
  }
  system.replace(1);
  system.order(1, true);
  system.talk();
  system.talk();
  CHECK(system.are_held(true));
}

TEST_CASE("a release from before a machine was started lets go of nothing on it", "[supervisor][machines]") {
  Accords system;
  system.order(0, true);
  system.order(0, false);
  system.talk();
  system.replace(1);
  system.at(1).is_held = true;  // by itself: its device had failed
  system.talk();
  CHECK(system.at(1).is_held);
  system.at(1).is_gathering = false;
  system.order(0, false);
  system.talk();
  CHECK_FALSE(system.at(1).is_held);
}

TEST_CASE("a number that no operator can have reached is not believed", "[supervisor][machines]") {
  Accords system;
  idl::MachineState rubbish;
  rubbish.origin("brain");
  rubbish.motors_order(UINT64_MAX);
  system.at(0).accord.hear(rubbish, false);
  system.order(0, true);
  system.talk();
  CHECK(system.are_held(true));
}
