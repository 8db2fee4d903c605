// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "orca/base/result.hpp"
#include "orca/host/kept_state.hpp"
#include "run/component/parts/component_parts.hpp"
#include "run/component/parts/component_states.hpp"
#include "run/component/parts/residency.hpp"

namespace orca::host {

/// Returns whether an object can say what its state is: it has neither failed nor been unloaded.
[[nodiscard]] bool can_tell_its_state(ComponentState state);

/// The hooks of one component that return a Status, called so that everything they do is a Status.
///
/// Thread contract: the component's strand.
class StateHooks {
 public:
  StateHooks(ComponentParts& parts, Residency& residency) : parts_(parts), residency_(residency) {}

  /// Calls a function that returns a Status as this hook.
  /// @errors  what it returned; internal with what it threw; unavailable if it was interrupted.
  template <class Body>
  Status call(Hook hook, const Body& body) {
    Status outcome;
    const auto fault = parts_.hooks.call(hook, [&] { outcome = body(); });
    const std::string name = hook_text(hook, "");
    if (fault && fault->interrupted) return fail(Code::unavailable, name + " was interrupted");
    if (fault) return fail(Code::internal, name + " " + fault->text);
    if (!outcome.ok()) return fail(outcome.error().code, name + " said: " + outcome.error().text());
    return ok();
  }

  /// Returns what the object saves. @pre  it is loaded.
  Result<KeptState> save();
  /// Gives the object a state. An empty one is left unread, because there is nothing to go on from; so is that of another
  /// type which the object does not accept.
  /// @return whether the object has it now. @pre  it is loaded.
  /// @errors  failed_precondition, and the object is untouched, if it is a version of its own type that it does not accept.
  Result<bool> load(const KeptState& state);

 private:
  [[nodiscard]] bool accepts(const StateTag& tag) const;

  ComponentParts& parts_;
  Residency& residency_;
};

}  // namespace orca::host
