// SPDX-License-Identifier: GPL-3.0-or-later
// Processes that come up together, as the test plays them.
#include "starting/company.hpp"

#include <catch2/catch.hpp>

#include "staged_process.hpp"

using namespace orca;
using namespace orca::supervisor;
using orca::test::StagedProcess;
using Words = std::vector<std::string>;

namespace {

// Two processes that are to be built, and then to open their hardware.
class TwoThatComeUp {
 public:
  TwoThatComeUp() {
    for (StagedProcess* const process : {&a, &b}) process->start();
  }

  // Lets them come up until the first wait, and does then what a test says.
  void play(const std::function<void()>& test) {
    conductor_.run([&] {
      conductor_.begin("bring-up", [this] { come_up(); });
      test();
    });
  }
  void turn() { conductor_.go_on(Moment{}); }

  StagedProcess a{"a", 0};
  StagedProcess b{"b", 1};
  Words said;
  bool is_over = false;

 private:
  void come_up() {
    const Company company({conductor_, [this] { return is_over; },
                           [this](Member& member, const Error& error) {
                             said.push_back(member.name() + " has refused: " + error.message);
                           }},
                          {&a.member(), &b.member()});
    if (company.ask_all([](const Member&) { return Build{}; }) &&
        company.ask(a.member(), Configure{"avoid"}) &&
        company.ask_all([](const Member&) { return OpenHardware{}; }))
      for (const Member* const member : company.present()) said.push_back(member->name() + " is up");
    said.emplace_back("over");
  }

  Conductor conductor_{[] {}};
};

}  // namespace

TEST_CASE("processes take each step together", "[supervisor][company]") {
  TwoThatComeUp two;
  two.play([&] {
    REQUIRE((two.a.hears<Build>() && two.b.hears<Build>()));
    two.a.answer();
    two.turn();
    CHECK_FALSE(two.a.hear().has_value());
    two.b.answer();
    two.turn();
    REQUIRE(two.a.hears<Configure>());
    CHECK_FALSE(two.b.hear().has_value());
    two.a.answer();
    two.turn();
    REQUIRE((two.a.hears<OpenHardware>() && two.b.hears<OpenHardware>()));
    two.b.answer();
    two.a.answer();
    two.turn();
    CHECK(two.said == Words{"a is up", "b is up", "over"});
  });
}

TEST_CASE("a process that ends while it comes up is left out, and the others come up",
          "[supervisor][company]") {
  TwoThatComeUp two;
  two.play([&] {
    REQUIRE((two.a.hears<Build>() && two.b.hears<Build>()));
    two.a.answer();
    SECTION("before it answers") { two.b.end(); }
    SECTION("when it is not asked") {
      two.b.answer();
      two.turn();
      two.b.end();
    }
    SECTION("and was started again, which is another matter") {
      two.b.end();
      two.b.start();
    }
    two.turn();
    REQUIRE(two.a.hears<Configure>());
    two.a.answer();
    two.turn();
    REQUIRE(two.a.hears<OpenHardware>());
    two.a.answer();
    two.turn();
    CHECK(two.said == Words{"a is up", "over"});
  });
}

TEST_CASE("nothing goes on beside a process that has refused, until it has ended", "[supervisor][company]") {
  TwoThatComeUp two;
  two.play([&] {
    REQUIRE((two.a.hears<Build>() && two.b.hears<Build>()));
    two.b.answer(fail(Code::not_found, "no such device"));
    two.a.answer();
    two.turn();
    CHECK(two.said == Words{"b has refused: no such device"});
    CHECK_FALSE(two.a.hear().has_value());
    two.b.end();
    two.turn();
    CHECK(two.a.hears<Configure>());
  });
}

TEST_CASE("nothing happens any more when none runs, or all is to end", "[supervisor][company]") {
  TwoThatComeUp two;
  two.play([&] {
    REQUIRE((two.a.hears<Build>() && two.b.hears<Build>()));
    SECTION("none runs") {
      two.a.end();
      two.b.end();
    }
    SECTION("all is to end") {
      two.is_over = true;
      two.a.answer();
      two.b.answer();
    }
    two.turn();
    CHECK(two.said == Words{"over"});
  });
}
