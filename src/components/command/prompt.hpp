// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

namespace orca::command {

/// A prompt on stderr, and the lines that are typed on stdin. It never waits, so that the component can be stopped meanwhile.
///
/// Thread contract: not synchronised.
class Prompt {
 public:
  /// Writes the prompt, unless it stands there already.
  /// @return whether it could be written.
  bool show();
  /// Lets the next show() write the prompt again, because other lines come below this one. The letters typed so far stay.
  void hide() { shown_ = false; }
  /// Reads what has been typed.
  /// @return whether that is a whole line now, or the end of the input.
  bool read();
  /// Returns the line; empty at the end of the input. A new one begins.
  [[nodiscard]] std::string take_line();

 private:
  bool shown_ = false;
  std::string typed_;
};

}  // namespace orca::command
