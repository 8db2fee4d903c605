// SPDX-License-Identifier: GPL-3.0-or-later
// Stops, silence and age, which come before every mode; and the modes that choose instead of blending.
#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include "motion_command_fuser/decide.hpp"
#include "orca/base/random.hpp"

using namespace orca::fuse;
using Catch::Detail::Approx;
using Said = Voice::Said;

namespace {

Rules rules_of(const std::string& mode) {
  return {.mode = mode_of(mode),
          .max_age = 0.5,
          .ballot = {.steer_gain = 1.0,
                     .max_turn_rate = 1.0,
                     .rate_spread = 0.15,
                     .speed_spread = 0.1,
                     .inertia = 0.2},
          .order = {"avoid", "goto"},
          .wiring = {.suppress = {{"avoid", "goto"}}, .inhibit = {}, .max_age = 0.5, .hold = 0.3},
          .required = {}};
}

Voice wishes(const std::string& name, double direction, double weight = 1.0, double age = 0.05) {
  return {name, Said::wish, age, {Wish::Kind::direction, direction, 0.3, weight}, age};
}
Voice has_no_opinion(const std::string& name, double age = 0.05) {
  return {name, Said::dont_care, age, {}, std::numeric_limits<double>::infinity()};
}
Voice must_be_heard(Voice voice) {
  voice.silence_limit = 0.4;
  return voice;
}
Voice stops(const std::string& name, double age = 0.05) {
  return {name, Said::full_stop, age, {}, std::numeric_limits<double>::infinity()};
}

}  // namespace

TEST_CASE("in every mode a fresh full stop wins over whatever else is wished", "[components][fuser]") {
  for (const std::string& mode : kModes) {
    CAPTURE(mode);
    orca::RandomStream random(1, "test", "stop");
    for (int i = 0; i < 50; ++i) {
      std::vector<Voice> voices(1 + random() % 5, wishes("goto", random.uniform(-1, 1), 1000.0));
      voices.insert(voices.begin() + static_cast<long>(random() % (voices.size() + 1)), stops("guard"));
      const Decision decision = decide(voices, rules_of(mode), 0.0);
      CHECK(decision.verdict == Verdict::told_to_stop);
      CHECK(decision.decided_by == "guard");
    }
  }
}

TEST_CASE("in every mode the command moves sideways by the shares of those who wish it",
          "[components][fuser]") {
  for (const std::string& mode : kModes) {
    CAPTURE(mode);
    Voice slides = wishes("avoid", 0.0, 3.0);
    slides.wish = {Wish::Kind::turn_rate, 0.1, 0.1, 3.0, 0.4};
    const std::vector voices{wishes("goto", 0.1, 1.0), slides};
    const Decision decision = decide(voices, rules_of(mode), 0.0);
    REQUIRE(decision.verdict == Verdict::fused);
    CHECK(decision.command.left == Approx(0.4 * decision.shares[1]));
    CHECK(decision.shares[1] > 0.5);
  }
}

TEST_CASE("a vector sum of wishes that cancel out stands, sideways, too", "[components][fuser]") {
  const double pi = 3.14159265358979323846;
  Voice ahead = wishes("goto", 0.0, 1.0);
  Voice back = wishes("avoid", 0.0, 1.0);
  ahead.wish = {Wish::Kind::direction, 0.0, 0.3, 1.0, 0.4};
  back.wish = {Wish::Kind::direction, pi, 0.3, 1.0, 0.4};
  const Decision decision = decide(std::vector{ahead, back}, rules_of("vector_sum"), 0.0);
  CHECK(decision.command.speed == Approx(0.0).margin(1e-9));
  CHECK(decision.command.left == Approx(0.0).margin(1e-9));
}

TEST_CASE("in every mode a command without an opinion or weight, or that is too old, does not count",
          "[components][fuser]") {
  for (const std::string& mode : kModes) {
    CAPTURE(mode);
    const Rules rules = rules_of(mode);
    CHECK(decide({}, rules, 0.0).verdict == Verdict::no_wish);
    const std::vector nothing{has_no_opinion("avoid"), wishes("goto", 0.2, 0.0),
                              wishes("late", 0.2, 1.0, 0.6), stops("dead", 0.6), Voice{.name = "mute"}};
    CHECK(decide(nothing, rules, 0.0).verdict == Verdict::no_wish);
    std::vector one = nothing;
    one.push_back(wishes("walk", 0.3));
    const Decision decision = decide(one, rules, 0.0);
    CHECK(decision.verdict == Verdict::fused);
    CHECK(decision.decided_by == "walk");
    CHECK(decision.command.value == Approx(0.3));
    CHECK(decision.shares == std::vector{0.0, 0.0, 0.0, 0.0, 0.0, 1.0});
  }
}

