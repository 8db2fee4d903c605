// SPDX-License-Identifier: GPL-3.0-or-later
#include "hosted/vigil.hpp"

#include <catch2/catch.hpp>

#include "channel/samples.hpp"
#include "open_descriptors.hpp"
#include "orca/supervisor/meeting_place.hpp"
#include "runtime_folder.hpp"

using namespace orca;
using namespace orca::supervisor;
using orca::test::null_device;
using orca::test::RuntimeFolder;

namespace {

// A process that waits for a supervisor.
struct WaitingProcess {
  RuntimeFolder folder;
  Result<ControlSocket> place = open_meeting_place("scout", "base");
  Vigil vigil{*place, [] { return Orphaned{"base", 17, {}, null_device(), null_device(), {}, {}}; }};
  Moment now{};
};

std::unique_ptr<Channel> visitor() {
  std::vector<Waiting> waiting = connect_to_waiting("scout");
  REQUIRE(waiting.size() == 1);
  return std::make_unique<Channel>(std::move(waiting[0].connection));
}

Result<Report> heard_by(Channel& visitor) {
  Result<Message> message = visitor.wait_for_message(5s);
  if (!message) return message.error();
  return decode_report(std::move(*message));
}

}  // namespace

TEST_CASE("who comes hears who waits, and may adopt it", "[supervisor][adoption]") {
  WaitingProcess lonely;
  CHECK_FALSE(lonely.vigil.turn(lonely.now));
  const auto supervisor = visitor();
  CHECK_FALSE(lonely.vigil.turn(lonely.now));
  const Result<Report> said = heard_by(*supervisor);
  REQUIRE(said);
  CHECK(std::get<Orphaned>(*said).process == "base");
  CHECK(std::get<Orphaned>(*said).graph == 17);
  CHECK(std::get<Orphaned>(*said).output);
  REQUIRE(supervisor->post(encode(Adopt{}, 3)).ok());
  const std::optional<Told> told = lonely.vigil.turn(lonely.now);
  REQUIRE(told);
  CHECK(std::holds_alternative<Adopt>(told->order));
  CHECK(told->request == 3);
  CHECK(told->by->post(encode(Answer{}, 3)).ok());
  CHECK(std::holds_alternative<Answer>(*heard_by(*supervisor)));
}

TEST_CASE("visitors that vanish, talk nonsense or say nothing change nothing", "[supervisor][adoption]") {
  WaitingProcess lonely;
  const std::size_t before = test::open_descriptors();
  for (int i = 0; i < 100; ++i) {
    visitor().reset();
    CHECK_FALSE(lonely.vigil.turn(lonely.now));
  }
  CHECK_FALSE(lonely.vigil.turn(lonely.now));
  for (auto& order : test::all_orders()) {
    const bool is_allowed = std::holds_alternative<Adopt>(order) || std::holds_alternative<TakeDown>(order) ||
                            std::holds_alternative<StopMotors>(order) ||
                            std::holds_alternative<ReleaseMotors>(order);
    const auto other = visitor();
    REQUIRE(other->post(encode(std::move(order), 1)).ok());
    CHECK(lonely.vigil.turn(lonely.now).has_value() == is_allowed);
    if (!is_allowed) CHECK(heard_by(*other));
    if (!is_allowed) CHECK(heard_by(*other).error().code == Code::unavailable);
    lonely.now += Vigil::kPatience;
    CHECK_FALSE(lonely.vigil.turn(lonely.now));
  }
  const auto silent = visitor();
  CHECK_FALSE(lonely.vigil.turn(lonely.now));
  lonely.now += Vigil::kPatience;
  CHECK_FALSE(lonely.vigil.turn(lonely.now));
  CHECK(heard_by(*silent));
  CHECK(heard_by(*silent).error().code == Code::unavailable);
  CHECK(test::open_descriptors() == before + 1);  // the silent one's end
}

TEST_CASE("a second visitor waits until the first is gone", "[supervisor][adoption]") {
  WaitingProcess lonely;
  auto first = visitor();
  CHECK_FALSE(lonely.vigil.turn(lonely.now));
  const auto second = visitor();
  CHECK_FALSE(lonely.vigil.turn(lonely.now));
  CHECK_FALSE(second->receive()->has_value());
  first.reset();
  CHECK_FALSE(lonely.vigil.turn(lonely.now));
  CHECK_FALSE(lonely.vigil.turn(lonely.now));
  CHECK(heard_by(*second));
}
