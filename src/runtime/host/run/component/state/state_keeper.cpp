// SPDX-License-Identifier: LGPL-3.0-or-later
#include "state_keeper.hpp"

#include <utility>

namespace orca::host {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 20;  // of a state, ten times a second to the supervisor

}  // namespace

StateKeeper::StateKeeper(ComponentParts& parts, Residency& residency)
    : parts_(parts),
      hooks_(parts, residency),
      keeps_(parts.settings.keeps_state && parts.run.state_sink != nullptr),
      state_(parts.settings.state) {}

TimePoint StateKeeper::due() const { return has_changed_ ? saturating_add(last_, kInterval) : kForever; }

void StateKeeper::keep() {
  has_changed_ = false;
  last_ = parts_.now();
  if (awaits_restore()) return;  // the state that is kept is still the one to begin with
  Result<KeptState> saved = hooks_.save();
  if (!saved) return give_up(saved.error().text());
  hand_out(std::move(saved).value());
}

void StateKeeper::keep_last() {
  if (parts_.run.state_sink == nullptr) return;
  if (awaits_restore()) return hand_out(*state_);
  Result<KeptState> saved = hooks_.save();
  if (!saved) return give_up(saved.error().text());
  if (!saved->bytes.empty()) hand_out(std::move(saved).value());  // it has one
}

void StateKeeper::hand_out(KeptState saved) {
  if (saved.bytes.size() > kMostBytes)
    return give_up("it takes " + std::to_string(saved.bytes.size()) + " bytes, more than " +
                   std::to_string(kMostBytes));
  if (saved == kept_) return;
  kept_ = std::move(saved);
  parts_.run.state_sink(parts_.settings.name, kept_);
}

void StateKeeper::give_up(const std::string& why) {
  keeps_ = false;
  parts_.write_log(log::Level::warning, "its state is not kept from now on: " + why);
}

Status StateKeeper::restore_early() {
  is_early_ = true;
  return restore();
}

Status StateKeeper::prepare_start() {
  if (!std::exchange(is_early_, false)) return ok();
  Result<KeptState> saved = hooks_.save();
  if (!saved) return saved.error();
  state_ = std::move(saved).value();
  is_restored_ = false;
  return ok();
}

Status StateKeeper::restore() {
  if (std::exchange(is_restored_, true) || !state_) return ok();
  const Result<bool> loaded = hooks_.load(*state_);
  if (!loaded && loaded.error().code != Code::failed_precondition) return loaded.error();
  if (std::exchange(is_told_, true)) return ok();
  if (loaded && *loaded) {
    parts_.write_log(log::Level::info, "goes on from the state " + state_->tag.text() +
                                           " that was kept before its process ended");
  } else {
    parts_.write_log(log::Level::warning,
                     "begins afresh: " + (loaded ? "the state that was kept is " + state_->tag.text()
                                                 : loaded.error().text()));
  }
  return ok();
}

}  // namespace orca::host