TEST_CASE("in every mode a behaviour that is silent for longer than its limit stops the robot",
          "[components][fuser]") {
  for (const std::string& mode : kModes) {
    CAPTURE(mode);
    const Rules rules = rules_of(mode);
    const std::vector heard{must_be_heard(has_no_opinion("avoid", 0.39)), wishes("goto", 0.0)};
    CHECK(decide(heard, rules, 0.0).verdict == Verdict::fused);
    for (const Voice& avoid :
         {has_no_opinion("avoid", 0.41), wishes("avoid", 0.0, 1.0, 0.41), Voice{.name = "avoid"}}) {
      const Decision decision = decide(std::vector{wishes("goto", 0.0), must_be_heard(avoid)}, rules, 0.0);
      CHECK(decision.verdict == Verdict::required_silent);
      CHECK(decision.decided_by == "avoid");
      CHECK(decide(std::vector{wishes("goto", 0.0), avoid}, rules, 0.0).verdict == Verdict::fused);
    }
  }
}

TEST_CASE("in every mode a required behaviour that is not listened to stops the robot",
          "[components][fuser]") {
  for (const std::string& mode : kModes) {
    CAPTURE(mode);
    Rules rules = rules_of(mode);
    rules.required = {"avoid"};
    CHECK(decide(std::vector{wishes("goto", 0.0), has_no_opinion("avoid")}, rules, 0.0).verdict ==
          Verdict::fused);
    const Decision decision = decide(std::vector{wishes("goto", 0.0), wishes("other", 0.0)}, rules, 0.0);
    CHECK(decision.verdict == Verdict::required_silent);
    CHECK(decision.decided_by == "avoid");
  }
}

TEST_CASE("in mode priority the first behaviour of the order that has a wish decides alone",
          "[components][fuser]") {
  const Rules rules = rules_of("priority");
  const std::vector both{wishes("goto", 0.0, 5.0), wishes("avoid", 0.7, 0.1)};
  CHECK(decide(both, rules, 0.0).decided_by == "avoid");
  CHECK(decide(both, rules, 0.0).command.value == 0.7);
  CHECK(decide(std::vector{wishes("goto", 0.2), has_no_opinion("avoid")}, rules, 0.0).decided_by == "goto");
  CHECK(decide(std::vector{wishes("walk", 0.1), wishes("goto", 0.2)}, rules, 0.0).decided_by == "goto");
  CHECK(decide(std::vector{wishes("walk", 0.1), wishes("play", 0.2)}, rules, 0.0).decided_by == "walk");
}

TEST_CASE("a suppressing behaviour's wish takes the place of the other's until a while after its last",
          "[components][fuser]") {
  const Rules rules = rules_of("subsumption");
  CHECK(decide(std::vector{wishes("goto", 0.0), wishes("avoid", 0.7)}, rules, 0.0).command.value == 0.7);
  Voice was_avoiding = has_no_opinion("avoid");
  was_avoiding.wish = wishes("avoid", 0.7).wish;
  was_avoiding.wish_age = 0.29;
  CHECK(decide(std::vector{wishes("goto", 0.0), was_avoiding}, rules, 0.0).command.value == 0.7);
  was_avoiding.wish_age = 0.31;
  CHECK(decide(std::vector{wishes("goto", 0.0), was_avoiding}, rules, 0.0).command.value == 0.0);
  CHECK(decide(std::vector{has_no_opinion("goto"), wishes("avoid", 0.7)}, rules, 0.0).decided_by == "avoid");
}

TEST_CASE("suppression goes up through the layers: the highest that has a wish comes out",
          "[components][fuser]") {
  Rules rules = rules_of("subsumption");
  rules.wiring.suppress = {{"escape", "avoid"}, {"avoid", "wander"}};
  const std::vector all{wishes("wander", 0.1), wishes("avoid", 0.2), wishes("escape", 0.3)};
  CHECK(decide(all, rules, 0.0).decided_by == "escape");
  CHECK(decide(std::vector{wishes("wander", 0.1), wishes("avoid", 0.2), has_no_opinion("escape")}, rules, 0.0)
            .decided_by == "avoid");
  CHECK(decide(std::vector{wishes("wander", 0.1), has_no_opinion("avoid"), has_no_opinion("escape")}, rules,
               0.0)
            .decided_by == "wander");
}

TEST_CASE("an inhibiting behaviour silences the other and puts nothing in its place", "[components][fuser]") {
  Rules rules = rules_of("subsumption");
  rules.wiring.suppress = {};
  rules.wiring.inhibit = {{"arm", "goto"}};
  CHECK(decide(std::vector{wishes("goto", 0.2), has_no_opinion("arm")}, rules, 0.0).decided_by == "goto");
  const std::vector both{wishes("goto", 0.2), wishes("arm", 0.0)};
  CHECK(decide(both, rules, 0.0).decided_by == "arm");  // its own line is left
  rules.wiring.inhibit = {{"arm", "goto"}, {"goto", "arm"}};
  CHECK(decide(both, rules, 0.0).verdict == Verdict::no_wish);
}

TEST_CASE("a node of a wiring reads higher > lower, and nothing else", "[components][fuser]") {
  const auto node = parse_node("  avoid >goto ");
  REQUIRE(node);
  CHECK(node->higher == "avoid");
  CHECK(node->lower == "goto");
  for (const char* wrong : {"", "avoid", "avoid >", "> goto", "goto > goto", ">"}) {
    CAPTURE(wrong);
    CHECK_FALSE(parse_node(wrong).has_value());
  }
}
