// SPDX-License-Identifier: LGPL-3.0-or-later
#include "ear.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "orca/idl/checks.hpp"
#include "orca/idl/time.hpp"

namespace orca::fuse {
namespace {

constexpr double kForEver = std::numeric_limits<double>::infinity();

// Returns the time between two commands [s].
double between(const idl::MotionCommand& former, const idl::MotionCommand& later) {
  return to_seconds(to_time_point(later.creation_time()) - to_time_point(former.creation_time()));
}

}  // namespace

void Ear::take(Listened& behaviour, const ObjectPtr<idl::MotionCommand>& newest, double limit) {
  behaviour.talks_nonsense = !senders_.accepts(check_command(newest), "MotionCommand", newest->origin());
  if (behaviour.talks_nonsense) {
    behaviour.reliance.look(kForEver, limit);
    behaviour.last = behaviour.last_wish = {};
    return;
  }
  ask_about(behaviour.name, *newest);
  behaviour.reliance.heard(behaviour.last ? between(*behaviour.last, *newest) : kForEver, limit);
  behaviour.last = newest;
  if (newest->kind() == idl::NORMAL) behaviour.last_wish = newest;
}

void Ear::note_wait(Duration waited) {
  if (waited < 500ms) return;
  const TimePoint now = host_.now();
  if (starved_at_ && now - *starved_at_ < 10s) return;
  starved_at_ = now;
  host_.write_log(log::Level::warning, "the process got no processor for " +
                                           std::to_string(to_seconds(waited)) +
                                           " s: what behaviours said meanwhile is late, and the robot stood");
}

void Ear::ask_about(const std::string& behaviour, const idl::MotionCommand& command) {
  const std::optional<std::string> doubt = doubt_about(command);
  if (doubt && asked_.insert(behaviour).second)
    host_.write_log(log::Level::warning, "the behaviour \"" + behaviour + "\" wishes for " + *doubt);
}

Voice::Said said(const idl::MotionCommand& command) {
  if (command.kind() == idl::FULLSTOP) return Voice::Said::full_stop;
  return command.kind() == idl::NORMAL ? Voice::Said::wish : Voice::Said::dont_care;
}

Wish wish_of(const ObjectPtr<idl::MotionCommand>& command) {
  const double speed = std::clamp(command->speed(), -kFastest, kFastest);
  const double left = std::clamp(sideways_speed(command), -kFastest, kFastest);
  // The direction of a velocity with a sideways part does not count.
  if (command->steering() == idl::BY_DIRECTION && !command.as<idl::HolonomicVelocity>())
    return {Wish::Kind::direction, command->direction(), speed, command->weight(), left};
  return {Wish::Kind::turn_rate, std::clamp(command->turn_rate(), -kFastestTurn, kFastestTurn), speed,
          command->weight(), left};
}

Loan<idl::MotionCommand> command_of(const Decision& decision, double steer_gain) {
  const Wish& wish = decision.command;
  if (decision.verdict != Verdict::fused) return full_stop();
  if (wish.left != 0.0) return slide(wish.speed, wish.left, as_rate(wish, steer_gain), wish.weight);
  if (wish.kind == Wish::Kind::direction) return head(wish.value, wish.speed, wish.weight);
  return turn(wish.value, wish.speed, wish.weight);
}

void describe(const Voice& said, const Listened& behaviour, double share, idl::FusionVoice& voice) {
  const bool heard = said.said != Voice::Said::nothing;
  voice.behaviour() = said.name;
  voice.heard(heard);
  voice.kind(heard ? behaviour.last->kind() : idl::DONTCARE);
  voice.age(heard ? said.age : 0.0);
  voice.weight(said.said == Voice::Said::wish ? said.wish.weight : 0.0);
  voice.share(share);
}

}  // namespace orca::fuse
