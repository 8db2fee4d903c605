// SPDX-License-Identifier: LGPL-3.0-or-later
#include "state_hooks.hpp"

#include <algorithm>

namespace orca::host {

namespace {

constexpr std::size_t kMostStateBytes = std::size_t{64}
                                        << 20;  // of a state: more would take too long between two laps

}  // namespace

bool can_tell_its_state(ComponentState state) {
  return state == ComponentState::idle || state == ComponentState::work ||
         state == ComponentState::suspended_idle || state == ComponentState::suspended_work;
}

Result<KeptState> StateHooks::save() {
  StateWriter writer;
  const Status saved = call(Hook::save_state, [&] {
    residency_.component()->save_state(writer);
    return ok();
  });
  if (!saved.ok()) return saved.error();
  if (writer.bytes().size() > kMostStateBytes)
    return fail(Code::failed_precondition, "save_state() wrote " + std::to_string(writer.bytes().size()) +
                                               " bytes; a state can have " + std::to_string(kMostStateBytes) +
                                               " at most");
  return KeptState{{residency_.type_name(), residency_.component()->state_version()}, writer.bytes()};
}

Result<bool> StateHooks::load(const KeptState& state) {
  if (state.bytes.empty())
    return false;  // whoever had it kept nothing, as a component without save_state() does
  const StateTag& tag = state.tag;
  if (!accepts(tag)) {
    if (tag.type != residency_.type_name()) return false;
    return fail(Code::failed_precondition, "it cannot read the state " + tag.text() +
                                               ": its own version is " +
                                               std::to_string(residency_.component()->state_version()) +
                                               ", and accepted_states() does not name that one");
  }
  const Status loaded = call(Hook::load_state, [&] {
    StateReader reader(tag, state.bytes);
    const Status read = residency_.component()->load_state(reader);
    return read.ok() ? reader.finish() : read;
  });
  if (!loaded.ok()) return loaded.error();
  return true;
}

bool StateHooks::accepts(const StateTag& tag) const {
  const Component& component = *residency_.component();
  if (tag == StateTag{residency_.type_name(), component.state_version()}) return true;
  const std::vector<StateTag> others = component.accepted_states();
  return std::ranges::find(others, tag) != others.end();
}

}  // namespace orca::host
