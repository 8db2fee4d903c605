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
      keeps_(parts.settings.keeps_state && parts.run.state_sink != nullptr) {}

TimePoint StateKeeper::due() const { return has_changed_ ? saturating_add(last_, kInterval) : kForever; }

void StateKeeper::keep() {
  has_changed_ = false;
  last_ = parts_.now();
  Result<KeptState> saved = hooks_.save();
  if (!saved) return give_up(saved.error().text());
  if (saved->bytes.size() > kMostBytes)
    return give_up("it takes " + std::to_string(saved->bytes.size()) + " bytes, more than " +
                   std::to_string(kMostBytes));
  if (*saved == kept_) return;
  kept_ = std::move(saved).value();
  parts_.run.state_sink(parts_.settings.name, kept_);
}

void StateKeeper::give_up(const std::string& why) {
  keeps_ = false;
  parts_.write_log(log::Level::warning, "its state is not kept from now on: " + why);
}

Status StateKeeper::restore() {
  const std::optional<KeptState>& state = parts_.settings.state;
  if (std::exchange(is_restored_, true) || !state) return ok();
  const Result<bool> loaded = hooks_.load(*state);
  if (!loaded && loaded.error().code != Code::failed_precondition) return loaded.error();
  if (loaded && *loaded) {
    parts_.write_log(log::Level::info, "goes on from the state " + state->tag.text() +
                                           " that was kept before its process was lost");
  } else {
    parts_.write_log(log::Level::warning,
                     "begins afresh: " + (loaded ? "the state that was kept is " + state->tag.text()
                                                 : loaded.error().text()));
  }
  return ok();
}

}  // namespace orca::host
