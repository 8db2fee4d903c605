// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/component/component.hpp"

#include "orca/base/strand.hpp"

namespace orca {

void Component::sleep(Duration time) {
  host_.strand().note_activity();
  host_.strand().wait_for(saturating_add(now(), time), [] { return false; });
}

bool Component::wait_until(const std::function<bool()>& condition, Duration limit) {
  return host_.strand().wait_for(saturating_add(now(), limit), condition);
}

}  // namespace orca
