// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "orca/base/descriptor.hpp"
#include "orca/plugin/standard_streams.hpp"

namespace orca::plugin {

/// The settings that all code of the process shares and that a library's static initialisation must not change: working
/// folder, umask, locale and what the standard streams have, as they were when the object was made.
///
/// Thread contract: one thread, while no other one changes them.
class SharedSettings {
 public:
  SharedSettings();

  /// Puts back what is different now. Returns what that was, for people: "the working folder", "the umask".
  [[nodiscard]] std::vector<std::string> put_back() const;

 private:
  Descriptor folder_;
  mode_t umask_;
  std::string locale_;
  StandardStreams streams_;
};

}  // namespace orca::plugin
